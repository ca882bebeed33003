#!/usr/bin/env python3
"""Solution II under Coulomb's law (2), from numbers that an orbit command has printed.

    solution_ii.py chi eta V e1 e2 z10 z20      mean slope of the return beside the orbit on both sides, and how it moves

The motion is longrun.py's, with all nine pairs of modes; the coordinate is z_2 - z_1 at the moment in which m_1 breaks loose
while or before m_2 sticks.  At chi = 0.8, eta = V = 1 (t_a = 0, t_b as given):

    t_b = 2 (e1 2.522959582776, e2 0.757583439696831, z10 1.23862812628658, z20 -1.60541432061178):
        returns within 3e-14; slopes -1.02006 (+1e-4: m_1 breaks while m_2 still slips) and -1.02673 (-1e-4: D comes between),
        as far from one limit, -1.02674, as the displacement: the return map has one slope
    t_b = 3: returns within 1e-14; -0.99301 and -0.99898.    t_b = 1: H-Gamma-D, no return
"""
import sys

from longrun import events, forces

chi, eta, V, e1, e2, z10, z20 = map(float, sys.argv[1:8])
u_r = 3 * e1, 5 * e2
u_s = u_r[0] - e1, u_r[1] - e2


def back(r):
    """z_2 - z_1 at the next break of m_1, and the phases on the way."""
    x1 = (e1 + u_s[0] + chi * r + u_s[1]) / (1 - chi)
    names, way, stuck = {(1, 0): "Gamma", (1, 1): "H", (0, 1): "C", (0, 0): "D"}, [], False
    for _, y, i, mode in events((chi, eta, V), u_s, u_r, [x1, x1 + r + u_s[1] / chi, V, V], (1, 0), 1 / 2048):
        if i == 0 and stuck:
            return forces(chi, y)[1] / chi - u_s[1] / chi, way
        if len(way) == 8:
            return None, way
        way.append(names.get(mode, "faster"))
        stuck = mode[0] == 0


if __name__ == "__main__":
    r = z20 - z10
    end, way = back(r)
    print("orbit", "-".join(way), "no return" if end is None else "off by %.1e" % (end - r))
    for d in (3e-4, 1e-4, -1e-4, -3e-4):
        moved, way = back(r + d)
        print("%g" % d, "-".join(way), "-" if moved is None or end is None else "%.5f" % ((moved - end) / d))
