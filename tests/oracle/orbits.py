"""Periodic orbits of the word D-Gamma-H-C to many digits, from the equations of motion (1) and Coulomb's law (2).

In each phase z'' = -K z, with the rows of K set to zero that belong to sticking masses; the motion is the exponential of
the 4x4 first-order system, by its power series and doubling.  An orbit solves six equations in (z10, z20, t_a, t_b, t_c, t_d) by
mpmath.findroot, started from the searches of scan.py.  No formula of the paper beyond (1) and (2), and none of the
closed forms of the C program, is used.

    orbits.py orbits|paper_1000|jacobian     print the data file of that name
    orbits.py check                          integrate the admissible orbits of orbits.tsv by (1) and (2) alone
    orbits.py compare SEED N                 hold the two searches of scan.py against each other on N random sets
"""
import math
import multiprocessing
import os
import random
import sys
from fractions import Fraction

import mpmath
from mpmath import mp, mpf

import coulomb
import scan

HERE = os.path.dirname(os.path.abspath(__file__))
PHASES = ("D", "Gamma", "H", "C")
UNKNOWNS = ("z10", "z20", "t_a", "t_b", "t_c", "t_d")
DIGITS = 60


def exact(q):
    return mpf(q.numerator) / q.denominator


def product(a, b):
    return [[a[i][0] * b[0][j] + a[i][1] * b[1][j] for j in range(2)] for i in range(2)]


def exponential(k, t):
    """The exponential of [[0, I], [-K, 0]] t for a 2x2 matrix K: blocks C = sum (-K t^2)^n / (2n)!, S = sum t (-K t^2)^n / (2n+1)!
    at t / 2^d, where the series are short, then d doublings C -> 2 C^2 - I, S -> 2 S C.  Each loses two bits."""
    size = max(abs(x) for row in k for x in row) * t * t
    d = max(0, int(mpmath.ceil(mpmath.log(size, 4))) + 8) if size else 0
    with mpmath.workprec(mp.prec + 2 * d + 20):
        h = t / 2 ** d
        power, c, s, n = [[mpf(1), mpf(0)], [mpf(0), mpf(1)]], [[mpf(0)] * 2 for _ in "12"], [[mpf(0)] * 2 for _ in "12"], 0
        step = [[-x * h * h for x in row] for row in k]
        while max(abs(x) for row in power for x in row) > mpf(2) ** -mp.prec:
            for i in range(2):
                for j in range(2):
                    c[i][j] += power[i][j]
                    s[i][j] += power[i][j] * h / (n + 1)
            power = [[x / ((n + 1) * (n + 2)) for x in row] for row in product(power, step)]
            n += 2
        for _ in range(d):
            c, s = product(c, c), product(s, c)
            c = [[2 * c[i][j] - (i == j) for j in range(2)] for i in range(2)]
            s = [[2 * x for x in row] for row in s]
        lower = [[-x for x in row] for row in product(k, s)]
    return +mpmath.matrix([c[0] + s[0], c[1] + s[1], lower[0] + c[0], lower[1] + c[1]])


