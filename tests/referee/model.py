"""The paper's system, written from the paper alone: the linear equations of its four phases (3), (5), (7), (9) and the
events (12), (14), (16), (39) that end them, Coulomb's law (2), in mpmath.

A state is (z_1, z_2, z_1', z_2'); a phase is one of D (both stick), G (Gamma: m_2 sticks), H (both slip), C (m_1 sticks).
"""
import functools
import re

from mpmath import findroot, matrix, mp, mpf

mp.dps = 30
FINE = 1 / mpf(64)  # step of the scan for first events, and of series
BITS = 160  # of what is behind the point in series


@functools.lru_cache(maxsize=None)
def number(text):
    """p/q or a decimal."""
    p, _, q = text.partition("/")
    return mpf(p) / mpf(q or 1)


def digits(text):
    """One unit of the last of its significant digits; of p/q none."""
    if "/" in text:
        return mpf(0)
    mantissa, _, exponent = text.lower().partition("e")
    return mpf(10) ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


class Certificate:
    """What audit.json has of a claim: c["chi"] is a number, c.text("printed") what is written, c.claim the claim."""

    def __init__(self, claim):
        self.claim = claim
        self.of = {item["name"]: item["value"] for item in claim.get("certificate", [])}
        self.read = set()  # the names that were asked for

    def text(self, name):
        self.read.add(name)
        return self.of[name]

    def __getitem__(self, name):
        return number(self.text(name))

    def second(self):
        """The same with what has "(2)" behind its name in the place of what has not."""
        other = Certificate(self.claim)
        other.read = self.read
        for name, value in self.of.items():
            if name.endswith(" (2)"):
                other.of[name[:-4]] = value
                other.read.add(name)
        return other

    def near(self, value, name):
        """Is that the certified number, to its digits?"""
        return abs(value - self[name]) <= digits(self.text(name)) * mpf("1.01") + abs(value) * mpf(10) ** -13


def system(c, phase):
    """A of Z' = A Z."""
    chi, k = c["chi"], c["chi"] * c["eta"]
    first, second = [-1, chi, 0, 0], [k, -k, 0, 0]
    still = [0, 0, 0, 0]
    return matrix([[0, 0, 1, 0], [0, 0, 0, 1], first if phase in "GH" else still, second if phase in "HC" else still])


def times(a, b):
    """Of matrices whose entries are whole multiples of 2^-BITS."""
    columns = list(zip(*b))
    return [[sum(map(int.__mul__, row, column)) >> BITS for column in columns] for row in a]


