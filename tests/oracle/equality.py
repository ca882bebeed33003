#!/usr/bin/env python3
"""Orbits with tr J = -1 and the third order of the return map there; writes equality.tsv.

The return map r -> r' is evaluated by mpmath at 60 digits: each phase by the matrix exponential of its first-order system,
each event by a secant search from a scan, derivatives by central differences of the map itself.  Nothing of the suite."""
import sys
from mpmath import mp, mpf, matrix, expm, findroot, sqrt, cos, sin

mp.dps = 60


def system(phase, chi, eta):
    a = matrix(4, 4)
    a[0, 2] = a[1, 3] = 1
    if phase in "GH":
        a[2, 0], a[2, 1] = -1, chi
    if phase in "HC":
        a[3, 0], a[3, 1] = chi * eta, -chi * eta
    return a


def flow(phase, par, z, t):
    chi, eta = par[0], par[1]
    return expm(system(phase, chi, eta) * t, method="taylor") * z


def switch(phase, par, z):
    chi, eta, V, e1, e2 = par
    return {"G": chi * (z[1] - z[0]) - e2, "H": z[2] - V, "C": z[3] - V}[phase]


def event(phase, par, z, near=None):
    if near is None:
        h = mpf(1) / 50
        mp.dps, keep = 16, mp.dps
        step = expm(system(phase, par[0], par[1]) * h)
        t, y = h, step * z
        first = switch(phase, par, y)
        while True:
            y = step * y
            t += h
            if switch(phase, par, y) * first <= 0:
                break
        mp.dps = keep
        near = t - h / 2
    return findroot(lambda t: switch(phase, par, flow(phase, par, z, t)), (near, near + mpf(10) ** -8), tol=mpf(10) ** -100)


def around(par, r, times=None):
    chi, eta, V, e1, e2 = par
    z = matrix([(e1 + chi * r) / (1 - chi), (e1 + r) / (1 - chi), V, V])
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
