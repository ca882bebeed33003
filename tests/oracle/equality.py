#!/usr/bin/env python3
"""Orbits with tr J = -1 and the third order of the return map there; writes equality.tsv.

The return map r -> r' is evaluated by mpmath at 60 digits: each phase by the series of its first-order system's exponential,
each event by a secant search from a scan, derivatives by central differences of the map itself.  Nothing of the suite."""
import sys
from mpmath import mp, mpf, findroot

mp.dps = 60


def flow(phase, par, z, t):
    """exp(A t) z by the series of the vector in steps of at most 1, in integers: so many of 2^-bits, which takes a tenth
    of the time of mpf."""
    bits, steps = mp.prec + 40, int(abs(t)) + 1
    chi, ratio, t, *z = (int(x * mpf(2) ** bits) for x in (par[0], par[0] * par[1], t / steps, *z))
    for _ in range(steps):
        term, k = z, 0
        while max(map(abs, term)) > 1:
            k += 1
            z1, z2, v1, v2 = term
            rates = v1, v2, (chi * z2 >> bits) - z1 if phase in "GH" else 0, ratio * (z1 - z2) >> bits if phase in "HC" else 0
            term = [(x * t >> bits) // k for x in rates]
            z = [x + y for x, y in zip(z, term)]
    return [x / mpf(2) ** bits for x in z]


def switch(phase, par, z):
    chi, eta, V, e1, e2 = par
    return {"G": chi * (z[1] - z[0]) - e2, "H": z[2] - V, "C": z[3] - V}[phase]


def event(phase, par, z, near=None):
    if near is None:  # a scan in double precision
        h = 1 / 50
        step = [[float(x) for x in flow(phase, par, [mpf(i == k) for i in range(4)], mpf(h))] for k in range(4)]
        numbers, y, t, first = [float(x) for x in par], [float(x) for x in z], 0, None
        while first is None or switch(phase, numbers, y) * first > 0:
            y = [sum(c[i] * x for c, x in zip(step, y)) for i in range(4)]
            t += h
            first = first or switch(phase, numbers, y)
        near = mpf(t - h / 2)
    return findroot(lambda t: switch(phase, par, flow(phase, par, z, t)), (near, near + mpf(10) ** -8), tol=mpf(10) ** -100)


def around(par, r, times=None):
    chi, eta, V, e1, e2 = par
    z = [(e1 + chi * r) / (1 - chi), (e1 + r) / (1 - chi), V, V]
    out = []
    for k, phase in enumerate("GHC"):
        t = event(phase, par, z, times[k] if times else None)
        z = flow(phase, par, z, t)
        out.append(t)
    return z[1] - z[0], out


def jet(par, r, times):
    h = mpf(10) ** -12
    f = [around(par, r + k * h, times)[0] for k in (-2, -1, 0, 1, 2)]
    c1 = (f[0] - 8 * f[1] + 8 * f[3] - f[4]) / (12 * h)
    c2 = (-f[0] + 16 * f[1] - 30 * f[2] + 16 * f[3] - f[4]) / (24 * h * h)
    c3 = (-f[0] + 2 * f[1] - 2 * f[3] + f[4]) / (12 * h ** 3)
    return f[2], c1, c2, c3


def fixed(par, r, times):
    for _ in range(8):
        h = mpf(10) ** -15
        a, b = around(par, r - h, times)[0], around(par, r + h, times)[0]
        slope = (b - a) / (2 * h)
        step = ((a + b) / 2 - r) / (slope - 1)
        r -= step
        if abs(step) < mpf(10) ** -35:
            break
    return r, slope


CASES = [  # chi eta V e1 e2, index of the varied one, two values, r to start from
    (["2/3", "1/2", "1", "4", "3/4"], 4, "0.79", "0.795", "-4.538"),
    (["0.79", "2", "1", "4", "1/4"], 0, "0.7833", "0.7831", "-3.2714"),
]


def rational(s):
    p, _, q = s.partition("/")
    return mpf(p) / mpf(q or 1)


def main():
    for data, vary, a, b, r in CASES:
        par = [rational(s) for s in data]
        r = mpf(r)
        x = [mpf(a), mpf(b)]
        s = []
        par[vary] = x[0]
        times = around(par, r)[1]
        for v in x:
            par[vary] = v
            r, slope = fixed(par, r, times)
            s.append(slope)
        for _ in range(8):
            new = x[1] - (s[1] + 1) * (x[1] - x[0]) / (s[1] - s[0])
            par[vary] = new
            r, slope = fixed(par, r, times)
            x, s = [x[1], new], [s[1], slope]
            if abs(slope + 1) < mpf(10) ** -20:
                break
        f, c1, c2, c3 = jet(par, r, times)
        print("\t".join(data), vary, mp.nstr(par[vary], 18), mp.nstr(r, 18), mp.nstr(c1, 15), mp.nstr(c2, 12), mp.nstr(c3, 12), sep="\t")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
