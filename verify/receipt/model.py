# --- Exact arithmetic: polynomials over Q by SymPy, denominators as products of known factors ---
import re
import sys
from types import SimpleNamespace

from mpmath import iv
from sympy import QQ, Function, Rational, Symbol, factor, ring


class NeedsOmega(Exception):
    pass


FACTORED = {}  # of polynomials that were asked for before


def factors_of(polynomial):
    """Its unit and monic factors with their powers; a long one counts as its only factor.  They are sought in the ring of the
    generators that occur, since SymPy looks at each of the 48."""
    if polynomial not in FACTORED:
        unit, factors = polynomial.LC, [(polynomial.monic(), 1)]
        if len(polynomial) <= 40:
            used = sorted(generators(polynomial))
            small = ring([polynomial.ring.symbols[i] for i in used], QQ)[0]
            few = small.from_dict({tuple(m[i] for i in used): c for m, c in polynomial.terms()}) if used else None
            unit, factors = few.factor_list() if used else (polynomial.LC, [])
            whole = [(polynomial.ring.from_dict({spread(m, used, polynomial.ring.ngens): c for m, c in f.terms()}), k)
                     for f, k in factors]
            for f, k in whole:
                unit *= f.LC**k
            factors = [(f.monic(), k) for f, k in whole]
        FACTORED[polynomial] = unit, factors
    return FACTORED[polynomial]


def spread(exponents, places, n):
    out = [0] * n
    for i, k in zip(places, exponents):
        out[i] = k
    return tuple(out)


def by_power(polynomial, i):
    """Its coefficients as one in generator i."""
    out = {}
    for m, c in polynomial.terms():
        out.setdefault(m[i], {})[m[:i] + (0,) + m[i + 1:]] = c
    return {k: polynomial.ring.from_dict(terms) for k, terms in out.items()}


def quotient(polynomial, factor):
    """None where a rest is left: by the powers of one generator and so on, up to the first that is not divided."""
    if factor.is_ground:
        return polynomial * (QQ(1) / factor.LC)
    i = min(generators(factor))
    low, rest, out = by_power(factor, i), by_power(polynomial, i), polynomial.ring.zero
    top = max(low)
    highest = low.pop(top)
    for k in range(max(rest, default=0), top - 1, -1):
        share = quotient(rest.pop(k, out.ring.zero), highest)
        if share is None:
            return None
        out += share * out.ring.gens[i] ** (k - top)
        for j, c in low.items():
            rest[k - top + j] = rest.get(k - top + j, out.ring.zero) - share * c
    return None if any(rest.values()) else out


class Number:
    """num / product of factor^power; never cancelled completely, zero exactly when num is."""

    def __init__(self, num, den=None, shared=()):
        """Cancels the shared factors."""
        self.num, self.den = num, {} if num == 0 else dict(den or {})
        for factor in [f for f in shared if f in self.den and len(f) <= 12 and len(num) <= 2000]:
            while self.den[factor] and (less := quotient(self.num, factor)) is not None:
                self.num, self.den[factor] = less, self.den[factor] - 1
        self.den = {f: k for f, k in self.den.items() if k}

    def times_missing(self, den):
        num = self.num
        for factor, k in den.items():
            for _ in range(k - self.den.get(factor, 0)):
                num = num * factor
        return num

    def __add__(self, other):
        """Only a factor that both have to the same power can divide the sum."""
        den = {f: max(self.den.get(f, 0), other.den.get(f, 0)) for f in {**self.den, **other.den}}
        shared = [f for f, k in self.den.items() if other.den.get(f) == k]
        return Number(self.times_missing(den) + other.times_missing(den), den, shared)

    def __neg__(self):
        return Number(-self.num, self.den)

    def __sub__(self, other):
        return self + (-other)

    def __mul__(self, other):
        """Only what divides the one and stands under the other cancels."""
        a, b = Number(self.num, other.den, other.den), Number(other.num, self.den, self.den)
        return Number(a.num * b.num, {f: a.den.get(f, 0) + b.den.get(f, 0) for f in {**a.den, **b.den}})

    def inverse(self):
        assert self.num != 0, "division by zero"
        num, den = self.num.ring.one, {}
        for factor, k in self.den.items():
            num = num * factor**k
        unit, factors = factors_of(self.num)
        for factor, k in factors:
            den[factor] = den.get(factor, 0) + k
        return Number(num * (QQ(1) / unit), den)

    def __truediv__(self, other):
        return self * other.inverse()

    def __pow__(self, n):
        out = Number(self.num.ring.one)
        for _ in range(abs(n)):
            out = out * self
        return out.inverse() if n < 0 else out

    def is_zero(self):
        return self.num == 0


