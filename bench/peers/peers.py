#!/usr/bin/env python3
"""Peers that are not C: CPython, mpmath, SciPy and PARI/GP on the jobs of `stickslip bench`, those that are installed.

    stickslip bench --inputs FOLDER [--quick]
    peers.py FOLDER [--quick]
    stickslip bench --peers FOLDER/peers.tsv ...

Reads FOLDER/JOB-inputs.tsv (inputs as exact doubles, true outputs to 60 digits) and writes FOLDER/peers.tsv: lines
"# name: version", then one row for each method at each setting.  Errors and times are taken as the C harness takes them:
the worst and the median error over the inputs in the job's units, the least and the median time of one call after a first
one that is not timed, fewer inputs for slow methods.  What fails on any input has no time; what is not installed has a row
that says so.  The methods are what a user of these systems would write: matrix exponentials, closed forms with Newton's
iteration from rough times, an integrator with its own event location, differences, a solver of six equations.
"""
import math
import pathlib
import platform
import re
import shutil
import statistics
import subprocess
import sys
import time

import mpmath as mp

try:
    import numpy
    import scipy
    import scipy.integrate
    import scipy.linalg
    import scipy.optimize
except ImportError:
    scipy = None

COLUMNS = ("job method title arithmetic kind setting bare state inputs failures error_worst error_median ns_least "
           "ns_median").split()
GROUPS = {"propagator": [0] * 16, "map": [0, 1, 2, 3], "jacobian": [0] * 4, "orbit": [0, 0, 0, 0, 1, 1, 2]}
DIGITS = (15, 30, 50)  # below the 60 of the truth
BARE = ("python", "mpmath-closed", "pari-gp", "python-central", "mpmath-central", "mpmath-diff", "scipy-fsolve",
        "mpmath-findroot")  # told rough times, or check no first event
SCENE = pathlib.Path(__file__).resolve().parents[2] / "verify/scenes/paper.scene"


def read(path):
    lines = path.read_text().splitlines()
    n_in = sum(name.startswith("in") for name in lines[0].split("\t"))
    with mp.workdps(80):
        for line in lines[1:]:
            field = line.split("\t")
            yield [float(x) for x in field[:n_in]], [mp.mpf(x) for x in field[n_in:]]


def rough(times):
    """What the C methods that do not search are told."""
    return [float(t) + min(float(t), 1) / 64 for t in times]


# --- The closed form, in the functions of lib: math or mpmath. ---

def newton(f, t, eps):
    for _ in range(60):
        value, rate = f(t)
        step = -value / rate
        t += step
        if abs(step) < eps:
            return t
    raise ArithmeticError("no convergence")


