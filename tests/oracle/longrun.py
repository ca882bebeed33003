#!/usr/bin/env python3
"""The long run from the paper's printed start, and where a slowed sticking mass of a stable orbit goes, by equation (1) and
Coulomb's law (2) alone: Runge-Kutta with fixed steps in plain floats, events by bisection of the step; writes longrun.tsv.

Lines: name, u_r1, u_r2, start (x1 x2 v1 v2), returns, word cut after each stick phase and folded, time between the last two
returns (or "-" when both masses never stick again within the time)."""
import itertools

def forces(chi, y):
    return y[0] - chi * y[1], chi * (y[1] - y[0])


def events(par, us, ur, x, mode, dt, t_max=1e5):
    """The moments at which a mass has come to the belt's speed, or broken loose: time, state, which, all modes; a mode is 0 where
    the mass sticks, else the sign of its sliding force."""
    chi, eta, v = par

    def rates(y):
        f = forces(chi, y)
        return [y[2], y[3], *(mode[i] and (1, eta)[i] * (mode[i] * us[i] - f[i]) for i in (0, 1))]

    def step(y, h):
        k1 = rates(y)
        k2 = rates([p + h / 2 * q for p, q in zip(y, k1)])
        k3 = rates([p + h / 2 * q for p, q in zip(y, k2)])
        k4 = rates([p + h * q for p, q in zip(y, k3)])
        return [p + h / 6 * (a + 2 * b + 2 * c + d) for p, a, b, c, d in zip(y, k1, k2, k3, k4)]

    def broken(y):
        """The masses whose mode has ended."""
        f = forces(chi, y)
        return [i for i in (0, 1) if (abs(f[i]) > ur[i] if mode[i] == 0 else mode[i] * (v - y[2 + i]) < 0)]

    t = 0.0
    while t < t_max:
        y = step(x, dt)
        if not broken(y):
            x, t = y, t + dt
            continue
        low, high = 0.0, dt
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (low, middle) if broken(step(x, middle)) else (middle, high)
        x, t = step(x, high), t + high
        i = broken(x)[0]
        x[2 + i] = v
        f = forces(chi, x)[i]
        mode = list(mode)
        mode[i] = 0 if mode[i] and abs(f) < ur[i] else 1 if f > 0 else -1
        yield t, x, i, tuple(mode)


def run(par, us, ur, x, returns, t_max):
    """The phases that follow each other, and when both masses stick."""
    mode = [0 if x[2 + i] == par[2] else 1 if x[2 + i] < par[2] else -1 for i in (0, 1)]
    word, back = "", []
    letter = {(0, 0): "D", (1, 0): "G", (1, 1): "H", (0, 1): "C"}
    for t, _, _, mode in events(par, us, ur, x, mode, 1 / 256, t_max):
        word += letter.get(mode, "?")
        back += [t] if mode == (0, 0) else []
        if len(back) == returns:
            break
    return word, back


def fold(word):
    pieces = [p + "D" for p in word.split("D")[:-1]]
    return " ".join(f"({p})^{len(list(g))}" for p, g in itertools.groupby(pieces))


def paper(factor):
    chi, eta, v, e1, e2 = 0.8, 1.0, 1.0, 2.7844, 0.8587
    need = (e1, 1.67050311145342)  # max(e_i, u_ri_min) of orbits.tsv, set paper
    ur = [factor * n for n in need]
    us = [ur[0] - e1, ur[1] - e2]
    d1 = (us[0] + us[1]) / (1 - chi)
    x = [0.8921 + d1, -2.1958 + d1 + us[1] / chi, v, v]
    return (chi, eta, v), us, ur, x


def main():
    for name, factor in (("paper", 1.25), ("paper2", 2.0)):
        par, us, ur, x = paper(factor)
        word, back = run(par, us, ur, x, 200, 1e5)
        print(name, *("%.10g" % q for q in (*ur, *x)), len(back), fold(word), "%.7f" % (back[-1] - back[-2]), sep="\t")

    # the stable orbit at chi = 2/3, eta = 2, V = 1, e1 = 2, e2 = 1/4, half way through its stick phase, m_1 slowed by 1e-6
    par, ur = (2 / 3, 2.0, 1.0), [2.5, 0.95279191029]
    us = [ur[0] - 2, ur[1] - 0.25]
    for name, slow in (("kept", 0.0), ("slowed", 1e-6)):
        x = [3.1095090990796 + 1.3377, 2.2519963798146 + 1.3377, 1.0 - slow, 1.0]
        word, back = run(par, us, ur, x, 20, 400)
        print(name, *("%.10g" % q for q in (*ur, *x)), len(back), fold(word) or word[:8], "-" if not back else "%.5f" % (back[-1] - back[-2]), sep="\t")


if __name__ == "__main__":
    main()