class Field:
    """Free generators; chi and eta by the frequencies, sines and cosines by half-angle tangents, or free of each other:
    what is an identity then is one on the circle."""

    def __init__(self, modes, fixed, with_omega, off_circle):
        self.ring, *self.pool = ring(["g%d" % i for i in range(48)], QQ)
        self.names, self.angles, self.roots = {}, [], []
        self.modes, self.off_circle = modes, off_circle
        one = self.one = self.number(1)
        two = self.number(2)
        if modes:
            w1, p = self.symbol("w_1"), self.symbol("w_2")
            self.w, self.omega = [w1, p], None
            if with_omega:  # omega^2 = w_1^2 + w_2^2 - 1: (omega - w_2)(omega + w_2) = (w_1 - 1)(w_1 + 1)
                low, high = p * (w1 - one), (w1 + one) / p
                self.w, self.omega = [w1, (high - low) / two], (high + low) / two
            a, b = self.w[0] * self.w[0], self.w[1] * self.w[1]
            stiff = a + b - one
            self.chi = (one - a) * (b - one) / stiff
            self.eta = stiff / self.chi
            self.check_frequencies()
        else:
            self.chi, self.omega = self.symbol("chi"), self.symbol("omega")
            self.eta = self.omega * self.omega / self.chi
        self.V = self.number(fixed["V"]) if "V" in fixed else self.symbol("V")

    def check_frequencies(self):
        a = self.system("H")
        for w in self.w:
            k11, k22 = -a[2][0] - w * w, -a[3][1] - w * w
            assert (k11 * k22 - a[2][1] * a[3][0]).is_zero()

    def number(self, q):
        return Number(self.ring.ground_new(QQ(*map(int, str(q).split("/")))))

    def symbol(self, name):
        if name not in self.names:
            self.names[name] = Number(self.pool[len(self.names)])
        return self.names[name]

    def sin_cos(self, angle):
        if angle.is_zero():
            return self.number(0), self.one
        for known, sine, cosine in self.angles:
            if (known - angle).is_zero():
                return sine, cosine
            if (known + angle).is_zero():
                return -sine, cosine
        h = self.symbol("half-angle %d" % len(self.angles))
        if self.off_circle:
            sine, cosine = h, self.symbol("cosine %d" % len(self.angles))
        else:
            square = self.one + h * h
            sine, cosine = self.number(2) * h / square, (self.one - h * h) / square
        self.angles.append((angle, sine, cosine))
        return sine, cosine

    def written(self, e, n=None):
        """In the names of the symbols, with sines and cosines of the first n angles."""
        angles, names = self.angles[:n], {}
        for name, symbol in self.names.items():
            names.update({i: name for i in generators(symbol.num)})
        for k, (angle, sine, cosine) in enumerate(angles):
            for word, of in ("sin", sine), ("cos", cosine):
                names.update({i: "%s(%s)" % (word, self.written(angle, k)) for i in generators(of.num)})
        symbols = {self.ring.symbols[i]: Symbol(name) for i, name in names.items()}
        out = e.num.as_expr().xreplace(symbols)
        for part, k in e.den.items():
            out /= part.as_expr().xreplace(symbols) ** k
        return factor(out)

    def sin(self, x):
        return self.sin_cos(x)[0]

    def cos(self, x):
        return self.sin_cos(x)[1]

    def cot(self, x):
        sine, cosine = self.sin_cos(x)
        return cosine / sine

    def sinc(self, x):
        return self.one if x.is_zero() else self.sin(x) / x

    def stumpff(self, x):
        return self.number("1/6") if x.is_zero() else (x - self.sin(x)) / (x * x * x)

    def hypot(self, x, y):
        return self.sqrt(x * x + y * y)

    def root_omega(self):
        if self.omega is None:
            raise NeedsOmega
        return self.omega

    def sqrt(self, x):
        """Of another element than chi eta: free, so that what is an identity does not use its square."""
        if (x - self.chi * self.eta).is_zero():
            return self.root_omega()
        for known, value in self.roots:
            if (known - x).is_zero():
                return value
        self.roots.append((x, self.symbol("root %d" % len(self.roots))))
        return self.roots[-1][1]

    def abs(self, x):
        return self.sqrt(x * x)

    def root(self, largest, *c):
        """The positive roots of an even polynomial of degree 4 that has w_1 < w_2 among its roots."""
        assert len(c) == 5 and c[1].is_zero() and c[3].is_zero()
        for w in self.w:
            assert (c[0] + c[2] * w * w + c[4] * w * w * w * w).is_zero()
        return self.w[1 if largest else 0]

    def system(self, phase):
        values = {"chi": self.chi, "eta": self.eta}
        return [[self.read(e, values) for e in row] for row in SYSTEM[phase]]

    def read(self, text, values):
        """Sums of products of chi and eta, as the program prints the entries of A."""
        total = self.number(0)
        for sign, term in re.findall(r"([+-]?)([^+-]+)", text):
            product = self.number(1)
            for factor in term.split("*"):
                product = product * (values[factor] if factor in values else self.number(factor))
            total = total - product if sign == "-" else total + product
        return total

    def propagator(self, phase, u):
        """exp(A u) = sum f_i F_i + g_i G_i with f_i = cos(w_i u), g_i = sin(w_i u)/w_i."""
        a, zero = self.system(phase), self.number(0)
        if phase == "H" and not self.modes:
            raise AssertionError("phase H needs its frequencies")
        w = {"D": [zero], "Gamma": [self.one, zero], "H": getattr(self, "w", None), "C": [None, zero]}[phase]
        if phase == "C":
            w = [self.root_omega(), zero]
        identity = [[self.one if i == j else zero for j in range(4)] for i in range(4)]
        minus = [[-e for e in row] for row in product(a, a)]
        out, total = [[zero] * 4 for _ in range(4)], [[zero] * 4 for _ in range(4)]
        for i, wi in enumerate(w):
            share = identity
            for k, wk in enumerate(w):
                if k != i:
                    over = (wi * wi - wk * wk).inverse()
                    share = product(share, [[(minus[r][c] - wk * wk * identity[r][c]) * over for c in range(4)] for r in range(4)])
            slope = product(a, share)
            # f' = -w^2 g and g' = f: P' = A P asks for A F = G and A G = -w^2 F
            assert all((x + wi * wi * y).is_zero() for r, s in zip(product(a, slope), share) for x, y in zip(r, s))
            f, g = self.one, u
            if not wi.is_zero():
                sine, f = self.sin_cos(wi * u)
                g = sine / wi
            out = [[out[r][c] + f * share[r][c] + g * slope[r][c] for c in range(4)] for r in range(4)]
            total = [[total[r][c] + share[r][c] for c in range(4)] for r in range(4)]
        assert all((total[r][c] - identity[r][c]).is_zero() for r in range(4) for c in range(4))  # P(0) = I
        return out


def product(a, b):
    out = []
    for row in a:
        line = []
        for c in range(len(b[0])):
            total = row[0] * b[0][c]
            for k in range(1, len(b)):
                total = total + row[k] * b[k][c]
            line.append(total)
        out.append(line)
    return out


