"""Two searches, in double precision, for the periodic orbits of the word D-Gamma-H-C.

Every phase is z'' = -K z with its own 2x2 matrix K, so a state Z = (z1, z2, z1', z2') moves by Taylor series of that
equation; nothing here solves it in closed form.  The stick phase forgets everything but r = z2 - z1: it ends at
z1 - chi z2 = e1 with both velocities V.  `by_return_map` follows each r once round and looks for r again;
`by_plane` looks for the common zeros of two functions of (t_b, t_c) that stay smooth where the return map jumps.
Their lists must agree; orbits.py refines them to many digits.
"""
import math

T_MAX = 200.0  # the longest global slip phase that is looked at


def functional_rate(k, n):
    """The functional n' with d/dt (n.Z) = n'.Z in the phase of stiffness k."""
    return (-(k[0][0] * n[2] + k[1][0] * n[3]), -(k[0][1] * n[2] + k[1][1] * n[3]), n[0], n[1])


def dot(n, z):
    return n[0] * z[0] + n[1] * z[1] + n[2] * z[2] + n[3] * z[3]


def sign(x):
    return (x > 0) - (x < 0)


class Flow:
    """The motion in one phase: by Taylor series within a step h, by powers of the step's matrix beyond it."""

    def __init__(self, k, h):
        self.k, self.h = k, h
        unit = [[float(i == j) for j in range(4)] for i in range(4)]
        columns = [self.taylor(tuple(e), h) for e in unit]
        self.powers = [[[columns[j][i] for j in range(4)] for i in range(4)]]

    def taylor(self, z, t):
        """Z after time t, from Z' = A Z: each term of the series is A t / n times the one before."""
        (a, b), (c, d) = self.k
        x, y, u, v = z
        sx, sy, su, sv = z
        for n in range(1, 60, 2):
            for f in (t / n, t / (n + 1)):
                x, y, u, v = u * f, v * f, -(a * x + b * y) * f, -(c * x + d * y) * f
                sx, sy, su, sv = sx + x, sy + y, su + u, sv + v
            if abs(x) + abs(y) + abs(u) + abs(v) < 1e-18 * (abs(sx) + abs(sy) + abs(su) + abs(sv)):
                break
        return (sx, sy, su, sv)

    def power(self, i):
        while len(self.powers) <= i:
            m = self.powers[-1]
            self.powers.append([[sum(m[r][s] * m[s][c] for s in range(4)) for c in range(4)] for r in range(4)])
        return self.powers[i]

    def at(self, z, t):
        n = int(t / self.h)
        rest, i = t - n * self.h, 0
        while n:
            if n & 1:
                z = tuple(dot(row, z) for row in self.power(i))
            n >>= 1
            i += 1
        return self.taylor(z, rest)

    def crossing(self, z, n, c, lo, hi):
        """A zero of n.Z - c in (lo, hi), where it changes sign: Newton inside a shrinking bracket."""
        rate = functional_rate(self.k, n)
        s = sign(dot(n, self.taylor(z, hi)) - c)
        t = 0.5 * (lo + hi)
        for _ in range(80):
            y = self.taylor(z, t)
            f, d = dot(n, y) - c, dot(rate, y)
            if f * s >= 0:
                hi = t
            else:
                lo = t
            if abs(f) <= 1e-16 * abs(d) or hi - lo < 1e-16:
                return t
            t = t - f / d if d else lo
            if not lo < t < hi:
                t = 0.5 * (lo + hi)
        return t

    def first_root(self, z, n, c, t_max):
        """The first t > 0 with n.Z(t) = c, and Z there; (None, None) if there is none up to t_max.

        A zero at the start counts as no root: the sign there is that of the first derivative that is not zero.
        A pair of roots inside one step shows by its slopes: then the extremum between them is looked at."""
        m = self.powers[0]
        (a0, a1, a2, a3), (b0, b1, b2, b3), (c0, c1, c2, c3), (d0, d1, d2, d3) = m
        n0, n1, n2, n3 = n
        rate = functional_rate(self.k, n)
        r0, r1, r2, r3 = rate
        scale = 1e-13 * (abs(c) + sum(abs(p * q) for p, q in zip(n, z)))
        f, d = dot(n, z) - c, dot(rate, z)
        s = sign(f) if abs(f) > scale else sign(d) or sign(dot(functional_rate(self.k, rate), z))
        x, y, u, v = z
        for i in range(int(t_max / self.h) + 1):
            nx = a0 * x + a1 * y + a2 * u + a3 * v
            ny = b0 * x + b1 * y + b2 * u + b3 * v
            nu = c0 * x + c1 * y + c2 * u + c3 * v
            nv = d0 * x + d1 * y + d2 * u + d3 * v
            nf = n0 * nx + n1 * ny + n2 * nu + n3 * nv - c
            nd = r0 * nx + r1 * ny + r2 * nu + r3 * nv
            hi = self.h if s * nf <= 0 else None
            if hi is None and s * d < 0 < s * nd:
                low = self.crossing((x, y, u, v), rate, 0.0, 0.0, self.h)
                if s * (dot(n, self.taylor((x, y, u, v), low)) - c) <= 0:
                    hi = low
            if hi is not None:
                t = self.crossing((x, y, u, v), n, c, 0.0, hi)
                return i * self.h + t, self.taylor((x, y, u, v), t)
            x, y, u, v, f, d = nx, ny, nu, nv, nf, nd
        return None, None

    def extrema(self, z, n, c, t_end):
        """The times of the interior local extrema of n.Z on (0, t_end)."""
        rate = functional_rate(self.k, n)
        times, t = [], 0.0
        while t < t_end:
            step = min(self.h, t_end - t)
            nz = self.taylor(z, step)
            if dot(rate, z) * dot(rate, nz) < 0:
                times.append(t + self.crossing(z, rate, 0.0, 0.0, step))
            z, t = nz, t + step
        return [s for s in times if 1e-12 < s < t_end - 1e-12]


