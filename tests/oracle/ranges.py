"""For how long the phases may last: the closed forms of verify/claims/7-ranges.claim on solutions of the paper's six equations.

The solutions are those of later.tsv, whose roots need not be first ones, sharpened by findroot, and others at times t_b
and t_c of a random scan; each phase by matrix exponentials.  Every condition is looked
at on a grid of 400 times and held against its range.  Prints what it has counted, and what does not agree (nothing).
"""
import random
import sys

from argument import findroot, flow, mp, mpf, period

mp.dps = 20
GRID = 400


def later(path="later.tsv"):
    data = None
    for line in open(path):
        f = line.rstrip("\n").split("\t")
        if f[0] == "set":
            data = [mpf(x) for x in f[2:7]]
        else:
            yield data, [mpf(x) for x in f[1:5]]


def sharpen(data, t):
    """z_10, z_20 and the four times at given e_1 and e_2."""
    chi, eta, v, e1, e2 = data

    def gaps(z10, z20, ta, tb, tc, td):
        s = period(chi, eta, v, tb, tc, (z10, z20, ta, td))
        return [s[3][2] - v, s[4][0] - z10, s[4][1] - z20, s[4][3] - v, s[1][0] - chi * s[1][1] - e1,
                chi * (s[2][1] - s[2][0]) - e2]

    b = flow("G", chi, eta, mp.matrix([e1, 0, v, v]), t[1])
    behind = e2 / chi - (b[1] - b[0]) - e1  # z_2 - z_1 at the start: that at the end less what the phase adds
    w = e1 - v * t[0] * (1 - chi)
    z10 = (w + chi * behind) / (1 - chi)
    return findroot(gaps, [z10, z10 + behind] + t)


def state_grid(chi, eta, z, phase, t):
    step = t / GRID
    out = [z]
    a = flow(phase, chi, eta, mp.eye(4), step)
    for _ in range(GRID):
        out.append(a * out[-1])
    return out


def sign(values):
    """Whether all are positive; None where that cannot be told on a grid."""
    least = min(values)
    return None if abs(least) < 1e-6 else least > 0


def check(data, x, count):
    chi, eta, v, e1, e2 = data
    z10, z20, ta, tb, tc, td = x
    s = period(chi, eta, v, tb, tc, (z10, z20, ta, td))
    g, c = state_grid(chi, eta, s[1], "G", tb)[1:-1], state_grid(chi, eta, s[3], "C", td)[1:-1]
    a, omega = (1 - chi) * v, mp.sqrt(chi * eta)
    phi = mp.atan(e1 / a)
    limit = 2 * (mp.pi - phi)
    turns = int(mp.floor(tb / (2 * mp.pi)))
    rise = a * (tb - mp.sin(tb)) + e1 * (1 - mp.cos(tb))
    crest = turns == 0 or rise > 2 * (a * (turns * mp.pi - phi) + e1)
    least = min(chi * (z[1] - z[0]) for z in g)
    late = (a * (ta + td) + chi * (z10 - z20) * (1 - mp.cos(omega * td))) / 2
    rows = [("V - z_1' in Gamma", sign([v - z[2] for z in g]), tb <= limit),
            ("h < e_2", sign([e2 - chi * (z[1] - z[0]) for z in g[:-4]]), tb - 2 * mp.pi * turns <= limit and crest),
            ("h is least at t_a", least > chi * (z20 - z10), True),
            ("bound of u_r2", abs(e2 - chi * (z20 - z10) - chi * rise) < 1e-12, True),
            ("z_20 < z_10", z20 < z10, e2 < chi * rise),
            ("V - z_2' in C", sign([v - z[3] for z in c]), z20 < z10 and omega * td <= mp.pi),
            ("bound of u_r1", abs((e1 - s[3][0] + chi * s[3][1]) / 2 - late) < 1e-12, True)]
    for name, found, said in rows:
        if found is None:
            continue
        n = count.setdefault(name, {})
        n[(bool(found), bool(said))] = n.get((bool(found), bool(said)), 0) + 1


def scan(n, count):
    """Periodic solutions of given t_b and t_c: unknown z_10, z_20, t_a, t_d; roots of any order, t_a of any sign."""
    random.seed(57)
    while n:
        chi, eta, v, tb, tc = [mpf(random.uniform(*r)) for r in ((.1, .9), (.3, 3), (.5, 2), (.3, 14), (.5, 8))]

        def gaps(*u):
            s = period(chi, eta, v, tb, tc, u)
            return [s[3][2] - v, s[4][0] - u[0], s[4][1] - u[1], s[4][3] - v]

        try:
            u = findroot(gaps, [mpf(random.uniform(-2, 2)), mpf(random.uniform(-3, 1)), mpf(1), mpf(random.uniform(.5, 6))])
        except (ValueError, ZeroDivisionError):
            continue
        s = period(chi, eta, v, tb, tc, u)
        e1, e2 = s[1][0] - chi * s[1][1], chi * (s[2][1] - s[2][0])
        if u[3] <= 0 or e1 <= 0 or e2 <= 0 or abs(u[0]) > 100 or u[3] > 40:
            continue
        check((chi, eta, v, e1, e2), (u[0], u[1], u[2], tb, tc, u[3]), count)
        n -= 1


if __name__ == "__main__":
    count = {}
    for data, t in later():
        check(data, sharpen(data, t), count)
    scan(int(sys.argv[1]) if len(sys.argv) > 1 else 60, count)
    for name, n in count.items():
        print("%-20s holds %3d, fails %3d as said; otherwise %d" % (
            name, n.get((True, True), 0), n.get((False, False), 0),
            n.get((True, False), 0) + n.get((False, True), 0)))