def apply(a, v):
    return [row[0] for row in product(a, [[x] for x in v])]


# --- Motions of the word D, Gamma, H, C ---

PHASES = ["D", "Gamma", "H", "C"]
TIMES = ["t_a", "t_b", "t_c", "t_d"]
ENDS = [
    (["z_10", "z_20", None, None], ["x", "y", None, None], None, [2, 3]),
    ([None, "z_2a", None, None], [None, "y_a", None, None], 0, [2, 3]),
    (["z_1b", None, "z'_1b", None], ["x_b", None, "u_b", None], 1, [3]),
    (["z_1c", "z_2c", None, "z'_2c"], ["x_c", "y_c", None, "v_c"], 2, []),
    (["z_1f", "z_2f", None, None], ["x_f", "y_f", None, None], 3, [2]),
]
# what the paper's local Jacobians take in (columns, c for chi) and keep
CORNERS = {
    "J_a": (["1000", "0100"], [1]),
    "J_b": (["c100"], [1, 2]),
    "J_c": (["1100", "0010"], [0, 1, 3]),
    "J_f": (["1000", "0100", "0001"], [0, 1]),
}


class Motion:
    def __init__(self, part, attempt, with_omega, off_circle):
        self.part = part
        modes, self.anchor, self.tangents, self.at_end = attempt
        self.f = Field(modes, part["fixed"], with_omega, off_circle)
        self.limits = [self.f.symbol("e_1"), self.f.symbol("e_2")]
        self.patched = part["kind"] == "patched"  # any state, carried through the phases without events
        self.word = self.patched or part["kind"] in ("arcs", "orbits")
        self.periodic = part["kind"] == "orbits"
        self.states, self.small, self.shifts = {}, {}, {}
        self.last = PHASES.index(part["phase"]) + (self.at_end == 2)  # switch before the time t, or at it
        self.first_state, self.first_small = self.earliest(part["reads"])

    def earliest(self, names):
        states, small = [4], [4]
        for name in names:
            m = re.fullmatch(r"z'?_[12]([0abc])0?", name)
            if m:
                states.append("0abc".index(m[1]))
            m = re.fullmatch(r"[xyuv](?:_([abcf]))?", name)
            if m:
                small.append("abcf".index(m[1]) + 1 if m[1] else 0)
            m = re.fullmatch(r"dt_([abcd])", name)
            if m:
                small.append("abcd".index(m[1]))
                states.append("abcd".index(m[1]))
            if "[" in name:
                states.append(0)
            m = re.fullmatch(r"[xz]_[12]'*\((.*)\)", name)
            if m:
                k = self.end_of(m[1])
                k = self.last if k is None else k[0]
                states.append(k)
                if self.part["finite"]:
                    small.append(k)
        return min(states), min(small)

    @staticmethod
    def end_of(argument):
        if argument == "0":
            return 0, False
        for k in range(1, 5):
            if argument == " + ".join(TIMES[:k]):
                return k, False
            if argument == " + ".join(t + " + d" + t for t in TIMES[:k]):
                return k, True
        return None

    def length(self, phase):
        return self.f.symbol(TIMES[phase])

    def switching(self, phase, z, linear=False):
        f = self.f
        w, r = z[0] - f.chi * z[1], f.chi * (z[1] - z[0])
        value = [w, r, z[2], z[3]][phase]
        return value if linear else value - [self.limits[0], self.limits[1], f.V, f.V][phase]

    def rate(self, phase, z):
        return apply(self.f.system(PHASES[phase]), z)

    def free_end(self, k, small):
        if self.patched and not small:
            return [self.f.symbol("Z%d[%d]" % (k, i + 1)) for i in range(4)]
        names, small_names, decided, sticking = ENDS[k]
        zero = self.f.number(0)
        v = [self.f.symbol(n) if n else zero for n in (small_names if small else names)]
        for i in sticking:
            v[i] = zero if small else self.f.V
        if decided is None:
            return v
        v[decided] = zero
        low = self.switching(k - 1, v, small)
        v[decided] = self.f.one
        slope = self.switching(k - 1, v, small) - low
        v[decided] = -(low / slope)
        return v

    def any_tangent(self, k):
        """Any numbers, but zero where a mass sticks in the phase before: its velocity is constant there, the belt's."""
        v = [self.f.symbol(c + ("_" + "abcf"[k - 1] if k else "")) for c in "xyuv"]
        rows = self.f.system(PHASES[k - 1])[2:] if k else []
        for i, row in enumerate(rows):
            if all(e.is_zero() for e in row):
                v[2 + i] = self.f.number(0)
        return v

    def state(self, k):
        k = 0 if k == 4 and self.periodic else k
        if k not in self.states:
            if k <= self.anchor or k <= self.first_state or (k == 0 and self.periodic):
                self.states[k] = self.free_end(k, False)
            elif k == 3 and self.anchor < 0:  # back through phase C from the start of the next period
                self.states[k] = apply(self.f.propagator("C", -self.length(3)), self.state(4))
            else:
                z = apply(self.f.propagator(PHASES[k - 1], self.length(k - 1)), self.state(k - 1))
                self.states[k] = z
                if k in (1, 2) and not self.patched:
                    self.limits[k - 1] = self.switching(k - 1, z, True)
        return self.states[k]

    def delay(self, k, dz):
        z = self.state(k)
        n_f = self.switching(k - 1, self.rate(k - 1, z), True)
        return -(self.switching(k - 1, dz, True) / n_f)

    def tangent(self, k):
        if k in self.small:
            return self.small[k]
        f = self.f
        if k > 0:
            self.shifts[k - 1] = f.symbol("d" + TIMES[k - 1])
        if self.patched:
            self.small[k] = self.any_tangent(k)
        elif self.tangents == 0 or k <= self.first_small:
            self.small[k] = self.free_end(k, True)
        elif self.part["finite"]:
            start = [a + b for a, b in zip(self.state(k - 1), self.tangent(k - 1))]
            longer = f.propagator(PHASES[k - 1], self.length(k - 1) + self.shifts[k - 1])
            self.small[k] = [a - b for a, b in zip(apply(longer, start), self.state(k))]
        else:
            carried = apply(f.propagator(PHASES[k - 1], self.length(k - 1)), self.tangent(k - 1))
            if self.tangents == 2:
                self.shifts[k - 1] = self.delay(k, carried)
            rate = self.rate(k - 1, self.state(k))
            self.small[k] = [a + b * self.shifts[k - 1] for a, b in zip(carried, rate)]
        return self.small[k]

    def some_state(self, k, perturbed):
        z = self.state(k)
        return [a + b for a, b in zip(z, self.tangent(k))] if perturbed else z

    def time(self):
        if not self.word:
            return self.f.symbol("t")
        t = self.f.number(0) if self.at_end else self.f.symbol("tau")
        for k in range(self.last):
            t = t + self.length(k)
            if self.part["finite"]:
                self.tangent(k + 1)
                t = t + self.shifts[k]
        return t

    def now(self, second):
        phase = self.part["phase"]
        if self.word:
            z, u = self.some_state(self.last, self.part["finite"]), self.f.symbol("tau")
            u = self.f.number(0) if self.at_end else u
        else:
            z, u = [self.f.symbol(n) for n in ("z_1(0)", "z_2(0)", "z_1'(0)", "z_2'(0)")], self.f.symbol("t")
        z = apply(self.f.propagator(phase, u), z)
        return self.rate(PHASES.index(phase), z) if second else z

    def positive(self):
        """chi, eta, V, 1 - chi and, inside a phase, the time since its start and the time to its end."""
        f = self.f
        if f.modes:
            return []
        out = [f.chi, f.omega, f.V, f.one - f.chi]
        if self.word and not self.part["finite"] and not self.at_end:
            out += [f.symbol("tau"), self.length(PHASES.index(self.part["phase"])) - f.symbol("tau")]
        return [x.num for x in out]

    def law(self):
        """What Coulomb's law asks in the phase: V - z_i' of a mass that slips; u_ri - f_i of one that sticks under the
        force f_i and, where the friction is known, u_ri + f_i, now and where the phase begins."""
        if not self.part["law"] or self.at_end:
            return []
        k, now = PHASES.index(self.part["phase"]), self.now(False)
        out = []
        for mass in range(2):
            if k in ([1, 2], [2, 3])[mass]:
                out.append(self.f.V - now[2 + mass])
                continue
            for z in (now, self.state(k)):
                force = self.f.chi * (z[1] - z[0]) if mass else z[0] - self.f.chi * z[1]
                out.append(self.limit(mass) - force)
                if self.part["law"] == "realistic":
                    twice = self.f.number(2) * self.f.symbol("u_s%d" % (mass + 1))
                    out.append(self.limit(mass) + twice + force)
        return out

    def motion(self, m):
        letter, mass, primes, argument = m[1], int(m[2]) - 1, len(m[3]), m[4]
        if self.part["kind"] == "flow" and argument == "0":
            return self.f.symbol("z_%d%s(0)" % (mass + 1, m[3]))
        if argument == "t":
            z = self.now(primes == 2)
        else:
            k, perturbed = self.end_of(argument)
            assert self.part["finite"] or not perturbed, "no other motion is declared"
            z = self.some_state(k, perturbed)
        value = z[mass + (2 if primes else 0)]
        return value + self.equilibrium(mass) if letter == "x" and primes == 0 else value

    def equilibrium(self, mass):
        """K d = (u_s1, eta u_s2)."""
        a = self.f.system("H")
        k = [[-a[2][0], -a[2][1]], [-a[3][0], -a[3][1]]]
        b = [self.f.symbol("u_s1"), self.f.eta * self.f.symbol("u_s2")]
        det = k[0][0] * k[1][1] - k[0][1] * k[1][0]
        return [b[0] * k[1][1] - b[1] * k[0][1], b[1] * k[0][0] - b[0] * k[1][0]][mass] / det

    def block(self, name):
        """The blocks and springs behind (1): the stiffness of all springs and the mass of the second block are free, chi
        is the part of the second spring, the first block alone turns once in the unit of time; a mass that slips has the
        friction u_s, one that sticks that which keeps it on the belt."""
        f, one = self.f, self.f.one
        stiffness, m2 = f.symbol("stiffness"), f.symbol("m_2")
        fixed = {"k_1": (one - f.chi) * stiffness, "k_2": f.chi * stiffness, "m_1": f.eta * m2, "m_2": m2}
        if name in fixed:
            return fixed[name]
        if name == "omega_3":
            return f.sqrt(stiffness / fixed["m_1"])
        if name == "t_prime":
            return f.symbol("t") / f.sqrt(stiffness / fixed["m_1"])
        mass = int(name[2]) - 1
        if self.part["phase"] in (["Gamma", "H"], ["H", "C"])[mass]:
            u = f.symbol("u_s" + name[2])
        else:
            z = self.now(False)
            x = [z[i] + self.equilibrium(i) for i in range(2)]
            u = f.chi * (x[1] - x[0]) if mass else x[0] - f.chi * x[1]
        return u * stiffness if name[0] == "F" else u

    def limit(self, i):
        if self.word and max(self.anchor, self.first_state) < i + 1:
            self.state(i + 1)
        return self.limits[i]

    def __call__(self, name):
        f = self.f
        if name in ("chi", "eta", "V"):
            return getattr(f, name)
        if name in ("e_1", "e_2"):
            return self.limit(int(name[2]) - 1)
        if name in ("u_r1", "u_r2"):
            return self.limit(int(name[3]) - 1) + f.symbol("u_s" + name[3])
        if name in ("u_s1", "u_s2", "lambda"):
            return f.symbol(name)
        if name == "t":
            return self.time()
        if "[" in name:
            return self.entry(name)
        if re.fullmatch(r"[uFkm]_[12]|omega_3|t_prime", name):
            return self.block(name)
        m = re.fullmatch(r"[xz]_[12]'*\(.*\)", name)
        if m:
            return self.motion(re.fullmatch(r"([xz])_([12])('*)\((.*)\)", name))
        if name in TIMES:
            return f.symbol(name)
        if self.periodic and name in ("z_100", "z_200"):
            return self.state(0)[int(name[2]) - 1]
        m = re.fullmatch(r"z('?)_([12])([0abc])", name)
        if m:
            return self.state("0abc".index(m[3]))[int(m[2]) - 1 + 2 * len(m[1])]
        m = re.fullmatch(r"dt_([abcd])", name)
        if m:
            self.tangent("abcd".index(m[1]) + 1)
            return self.shifts["abcd".index(m[1])]
        m = re.fullmatch(r"([xyuv])(?:_([abcf]))?", name)
        return self.tangent("abcf".index(m[2]) + 1 if m[2] else 0)["xyuv".index(m[1])]

    def entry(self, name):
        m = re.fullmatch(r"S_([abc])\[(\d),1\]", name)
        if m and self.word:  # a state in which two phases meet
            return self.state("0abc".index(m[1]))[int(m[2]) - 1]
        m = re.fullmatch(r"N\[(\d),3\]", name)
        if not (m and self.periodic):
            return self.f.symbol(name)
        z, row = self.state(0), int(m[1])  # N Z_0 = Z_0
        value = z[row - 1]
        for j in (1, 2, 4):
            value = value - self.f.symbol("N[%d,%d]" % (row, j)) * z[j - 1]
        return value / z[2]

    # --- the model's matrices ---

    def local_jacobian(self, phase):
        """(I - f n^T/(n f)) P."""
        p = self.f.propagator(PHASES[phase], self.length(phase))
        rate = self.rate(phase, self.state(phase + 1))
        columns = []
        for c in range(4):
            v = [p[r][c] for r in range(4)]
            dt = self.delay(phase + 1, v)
            columns.append([a + b * dt for a, b in zip(v, rate)])
        return [[columns[c][r] for c in range(4)] for r in range(4)]

    def direction(self, code):
        return [{"0": self.f.number(0), "1": self.f.one, "c": self.f.chi}[e] for e in code]

    def corner(self, name):
        columns, keep = CORNERS[name]
        jacobian = self.local_jacobian(list(CORNERS).index(name))
        images = [apply(jacobian, self.direction(c)) for c in columns]
        return [[image[r] for image in images] for r in keep], images

    def return_jacobian(self):
        """Each phase carries the columns of its corner to those of the next: then J is the product of the corners."""
        names, total = list(CORNERS), None
        for name, after in zip(names, names[1:] + [None]):
            columns, keep = CORNERS[name]
            if after:
                corner, images = self.corner(name)
                for c, image in enumerate(images):
                    for r, code in enumerate(CORNERS[after][0]):
                        image = [a - corner[r][c] * b for a, b in zip(image, self.direction(code))]
                    assert all(e.is_zero() for e in image), "the corners do not fit together"
            unknown = [[self.f.symbol("%s[%d,%d]" % (name, r + 1, c + 1)) for c in range(len(columns))] for r in range(len(keep))]
            total = product(unknown, total) if total else unknown
        return total

    def oracle(self, name):
        f = self.f
        if name in ("K", "K_1", "K_2"):
            a = f.system({"K": "H", "K_1": "Gamma", "K_2": "C"}[name])
            return [[-a[2 + r][c] for c in range(2)] for r in range(2)]
        if name in ("d_01", "d_02"):
            return [[self.equilibrium(int(name[3]) - 1)]]
        if name in ("omega_1", "omega_2"):
            return [[f.w[int(name[6]) - 1]]]
        if name in CORNERS:
            return self.corner(name)[0]
        if name.startswith("S_"):
            return [[e] for e in self.state("0abc".index(name[2]))]
        if name.startswith("dZ_"):
            return [[e] for e in self.tangent("0abcf".index(name[3]))]
        if name == "J":
            return self.return_jacobian()
        if name == "N":
            total = None
            for k, phase in enumerate(PHASES):
                p = f.propagator(phase, self.length(k))
                total = product(p, total) if total else p
            return total
        return f.propagator(name.split("(")[0], f.symbol("t"))