class Pass:
    """From r at the end of the stick phase: rotation of w, two modes, rotation of r."""

    def __init__(self, lib, params):
        chi, eta, V, e1, e2 = params
        self.lib, self.V, self.e1, self.chi, self.pull, self.rb = lib, V, e1, chi, eta * e2, e2 / chi
        self.a, self.stiff = (1 - chi) * V, chi * eta
        mean, root = (1 + self.stiff) / 2, lib.sqrt(((1 - self.stiff) / 2) ** 2 + chi * self.stiff)
        self.square = [self.stiff * (1 - chi) / (mean + root), mean + root]
        self.om = [lib.sqrt(q) for q in self.square]

    def slow(self, u):
        """The projector of the slow mode is (large - K)/(large - small)."""
        gap, large = self.square[1] - self.square[0], self.square[1]
        return [((large - 1) * u[0] + self.chi * u[1]) / gap,
                (self.stiff * u[0] + (large - self.stiff) * u[1]) / gap]

    def modes(self, v, f):
        vs, fs = self.slow(v), self.slow(f)
        return [[(vs[i], fs[i] / self.om[0]), (v[i] - vs[i], (f[i] - fs[i]) / self.om[1])] for i in range(2)]

    def speed_force(self, amp, t, i):
        """The velocity of a mass, and minus its acceleration."""
        sine, cosine = [self.lib.sin(q * t) for q in self.om], [self.lib.cos(q * t) for q in self.om]
        return (sum(amp[i][k][0] * cosine[k] - amp[i][k][1] * sine[k] for k in range(2)),
                sum(self.om[k] * (amp[i][k][0] * sine[k] + amp[i][k][1] * cosine[k]) for k in range(2)))

    def leave(self, t):
        """z_1' and w at the end of the slip-stick phase."""
        s, c = self.lib.sin(t), self.lib.cos(t)
        return self.V - self.a * (1 - c) - self.e1 * s, self.e1 * c + self.a * s

    def map(self, r, hint, eps):
        """t_b, t_c, t_d, r and w where the stick-slip phase ends."""
        lib, a, e1 = self.lib, self.a, self.e1
        tb = newton(lambda t: (a * (t - lib.sin(t)) + e1 * (1 - lib.cos(t)) + r - self.rb,
                               a * (1 - lib.cos(t)) + e1 * lib.sin(t)), hint[0], eps)
        v1, w = self.leave(tb)
        amp = self.modes([v1, self.V], [w, self.pull])

        def at(t):
            speed, force = self.speed_force(amp, t, 0)
            return speed - self.V, -force

        tc = newton(at, hint[1], eps)
        speed, force = self.speed_force(amp, tc, 1)
        wc = self.speed_force(amp, tc, 0)[1]
        rc, turned, omega = force / self.stiff, (speed - self.V) / lib.sqrt(self.stiff), lib.sqrt(self.stiff)
        sign = 1 if turned > 0 else -1
        td, end = lib.atan2(abs(turned), sign * rc) / omega, sign * lib.sqrt(rc * rc + turned * turned)
        return [tb, tc, td, end], wc + a * td - self.chi * (end - rc)

    def slope(self, tb, tc):
        """Of the return map of r: the trace of the Jacobian."""
        v1, w = self.leave(tb)
        amp, by_tb = self.modes([v1, self.V], [w, self.pull]), self.modes([-w, 0], [self.a + v1 - self.V, 0])
        (speed, force), wc = self.speed_force(amp, tc, 1), self.speed_force(amp, tc, 0)[1]
        (dq, df), dp = self.speed_force(by_tb, tc, 1), self.speed_force(by_tb, tc, 0)[0]
        q, rc = speed - self.V, force / self.stiff
        dtc = dp / wc
        dr, dq = df / self.stiff + q * dtc, dq - self.stiff * rc * dtc
        end = math.copysign(1, q) * self.lib.sqrt(rc * rc + q * q / self.stiff)
        return (rc * dr + q * dq / self.stiff) / end / (v1 - self.V)


