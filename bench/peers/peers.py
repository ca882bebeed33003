#!/usr/bin/env python3
"""Peers that are not C: mpmath, SciPy and PARI/GP on the inputs of `stickslip bench --out FOLDER`, those that are installed.

    peers.py FOLDER [--quick]

Reads FOLDER/propagator-inputs.tsv and FOLDER/map-inputs.tsv (inputs as exact doubles, true outputs to 60 digits) and writes
FOLDER/peers.tsv, in the columns of the other tables.  Errors and times are taken as the C harness takes them: the worst and
the median relative error over the inputs, the least and the median time of one call.  A peer that fails on any input has no
time.  The methods are what a user of these systems would write: matrix exponentials, closed forms with Newton's iteration
from rough times, an integrator with its own event location.
"""
import math
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

import mpmath as mp

try:
    import numpy
    import scipy.integrate
    import scipy.linalg
except ImportError:
    scipy = None

COLUMNS = "job method arithmetic kind setting state inputs failures error_worst error_median ns_least ns_median".split()


def read(path):
    lines = path.read_text().splitlines()
    n_in = sum(name.startswith("in") for name in lines[0].split("\t"))
    with mp.workdps(80):
        for line in lines[1:]:
            field = line.split("\t")
            yield [float(x) for x in field[:n_in]], [mp.mpf(x) for x in field[n_in:]]


def system(chi, eta, one):
    """The matrix of Z' = A Z in the phase in which both masses slip."""
    o = 0 * one
    return [[o, o, one, o], [o, o, o, one], [-one, chi, o, o], [chi * eta, -chi * eta, o, o]]


# --- The propagator. ---

def expm_mpmath(x):
    chi, eta, t = map(mp.mpf, x)
    h = mp.expm(mp.matrix(system(chi, eta, mp.mpf(1))) * t, method="taylor")
    return [h[i, k] for i in range(4) for k in range(4)]


def expm_scipy(x):
    return list(scipy.linalg.expm(numpy.array(system(x[0], x[1], 1.0)) * x[2]).ravel())


# --- The map from r: t_b, t_c, t_d and r. ---

def newton(f, t, eps):
    for _ in range(60):
        value, rate = f(t)
        step = -value / rate
        t += step
        if abs(step) < eps:
            return t
    raise ArithmeticError("no convergence")