# --- The proof ---


def generators(polynomial):
    return {i for exponents in polynomial.monoms() for i, k in enumerate(exponents) if k}


def reader(values, f, x):
    """Gives each value of a part, worked out once."""
    known = {}

    def value(k):
        if k not in known:
            known[k] = code[k]()
        return known[k]

    code = values(f, x, value)
    return value


def named(f):
    """The parameters, and what else is named as a free symbol."""
    return lambda name: getattr(f, name) if name in ("chi", "eta", "V") else f.symbol(name)


def differences(part, entries, motion):
    """What the sides of these entries differ by."""
    value, n = reader(part["values"], motion.f, motion), len(part["by"])
    right = [e for row in motion.oracle(part["oracle"]) for e in row] if part["oracle"] else None
    left = part["sides"]
    return [(i, value(left[i]) - (right[i] if right else value(left[n + i]))) for i in entries]


def unequal(part, entries, attempt, with_omega, off_circle):
    """The entries among these whose sides differ."""
    motion = Motion(part, attempt, with_omega, off_circle)
    return [i for i, d in differences(part, entries, motion) if not holds(motion, part["relations"][i], d)]


def holds(motion, relation, difference):
    if relation == "=":
        return difference.is_zero()
    margin, positive = -difference if relation == "<" else difference, motion.positive()
    if product_sign(margin, positive) > 0:
        return True
    f = motion.f
    rests = (margin - factor * x for x in motion.law() for factor in (f.one, f.chi, f.number(2), f.number("1/2")))
    return any(rest.is_zero() or product_sign(rest, positive) > 0 for rest in rests)