def eps_of(lib):
    return 1e-9 if lib is math else mp.mpf(10) ** (-mp.mp.dps // 2 - 2)


def numbers(lib, x):
    return x if lib is math else [mp.mpf(v) for v in x]


def map_closed(lib, x, true):
    x = numbers(lib, x)
    return Pass(lib, x[:5]).map(x[5], numbers(lib, rough(true[:3])), eps_of(lib))[0]


def positions(lib, x, hint):
    """The positions after one pass from x[5:]."""
    p = Pass(lib, x[:5])
    (_, _, _, r), w = p.map(x[6] - x[5], hint, eps_of(lib))
    z1 = (w + p.chi * r) / (1 - p.chi)
    return [z1, z1 + r]


# --- The propagator. ---

def system(chi, eta, one):
    """The matrix of Z' = A Z in the phase in which both masses slip."""
    o = 0 * one
    return [[o, o, one, o], [o, o, o, one], [-one, chi, o, o], [chi * eta, -chi * eta, o, o]]


def expm_mpmath(x, true):
    chi, eta, t = map(mp.mpf, x)
    h = mp.expm(mp.matrix(system(chi, eta, mp.mpf(1))) * t, method="taylor")
    return [h[i, k] for i in range(4) for k in range(4)]


def expm_scipy(x, true):
    return list(scipy.linalg.expm(numpy.array(system(x[0], x[1], 1.0)) * x[2]).ravel())


# --- The map, integrated. ---

def map_scipy(x, true, method, tol):
    """w, r and the velocities through three phases, each ended by SciPy's event location."""
    chi, eta, V, e1, e2, r = x
    y, times = [e1, r, V, V], []
    for slips, switch in (((1, 0), lambda t, y: y[1] - e2 / chi), ((1, 1), lambda t, y: y[2] - V),
                          ((0, 1), lambda t, y: y[3] - V)):
        def side(t, y, slips=slips):
            return [y[2] - chi * y[3], y[3] - y[2], -slips[0] * y[0], -slips[1] * chi * eta * y[1]]

        def event(t, y, switch=switch):
            return switch(t, y)

        event.terminal = True
        longest = 1.5 / math.sqrt(1 + chi * eta)
        run = scipy.integrate.solve_ivp(side, (0, 100), y, method=method, rtol=max(tol, 3e-14), atol=tol,
                                        events=event, max_step=longest)
        if run.status != 1:
            raise ArithmeticError("no event")
        times.append(run.t_events[0][0])
        y = list(run.y_events[0][0])
        if len(times) == 1:
            y[1] = e2 / chi
        if len(times) == 2:
            y[2] = V
    return times + [y[1]]


# --- The Jacobian by differences. ---

def closed_hint(x):
    """Rough times, found once and outside of the timing, since the differences are what is measured."""
    w, r = x[5] - x[0] * x[6], x[6] - x[5]
    y = [x[3], r, x[2], x[2]]
    chi, eta, V, _, e2 = x[:5]
    t, times, h = 0.0, [], 1e-3 / math.sqrt(1 + chi * eta)
    phases = (((1, 0), lambda y: y[1] - e2 / chi), ((1, 1), lambda y: y[2] - V))
    for slips, switch in phases:
        begin, value = t, None
        while t < begin + 100:
            f = [y[2] - chi * y[3], y[3] - y[2], -slips[0] * y[0], -slips[1] * chi * eta * y[1]]
            mid = [a + h / 2 * b for a, b in zip(y, f)]
            f = [mid[2] - chi * mid[3], mid[3] - mid[2], -slips[0] * mid[0], -slips[1] * chi * eta * mid[1]]
            y = [a + h * b for a, b in zip(y, f)]
            t += h
            now = switch(y)
            if value is not None and value < 0 <= now:
                break
            value = now
        times.append(t - begin)
    return times


def jacobian_mpmath(x, hint, rule):
    """Entry by entry, as mpmath.diff does it; or central differences at 10^(-digits/3) with those digits."""
    x, hint = numbers(mp, x), numbers(mp, hint)
    if rule == "diff":
        def entry(row, col):
            return mp.diff(lambda z: positions(mp, x[:col] + [z] + x[col + 1:], hint)[row], x[col])
        return [entry(row, col) for row in range(2) for col in (5, 6)]
    h = mp.mpf(10) ** (-mp.mp.dps // 3)
    ends = [[positions(mp, x[:col] + [x[col] + side * h] + x[col + 1:], hint) for side in (1, -1)] for col in (5, 6)]
    return [(up[row] - down[row]) / (2 * h) for row in range(2) for up, down in ends]


def jacobian_python(x, hint):
    h = 6e-6 * (abs(x[5]) + abs(x[6]) + x[2])
    ends = [[positions(math, x[:col] + [x[col] + side * h] + x[col + 1:], hint) for side in (1, -1)] for col in (5, 6)]
    return [(up[row] - down[row]) / (2 * h) for row in range(2) for up, down in ends]


# --- The orbit from the printed guess: z_10, z_20, t_a, t_b, t_c, t_d. ---

def printed_guess():
    value = dict(re.findall(r"^printed: (\w+) = (\S+)", SCENE.read_text(), re.M))
    return [float(value[k]) for k in ("z10", "z20", "t_a", "t_b", "t_c", "t_d")]


def six(lib, params):
    """The six equations in the six unknowns, one by one through the phases."""
    p = Pass(lib, params)
    omega = lib.sqrt(p.stiff)

    def residual(z10, z20, ta, tb, tc, td):
        w, r = z10 - p.chi * z20, z20 - z10
        w1, r1 = w + p.a * ta, r
        v1, wb = p.leave(tb)
        rb = r1 + p.a * (tb - lib.sin(tb)) + p.e1 * (1 - lib.cos(tb))
        amp = p.modes([v1, p.V], [wb, p.stiff * p.rb])
        (speed, wc), (other, force) = p.speed_force(amp, tc, 0), p.speed_force(amp, tc, 1)
        rc, q, s, c = force / p.stiff, other - p.V, lib.sin(omega * td), lib.cos(omega * td)
        rd = rc * c + q / omega * s
        return [w1 - p.e1, rb - p.rb, speed - p.V, -rc * omega * s + q * c,
                wc + p.a * td - p.chi * (rd - rc) - w, rd - r]

    return residual, p


def in_order(x, p):
    return list(x[2:]) + [x[0], x[1], p.slope(x[3], x[4])]


def orbit_scipy(x, true, guess):
    residual, p = six(math, x)
    root, _, status, _ = scipy.optimize.fsolve(lambda u: residual(*map(float, u)), guess, xtol=1e-14, full_output=True)
    if status not in (1, 3, 4, 5):  # the others say: no more progress, which is right at the rounding
        raise ArithmeticError("fsolve gives up")
    return in_order([float(u) for u in root], p)


def orbit_mpmath(x, true, guess):
    residual, p = six(mp, numbers(mp, x))
    eps = mp.mpf(10) ** (-2 * mp.mp.dps + 6)  # of the squared residual
    return in_order(list(mp.findroot(residual, guess, solver="mdnewton", tol=eps, maxsteps=30)), p)


# --- Measuring. ---

def error_of(got, true, groups):
    with mp.workdps(80):
        scale = [max(abs(t) for t, g in zip(true, groups) if g == mine) for mine in groups]
        return max(abs(mp.mpf(g) - t) / s for g, t, s in zip(got, true, scale))


def time_one(run, quick):
    """The result, and the times of a call: batches for what is fast, since reading the clock takes time too."""
    got = run()
    begin = time.perf_counter_ns()
    run()
    repeats = max(1, int(1e5 / (time.perf_counter_ns() - begin + 1)))
    seconds = []
    for _ in range(2 if quick else 5):
        begin = time.perf_counter_ns()
        for _ in range(repeats):
            run()
        seconds.append((time.perf_counter_ns() - begin) / repeats)
    return got, min(seconds), statistics.median(seconds)


def measure(job, cases, run, quick):
    """The part of a row that is measured: state to ns_median."""
    errors, least, middle, failures, tried = [], [], [], 0, 0
    end = time.perf_counter() + (0.3 if quick else 1.5)
    for x, true in cases:
        if tried and time.perf_counter() > end:
            break
        tried += 1
        try:
            got, fast, typical = time_one(lambda: run(x, true), quick)
            errors.append(error_of(got, true, GROUPS[job]))
            least.append(fast)
            middle.append(typical)
        except (ArithmeticError, ValueError):
            failures += 1
    if failures:
        return ["failed: gives up", tried, failures] + ["-"] * 4
    return judged(errors, tried, statistics.mean(least), statistics.mean(middle))


def judged(errors, tried, least, median):
    wrong = sum(not e < 0.5 for e in errors)
    if wrong:
        return ["failed: not one digit right", tried, wrong] + ["-"] * 4
    return ["ok", tried, 0, mp.nstr(max(errors), 2), mp.nstr(statistics.median(errors), 2), "%.5g" % least,
            "%.5g" % median]


def run_gp(cases, digits):
    """PARI/GP runs its own script over all inputs and times itself."""
    program = pathlib.Path(__file__).with_name("map.gp").read_text()
    data = ";".join(",".join("%d/%d" % v.as_integer_ratio() for v in x + rough(true[:3])) for x, true in cases)
    done = subprocess.run(["gp", "-q", "-f"], input="%s\nrun(%d, [%s])\n" % (program, digits, data), capture_output=True,
                          text=True)
    out = done.stdout.split()
    if done.returncode or len(out) != 2 + 4 * len(cases):
        return ["failed: gives up", len(cases), len(cases)] + ["-"] * 4
    with mp.workdps(80):
        results = [mp.mpf(v) for v in out[2:]]
    errors = [error_of(results[4 * k:4 * k + 4], true, GROUPS["map"]) for k, (_, true) in enumerate(cases)]
    return judged(errors, len(cases), float(out[0]), float(out[1]))


# --- The table: job, method, title, arithmetic, kind, setting, what runs it (None: not installed). ---

def with_hints(cases, f):
    hints = {id(x): closed_hint(x) for x, _ in cases}
    return lambda x, true: f(x, hints[id(x)])


def methods(job, cases, quick):
    def at_digits(method, title, f):
        for dps in DIGITS[::2] if quick else DIGITS:
            yield method, title, "mpmath", "digits", dps, f

    def in_double(method, title, f, kind="", setting="", have=True):
        return method, title, "double", kind, setting, f if have else None

    if job == "propagator":
        yield from at_digits("mpmath-expm", "mpmath.expm, Taylor series", expm_mpmath)
        yield in_double("scipy-expm", "scipy.linalg.expm", expm_scipy, have=scipy)
    elif job == "map":
        yield in_double("python", "closed form in CPython from rough t_b and t_c, no search",
                        lambda x, true: map_closed(math, x, true))
        yield from at_digits("mpmath-closed", "closed form in mpmath from rough t_b and t_c, no search",
                             lambda x, true: map_closed(mp, x, true))
        for method in ("DOP853", "LSODA", "Radau"):
            for tol in (1e-6, 1e-10, 1e-13):
                if method != "Radau" or tol != 1e-13:  # it needs seconds for a call there
                    yield in_double("scipy-" + method.lower(), "scipy.integrate.solve_ivp, %s, with its events" % method,
                                    lambda x, true, m=method, e=tol: map_scipy(x, true, m, e), "tolerance", tol, scipy)
        for digits in (18, 50):
            yield ("pari-gp", "closed form in PARI/GP from rough t_b and t_c, no search", "gp", "digits", digits,
                   (lambda d=digits: run_gp(cases, d)) if shutil.which("gp") else None)
    elif job == "jacobian":
        yield in_double("python-central", "central differences of the closed form in CPython",
                        with_hints(cases, jacobian_python))
        yield from at_digits("mpmath-central", "central differences in mpmath at the step 10^(-digits/3)",
                             with_hints(cases, lambda x, hint: jacobian_mpmath(x, hint, "central")))
        yield from at_digits("mpmath-diff", "mpmath.diff, entry by entry",
                             with_hints(cases, lambda x, hint: jacobian_mpmath(x, hint, "diff")))
    else:
        guess = printed_guess()
        yield in_double("scipy-fsolve", "scipy.optimize.fsolve on six unknowns",
                        lambda x, true: orbit_scipy(x, true, guess), have=scipy)
        yield from at_digits("mpmath-findroot", "mpmath.findroot on six unknowns",
                             lambda x, true: orbit_mpmath(x, true, guess))


def rows_of(job, cases, quick):
    absent = set()
    for method, title, arithmetic, kind, setting, run in methods(job, cases, quick):
        bare = "yes" if method in BARE else "no"
        if run is None:  # once, whatever its settings
            if method not in absent:
                yield [job, method, title, arithmetic, "", "", bare, "not installed", 0, 0] + ["-"] * 4
            absent.add(method)
            continue
        with mp.workdps(setting if arithmetic == "mpmath" else 16):
            measured = run() if arithmetic == "gp" else measure(job, cases, run, quick)
        yield [job, method, title, arithmetic, kind, setting, bare] + measured


def versions():
    gp = shutil.which("gp")
    number = subprocess.run(["gp", "--version-short"], capture_output=True, text=True).stdout.strip() if gp else ""
    return {"Python": platform.python_version(), "mpmath": "%s (%s)" % (mp.__version__, mp.libmp.BACKEND),
            "SciPy": "%s, NumPy %s" % (scipy.__version__, numpy.__version__) if scipy else "not installed",
            "PARI/GP": number or "not installed"}


def main():
    arguments = [a for a in sys.argv[1:] if a != "--quick"]
    if len(arguments) != 1 or arguments[0].startswith("-"):
        sys.exit(__doc__)
    folder, quick = pathlib.Path(arguments[0]), "--quick" in sys.argv
    if not folder.is_dir():
        sys.exit("peers.py: no folder %s" % folder)
    lines = ["# %s: %s" % pair for pair in versions().items()] + ["\t".join(COLUMNS)]
    for job in GROUPS:
        path = folder / (job + "-inputs.tsv")
        cases = list(read(path))[:4 if quick else None] if path.exists() else []
        lines += ["\t".join(map(str, row)) for row in rows_of(job, cases, quick)] if cases else []
    (folder / "peers.tsv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