class System:
    """One parameter set, its exact values rounded once to the working precision in force."""

    def __init__(self, params):
        self.chi, self.eta, self.v, self.e1, self.e2 = (exact(p) for p in params)
        ce = self.chi * self.eta
        slip1, slip2, stick = (1, -self.chi), (-ce, ce), (0, 0)
        rows = {"D": (stick, stick), "Gamma": (slip1, stick), "H": (slip1, slip2), "C": (stick, slip2)}
        self.stiffness, self.matrix, self.last = rows, {}, (None, None)
        for ph, (r1, r2) in rows.items():
            self.matrix[ph] = mpmath.matrix([[0, 0, 1, 0], [0, 0, 0, 1], [-r1[0], -r1[1], 0, 0],
                                             [-r2[0], -r2[1], 0, 0]])
        self.event = {
            "D": (mpmath.matrix([[1, -self.chi, 0, 0]]), self.e1),
            "Gamma": (mpmath.matrix([[-self.chi, self.chi, 0, 0]]), self.e2),
            "H": (mpmath.matrix([[0, 0, 1, 0]]), self.v),
            "C": (mpmath.matrix([[0, 0, 0, 1]]), self.v),
        }

    def step(self, ph, t):
        """The last one is kept: Newton's iteration asks for the value and for the slope at one time."""
        if self.last[0] != (ph, t, mp.dps):
            self.last = (ph, t, mp.dps), exponential(self.stiffness[ph], mpf(t))
        return self.last[1]

    def residual_and_jacobian(self, x):
        """The six equations (12), (14), (16), (18) at x = (z10, z20, t_a, t_b, t_c, t_d), and their derivative."""
        z = mpmath.matrix([x[0], x[1], self.v, self.v])
        s = mpmath.matrix(4, 6)
        s[0, 0] = s[1, 1] = 1
        f, j = mpmath.matrix(6, 1), mpmath.matrix(6, 6)
        for i, ph in enumerate(PHASES):
            e = self.step(ph, x[2 + i])
            z, s = e * z, e * s
            s[:, 2 + i] = self.matrix[ph] * z
            n, c = self.event[ph]
            if ph != "C":
                f[i] = (n * z)[0] - c
                j[i, :] = n * s
        for i, (row, start) in enumerate(((0, x[0]), (1, x[1]), (3, self.v))):
            f[3 + i] = z[row] - start
            j[3 + i, :] = s[row, :]
        j[3, 0] -= 1
        j[4, 1] -= 1
        return f, j

    def solve(self, guess):
        known = {}

        def both(x):
            if x not in known:
                known.clear()
                known[x] = self.residual_and_jacobian(x)
            return known[x]

        return mpmath.findroot(lambda *x: both(x)[0], guess, J=lambda *x: both(x)[1],
                               tol=mpf(10) ** (15 - mp.dps), maxsteps=40, norm=lambda y: mpmath.norm(y, mpmath.inf))

    def phase_end(self, ph, z, guess):
        """The event of the phase near guess from the state z: its time and the state there."""
        n, c = self.event[ph]
        a = self.matrix[ph]

        def value(t):
            return (n * (self.step(ph, t) * z))[0] - c

        t = mpmath.findroot(value, guess, solver="newton", df=lambda t: (n * (a * (self.step(ph, t) * z)))[0],
                            tol=mpf(10) ** (8 - mp.dps), verify=False)  # of the last step, whose square is left
        d = mpf(10) ** (20 - mp.dps)
        if value(t - d) * value(t + d) >= 0:
            raise ArithmeticError("no change of sign at the event of phase " + ph)
        return t, self.step(ph, t) * z

    def word(self, z10, z20, times):
        """The states at the ends of the four phases, each event taken near the given time."""
        z, ends = mpmath.matrix([z10, z20, self.v, self.v]), []
        for ph, t in zip(PHASES, times):
            z = self.phase_end(ph, z, t)[1]
            ends.append(z)
        return ends

    def return_jacobian(self, x, h):
        j = mpmath.matrix(2, 2)
        for k in range(2):
            up, down = ([x[0], x[1]] for _ in range(2))
            up[k] += h
            down[k] -= h
            fu, fd = self.word(*up, x[2:])[3], self.word(*down, x[2:])[3]
            j[0, k], j[1, k] = (fu[0] - fd[0]) / (2 * h), (fu[1] - fd[1]) / (2 * h)
        return j

    def local_jacobian(self, ph, z, t, h):
        j = mpmath.matrix(4, 4)
        for k in range(4):
            up, down = z.copy(), z.copy()
            up[k] += h
            down[k] -= h
            column = (self.phase_end(ph, up, t)[1] - self.phase_end(ph, down, t)[1]) / (2 * h)
            for i in range(4):
                j[i, k] = column[i]
        return j

    def smallest(self, flow, ph, z, t_end, n):
        """The least value of n.Z on the closed phase: both ends and the interior extrema."""
        a, times = self.matrix[ph], [mpf(0), t_end]
        for t in flow.extrema(tuple(float(x) for x in z), tuple(float(x) for x in n), 0.0, float(t_end)):
            times.append(mpmath.findroot(lambda s: (n * (a * (self.step(ph, s) * z)))[0], (t, t + mpf(10) ** -8)))
        return min((n * (self.step(ph, t) * z))[0] for t in times)


