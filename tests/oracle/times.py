"""times.py: the paper's example with t_b = 2 and t_c = 3/2 taken exactly, 40 significant digits.

The four conditions that are left (z1' = V at the end of the global slip phase, and the period closing) are solved for
z10, z20, t_a and t_d by mpmath.findroot, each phase propagated by mpmath.expm; e1 and e2 are then what the restoring
forces are at t_a and t_b, and J the central differences of the event-located map.
"""
from fractions import Fraction

import mpmath
from mpmath import mp, mpf

from orbits import PHASES, System, digits


def states(system, z10, z20, times):
    z = mpmath.matrix([z10, z20, system.v, system.v])
    found = []
    for ph, t in zip(PHASES, times):
        z = system.step(ph, t) * z
        found.append(z)
    return found


def values(dps):
    with mpmath.workdps(dps):
        system = System([Fraction(4, 5), Fraction(1), Fraction(1), Fraction(1), Fraction(1)])

        def residual(z10, z20, t_a, t_d):
            z = states(system, z10, z20, (t_a, mpf(2), mpf(3) / 2, t_d))
            return [z[2][2] - system.v, z[3][3] - system.v, z[3][0] - z10, z[3][1] - z20]

        z10, z20, t_a, t_d = mpmath.findroot(residual, (mpf("0.9"), mpf("-2.2"), mpf("0.7"), mpf("2.34")),
                                             tol=mpf(10) ** (20 - mp.dps))
        times = (t_a, mpf(2), mpf(3) / 2, t_d)
        z = states(system, z10, z20, times)
        e1 = z[0][0] - system.chi * z[0][1]
        e2 = system.chi * (z[1][1] - z[1][0])
        system.event["D"] = (system.event["D"][0], e1)
        system.event["Gamma"] = (system.event["Gamma"][0], e2)
        j = system.return_jacobian((z10, z20) + times, mpf(10) ** -(dps // 3))
        named = (("z10", z10), ("z20", z20), ("t_a", t_a), ("t_d", t_d), ("e1", e1), ("e2", e2), ("J11", j[0, 0]),
                 ("J12", j[0, 1]), ("J21", j[1, 0]), ("J22", j[1, 1]))
        return [name + "\t" + digits(x, 40) for name, x in named]


if __name__ == "__main__":
    answers = values(150)
    if answers != values(200):
        raise ArithmeticError("the digits depend on the working precision")
    print("# The paper's example with t_b = 2, t_c = 3/2 taken exactly.  Made by times.py.")
    print("\n".join(answers))