def terms_sign(p, sure):
    """The sign of all terms, over positive generators (sure) and squares of others, if one is over the former alone."""
    signs = {1 if c > 0 else -1 for c in p.coeffs()}
    others = [[k for i, k in enumerate(exponents) if k and i not in sure] for exponents in p.monoms()]
    squares = all(k % 2 == 0 for powers in others for k in powers)
    return signs.pop() if len(signs) == 1 and squares and [] in others else 0


def product_sign(x, positive):
    """The sign of powers of positive polynomials times polynomials that have one by their terms; else 0."""
    sure = {min(generators(p)) for p in positive if p.is_generator}
    sign = 1
    for rest in [x.num, *x.den]:
        for factor in positive:
            while rest and generators(factor) and (less := quotient(rest, factor)) is not None:
                rest = less
        sign *= terms_sign(rest, sure)
    return sign


def prove(part, entries, attempt):
    for off_circle in (True, False):
        try:
            entries = unequal(part, entries, attempt, False, off_circle)
        except NeedsOmega:
            entries = unequal(part, entries, attempt, True, off_circle)
        if not entries:
            return
    raise AssertionError("%s: entry %d is not an identity" % (CLAIM, entries[0] + 1))


def disprove(part, entries, attempt):
    """Says what is printed less what is right; how many entries are wrong."""
    wrong = unequal(part, entries, attempt, False, False)
    motion = Motion(part, attempt, False, True)
    for i, d in differences(part, wrong, motion):
        print("entry %d of %d, as printed less that of %s: %s" % (
            i + 1, len(part["by"]), part["oracle"], motion.f.written(d)))
    return len(wrong)