def map_mpmath(x, hint):
    """The closed form: rotation of w, two modes, rotation of r."""
    chi, eta, V, e1, e2, r0 = map(mp.mpf, x)
    eps = mp.mpf(10) ** (-mp.mp.dps // 2 - 2)
    a = (1 - chi) * V
    tb = newton(lambda t: (a * (t - mp.sin(t)) + e1 * (1 - mp.cos(t)) + r0 - e2 / chi,
                           a * (1 - mp.cos(t)) + e1 * mp.sin(t)), mp.mpf(hint[0]), eps)
    s, c = mp.sin(tb), mp.cos(tb)
    w, v = e1 * c + a * s, [V - a * (1 - c) - e1 * s, V]
    stiff = chi * eta
    mean, root = (1 + stiff) / 2, mp.sqrt(((1 - stiff) / 2) ** 2 + chi * stiff)
    square = [stiff * (1 - chi) / (mean + root), mean + root]
    om = [mp.sqrt(q) for q in square]
    f = [w, eta * e2]
    # the projector of the slow mode is (large - K)/(large - small)
    gap = square[1] - square[0]

    def slow(u):
        return [((square[1] - 1) * u[0] + chi * u[1]) / gap, (stiff * u[0] + (square[1] - stiff) * u[1]) / gap]

    vs, fs = slow(v), slow(f)
    amp = [[(vs[i], fs[i] / om[0]), (v[i] - vs[i], (f[i] - fs[i]) / om[1])] for i in range(2)]

    def at(t, i):
        sine, cosine = [mp.sin(q * t) for q in om], [mp.cos(q * t) for q in om]
        speed = sum(amp[i][k][0] * cosine[k] - amp[i][k][1] * sine[k] for k in range(2))
        force = sum(om[k] * (amp[i][k][0] * sine[k] + amp[i][k][1] * cosine[k]) for k in range(2))
        return speed - V, -force

    tc = newton(lambda t: at(t, 0), mp.mpf(hint[1]), eps)
    q, minus = at(tc, 1)
    r, omega = -minus / stiff, mp.sqrt(stiff)
    sign = 1 if q > 0 else -1
    return [tb, tc, mp.atan2(abs(q) / omega, sign * r) / omega, sign * mp.sqrt(r * r + q * q / stiff)]


def map_scipy(x, method, tol):
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


# --- Measuring. ---

def relative(got, true, one_scale):
    scale = [max(abs(v) for v in true)] * len(true) if one_scale else [abs(v) for v in true]
    with mp.workdps(80):
        return max(abs(mp.mpf(g) - t) / s for g, t, s in zip(got, true, scale))


def number(x):
    return "-" if x is None else "%.5g" % x


def measure(job, method, arithmetic, kind, setting, cases, run, dps, quick):
    errors, least, middle, failures = [], [], [], 0
    with mp.workdps(dps):
        for x, true in cases:
            seconds = []
            try:
                for _ in range(2 if quick else 7):
                    begin = time.perf_counter_ns()
                    got = run(x, true)
                    seconds.append(time.perf_counter_ns() - begin)
                errors.append(relative(got, true, job == "propagator"))
            except (ArithmeticError, ValueError):
                failures += 1
                continue
            least.append(min(seconds))
            middle.append(statistics.median(seconds))
    bad = failures or max(errors) >= 0.5
    state = "ok" if not bad else "failed: gives up (%d of %d)" % (failures, len(cases)) if failures else \
        "failed: not one digit right"
    row = [job, method, arithmetic, kind, setting, state, len(cases), failures]
    row += ["-"] * 4 if bad else [mp.nstr(max(errors), 2), mp.nstr(statistics.median(errors), 2),
                                  number(statistics.mean(least)), number(statistics.mean(middle))]
    return row


def rough(true):
    """What the C methods that do not search are told."""
    return [float(t) + min(float(t), 1) / 64 for t in true[:3]]


def gp_map(cases):
    """PARI/GP runs its own script over all inputs and times itself."""
    program = pathlib.Path(__file__).with_name("map.gp").read_text()
    data = ";".join(",".join("%d/%d" % v.as_integer_ratio() for v in x + rough(true)) for x, true in cases)
    out = subprocess.run(["gp", "-q", "-f"], input="%s\nrun([%s])\n" % (program, data), capture_output=True, text=True,
                         check=True).stdout.split()
    with mp.workdps(80):
        results = [mp.mpf(v) for v in out[1:]]
    errors = [relative(results[4 * k:4 * k + 4], true, False) for k, (_, true) in enumerate(cases)]
    ns = float(out[0])
    return ["map", "pari-gp", "gp", "digits", 77, "ok", len(cases), 0, mp.nstr(max(errors), 2),
            mp.nstr(statistics.median(errors), 2), number(ns), number(ns)]


def main():
    arguments = [a for a in sys.argv[1:] if a != "--quick"]
    if len(arguments) != 1:
        sys.exit(__doc__)
    folder, quick = pathlib.Path(arguments[0]), "--quick" in sys.argv
    if not folder.is_dir():
        sys.exit("peers.py: no folder %s" % folder)
    rows = []
    for job in ("propagator", "map"):
        path = folder / (job + "-inputs.tsv")
        if not path.exists():
            continue
        cases = list(read(path))[:4 if quick else None]
        for dps in (16, 50):
            run = (lambda x, true: expm_mpmath(x)) if job == "propagator" else \
                (lambda x, true: map_mpmath(x, rough(true)))
            rows.append(measure(job, "mpmath", "mpmath", "digits", dps, cases, run, dps, quick))
        if scipy and job == "propagator":
            rows.append(measure(job, "scipy-expm", "double", "", "", cases, lambda x, true: expm_scipy(x), 16, quick))
        for method in ("DOP853", "LSODA") if scipy and job == "map" else ():
            for tol in (1e-6, 1e-10, 1e-13):
                rows.append(measure(job, "scipy-" + method, "double", "tolerance", tol, cases,
                                    lambda x, true, m=method, e=tol: map_scipy(x, m, e), 16, quick))
        if job == "map" and shutil.which("gp"):
            rows.append(gp_map(cases))
    text = "\n".join("\t".join(map(str, row)) for row in [COLUMNS] + rows) + "\n"
    (folder / "peers.tsv").write_text(text)
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
