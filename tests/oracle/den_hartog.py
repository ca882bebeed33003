"""den_hartog.py: steady motions of m x'' + k x + F sgn(x') = P cos(omega t) that never stop, found without their closed form.

With m = k = P = 1 the load stands beside the motion as two more states, so that each half period is a linear system
w' = A w, w = (x, x', 1, cos, sin), carried by the series of exp(A t) w; a reversal is where x' first vanishes.  A motion
from rest, with sticking, is followed until it nearly repeats; Newton's iteration on the map from one upper extreme to the
next, in its x and the phase of the load there, ends it.  `python3 den_hartog.py` prints the table, at 55 and 70 digits the
same: beta = omega, F; x_0 and phi at an upper extreme, where the load is P cos phi, 0 <= phi < 2 pi.

`python3 den_hartog.py check` holds Den Hartog's formulas against den_hartog.tsv; shows that the steady motion does not stop
where friction is a little below his limit, and does once it is a little above; and that the limit is not enough at a
low frequency (beta = 2/5, F = 3/20).
"""
import pathlib
import sys

from mpmath import mp, mpf, pi, cos, sin, sqrt, atan2, floor, nstr

POINTS = [("2/7", "1/25"), ("2/5", "1/10"), ("11/20", "1/4"), ("3/4", "1/5"), ("9/10", "3/5"), ("21/20", "7/10"),
          ("5/4", "1/2"), ("3/2", "1/10"), ("2", "2/5"), ("4", "1/2")]
DOWN, STUCK, UP = -1, 0, 1
STEPS = 60  # in a period, between which a velocity does not vanish twice


def rational(text):
    p, _, q = text.partition("/")
    return mpf(int(p)) / int(q or 1)