def below(flow, z, t_end, n, c):
    """Whether n.Z < c in the open phase: at most c at both ends and below c at every interior maximum."""
    ends = [scan.dot(n, z) - c, scan.dot(n, flow.at(z, t_end)) - c]
    inner = [scan.dot(n, flow.at(z, t)) - c for t in flow.extrema(z, n, c, t_end)]
    if any(abs(f) < 1e-6 for f in inner) or any(1e-10 < abs(f) < 1e-6 for f in ends):
        raise ArithmeticError("a condition is too close to call in double precision")
    return all(f <= 1e-10 for f in ends) and all(f < 0 for f in inner)


def violations(model, x):
    """The names of the conditions that the orbit breaks (double precision, every margin above 1e-6)."""
    z0 = (float(x[0]), float(x[1]), model.v, model.v)
    states, z = [], z0
    for ph, t in zip(PHASES, x[2:]):
        states.append(z)
        z = model.flow[ph].at(z, float(t)) if t >= 0 else model.flow[ph].taylor(z, float(t))
    v1, v2 = model.event["H"], model.event["C"]
    t = dict(zip(PHASES, map(float, x[2:])))
    s = dict(zip(PHASES, states))
    f = model.flow
    checks = {
        "t_a": float(x[2]) > 0,
        "gamma_v1": below(f["Gamma"], s["Gamma"], t["Gamma"], *v1),
        "h_v1": below(f["H"], s["H"], t["H"], *v1),
        "h_v2": below(f["H"], s["H"], t["H"], *v2),
        "c_v2": below(f["C"], s["C"], t["C"], *v2),
        "c_w": below(f["C"], s["C"], t["C"], *model.event["D"]),
        "d_r": scan.dot(model.event["Gamma"][0], z0) < model.e2,
        "gamma_r": below(f["Gamma"], s["Gamma"], t["Gamma"], *model.event["Gamma"]),
    }
    return [name for name, good in checks.items() if not good]


def friction_bounds(system, model, x):
    """(u_r1_min, u_r2_min): half the distance from e_i down to the least force on the sticking mass.

    Phase D counts with the values at both of its ends, also when t_a < 0."""
    z0 = mpmath.matrix([x[0], x[1], system.v, system.v])
    za = system.step("D", x[2]) * z0
    zb = system.step("Gamma", x[3]) * za
    zc = system.step("H", x[4]) * zb
    (w, e1), (r, e2) = system.event["D"], system.event["Gamma"]
    least_c = system.smallest(model.flow["C"], "C", zc, x[5], w)
    if x[2] < 0 and least_c > e1:
        raise ArithmeticError("the lower bound of u_r1 depends on how a stick phase of negative length is counted")
    least_w = min(least_c, (w * z0)[0], (w * za)[0])
    least_r = min((r * z0)[0], system.smallest(model.flow["Gamma"], "Gamma", za, x[3], r))
    return (e1 - least_w) / 2, (e2 - least_r) / 2


def read_sets():
    sets = []
    with open(os.path.join(HERE, "sets.tsv"), encoding="utf-8") as f:
        for line in f:
            if not line.startswith("#"):
                field = line.rstrip("\n").split("\t")
                sets.append((field[0], field[1:6], field[6]))
    return sets


def agree(a, b):
    return len(a) == len(b) and all(
        abs(u - v) < 1e-6 * (1 + max(map(abs, p))) for p, q in zip(a, b) for u, v in zip(p, q))


