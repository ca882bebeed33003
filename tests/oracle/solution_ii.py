#!/usr/bin/env python3
"""Solution II under Coulomb's law (2), from numbers that an orbit command has printed.

    solution_ii.py chi eta V e1 e2 z10 z20      mean slope of the return beside the orbit on both sides, and how it moves

The equations of motion (1) by Runge-Kutta steps in floats, all nine pairs of modes, events by bisection; the coordinate is
z_2 - z_1 at the moment in which m_1 breaks loose while or before m_2 sticks.  At chi = 0.8, eta = V = 1 (t_a = 0, t_b as given):

    t_b = 2 (e1 2.522959582776, e2 0.757583439696831, z10 1.23862812628658, z20 -1.60541432061178):
        returns within 3e-14; slopes -1.02006 (+1e-4: m_1 breaks while m_2 still slips) and -1.02673 (-1e-4: D comes between),
        as far from one limit, -1.02674, as the displacement: the return map has one slope
    t_b = 3: returns within 1e-14; -0.99301 and -0.99898.    t_b = 1: H-Gamma-D, no return
"""
import sys

chi, eta, V, e1, e2, z10, z20 = map(float, sys.argv[1:8])
u_r = 3 * e1, 5 * e2
u_s = u_r[0] - e1, u_r[1] - e2


def forces(y):
    return y[0] - chi * y[1], chi * (y[1] - y[0])


def rates(y, mode):
    f = forces(y)
    return [y[2], y[3], mode[0] and u_s[0] * mode[0] - f[0], mode[1] and eta * (u_s[1] * mode[1] - f[1])]


def step(y, h, mode):
    k1 = rates(y, mode)
    k2 = rates([p + h / 2 * q for p, q in zip(y, k1)], mode)
    k3 = rates([p + h / 2 * q for p, q in zip(y, k2)], mode)
    k4 = rates([p + h * q for p, q in zip(y, k3)], mode)
    return [p + h / 6 * (a + 2 * b + 2 * c + d) for p, a, b, c, d in zip(y, k1, k2, k3, k4)]


def broken(y, mode):
    """The masses whose mode has ended."""
    f = forces(y)
    return [i for i in range(2) if (abs(f[i]) > u_r[i] if mode[i] == 0 else mode[i] * (V - y[2 + i]) < 0)]


def back(r):
    """z_2 - z_1 at the next break of m_1, and the phases on the way."""
    x1 = (e1 + u_s[0] + chi * r + u_s[1]) / (1 - chi)
    y, mode, h, way = [x1, x1 + r + u_s[1] / chi, V, V], (1, 0), 1 / 2048, []
    y, names = step(y, h, mode), {(1, 0): "Gamma", (1, 1): "H", (0, 1): "C", (0, 0): "D"}
    while len(way) < 8:
        after = step(y, h, mode)
        if not broken(after, mode):
            y = after
            continue
        low, high = 0, h
        for _ in range(60):
            mid = (low + high) / 2
            low, high = (low, mid) if broken(step(y, mid, mode), mode) else (mid, high)
        y = step(y, high, mode)
        i, now = broken(y, mode)[0], list(mode)
        y[2 + i] = V
        f = forces(y)[i]
        now[i] = 0 if abs(f) < u_r[i] else 1 if f > 0 else -1
        if mode[i] == 0 and i == 0:
            return forces(y)[1] / chi - u_s[1] / chi, way
        mode = tuple(now)
        way.append(names.get(mode, "faster"))
    return None, way


if __name__ == "__main__":
    r = z20 - z10
    end, way = back(r)
    print("orbit", "-".join(way), "no return" if end is None else "off by %.1e" % (end - r))
    for d in (3e-4, 1e-4, -1e-4, -3e-4):
        moved, way = back(r + d)
        print("%g" % d, "-".join(way), "-" if moved is None or end is None else "%.5f" % ((moved - end) / d))