class Model:
    """The equations (1) with the law (2), in the coordinates z, for one parameter set."""

    def __init__(self, chi, eta, v, e1, e2):
        self.chi, self.eta, self.v, self.e1, self.e2 = chi, eta, v, e1, e2
        ce = chi * eta
        fastest = math.sqrt(1 + ce)
        h = 0.12 / fastest
        self.flow = {
            "D": Flow(((0.0, 0.0), (0.0, 0.0)), h),
            "Gamma": Flow(((1.0, -chi), (0.0, 0.0)), 0.1),
            "H": Flow(((1.0, -chi), (-ce, ce)), h),
            "C": Flow(((0.0, 0.0), (-ce, ce)), 0.1 / max(1.0, math.sqrt(ce))),
        }
        self.fastest = fastest
        # what must vanish at the end of each phase: n.Z - c
        self.event = {
            "D": ((1.0, -chi, 0.0, 0.0), e1),
            "Gamma": ((-chi, chi, 0.0, 0.0), e2),
            "H": ((0.0, 0.0, 1.0, 0.0), v),
            "C": ((0.0, 0.0, 0.0, 1.0), v),
        }
        # left eigenvectors l of K (l K = lambda l) for the bound on z1' in the global slip phase
        root = math.sqrt((1 + ce) ** 2 - 4 * ce * (1 - chi))
        big = (1 + ce + root) / 2
        self.eigen = (ce * (1 - chi) / big, big)
        # l = (1, m): column 1 gives 1 - m chi eta = lambda
        self.left = tuple((1 - lam) / ce for lam in self.eigen)

    def stick_end(self, r):
        z2 = (self.e1 + r) / (1 - self.chi)
        return (z2 - r, z2, self.v, self.v)

    def never_reaches(self, z):
        """True if the two modes of the global slip phase together cannot bring z1' up to V."""
        (l1, l2), (m1, m2) = self.eigen, self.left
        a = [math.hypot(z[2] + m * z[3], math.sqrt(l) * (z[0] + m * z[1])) for l, m in ((l1, m1), (l2, m2))]
        # z1 = (m2 y1 - m1 y2) / (m2 - m1) for y_i = z1 + m_i z2
        return (abs(m2) * a[0] + abs(m1) * a[1]) / abs(m2 - m1) < self.v

    def reach(self, z):
        """The largest |r| that a stick-slip phase can end with, by the energy of the global slip phase from z.

        eta z1'^2 + z2'^2 + eta (z1^2 - 2 chi z1 z2 + chi z2^2) = 2 E is conserved and is at least chi eta r^2 + z2'^2;
        the stick-slip phase ends with chi eta r^2 equal to chi eta r^2 + (z2' - V)^2 at its start."""
        x, y, u, v = z
        energy = self.eta * u * u + v * v + self.eta * (x * x - 2 * self.chi * x * y + self.chi * y * y)
        return (math.sqrt(max(energy, 0.0)) + self.v) / math.sqrt(self.chi * self.eta)

    def once_round(self, r):
        """(r at the end, t_b, t_c, t_d, Z_c), or a string that says why there is no return."""
        za = self.stick_end(r)
        limit = (self.e2 / self.chi - r) / (self.v * (1 - self.chi)) + 2
        t_b, zb = self.flow["Gamma"].first_root(za, *self.event["Gamma"], limit)
        if t_b is None:
            return "no t_b"
        if -r > self.reach(zb):
            return "out of reach"
        if self.never_reaches(zb):
            return "never"
        t_c, zc = self.flow["H"].first_root(zb, *self.event["H"], T_MAX)
        if t_c is None:
            return "late"
        t_d, zf = self.flow["C"].first_root(zc, *self.event["C"], 7 / math.sqrt(self.chi * self.eta))
        if t_d is None:
            return "no t_d"
        return zf[1] - zf[0], t_b, t_c, t_d, zc

    def slip_start(self, t_b):
        """For a slip-stick phase that lasts t_b: the r it starts from, its end state, and the derivative of that
        state with respect to t_b.  A change of r alone moves z along (chi, 1), which phase Gamma leaves at rest."""
        z = self.flow["Gamma"].at(self.stick_end(0.0), t_b)
        r = self.e2 / self.chi - (z[1] - z[0])
        c = 1 / (1 - self.chi)
        zb = (z[0] + r * self.chi * c, z[1] + r * c, z[2], z[3])
        dr = -(z[3] - z[2])
        tangent = (z[2] + dr * self.chi * c, z[3] + dr * c, -(zb[0] - self.chi * zb[1]), 0.0)
        return r, dr, zb, tangent

    def plane(self, flow, t_b, t_c):
        """z1' - V and what phase C keeps, less what t_b asks of it, at the end of a phase H that flow moves along, and their
        derivatives by t_b and t_c."""
        ce = self.chi * self.eta
        r, dr, zb, tb = self.slip_start(t_b)
        z, u = flow.at(zb, t_c), flow.at(tb, t_c)
        rc, q = z[1] - z[0], z[3] - self.v
        acc1, acc2 = -(z[0] - self.chi * z[1]), -ce * (z[1] - z[0])
        return (z[2] - self.v, ce * (rc * rc - r * r) + q * q, u[2], acc1,
                2 * ce * (rc * (u[1] - u[0]) - r * dr) + 2 * q * u[3], 2 * ce * rc * (z[3] - z[2]) + 2 * q * acc2)

    def orbit_from(self, r, t_b, t_c, t_d, zf):
        w = zf[0] - self.chi * zf[1]
        return (zf[0], zf[1], (self.e1 - w) / (self.v * (1 - self.chi)), t_b, t_c, t_d)


