"""Passages of a motion under smoothed friction, by SciPy's Radau method (implicit Runge-Kutta of order 5).

Nothing is shared with bench/smooth.c but the law that is written in its header:
  u_i = tanh x (u_si + rise_i exp(-(x/10)^2)),  x = s (V - x_i')/V,  the largest value of u_i being u_ri.
State: w = z_1 - chi z_2, r = z_2 - z_1, p = x_1' - V, q = x_2' - V, with z measured from the equilibrium under u_s1, u_s2.
Prints tests/oracle/smooth.tsv: the parameters and the start, then t, w, r, p at the first passages of q = level from above.

  python3 tests/oracle/smooth.py > tests/oracle/smooth.tsv        (needs SciPy; 1.10.1 made the file)
"""
import numpy
import scipy
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

CHI, ETA, V, E1, E2 = 2 / 3, 2.0, 1.0, 2.0, 0.25
LIMIT = (2.5, 0.95)
SLOPE, LEVEL, PASSAGES = 1000.0, -2.5, 3
START = [1.1, -1.9, 0.0, 0.0]
SLIDING = (LIMIT[0] - E1, LIMIT[1] - E2)


def law(x, sliding, rise):
    return numpy.tanh(x) * (sliding + rise * numpy.exp(-(x / 10) ** 2))


def rise_of(sliding, limit):
    def top(rise):
        found = minimize_scalar(lambda x: -law(x, sliding, rise), bounds=(0, 30), method="bounded",
                                options={"xatol": 1e-12})
        return -found.fun
    return brentq(lambda rise: top(rise) - limit, 0, 10 * limit, xtol=1e-14)


RISE = tuple(rise_of(SLIDING[i], LIMIT[i]) for i in range(2))


def field(t, y):
    w, r, p, q = y
    u = [law(-SLOPE * v / V, SLIDING[i], RISE[i]) for i, v in enumerate((p, q))]
    return [(1 - CHI) * V + p - CHI * q, q - p, -w - SLIDING[0] + u[0], ETA * (u[1] - SLIDING[1] - CHI * r)]


def passage(t, y):
    return y[3] - LEVEL


passage.direction = -1


def main():
    print("# tests/oracle/smooth.py, SciPy", scipy.__version__)
    print("start", *(repr(float(x)) for x in (CHI, ETA, V, E1, E2, *LIMIT, SLOPE, LEVEL, *START)), sep="\t")
    end = solve_ivp(field, (0, 60), START, method="Radau", rtol=1e-11, atol=[1e-12, 1e-12, 1e-14, 1e-14], events=passage)
    for t, y in list(zip(end.t_events[0], end.y_events[0]))[:PASSAGES]:
        print("passage", *(repr(float(x)) for x in (t, *y[:3])), sep="\t")


if __name__ == "__main__":
    main()
