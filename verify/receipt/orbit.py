# One period of the motion by interval arithmetic: the closed forms of the equations of motion (1) in the phases Gamma, H and
# C, each up to the first zero of what ends it.  At the end of the global stick phase all depends on r = z_2 - z_1 alone.
import sys

from mpmath import iv, mp, mpf

iv.dps = mp.dps = 30


def exact(s):
    p, _, q = s.partition("/")
    return iv.mpf(p) / iv.mpf(q or "1")


CHI, ETA, V, E1, E2 = (exact(PARAMETERS[name]) for name in ("chi", "eta", "V", "e1", "e2"))


def first_zero(f, rate, fine):
    """An interval that holds the first zero of f: before it f keeps its sign, behind it f has the other one.  On it the
    rate of f is not zero, so that the zero depends continuously on the start."""
    sign, t, h, begin = (1 if f(iv.mpf(0)) > 0 else -1), mpf(0), mpf(1) / 32, None
    while True:
        y = f(iv.mpf([t, t + h])) * sign
        if y > 0 and begin is None or y < 0 and begin is not None:
            if y < 0:
                assert 0 not in rate(iv.mpf([begin, t])), "the phase may end at a double zero"
                return iv.mpf([begin, t])
            t, h = t + h, h * 2
        elif h > fine * (1 + t):
            h /= 2
        else:
            begin, t = t if begin is None else begin, t + h


def period(r):
    """r one period later, and the lengths of the phases, of all starts with that r."""
    fine = max(mpf(2) ** -60, mpf(r.delta) / 8)
    z1 = (E1 + CHI * r) / (1 - CHI)
    z2 = z1 + r

    def w(t):  # z_1 - chi z_2 in Gamma
        return E1 * iv.cos(t) + V * (1 - CHI) * iv.sin(t)

    def z1_gamma(t):
        return w(t) + CHI * (z2 + V * t)

    def v1_gamma(t):
        return -E1 * iv.sin(t) + V * (1 - CHI) * iv.cos(t) + CHI * V

    t_b = first_zero(lambda t: CHI * (z2 + V * t - z1_gamma(t)) - E2, lambda t: V - v1_gamma(t), fine)
    start = [z1_gamma(t_b), z2 + V * t_b]
    speed = [v1_gamma(t_b), V]
    root = iv.sqrt((1 + CHI * ETA) ** 2 - 4 * CHI * ETA * (1 - CHI))  # modes (1, l) of K: omega^2 = 1 - chi l
    squares = [(1 + CHI * ETA - root) / 2, (1 + CHI * ETA + root) / 2]
    shape, omega = [(1 - x) / CHI for x in squares], [iv.sqrt(x) for x in squares]

    def share(x):  # of the two modes in a pair (first, second mass)
        b = (x[1] - shape[0] * x[0]) / (shape[1] - shape[0])
        return [x[0] - b, b]

    at, to = share(start), share(speed)

    def position(t, mass):
        return sum((shape[k] if mass else 1) * (at[k] * iv.cos(omega[k] * t) + to[k] / omega[k] * iv.sin(omega[k] * t))
                   for k in (0, 1))

    def velocity(t, mass):
        return sum((shape[k] if mass else 1) * (to[k] * iv.cos(omega[k] * t) - at[k] * omega[k] * iv.sin(omega[k] * t))
                   for k in (0, 1))

    t_c = first_zero(lambda t: velocity(t, 0) - V, lambda t: position(t, 0) - CHI * position(t, 1), fine)
    r_c, q, o = position(t_c, 1) - position(t_c, 0), velocity(t_c, 1) - V, iv.sqrt(CHI * ETA)
    w_c = position(t_c, 0) - CHI * position(t_c, 1)
    t_d = first_zero(lambda t: q * iv.cos(o * t) - r_c * o * iv.sin(o * t),
                     lambda t: q * iv.sin(o * t) + r_c * o * iv.cos(o * t), fine)
    r_end = r_c * iv.cos(o * t_d) + q / o * iv.sin(o * t_d)
    # w' = V - chi z_2' in C, and V (1 - chi) in D
    w_d = w_c + V * (1 - CHI) * t_d - CHI * (r_end - r_c)
    return r_end, ((E1 - w_d) / (V * (1 - CHI)), t_b, t_c, t_d)


def in_print(name):
    """Every value that is written so, rounded or cut off."""
    value, unit = (exact(x) for x in PRINTED[name][1:])
    size = abs(value) + unit * iv.mpf([-0.5, 1])
    return -size if value < 0 else size


def pieces(x, n):
    return [iv.mpf([x.a + (x.b - x.a) * k / n, x.a + (x.b - x.a) * (k + 1) / n]) for k in range(n)]


def closing():
    """How far r is from where it was, one period after any start with the printed digits."""
    off = [period(r)[0] - r for r in pieces(in_print("z20") - in_print("z10"), 16)]
    low, high = min(x.a for x in off), max(x.b for x in off)
    print("from z_10 in %s and z_20 in %s, z_2 - z_1 changes by %s to %s" % (
        in_print("z10"), in_print("z20"), mp.nstr(mpf(low), 5), mp.nstr(mpf(high), 5)))
    return not low <= 0 <= high


def orbit():
    """The numbers of the periodic solution that Newton's iteration finds from the printed start, and their enclosure."""
    r, h = mpf((in_print("z20") - in_print("z10")).mid), mpf(10) ** -9
    for _ in range(8):
        f, g = (mpf((period(iv.mpf(x))[0] - x).mid) for x in (r, r + h))
        r -= (step := f * h / (g - f))
        if abs(step) < mpf(10) ** -15:  # far inside the box
            break
    box = iv.mpf([r - h / 1000, r + h / 1000])
    ends = [period(iv.mpf(x))[0] - x for x in (box.a, box.b)]
    if not (ends[0] > 0 > ends[1] or ends[0] < 0 < ends[1]):
        return None
    t = period(box)[1]
    z10 = (E1 - V * (1 - CHI) * t[0] + CHI * box) / (1 - CHI)
    return {"t_a": t[0], "t_b": t[1], "t_c": t[2], "t_d": t[3], "z10": z10, "z20": z10 + box,
            "u_r1": V * t[0] * (1 - CHI) / 2, "u_r2": (E2 - CHI * box) / 2}


def number(name):
    found = orbit()
    if found is None:
        return False
    print("on the periodic solution %s is in %s; printed: %s" % (name, found[name], PRINTED[name][0]))
    return found[name] < in_print(name) or found[name] > in_print(name)


refuted = number(NUMBER) if NUMBER else closing()
print("%s: %s" % (CLAIM, "refuted" if refuted else "not shown to be wrong"))
sys.exit(not refuted)