def longest_gamma(model):
    """A time beyond which no slip-stick phase can belong to an orbit: r falls at least like V (1 - chi) (1 - t)."""
    most = max(model.reach(model.slip_start(2 * math.pi * i / 720)[2]) for i in range(1, 721))
    return (1.001 * most + model.e2 / model.chi) / (model.v * (1 - model.chi)) + 1


def by_return_map(model, samples=3000):
    """Orbits as the fixed points of r -> r, sampled in s with r = e2/chi - s^2 and subdivided where anything jumps.

    Returns the list of guesses (z10, z20, t_a, t_b, t_c, t_d) and a dict of counts of the samples without return."""
    counts, top = {}, model.e2 / model.chi

    def value(s):
        out = model.once_round(top - s * s)
        if isinstance(out, str):
            counts[out] = counts.get(out, 0) + 1
            return (s, None, out)
        return (s, out[0] - (top - s * s), out)

    def near(p, q):
        if p[1] is None or q[1] is None:
            return p[2] == q[2]
        return (abs(p[2][2] - q[2][2]) < 0.1 / model.fastest and abs(p[2][1] - q[2][1]) < 0.1
                and p[2][4][3] * q[2][4][3] != 0 and sign(p[2][4][3] - model.v) == sign(q[2][4][3] - model.v))

    def fill(p, q, out):
        if near(p, q) or q[0] - p[0] < 1e-12:
            out.append(q)
            return
        mid = value(0.5 * (p[0] + q[0]))
        fill(p, mid, out)
        fill(mid, q, out)

    biggest = max(model.reach(model.slip_start(2 * math.pi * i / 720)[2]) for i in range(1, 721))
    s_max = math.sqrt(top + 1.001 * biggest)
    points = [value(s_max * (i + 0.5) / samples) for i in range(samples)]
    points.insert(0, value(s_max * 1e-5))
    line = [points[0]]
    for p, q in zip(points, points[1:]):
        fill(p, q, line)

    roots = []

    def bisect(p, q):
        while q[0] - p[0] > 1e-15 * s_max:
            mid = value(0.5 * (p[0] + q[0]))
            if mid[1] is None or mid[0] in (p[0], q[0]):
                break
            if mid[1] * p[1] > 0:
                p = mid
            else:
                q = mid
        if near(p, q) and abs(p[1]) + abs(q[1]) < 1e-6 * (1 + abs(top - p[0] ** 2)):
            roots.append(p[0])

    def hidden(p, m, q):
        """Golden section for a change of sign near a smallest |value| of one sign."""
        s = sign(m[1])
        lo, hi = p, q
        for _ in range(60):
            left, right = value(lo[0] + 0.382 * (hi[0] - lo[0])), value(lo[0] + 0.618 * (hi[0] - lo[0]))
            for x in (left, right):
                if x[1] is None or not near(x, m):
                    return
                if s * x[1] <= 0:
                    bisect(p, x)
                    bisect(x, q)
                    return
            if s * left[1] < s * right[1]:
                hi = right
            else:
                lo = left
            if s * min(left[1] * s, right[1] * s) > 1e6 * (hi[0] - lo[0]):
                return

    for p, q in zip(line, line[1:]):
        if p[1] is not None and q[1] is not None and near(p, q) and p[1] * q[1] <= 0:
            bisect(p, q)
    for p, m, q in zip(line, line[1:], line[2:]):
        if None not in (p[1], m[1], q[1]) and near(p, m) and near(m, q) and p[1] * m[1] > 0 and m[1] * q[1] > 0:
            if abs(m[1]) <= abs(p[1]) and abs(m[1]) <= abs(q[1]):
                hidden(p, m, q)

    found = []
    for s in roots:
        r = top - s * s
        _, t_b, t_c, t_d, zc = model.once_round(r)
        found.append(model.orbit_from(r, t_b, t_c, t_d, model.flow["C"].at(zc, t_d)))
    return distinct(found), counts