def search(text):
    """The orbits of a parameter set in double precision, by both searches, and what the samples without return were."""
    model = scan.Model(*(float(Fraction(p)) for p in text))
    first, counts = scan.by_return_map(model)
    second = scan.by_plane(model, 0.01, 0.04)
    if not agree(first, second):
        raise ArithmeticError("the two searches differ: %r\n%r" % (first, second))
    return model, first, counts


def digits(x, n=DIGITS):
    return mpmath.nstr(x, n, strip_zeros=False, min_fixed=-mpmath.inf, max_fixed=mpmath.inf)


def orbit_values(text, model, guess, dps):
    with mpmath.workdps(dps):
        system = System([Fraction(p) for p in text])
        x = list(system.solve([mpf(g) for g in guess]))
        j = system.return_jacobian(x, mpf(10) ** (-dps // 3))
        if abs(j[0, 0] * j[1, 1] - j[0, 1] * j[1, 0]) > mpf(10) ** (-DIGITS - 5) * mpmath.norm(j) ** 2:
            raise ArithmeticError("the return map forgets all but r, yet its Jacobian is not singular")
        values = x + [sum(x[2:]), j[0, 0] + j[1, 1], *friction_bounds(system, model, x)]
        return [digits(y) for y in values]


def orbits_of(entry):
    name, text, _ = entry
    model, guesses, counts = search(text)
    late = counts.get("late", 0) + counts.get("no t_b", 0) + counts.get("no t_d", 0)
    lines = ["\t".join(["set", name, *text, str(len(guesses)), "%g" % scan.T_MAX, str(late)])]
    for k, guess in enumerate(guesses):
        values = orbit_values(text, model, guess, 3 * DIGITS)
        again = orbit_values(text, model, guess, 3 * DIGITS + 45)
        if values != again:
            raise ArithmeticError("%s: the digits depend on the working precision\n%r\n%r" % (name, values, again))
        broken = violations(model, [mpf(v) for v in values[:6]])
        lines.append("\t".join(["orbit", name, str(k), *values, "no" if broken else "yes", ",".join(broken) or "-"]))
    return lines


def print_orbits():
    print("# Periodic orbits of the word D-Gamma-H-C, %d significant digits, rounded to nearest.  "
          "Made by orbits.py orbits." % DIGITS)
    print("# set\tname\tchi\teta\tV\te1\te2\torbits\tt_c_limit\tsamples_without_t_c_up_to_the_limit")
    print("# orbit\tname\tindex\t" + "\t".join(UNKNOWNS)
          + "\tperiod\ttrace\tu_r1_min\tu_r2_min\tadmissible\tviolations")
    with multiprocessing.Pool() as pool:
        for lines in pool.imap(orbits_of, read_sets(), 1):
            print("\n".join(lines), flush=True)


def print_paper(n=1010):
    _, text, _ = read_sets()[0]
    _, guesses, _ = search(text)
    printed = (0.8921, -2.1958, 0.6784, 2.0, 1.5, 2.34)
    guess = min(guesses, key=lambda g: max(abs(a - b) for a, b in zip(g, printed)))
    answers = []
    for dps in (n + 50, n + 190):
        with mpmath.workdps(dps):
            x = System([Fraction(p) for p in text]).solve([mpf(g) for g in guess])
            answers.append([digits(y, n) for y in x])
    if answers[0] != answers[1]:
        raise ArithmeticError("the digits depend on the working precision")
    print("# The orbit nearest to the paper's printed numbers, %d significant digits.  "
          "Made by orbits.py paper_1000." % n)
    for name, value in zip(UNKNOWNS, answers[0]):
        print(name + "\t" + value)


# the name of a set in sets.tsv and the index of the orbit by increasing z10
JACOBIANS = (("paper", 1), ("stable", 0), ("long-slip", 1), ("beyond-tstar2", 1))


def jacobian_of(case):
    name, index = case
    text = next(t for n, t, _ in read_sets() if n == name)
    _, guesses, _ = search(text)
    answers = []
    for dps, h in ((150, 45), (200, 60)):
        with mpmath.workdps(dps):
            h = mpf(10) ** -h
            system = System([Fraction(p) for p in text])
            x = list(system.solve([mpf(g) for g in guesses[index]]))
            z = mpmath.matrix([x[0], x[1], system.v, system.v])
            found = {}
            for ph, t in zip(PHASES, x[2:]):
                found[ph] = system.local_jacobian(ph, z, t, h)
                z = system.phase_end(ph, z, t)[1]
            found["return"] = system.return_jacobian(x, h)
            answers.append([(m, i, k, digits(j[i, k], 40) if abs(j[i, k]) > mpf(10) ** -60 else "0")
                            for m, j in found.items() for i in range(j.rows) for k in range(j.cols)])
    if answers[0] != answers[1]:
        raise ArithmeticError("%s: the digits depend on the working precision" % name)
    return ["\t".join([name, str(index), m, str(i + 1), str(k + 1), v]) for m, i, k, v in answers[0]]


def print_jacobian():
    print("# Derivatives of event-located maps, 40 significant digits.  Made by orbits.py jacobian.")
    print("# Matrix: the phase whose map Z_start -> Z_end it is (4x4), or return: (z10, z20) -> one pass of the word.")
    print("# set\torbit\tmatrix\trow\tcolumn\tvalue")
    with multiprocessing.Pool() as pool:
        for lines in pool.imap(jacobian_of, JACOBIANS, 1):
            print("\n".join(lines), flush=True)


def print_check():
    """Integrate each admissible orbit of orbits.tsv over one period by (1) and (2) alone."""
    params, worst, count = {}, mpf(0), 0
    mp.dps = 45
    with open(os.path.join(HERE, "orbits.tsv"), encoding="utf-8") as f:
        for line in f:
            field = line.rstrip("\n").split("\t")
            if field[0] == "set":
                params[field[1]] = [exact(Fraction(p)) for p in field[2:7]]
            elif field[0] == "orbit" and field[13] == "yes":
                error = coulomb.one_period(params[field[1]], [mpf(v) for v in field[3:9]],
                                           mpf(field[11]), mpf(field[12]))
                print(field[1], field[2], mpmath.nstr(error, 3), sep="\t", flush=True)
                worst, count = max(worst, error), count + 1
    print("# %d admissible orbits, largest error %s" % (count, mpmath.nstr(worst, 3)))
    return worst < mpf(10) ** -35 and count > 0


def compare_one(seed):
    rng = random.Random(seed)

    def about(lo, hi):
        return float("%.3g" % math.exp(rng.uniform(math.log(lo), math.log(hi))))

    params = (round(rng.uniform(0.05, 0.95), 3), about(0.05, 20), about(0.5, 3), about(0.2, 6), about(0.05, 3))
    model = scan.Model(*params)
    if scan.longest_gamma(model) > 300:
        return seed, params, None, None, {}
    first, counts = scan.by_return_map(model, 1500)
    return seed, params, first, scan.by_plane(model), counts


def print_compare(start, n):
    same = other = orbits = skipped = 0
    with multiprocessing.Pool() as pool:
        for seed, params, first, second, counts in pool.imap(compare_one, range(start, start + n), 1):
            if first is None:
                skipped += 1
            elif agree(first, second):
                same, orbits = same + 1, orbits + len(first)
            else:
                other += 1
                print("differ", seed, params, first, second, counts, sep="\t", flush=True)
    print("# the searches agree on %d sets with %d orbits, differ on %d; %d skipped as too long" %
          (same, orbits, other, skipped))
    return other == 0


def main(args):
    if args == ["orbits"]:
        print_orbits()
    elif args == ["paper_1000"]:
        print_paper()
    elif args == ["jacobian"]:
        print_jacobian()
    elif args == ["check"]:
        return 0 if print_check() else 1
    elif len(args) == 3 and args[0] == "compare":
        return 0 if print_compare(int(args[1]), int(args[2])) else 1
    else:
        print(__doc__, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