class Oscillator:
    def __init__(self, beta, friction):
        self.beta, self.friction = beta, friction
        self.step = 2 * pi / beta / STEPS

    def flow(self, w, way, t):
        """exp(A t) w, by its series; a mass that moves down is pushed up by friction."""
        x, v, one, c, s = sums = w
        beta_t, force, k = self.beta * t, way * self.friction, 0
        least = mpf(10) ** (-mp.dps - 5)
        while max(abs(x), abs(v), abs(c), abs(s)) > least:
            k += 1
            if way == STUCK:
                x, v, one, c, s = 0, 0, 0, -beta_t * s / k, beta_t * c / k
            else:
                x, v, one, c, s = t * v / k, t * (c - x - force * one) / k, 0, -beta_t * s / k, beta_t * c / k
            sums = [total + term for total, term in zip(sums, (x, v, one, c, s))]
        return sums

    def push(self, w):
        """Spring and load on the mass."""
        return w[3] - w[0]

    def event(self, w, way, value):
        """The time of the zero of value(w) within a step after w, with the state there; value changes its sign."""
        low, high = mpf(0), self.step
        at_low = value(w) or value(self.flow(w, way, self.step / 1024))
        for _ in range(20):
            middle = (low + high) / 2
            if value(self.flow(w, way, middle)) * at_low > 0:
                low = middle
            else:
                high = middle
        t, before = high, low
        for _ in range(12):  # secants
            f, g = value(self.flow(w, way, t)), value(self.flow(w, way, before))
            if f == g or abs(t - before) < mpf(10) ** (5 - mp.dps):
                break
            t, before = t - f * (t - before) / (f - g), t
        return t, self.flow(w, way, t)

    def phase(self, w, way):
        """Until the mass reverses or stops, or is torn off: the time it takes and the state then."""
        elapsed = mpf(0)
        force = lambda s: abs(self.push(s)) - self.friction
        value = force if way == STUCK else (lambda s: s[1])
        began = way == STUCK
        while True:
            after = self.flow(w, way, self.step)
            ends = value(after) > 0 if way == STUCK else value(after) * way <= 0
            if ends and not began and value(self.flow(w, way, self.step / 1024)) * way <= 0:
                return elapsed, w  # not even begun
            if ends:
                t, after = self.event(w, way, value)
                return elapsed + t, after
            w, elapsed, began = after, elapsed + self.step, True

    def way_from_rest(self, w):
        push = self.push(w)
        return STUCK if abs(push) <= self.friction else UP if push > 0 else DOWN

    def follow(self, periods, start=None):
        """From rest, or from an upper extreme: the last state at such, and how long the mass stood still in the last half of
        the time."""
        x, phi = start or (mpf(0), mpf(0))
        w, t, stood, last = [x, mpf(0), mpf(1), cos(phi), sin(phi)], mpf(0), mpf(0), None
        way = self.way_from_rest(w)
        until = periods * 2 * pi / self.beta
        while t < until:
            took, w = self.phase(w, way)
            t += took
            if way == STUCK:
                stood += took if t > until / 2 else 0
                way = UP if self.push(w) > 0 else DOWN
                continue
            if way == UP:
                last = list(w)
            w[1] = mpf(0)
            way = self.way_from_rest(w)
        return last, stood

    def returned(self, x, phi):
        """From an upper extreme to the next by two half periods, whatever the forces there."""
        w = [x, mpf(0), mpf(1), cos(phi), sin(phi)]
        _, w = self.phase(w, DOWN)
        w[1] = mpf(0)
        _, w = self.phase(w, UP)
        return w[0], atan2(w[4], w[3])

    def improved(self, x, phi):
        """x_0 and phi of the motion that repeats after one period of the load, near these."""
        h = mpf(10) ** (-mp.dps // 2)

        def residual(x, phi):
            new, after = self.returned(x, phi)
            turns = (after - phi) / (2 * pi)
            return new - x, 2 * pi * (turns - floor(turns + mpf(1) / 2))

        for _ in range(8):
            r, by_x, by_phi = residual(x, phi), residual(x + h, phi), residual(x, phi + h)
            a, c = (by_x[0] - r[0]) / h, (by_x[1] - r[1]) / h
            b, d = (by_phi[0] - r[0]) / h, (by_phi[1] - r[1]) / h
            shift = (d * r[0] - b * r[1]) / (a * d - b * c), (a * r[1] - c * r[0]) / (a * d - b * c)
            x, phi = x - shift[0], phi - shift[1]
            if max(abs(e) for e in shift) < mpf(10) ** (8 - mp.dps):
                return x, phi % (2 * pi)
        raise ValueError("no convergence")


def motion(beta, friction):
    """x_0 and phi by increasing precision."""
    mp.dps = 16
    last, stood = Oscillator(rational(beta), rational(friction)).follow(100)
    if stood:
        raise ValueError(f"{beta} {friction}: the mass stops")
    x, phi = last[0], atan2(last[4], last[3])
    for mp.dps in (30, 55, 70):
        x, phi = Oscillator(rational(beta), rational(friction)).improved(x, phi)
        yield x, phi


def table():
    for beta, friction in POINTS:
        _, coarse, fine = [[nstr(v, 35, strip_zeros=False) for v in pair] for pair in motion(beta, friction)]
        if coarse != fine:
            sys.exit(f"{beta} {friction}: the digits differ: {coarse} {fine}")
        yield beta, friction, *fine


# --- Den Hartog's formulas ---


def functions(beta):
    return 1 / (1 - beta ** 2), sin(pi / beta) / (beta * (1 + cos(pi / beta)))


def formulas(beta, friction):
    """x_0, cos phi, sin phi."""
    v, s = functions(beta)
    x_0 = sqrt(v ** 2 - friction ** 2 * s ** 2)
    return x_0, x_0 / v, -friction * s / v


def limit(beta):
    v, s = functions(beta)
    return sqrt(v ** 2 / (s ** 2 + 1 / beta ** 4))


def check():
    mp.dps = 45
    rows = [line.split("\t") for line in open(pathlib.Path(__file__).with_suffix(".tsv")) if line.strip()]
    worst = mpf(0)
    for beta, friction, x_0, phi in rows:
        x, c, s = formulas(rational(beta), rational(friction))
        worst = max(worst, abs(x - mpf(x_0)) / x, abs(c - cos(mpf(phi))), abs(s - sin(mpf(phi))))
    print(f"{len(rows)} motions: the formulas differ by at most {nstr(worst, 2)}")
    failed = len(rows) != len(POINTS) or worst > mpf(10) ** -30
    mp.dps = 16
    for beta in [mpf(p) / q for p, q in ((11, 20), (9, 10), (5, 4), (3, 1))]:
        easy, below, above = [Oscillator(beta, limit(beta) * (1 + part)) for part in (-0.1, -0.0001, 0.0001)]
        last, _ = easy.follow(60)
        steady = below.improved(*easy.improved(last[0], atan2(last[4], last[3])))
        stood = [o.follow(10, steady)[1] for o in (below, above)]
        print(f"beta {nstr(beta, 4)}, limit {nstr(limit(beta), 10)}: the mass stands still for a time of {nstr(stood[0], 3)} "
              f"in 5 periods a 10000th below, of {nstr(stood[1], 3)} as much above")
        failed |= stood[0] != 0 or stood[1] == 0
    beta, friction = mpf(2) / 5, mpf(3) / 20
    stood = Oscillator(beta, friction).follow(50)[1]
    print(f"beta 2/5, F 3/20, limit {nstr(limit(beta), 10)}: the mass stands still for {nstr(stood, 3)}")
    return failed or friction > limit(beta) or stood == 0


if __name__ == "__main__":
    if sys.argv[1:] == ["check"]:
        sys.exit(check())
    for row in table():
        print(*row, sep="\t", flush=True)