def rank(matrix):
    """Elimination with every symbol free; a pivot is a number times powers of chi, eta and V, so it is nowhere zero."""
    f = Field(False, {}, False, False)
    value = reader(matrix["values"], f, named(f))

    def is_unit(e):
        positive = generators(f.chi.num) | generators(f.omega.num) | generators(f.V.num)
        return not e.is_zero() and all(len(p) == 1 and generators(p) <= positive for p in [e.num, *e.den])

    rows, pivots = [[value(k) for k in row] for row in matrix["rows"]], 0
    while True:
        found = [(i, c) for i, row in enumerate(rows) for c, e in enumerate(row) if is_unit(e)]
        if not found:
            break
        i, c = found[0]
        top, pivots = rows.pop(i), pivots + 1
        rows = [[a - row[c] / top[c] * b for a, b in zip(row, top)] for row in rows]
    assert all(e.is_zero() for row in rows for e in row), "%s: entries are left that may be zero or not" % CLAIM
    return pivots


# --- Ranks but for exceptions ---
#
# On the connected domain the equations are quotients of analytic functions, and so is every minor of their derivatives:
# one that is not zero at one point is zero on no open set.


class Analytic:
    """A function: its value and derivatives at a point, in intervals; itself in the field; whole: no quotient."""

    def __init__(self, value, slopes, exact, whole=True):
        self.value, self.slopes, self.exact, self.whole = value, slopes, exact, whole

    def __add__(self, other):
        return Analytic(self.value + other.value, [a + b for a, b in zip(self.slopes, other.slopes)],
                        lambda: self.exact() + other.exact(), self.whole and other.whole)

    def __neg__(self):
        return Analytic(-self.value, [-a for a in self.slopes], lambda: -self.exact(), self.whole)

    def __sub__(self, other):
        return self + (-other)

    def __mul__(self, other):
        return Analytic(self.value * other.value,
                        [a * other.value + b * self.value for a, b in zip(self.slopes, other.slopes)],
                        lambda: self.exact() * other.exact(), self.whole and other.whole)

    def __truediv__(self, other):
        over = 1 / other.value
        return self * Analytic(over, [-a * over**2 for a in other.slopes], lambda: other.exact().inverse(), False)

    def __pow__(self, n):
        out = self
        for _ in range(abs(n) - 1):
            out = out * self
        return out if n > 0 else out / (out * out)


class Point:
    def __init__(self, unknowns):
        self.unknowns, self.field, self.symbols = unknowns, Field(True, {}, False, False), []

    def number(self, q):
        p, _, over = q.partition("/")
        return Analytic(iv.mpf(p) / iv.mpf(over or "1"), [0] * len(self.unknowns), lambda: self.field.number(q))

    def symbol(self, name):
        """Some number between 0 and 1."""
        if name not in self.symbols:
            self.symbols.append(name)
        k, f = self.symbols.index(name), self.field
        return Analytic(iv.mpf(2 * k + 3) / (3 * k + 5), [int(name == u) for u in self.unknowns],
                        lambda: {"chi": f.chi, "eta": f.eta, "V": f.V}.get(name) or f.symbol(name))

    def sin(self, x, turn=0):
        assert x.whole, "a sine of a quotient"
        value, slope = [(iv.sin(x.value), iv.cos(x.value)), (iv.cos(x.value), -iv.sin(x.value))][turn]
        return Analytic(value, [a * slope for a in x.slopes], None)

    def cos(self, x):
        return self.sin(x, 1)

    def cot(self, x):
        return self.cos(x) / self.sin(x)

    def sqrt(self, x):
        assert (x.exact() - self.field.chi * self.field.eta).is_zero(), "a root that may be branched"
        assert all(a == 0 for a in x.slopes)
        return Analytic(iv.sqrt(x.value), x.slopes, self.field.root_omega)

    def root(self, largest, *c):
        """A frequency: 0 < w_1 < w_2 are simple roots."""
        exact = self.field.root(largest, *[a.exact() for a in c])
        assert all(b == 0 for a in c for b in a.slopes)
        spread = iv.sqrt(c[2].value**2 - 4 * c[0].value * c[4].value)
        square = (-c[2].value + (spread if largest else -spread)) / (2 * c[4].value)
        return Analytic(iv.sqrt(square), c[0].slopes, lambda: exact)


