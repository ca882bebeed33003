"""later.py: solutions of the paper's six equations with positive times and t_c below 20, later roots included.

The common zeros of z1' - V and r^2 + q^2/omega^2 - r0^2 over (t_b, t_c) by a grid of 1/50 in plain double precision,
modes from the roots of the characteristic polynomial, Newton's iteration with differences; then every t_d that brings
phase C to (r0, 0) and leaves t_a > 0.  A search, no proof.  Rows: set, chi, eta, V, e1, e2; solution, t_a, t_b, t_c, t_d.
"""
import math

SETS = [("paper", "0.8", "1", "1", "2.7844", "0.8587", 40), ("two-admissible", "0.71", "1.2", "1.9", "5.9", "0.158", 40),
        ("mixed", "0.44", "1.6", "0.35", "3.18", "2.58", 90)]
STEP, LAST = 0.02, 20.0


class Motion:
    def __init__(self, chi, eta, v, e1, e2):
        self.chi, self.v, self.e1, self.e2 = chi, v, e1, e2
        self.a, self.omega = (1 - chi) * v, math.sqrt(chi * eta)
        trace, det = 1 + chi * eta, chi * eta * (1 - chi)
        half = math.sqrt(trace * trace / 4 - det)
        squares = [trace / 2 - half, trace / 2 + half]
        self.om = [math.sqrt(x) for x in squares]
        self.shape = [(1 - x) / chi for x in squares]  # modes (1, shape)

    def modes(self, z1, z2):
        second = (z2 - self.shape[0] * z1) / (self.shape[1] - self.shape[0])
        return z1 - second, second

    def slip_stick(self, tb):
        """The modes where phase H starts, positions and velocities, and r0."""
        w = self.e1 * math.cos(tb) + self.a * math.sin(tb)
        rate = self.a * math.cos(tb) - self.e1 * math.sin(tb)
        r = self.e2 / self.chi
        r0 = r - self.a * (tb - math.sin(tb)) - self.e1 * (1 - math.cos(tb))
        return (self.modes((w + self.chi * r) / (1 - self.chi), (w + r) / (1 - self.chi)),
                self.modes(rate + self.chi * self.v, self.v), r0)

    def turn(self, tc):
        return [(math.cos(o * tc), math.sin(o * tc)) for o in self.om]

    def slip(self, start, turn):
        z = [0.0, 0.0, 0.0, 0.0]
        for q, p, om, shape, (c, s) in zip(start[0], start[1], self.om, self.shape, turn):
            x, v = q * c + p * s / om, p * c - q * om * s
            for k, part in enumerate((x, shape * x, v, shape * v)):
                z[k] += part
        return z

    def left(self, start, turn):
        z = self.slip(start, turn)
        r, q = z[1] - z[0], z[3] - self.v
        return z[2] - self.v, r * r + (q / self.omega) ** 2 - start[2] ** 2

    def newton(self, x):
        f = None
        for _ in range(50):
            e = 1e-7
            f, fb, fc = (self.left(self.slip_stick(b), self.turn(c))
                         for b, c in (x, (x[0] + e, x[1]), (x[0], x[1] + e)))
            j = [(fb[0] - f[0]) / e, (fc[0] - f[0]) / e, (fb[1] - f[1]) / e, (fc[1] - f[1]) / e]
            det = j[0] * j[3] - j[1] * j[2]
            if det == 0:
                return None
            step = (j[3] * f[0] - j[1] * f[1]) / det, (j[0] * f[1] - j[2] * f[0]) / det
            x = x[0] - step[0], x[1] - step[1]
            if abs(step[0]) + abs(step[1]) < 1e-12:
                break
        good = abs(f[0]) + abs(f[1]) < 1e-8 and x[0] > 1e-4 and 1e-4 < x[1] < LAST
        return x if good else None

    def ends(self, tb, tc):
        """Every (t_d, t_a)."""
        start = self.slip_stick(tb)
        z, r0 = self.slip(start, self.turn(tc)), start[2]
        r, q = z[1] - z[0], z[3] - self.v
        td = math.atan2(q / self.omega * r0, r * r0) % (2 * math.pi) / self.omega
        ta = ((self.e1 + self.chi * r0) / (1 - self.chi) - z[0]) / self.v - td
        while ta > 0:
            yield td, ta
            td, ta = td + 2 * math.pi / self.omega, ta - 2 * math.pi / self.omega


def apart(values):
    return min(values) > 0 or max(values) < 0


def cells(m, last_tb):
    turns = [m.turn(max(k * STEP, 1e-9)) for k in range(round(LAST / STEP) + 1)]
    before = None
    for i in range(round(last_tb / STEP) + 1):
        start = m.slip_stick(max(i * STEP, 1e-9))
        row = [m.left(start, t) for t in turns]
        for k in range(len(row) - 1 if before else 0):
            corners = row[k], row[k + 1], before[k], before[k + 1]
            if not apart([c[0] for c in corners]) and not apart([c[1] for c in corners]):
                yield (i - 0.5) * STEP, (k + 0.5) * STEP
        before = row


for name, *numbers, last in SETS:
    motion, zeros, rows = Motion(*map(float, numbers)), [], []
    for cell in cells(motion, last):
        zero = motion.newton(cell)
        if zero and all(abs(zero[0] - z[0]) + abs(zero[1] - z[1]) > 1e-5 for z in zeros):
            zeros.append(zero)
    for tb, tc in zeros:
        rows += [(tc, td, ta, tb) for td, ta in motion.ends(tb, tc)]
    print("set", name, *numbers, sep="\t")
    for tc, td, ta, tb in sorted(rows):
        print("solution", *("%.6f" % t for t in (ta, tb, tc, td)), sep="\t")
