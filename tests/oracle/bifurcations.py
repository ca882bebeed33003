#!/usr/bin/env python3
"""Bifurcation values along lines in parameter space; writes bifurcations.tsv.

Unknowns are the parameter p and r = z_2 - z_1 at the stick phase.  The return map is equality.py's (series,
secant searches for events); its fixed point is followed in p, or at a fold p is solved for at given r, and a function of
the orbit is brought to zero by the secant method.  Slopes are central differences of the map itself.  Nothing of the suite.

Fields: chi eta V e1 e2 (that of the line is -), name and ends of the line, kind, value, r there."""
import sys

from equality import around, event, fixed, flow
from mpmath import mp, mpf, nstr

NAMES = ["chi", "eta", "V", "e1", "e2"]


def states(par, r, times):
    chi, eta, V, e1, e2 = par
    z = [(e1 + chi * r) / (1 - chi), (e1 + r) / (1 - chi), V, V]
    out = [z]
    for phase, t in zip("GHC", times):
        z = flow(phase, par, z, t)
        out.append(z)
    return out


def slope(par, r, times):
    h = mpf(10) ** -15
    return (around(par, r + h, times)[0] - around(par, r - h, times)[0]) / (2 * h)


def stick(par, r, times):
    """t_a, from w at the end of phase C."""
    end = states(par, r, times)[3]
    return (par[3] - (end[0] - par[0] * end[1])) / ((1 - par[0]) * par[2])


def top(par, r, times, mass):
    """The greatest of the maxima of z' - V inside phase H, by a scan and a secant search on z''."""
    z = states(par, r, times)[1]
    h = times[1] / 400

    def force(y):
        w, chi_r = y[0] - par[0] * y[1], par[0] * (y[1] - y[0])
        return -w if mass == 0 else -par[1] * chi_r

    best, y, t, before = None, flow("H", par, z, h), h, force(z)
    for _ in range(398):
        now = force(y)
        if before > 0 >= now:
            s = mp.findroot(lambda s: force(flow("H", par, z, s)), (t - h, t), tol=mpf(10) ** -90)
            value = flow("H", par, z, s)[2 + mass] - par[2]
            best = value if best is None else max(best, value)
        before, y, t = now, flow("H", par, y, h), t + h
    return best


FUNCTIONS = {
    "flip": lambda par, r, times: slope(par, r, times) + 1,
    "t_a": stick,
    "c_v2": lambda par, r, times: states(par, r, times)[2][3] - par[2],
    "t_c": lambda par, r, times: states(par, r, times)[2][0] - par[0] * states(par, r, times)[2][1],
    "h_v1": lambda par, r, times: top(par, r, times, 0),
    "h_v2": lambda par, r, times: top(par, r, times, 1),
}
PAPER = ["0.8", "1", "1", "2.7844", "-"]
EQUAL = ["-", "2", "1", "4", "0.25"]
CASES = [  # parameters, ends of the line, kind, two values, r to start from
    (PAPER, "0.5", "3", "flip", "1.80", "1.81", "-3.1108"),
    (PAPER, "0.5", "3", "t_a", "2.10", "2.101", "-3.1123"),
    (PAPER, "0.5", "3", "c_v2", "0.57", "0.569", "-0.8566"),
    (PAPER, "0.5", "3", "h_v1", "1.35", "1.351", "-2.2280"),
    (PAPER, "0.5", "3", "fold", "1.13", "0.5404", "0.53"),  # r between those of the two orbits
    (EQUAL, "0.7", "0.9", "flip", "0.78", "0.781", "-3.2536"),
    (EQUAL, "0.7", "0.9", "h_v2", "0.83", "0.829", "-1.0698"),
]


def solve(f, a, b, digits):
    fa, fb = f(a), f(b)
    for _ in range(40):
        a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
        fb = f(b)
        if abs(b - a) < mpf(10) ** -digits:
            return b
    raise ValueError("no convergence")


def along(data, kind, a, b, r):
    vary = data.index("-")
    par = [mpf(x) if x != "-" else mpf(a) for x in data]
    state = [mpf(r), around(par, mpf(r))[1]]

    def f(p):
        par[vary] = p
        state[0] = fixed(par, state[0], state[1])[0]
        state[1] = around(par, state[0], state[1])[1]
        return FUNCTIONS[kind](par, state[0], state[1])

    p = solve(f, mpf(a), mpf(b), 22)
    return p, state[0]


def fold(data, p, r, s):
    """p is solved for at given r; there the slope is 1."""
    vary = data.index("-")
    par = [mpf(x) if x != "-" else mpf(p) for x in data]
    state = [mpf(p), around(par, mpf(r))[1]]

    def off(q, r):
        par[vary] = q
        end, state[1] = around(par, r, state[1])
        return end - r

    def f(r):
        h = mpf(10) ** -6
        state[0] = solve(lambda q: off(q, r), state[0], state[0] + h, 40)
        par[vary] = state[0]
        return slope(par, r, state[1]) - 1

    r = solve(f, mpf(r), mpf(s), 18)
    return state[0], r


def main():
    for data, low, high, kind, a, b, r in CASES:
        p, r = fold(data, a, b, r) if kind == "fold" else along(data, kind, a, b, r)
        name = NAMES[data.index("-")]
        print("\t".join(data), name, low, high, kind, nstr(p, 20), nstr(r, 15), sep="\t")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