def pivots(rows):
    """How many elimination in intervals finds that are certainly not zero: a minor of that order is not."""
    n = 0
    while True:
        found = [(min(abs(e.a), abs(e.b)), i, c) for i, row in enumerate(rows) for c, e in enumerate(row) if 0 not in e]
        if not found:
            return n
        _, i, c = max(found)
        top, n = rows.pop(i), n + 1
        rows = [[0 * a if k == c else a - row[c] / top[c] * b for k, (a, b) in enumerate(zip(row, top))]
                for row in rows]


def generic_rank(values, equations, unknowns):
    """No more than the unknowns, and the equations that are not others again; no less than the rank at some point."""
    point = Point(unknowns)
    at_point = list(map(reader(values, point, point.symbol), equations))
    least = pivots([[e + iv.mpf(0) for e in a.slopes] for a in at_point])
    names = {name: Function(name) for name in ("sin", "cos", "cot", "sqrt", "root")}
    exact = reader(values, SimpleNamespace(number=Rational, **names), Symbol)

    def again(i, k):
        """Equation i is k or its negative; not where their values at the point differ, which spares the algebra."""
        return any(0 in at_point[i].value - sign * at_point[k].value
                   and (exact(equations[i]) - sign * exact(equations[k])).expand() == 0 for sign in (1, -1))

    most = min(sum(not any(again(i, k) for k in range(i)) for i in range(len(equations))), len(unknowns))
    assert least == most, "%s: the rank may be %d or more" % (CLAIM, least)
    return least


# --- What is divided by, and how each phase ends ---


def free_motion(anchor=4, modes=False):
    """Of the whole word, its states free but for the events that they are at."""
    part = {"fixed": {}, "kind": "orbits", "phase": "D", "finite": False, "law": "", "reads": ["z_10"]}
    motion = Motion(part, (modes, anchor, 0, 1), False, True)
    if not modes:
        motion.f.root = lambda largest, *c: motion.f.symbol("w_2" if largest else "w_1")  # free as well
    return motion


def sign(x, motion):
    """By what is positive for all parameters, sqrt(chi eta) among it, and k of chi = k/(1 + k); 0: not known."""
    f, positive = motion.f, motion.positive() + [motion.f.symbol(e).num for e in ("e_1", "e_2", "m_2", "stiffness")]
    if f.modes:  # 0 < w_1 < 1 < w_2
        a, b, one = *f.w, f.one
        positive += [e.num for e in (f.V, a, b, one - a, one + a, b - one, b + one, b - a, b + a, a * a + b * b - one)]
    of_k = [] if f.modes else [p for p in positive if p.is_generator]  # 1 - k may be negative
    return product_sign(x, positive) or (product_sign(by_ratio(x, f.chi.num), of_k) if of_k else 0)


def by_ratio(x, chi):
    """x times a power of 1 + k at chi = k/(1 + k), k under the name of chi."""
    def replaced(p):
        degree, (at,) = p.degree(chi), generators(chi)
        return sum((p.ring({e: c}) * (1 + chi) ** (degree - e[at]) for e, c in p.terms()), p.ring(0))
    return Number(replaced(x.num), {replaced(p): k for p, k in x.den.items()})


def has_factor(x, slower, motion):
    """slower is x times what has no pole, and zero where x is."""
    quotient = slower / x
    return sign(Number(motion.f.one.num, quotient.den), motion) != 0


def first_mass_is_slower():
    """z_1' < V at t_a + t_b.  Throughout the slip-stick phase z_1''^2 + (z_1' - chi V)^2 = e_1^2 + (V - chi V)^2.  With
    z_1' = V at its end z_1'' would be e_1 or -e_1, in both phases, and z_1' exceed V just after or just before."""
    m = free_motion()
    f, start, end = m.f, m.state(1), m.state(2)
    lag = [z[2] - f.chi * f.V for z in (start, end)]
    rate = [m.rate(1, z) for z in (start, end)]
    assert (rate[0][2] ** 2 + lag[0] ** 2 - f.symbol("e_1") ** 2 - (f.V - f.chi * f.V) ** 2).is_zero()
    assert (m.rate(1, rate[1])[2] + lag[1]).is_zero()  # the derivative of that sum is 2 z_1'' (z_1''' + z_1' - chi V)
    assert (rate[1][2] - m.rate(2, end)[2]).is_zero()


def second_mass_is_slower():
    """z_2' < V at t_a + t_b + t_c.  With z_2' = V there z_2'' is zero, else z_2' would exceed V just after or just
    before; but then the masses are at one place with one velocity, and stay so throughout the stick-slip phase."""
    m = free_motion()
    assert (m.rate(2, m.state(3))[3] - m.rate(3, m.state(3))[3]).is_zero()
    apart = m.f.symbol("apart")
    assert sign(m.rate(3, [m.f.number(0), apart, m.f.V, m.f.V])[3] / apart, m)
    stays = m.rate(3, [m.f.symbol("z"), m.f.symbol("z"), m.f.V, m.f.V])
    assert stays[3].is_zero() and (stays[0] - stays[1]).is_zero()


def nowhere_zero(formula, root, admissible, values, k):
    for anchor, state, component, reason in (4, 2, 2, first_mass_is_slower), (-1, 3, 3, second_mass_is_slower):
        m = free_motion(anchor)
        x = reader(values, m.f, m)(k)
        if sign(x, m) > 0 or sign(x, m) and not root:
            return True
        if admissible and not root and has_factor(x, m.f.V - m.state(state)[component], m):
            reason()
            return True
    m = free_motion(modes=True)
    x = sign(reader(values, m.f, m)(k), m)
    return x > 0 or x and not root