def exponential(a, t):
    """exp(a t), a as a list of rows: Taylor's series for t/2^n below 1/64, squared n times, all in integers; mpmath's own
    is slow."""
    n = 0
    while abs(t) > FINE * 2**n:
        n += 1
    e = term = [[(i == k) << BITS for k in range(len(a))] for i in range(len(a))]
    a, k = [[int(x * t * mpf(2) ** (BITS - n)) for x in row] for row in a], 0
    while max(abs(x) for row in term for x in row) > 1:
        k += 1
        term = [[x // k for x in row] for row in times(term, a)]
        e = [[x + y for x, y in zip(p, q)] for p, q in zip(e, term)]
    for _ in range(n):
        e = times(e, e)
    return [[x / mpf(2) ** BITS for x in row] for row in e]


def flow(c, phase, t):
    return matrix(exponential(system(c, phase).tolist(), t))


def ends(c, phase):
    """Zero when the phase ends: (12), (14), (16), (39)."""
    return {"D": lambda z: z[0] - c["chi"] * z[1] - c["e_1"], "G": lambda z: c["chi"] * (z[1] - z[0]) - c["e_2"],
            "H": lambda z: z[2] - c["V"], "C": lambda z: z[3] - c["V"]}[phase]


def first_zero(c, phase, z, g, most=60):
    """The first t > 0 at which g of the flow from z is zero: a scan in double precision, then a secant; None: none."""
    e = [[float(x) for x in row] for row in (flow(c, phase, FINE)).tolist()]
    at, before = [float(x) for x in z], None
    for n in range(int(most / FINE)):
        at = [sum(a * b for a, b in zip(row, at)) for row in e]
        after = float(g(at))
        if before is not None and before * after <= 0 or before is None and float(g(z)) * after < 0:
            return findroot(lambda t: g(flow(c, phase, t) * z), (n * FINE, (n + 1) * FINE), tol=mpf(10) ** -40)
        before = after
    return None


def stick(c, w, r):
    """The state with both masses on the belt, z_1 - chi z_2 = w and z_2 - z_1 = r."""
    z_1 = (w + c["chi"] * r) / (1 - c["chi"])
    return matrix([z_1, z_1 + r, c["V"], c["V"]])


def moments(c, phase, z, t):
    """63 states inside a phase that begins at z and lasts t."""
    step = flow(c, phase, t / 64)
    for _ in range(63):
        z = step * z
        yield z


class Passage:
    """One pass through D, Gamma, H and C: z[0] to z[4], their states, t[0] to t[3], their times."""

    known = {}  # passes that were made before: t and z

    def __init__(self, c, z_10, z_20):
        key = (*(c[name] for name in ("chi", "eta", "V", "e_1", "e_2")), z_10, z_20)
        self.c = c
        if key not in self.known:
            self.run(c, z_10, z_20)
            self.known[key] = self.t, self.z
        self.t, self.z = self.known[key]

    def run(self, c, z_10, z_20):
        v = c["V"]
        self.t, self.z = [], [matrix([z_10, z_20, v, v])]
        self.t.append((c["e_1"] - (z_10 - c["chi"] * z_20)) / (v * (1 - c["chi"])))  # of any sign
        self.z.append(flow(c, "D", self.t[0]) * self.z[0])
        for phase in "GHC":
            self.t.append(first_zero(c, phase, self.z[-1], ends(c, phase)))
            self.z.append(flow(c, phase, self.t[-1]) * self.z[-1])

    def along(self, k, share):
        return flow(self.c, "DGHC"[k], self.t[k] * share) * self.z[k]

    def at(self, time):
        """The state at the time of the motion, which starts at 0."""
        k = 0
        while k < 3 and time > self.t[k]:
            time, k = time - self.t[k], k + 1
        return flow(self.c, "DGHC"[k], time) * self.z[k]

    def closes(self):
        return max(abs(x) for x in self.z[4] - self.z[0]) < mpf(10) ** -9

    def is_motion(self):
        """t_a to t_d positive, no mass faster than the belt."""
        return min(self.t) > 0 and all(z[i] < self.c["V"] for k, masses in ((1, [2]), (2, [2, 3]), (3, [3]))
                                       for z in self.moments(k) for i in masses)

    def moments(self, k):
        return moments(self.c, "DGHC"[k], self.z[k], self.t[k])


def passage(c):
    """The certified pass, its four times checked."""
    p = Passage(c, c["z_10"], c["z_20"])
    assert all(c.near(t, name) for t, name in zip(p.t, ("t_a", "t_b", "t_c", "t_d"))), "its times"
    return p


def orbit(c):
    p = passage(c)
    assert p.closes(), "it is not periodic"
    return p


def derivative(of, c, h=mpf(10) ** -8):
    """d/ds of a list of numbers made from the pass whose start is moved by s (x, y)."""
    def moved(s):
        return of(Passage(c, c["z_10"] + s * c["x"], c["z_20"] + s * c["y"]))
    plus, minus = moved(h), moved(-h)
    return [(a - b) / (2 * h) for a, b in zip(plus, minus)]


def sides(c, left, right):
    """Are the certified entries of both sides what they are here, and different?"""
    entry = re.fullmatch(r"\[(\d),(\d)\]|(\d)|", c.text("entry") if "entry" in c.of else "")
    assert entry, "the name of the entry"
    place = [int(k) - 1 for k in entry.groups() if k]
    def pick(m):
        return m[place[0], place[1]] if len(place) == 2 else m[place[0]] if place else m
    a, b = pick(left), pick(right)
    return c.near(a, "left") and c.near(b, "right") and abs(a - b) > mpf(10) ** -6
