"""One period by the equations of motion (1) and Coulomb's law (2) alone, in the coordinates x.

No z, no K, no phases: each mass sticks or slips as (2) says from its velocity and its restoring force, and (1) is
integrated by its own Taylor series at mpmath's working precision.  Sliding forces are chosen above the bounds u_r_min.
"""
import mpmath
from mpmath import mp, mpf

ORDER_STEP = mpf("0.05")


def series(x, chi, eta, u, stick):
    """Taylor coefficients of (x1, x2) from the state (x1, x2, x1', x2'); u: the sliding forces."""
    a, b = [x[0], x[2]], [x[1], x[3]]
    n = 0
    while True:
        f1 = 0 if stick[0] else -a[n] + chi * b[n] + (u[0] if n == 0 else 0)
        f2 = 0 if stick[1] else -chi * eta * (b[n] - a[n]) + (eta * u[1] if n == 0 else 0)
        a.append(f1 / mpf((n + 1) * (n + 2)))
        b.append(f2 / mpf((n + 1) * (n + 2)))
        n += 1
        if n > 8 and (abs(a[-1]) + abs(b[-1]) + abs(a[-2]) + abs(b[-2])) * ORDER_STEP ** n < mp.eps / 100:
            return a, b


def value(p, t):
    return mpmath.polyval(p[::-1], t)


def slope(p, t):
    return value([k * p[k] for k in range(1, len(p))], t)


def one_period(params, orbit, u_r1_min, u_r2_min):
    """The largest error of the events' times and of the state after one period of an admissible orbit."""
    chi, eta, v, e1, e2 = params
    z10, z20, *times = orbit
    ur = [mpf(5) / 4 * max(e1, u_r1_min), mpf(5) / 4 * max(e2, u_r2_min)]
    us = [ur[0] - e1, ur[1] - e2]
    x0 = [z10 + (us[0] + us[1]) / (1 - chi), z20 + (us[0] * chi + us[1]) / ((1 - chi) * chi), v, v]

    def force(i, y1, y2):
        return y1 - chi * y2 if i == 0 else chi * (y2 - y1)

    x, t, stick, side, log = list(x0), mpf(0), [True, True], [1, 1], []
    if any(abs(force(i, x[0], x[1])) >= ur[i] for i in range(2)):
        raise ArithmeticError("a mass does not stick at the start")
    while len(log) < 4:
        u = [side[0] * us[0], side[1] * us[1]]
        a, b = series(x, chi, eta, u, stick)

        def margin(i, s):
            """Positive while mass i goes on as it does."""
            if stick[i]:
                return ur[i] - abs(force(i, value(a, s), value(b, s)))
            return side[i] * (v - slope((a, b)[i], s))

        due = [(i, ORDER_STEP) for i in range(2) if margin(i, ORDER_STEP) < 0]
        step = ORDER_STEP
        if due:
            ends = []
            for i, _ in due:
                s = mpmath.findroot(lambda s: margin(i, s), (mp.eps ** mpf("0.25"), ORDER_STEP), solver="anderson",
                                    tol=mp.eps ** 2, maxsteps=200, verify=False)
                ends.append((s, i))
            step, i = min(ends)
        t += step
        x = [value(a, step), value(b, step), slope(a, step), slope(b, step)]
        if due:
            pull = force(i, x[0], x[1])
            log.append(t)
            if stick[i]:
                stick[i], side[i] = False, (1 if pull > 0 else -1)
            elif abs(pull) < ur[i]:
                stick[i] = True
            else:
                side[i] = 1 if pull > 0 else -1
            x[2 + i] = v
    expected = [sum(times[:k]) for k in range(1, 5)]
    scale = 1 + max(abs(y) for y in x0)
    errors = [abs(p - q) for p, q in zip(log, expected)] + [abs(p - q) for p, q in zip(x, x0)]
    if stick != [True, True]:
        raise ArithmeticError("not both masses stick after four events")
    return max(errors) / scale