def by_plane(model, d_b=0.02, d_c=0.06):
    """Orbits as the common zeros in (t_b, t_c) of  z1'(t_c) - V  and  chi eta (r_c^2 - r^2) + (z2'(t_c) - V)^2,
    where r is what t_b asks of the stick phase: the stick-slip phase keeps chi eta r^2 + (z2' - V)^2.

    Row by row, each grid point where both functions could vanish nearby starts a Newton iteration.  A row ends when
    z1' is above V by more than a step of t_b can change.  Only first events are kept in the end."""
    chi, v, ce = model.chi, model.v, model.chi * model.eta
    h_flow = Flow(model.flow["H"].k, d_c / model.fastest)
    step, m = h_flow.h, h_flow.powers[0]
    (a0, a1, a2, a3), (b0, b1, b2, b3), (c0, c1, c2, c3), (g0, g1, g2, g3) = m
    steps = int(T_MAX / step) + 1

    def newton(t_b, t_c):
        start = (t_b, t_c)
        for _ in range(40):
            f, g, fb, fc, gb, gc = model.plane(h_flow, t_b, t_c)
            det = fb * gc - fc * gb
            if det == 0:
                return None
            db, dc = -(f * gc - g * fc) / det, -(fb * g - gb * f) / det
            shrink = min(1.0, 2 * d_b / (abs(db) + 1e-300), 2 * step / (abs(dc) + 1e-300))
            t_b, t_c = t_b + shrink * db, t_c + shrink * dc
            if abs(t_b - start[0]) > 12 * d_b or abs(t_c - start[1]) > 12 * step or t_b <= 0 or t_c <= 0:
                return None
            if abs(db) + abs(dc) < 1e-12 * (1 + t_c):
                return (t_b, t_c)
        return None

    zeros, last = [], longest_gamma(model)
    for i in range(1, int(last / d_b) + 1):
        t_b = (i - 0.5) * d_b
        r, dr, zb, tb = model.slip_start(t_b)
        if -r > 1.05 * model.reach(zb) + 1 or zb[2] > v + 0.2 * (v + model.e1):
            continue
        if model.never_reaches(tuple(1.05 * x for x in zb)):
            continue
        x, y, p, w = zb
        tx, ty, tp, tw = tb
        for j in range(steps):
            rc, q = y - x, w - v
            f = p - v
            fb, fc = tp, -(x - chi * y)
            size_f = abs(fb) * d_b + abs(fc) * step
            if f > 2 * size_f + 4 * d_b:
                break
            second = 4 * d_b * d_b * (1 + v)
            if abs(f) <= size_f + second:
                g = ce * (rc * rc - r * r) + q * q
                gb = 2 * ce * (rc * (ty - tx) - r * dr) + 2 * q * tw
                gc = 2 * ce * rc * (w - p) - 2 * q * ce * rc
                if abs(g) <= abs(gb) * d_b + abs(gc) * step + second * (1 + ce) * (1 + abs(r)):
                    hit = newton(t_b, max(j, 0.25) * step)
                    if hit and not any(abs(b - hit[0]) + abs(c - hit[1]) < 1e-8 for b, c in zeros):
                        zeros.append(hit)
            x, y, p, w = (a0 * x + a1 * y + a2 * p + a3 * w, b0 * x + b1 * y + b2 * p + b3 * w,
                          c0 * x + c1 * y + c2 * p + c3 * w, g0 * x + g1 * y + g2 * p + g3 * w)
            tx, ty, tp, tw = (a0 * tx + a1 * ty + a2 * tp + a3 * tw, b0 * tx + b1 * ty + b2 * tp + b3 * tw,
                              c0 * tx + c1 * ty + c2 * tp + c3 * tw, g0 * tx + g1 * ty + g2 * tp + g3 * tw)

    found = []
    for t_b, t_c in zeros:
        r = model.slip_start(t_b)[0]
        out = model.once_round(r)
        if isinstance(out, str) or abs(out[1] - t_b) > 1e-6 or abs(out[2] - t_c) > 1e-5 or abs(out[0] - r) > 1e-5:
            continue
        found.append(model.orbit_from(r, t_b, t_c, out[3], model.flow["C"].at(out[4], out[3])))
    return distinct(found)


def distinct(orbits):
    kept = []
    for o in sorted(orbits):
        if not any(abs(o[3] - k[3]) + abs(o[4] - k[4]) < 1e-6 for k in kept):
            kept.append(o)
    return kept
