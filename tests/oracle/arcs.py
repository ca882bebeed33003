#!/usr/bin/env python3
"""Passes through the word for tests/check_map.c: from z_1, z_2 with both velocities V, each phase propagated by
mpmath.expm of its first-order system, its first event bracketed by samples and bisection and then refined, 60 digits.

    python3 arcs.py > arcs.tsv
"""
from fractions import Fraction

import mpmath
from mpmath import mp, mpf

from orbits import PHASES, System, digits

# chi, eta, V, e1, e2, z10, z20: doubles, taken exactly
CASES = [
    (0.75, 1.25, 1.0, 2.5, 1.5, 0.25, -1.0),
    (0.8, 1.0, 1.0, 2.7844, 0.8587, 0.8921, -2.1958),
    (0.25, 6.0, 0.5, 1.0, 0.125, 0.5, -1.5),
    (0.75, 1.0, 1.0, 2.0, 0.75, 0.0, 1.0 - 2.0**-40),  # t_b about 2^-20
    (1.0 - 2.0**-30, 1.0, 1.0, 1.5, 0.5, 0.25, -1.25),  # both masses nearly one
    (0.015625, 40.0, 2.0, 4.0, 0.25, 1.0, 3.0),
    (0.5, 0.25, 1.0, 0.25, 1.0, 0.0, -6.0),  # t_b beyond the first period
    (0.9375, 12.0, 2.0, 0.5, 3.0, 6.0, 8.5),
]
STEP = mpf(1) / 128


def first(system, phase, z):
    """The first time at which the switching function changes its sign; t_a has any sign."""
    n, c = system.event[phase]

    def value(t):
        return (n * (system.step(phase, t) * z))[0] - c

    if phase == "D":
        return -value(mpf(0)) / (value(mpf(1)) - value(mpf(0)))
    one, here, high, start = system.step(phase, STEP), z, mpf(0), value(mpf(0))
    while high == 0 or ((n * here)[0] - c) * start > 0:
        here, high = one * here, high + STEP
        if high > 50:
            raise ArithmeticError("no event of phase " + phase)
    low = high - STEP if high > STEP else high / mpf(2) ** 60
    while high - low > mpf(10) ** -12 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if value(middle) * start > 0 else (low, middle)
    return (low + high) / 2


def arc(case, dps):
    with mpmath.workdps(30):
        system = System([Fraction(x) for x in case[:5]])
        z, guess = mpmath.matrix([*map(mpf, case[5:]), system.v, system.v]), []
        for phase in PHASES:
            guess.append(first(system, phase, z))
            z = system.step(phase, guess[-1]) * z
    with mpmath.workdps(dps):
        system = System([Fraction(x) for x in case[:5]])
        z, times = mpmath.matrix([*map(mpf, case[5:]), system.v, system.v]), []
        for phase, t in zip(PHASES, guess):
            t, z = system.phase_end(phase, z, t)
            times.append(t)
        return [digits(x, 60) for x in (*times, z[0], z[1])]


if __name__ == "__main__":
    print("# chi eta V e1 e2 z10 z20, then t_a t_b t_c t_d and z_1, z_2 at the end.  Made by arcs.py.")
    for case in CASES:
        values = arc(case, 140)
        if values != arc(case, 180):
            raise ArithmeticError("the digits depend on the working precision")
        print("\t".join([repr(x) for x in case] + values))