def divisors(part, motion):
    """What the values of a part are divided by."""
    found, divide = [], Number.__truediv__
    Number.__truediv__ = lambda a, b: found.append(b) or divide(a, b)
    value = reader(part["values"], motion.f, motion)
    for side in part["sides"]:
        value(side)
    Number.__truediv__ = divide
    return found


def ends_transversally(k):
    """The rate at which what ends the phase passes its limit is nowhere zero, or J is divided by it."""
    m = free_motion()
    rate = m.switching(k, m.rate(k, m.state(k + 1)), True)
    part = [part for part in PARTS if part["oracle"] == list(CORNERS)[k]][0]
    return sign(rate, m) or any(not x.is_zero() and sign(rate / x, m) for x in divisors(part, m))


def criterion(values, sides, relations):
    """By the theorem of linearized stability: J is the derivative of an analytic return map, and has the eigenvalues
    0 and tr J."""
    assert all(ends_transversally(k) for k in range(4)), "%s: a phase may end at a double zero" % CLAIM
    # the other conditions hold strictly, so that neighbours have the same phases
    m = free_motion()
    for k, mass in (1, 0), (2, 1):
        assert sign(m.rate(k, m.state(k))[2 + mass], m) < 0
    first_mass_is_slower()
    second_mass_is_slower()
    whole = [part for part in PARTS if part["oracle"] == "J"][0]
    of_j, said = (reader(part, m.f, named(m.f)) for part in (whole["values"], values))
    j = [of_j(k) for k in whole["sides"]]
    trace = j[0] + j[3]
    assert (j[0] * j[3] - j[1] * j[2]).is_zero(), "%s: det J is not zero" % CLAIM
    margins = [said(right) - said(left) if op == "<" else said(left) - said(right)
               for left, right, op in zip(sides, sides[len(relations):], relations)]
    if len(margins) == 1 and m.f.roots:  # y - |x|: y > 0, and y^2 - x^2
        (square, modulus), = m.f.roots
        y = margins[0] + modulus
        assert sign(y, m) > 0, "%s: it may compare with what is negative" % CLAIM
        margins = [y * y - square]

    def times_positive(x, y):
        """y has no denominator."""
        rest = quotient(x.num, y.num)
        return rest is not None and sign(Number(rest, x.den), m) > 0

    a, b = m.f.one + trace, m.f.one - trace
    found = [len(margins) == len(form) and all(map(times_positive, margins, form)) for form in ([a, b], [b, a], [a * b])]
    assert set(relations) <= set("<>") and any(found), "%s: it is not |tr J| < 1 that is said" % CLAIM


# --- What was checked, in words ---

WHERE = {
    "params": "for all parameters", "flow": "on every motion of the phase %s",
    "arcs": "on every passage through the phases D, Gamma, H and C, each up to its event",
    "orbits": "on every periodic solution with the phases D, Gamma, H and C",
    "patched": "whatever the states and the lengths of the phases are, events or not"}


def told(part):
    where = WHERE[part["kind"]].replace("%s", part["phase"])
    if part["law"]:
        where += ", where Coulomb's law (2) holds in the phase " + part["phase"]
    where += "".join(", with %s = %s" % pair for pair in part["fixed"].items())
    where += ", for finite perturbations" if part["finite"] else ""
    n, equal = len(part["by"]), part["relations"].count("=")
    what = ["every entry (%d) is that of the model's %s" % (n, part["oracle"])] if part["oracle"] else [
        said % k for k, said in ((equal, "both sides are equal in every equation (%d)"),
                                 (n - equal, "every inequality (%d) holds strictly")) if k]
    return "Checked exactly, %s: %s." % (where, " and ".join(what))


sys.setrecursionlimit(100000)
assert PARTS or MATRICES or GENERIC or DIVISORS or CRITERION, "%s: there is nothing to prove" % CLAIM
print(__doc__)
for matrix in MATRICES:
    assert rank(matrix) == matrix["rank"], "%s: the rank is another" % CLAIM
    print("Checked exactly: the matrix of derivatives (%d by %d) has rank %d everywhere." % (
        len(matrix["rows"]), len(matrix["rows"][0]), matrix["rank"]))
for values, equations, unknowns, said in GENERIC:
    assert generic_rank(values, equations, unknowns) == said, "%s: the rank is another" % CLAIM
    print("Checked by intervals at one point, hence so at almost all: %d of the %d equations are independent in %s." % (
        said, len(equations), ", ".join(unknowns)))
    print("More cannot be: %s." % (
        "there are no more unknowns" if said == len(unknowns) else
        "there are no more" if said == len(equations) else "the others are some of them again, exactly"))
for part in PARTS:
    assert 0 < len(part["by"]) * (1 if part["oracle"] else 2) == len(part["sides"]), "%s: a side is left out" % CLAIM
    for attempt in sorted(set(part["by"])):
        prove(part, [i for i, by in enumerate(part["by"]) if by == attempt], attempt)
    print(told(part))
for formula, root, admissible, *code in DIVISORS:
    assert nowhere_zero(formula, root, admissible, *code), "%s: %s may be zero" % (CLAIM, formula)
    print("Checked exactly, for %s: %s is %s." % (
        "all admissible solutions" if admissible else "all parameters", formula, "positive" if root else "nowhere zero"))
if CRITERION:
    criterion(*CRITERION)
    print("Checked exactly: every phase ends at a simple zero, det J = 0, and what is said of tr J is |tr J| < 1.\n"
          "Taken as known: the theorem of linearized stability.")
print("Not checked here: that what is read is what the paper means, and, where motions enter, that the matrices A and\n"
      "the ends of the phases in this script are those of (1), (2), (12), (14) and (16).")
assert not PRINTED or sum(
    disprove(part, [i for i, by in enumerate(part["by"]) if by == attempt], attempt)
    for part in PRINTED for attempt in sorted(set(part["by"]))), "%s: it holds as printed" % CLAIM
print(CLAIM + ": proved")
