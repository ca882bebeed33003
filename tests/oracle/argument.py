"""Counterexamples to arguments of the paper, checked by a program of its own.

Equations of motion (1) with Coulomb's law (2) in the coordinates z = x - d, each phase as Z' = A Z + b, exponentials by
mpmath.  At given chi, eta, V, t_b, t_c the six equations of the word D-Gamma-H-C are solved for z10, z20, t_a, t_d, e1, e2
from a rough start; then every condition is looked at on a dense grid of times.  Prints the rows of check_argument.c.
"""
from mpmath import mp, mpf, matrix, expm, findroot

mp.dps = 30


def flow(phase, chi, eta, z, t):
    a = matrix(4, 4)
    a[0, 2] = a[1, 3] = 1
    if phase in ("G", "H"):
        a[2, 0], a[2, 1] = -1, chi
    if phase in ("H", "C"):
        a[3, 0], a[3, 1] = chi * eta, -chi * eta
    return expm(a * t) * z


def period(chi, eta, v, tb, tc, u):
    z10, z20, ta, td = u
    states = [matrix([z10, z20, v, v])]
    for phase, t in zip("DGHC", (ta, tb, tc, td)):
        states.append(flow(phase, chi, eta, states[-1], t))
    return states


def solve(chi, eta, v, tb, tc, guess):
    def gaps(*u):
        s = period(chi, eta, v, tb, tc, u)
        return [s[3][2] - v, s[4][0] - u[0], s[4][1] - u[1], s[4][3] - v]

    u = findroot(gaps, guess)
    s = period(chi, eta, v, tb, tc, u)
    return u, s, s[1][0] - chi * s[1][1], chi * (s[2][1] - s[2][0])


def least(chi, eta, z, phase, t, f, n=400):
    return min(f(flow(phase, chi, eta, z, t * k / n)) for k in range(1, n))


def report(name, chi, eta, v, tb, tc, guess):
    u, s, e1, e2 = solve(chi, eta, v, tb, tc, guess)
    ta, td = u[2], u[3]
    wc = s[3][0] - chi * s[3][1]
    speeds = [least(chi, eta, s[1], "G", tb, lambda z: v - z[2]), least(chi, eta, s[2], "H", tc, lambda z: v - z[2]),
              least(chi, eta, s[2], "H", tc, lambda z: v - z[3]), least(chi, eta, s[3], "C", td, lambda z: v - z[3])]
    force = least(chi, eta, s[1], "G", tb, lambda z: e2 - chi * (z[1] - z[0]))
    print("# %s: z10 %s z20 %s t_a %s t_d %s e1 %s e2 %s" % ((name,) + tuple(mp.nstr(x, 12) for x in (u[0], u[1], ta, td, e1, e2))))
    print("#   least V - z1' in Gamma, H: %s %s; V - z2' in H, C: %s %s; e2 - chi r in Gamma: %s"
          % tuple(mp.nstr(x, 4) for x in speeds + [force]))
    bounds = (v * ta * (1 - chi) / 2, (e1 - wc) / 2, (e2 - chi * (u[1] - u[0])) / 2)
    print("{%s, %s, %s, %s, %s}," % tuple(mp.nstr(x, 15) for x in (e1, e2) + bounds))


if __name__ == "__main__":
    # first: the certificate of text-59-concluded; second: found by a plain random scan, t_b near 2 pi
    report("first", mpf(3) / 64, mpf(55) / 8, mpf(3) / 4, mpf(221) / 64, mpf(269) / 32, (-0.2, -0.75, 0.41, 0.195))
    report("second", mpf(11) / 64, mpf(83) / 16, mpf(1), mpf(193) / 32, mpf(89) / 16, (-1.174, -1.866, 1.037, 1.015))
