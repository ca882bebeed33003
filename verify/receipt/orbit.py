# One period of the motion by interval arithmetic: the closed forms of the equations of motion (1) in the phases Gamma, H and
# C, each up to the first zero of what ends it.  At the end of the global stick phase all depends on r = z_2 - z_1 alone.
import itertools
import re
import sys
import types

from mpmath import iv, mp, mpf

if GOALS is not None:
    from sympy import Abs, Rational, Symbol, cancel, cos, cot, diff, exp, pi, sin, sqrt, symbols

iv.dps = mp.dps = 30


def exact(s):
    p, _, q = s.partition("/")
    return iv.mpf(p) / iv.mpf(q or "1")


CHI, ETA, V, E1, E2 = (exact(PARAMETERS[name]) for name in ("chi", "eta", "V", "e1", "e2"))


def first_zero(f, rate, fine):
    """An interval that holds the first zero of f: before it f keeps its sign, behind it f has the other one.  On it the
    rate of f is not zero, so that the zero depends continuously on the start.  Intervals are compared by their ends: to
    mpmath from 1.4 on it is an error where these do not decide."""
    sign, t, h, begin = (1 if f(iv.mpf(0)).a > 0 else -1), mpf(0), mpf(1) / 32, None
    while True:
        y = f(iv.mpf([t, t + h])) * sign
        if y.a > 0 and begin is None or y.b < 0 and begin is not None:
            if y.b < 0:
                assert 0 not in rate(iv.mpf([begin, t])), "the phase may end at a double zero"
                return iv.mpf([begin, t])
            t, h = t + h, h * 2
        elif h > fine * (1 + t):
            h /= 2
        else:
            begin, t = t if begin is None else begin, t + h


def period(r):
    """r one period later, the lengths of the phases, and the states in each after a time, of all starts with that r."""
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
    t_a = (E1 - w_d) / (V * (1 - CHI))
    z10, z1c = z1 - V * t_a, position(t_c, 0)

    def stick_slip(t):
        distance = r_c * iv.cos(o * t) + q / o * iv.sin(o * t)
        return z1c + V * t, z1c + V * t + distance, V, V + q * iv.cos(o * t) - r_c * o * iv.sin(o * t)

    return r_end, (t_a, t_b, t_c, t_d), {
        "D": lambda t: (z10 + V * t, z10 + r + V * t, V, V),
        "Gamma": lambda t: (z1_gamma(t), z2 + V * t, v1_gamma(t), V),
        "H": lambda t: (position(t, 0), position(t, 1), velocity(t, 0), velocity(t, 1)),
        "C": stick_slip}


def in_print(name, own=False):
    """Every value that is written so, rounded or cut off; own: to its own decimals, however many others have."""
    decimal, value, unit = PRINTED[name][0], *(exact(x) for x in PRINTED[name][1:])
    if own:
        unit = iv.mpf(1) / 10 ** len(decimal.partition(".")[2])
    size = abs(value) + unit * iv.mpf([-0.5, 1])
    return -size if value < 0 else size


def pieces(x, n):
    return [iv.mpf([x.a + (x.b - x.a) * k / n, x.a + (x.b - x.a) * (k + 1) / n]) for k in range(n)]


def closing():
    """How far r is from where it was, one period after any start with the printed digits."""
    off = [period(r)[0] - r for r in pieces(in_print("z20") - in_print("z10"), 16)]
    low, high = min(x.a for x in off), max(x.b for x in off)
    print("From z_10 in %s and z_20 in %s, z_2 - z_1 changes by %s to %s" % (
        in_print("z10"), in_print("z20"), mp.nstr(mpf(low), 5), mp.nstr(mpf(high), 5)))
    return not low <= 0 <= high


def orbit():
    """The numbers of the periodic solution that Newton's iteration finds from the printed start, and its phases."""
    r, h = mpf((in_print("z20") - in_print("z10")).mid), mpf(10) ** -9
    for _ in range(8):
        f, g = (mpf((period(iv.mpf(x))[0] - x).mid) for x in (r, r + h))
        r -= (step := f * h / (g - f))
        if abs(step) < mpf(10) ** -15:  # far inside the box
            break
    box = iv.mpf([r - h / 1000, r + h / 1000])
    ends = [period(iv.mpf(x))[0] - x for x in (box.a, box.b)]
    if not (ends[0].a > 0 > ends[1].b or ends[0].b < 0 < ends[1].a):
        return None, None
    _, t, phases = period(box)
    z10 = phases["D"](iv.mpf(0))[0]
    return {"t_a": t[0], "t_b": t[1], "t_c": t[2], "t_d": t[3], "z10": z10, "z20": z10 + box,
            "u_r1": V * t[0] * (1 - CHI) / 2, "u_r2": (E2 - CHI * box) / 2}, phases


def number(name):
    """What is to be said of it; None: not that it is wrong."""
    found = orbit()[0]
    if found is None:
        return None
    print("On the periodic solution found from the printed start %s is in %s; printed: %s" % (name, found[name], PRINTED[name][0]))
    if not (found[name].b < in_print(name).a or found[name].a > in_print(name).b):
        return None
    if found[name] not in in_print(name, True):
        return "refuted"
    print("Read to its own decimals alone, not to those of the other numbers, %s is right." % PRINTED[name][0])
    return "conditional"


# --- Inequalities at that solution's numbers, or along its phases ---

if GOALS is not None:
    MOVING = z_1, z_2, v_1, v_2, t = symbols("z_1(t) z_2(t) z_1'(t) z_2'(t) t")
    chi, eta, v, e_1, e_2, u_r1, u_r2, u_s1, u_s2 = symbols("chi eta V e_1 e_2 u_r1 u_r2 u_s1 u_s2")
    LENGTHS = t_a, t_b, t_c, t_d = symbols("t_a t_b t_c t_d")
    z_10, z_20 = symbols("z_10 z_20")
    PHASES = dict(zip(("D", "Gamma", "H", "C"), LENGTHS))
    SWITCHING = ["0"] + [" + ".join(map(str, LENGTHS[:k])) for k in (1, 2, 3, 4)]
    # z_1'' and z_2'' by (1) and (2)
    RATES = {"D": (0, 0), "Gamma": (chi * z_2 - z_1, 0), "H": (chi * z_2 - z_1, chi * eta * (z_1 - z_2)),
             "C": (0, chi * eta * (z_1 - z_2))}
    STICKING = {"D": [(v_1, v), (v_2, v)], "Gamma": [(v_2, v)], "H": [], "C": [(v_1, v)], "": []}
    # what is exactly so where the phases begin, one after the other, and where the last one ends
    MEETING = [
        [(v_1, v), (v_2, v), (z_1, z_10), (z_2, z_20)],
        [(v_1, v), (v_2, v), (z_1, z_10 + v * t_a), (z_2, z_20 + v * t_a),
         (e_1, z_10 + v * t_a - chi * (z_20 + v * t_a))],
        [(v_2, v), (e_2, chi * (z_2 - z_1)), (z_2, z_20 + v * (t_a + t_b))], [(v_1, v), (z_1, z_10 - v * t_d)],
        [(v_1, v), (v_2, v), (z_1, z_10), (z_2, z_20)]]
    # the masses are slower than the belt where they slip, and their forces below the limits where they stick
    LAW = [("", length) for length in LENGTHS] + [
        ("Gamma", v - v_1), ("H", v - v_1), ("H", v - v_2), ("C", v - v_2), ("D", e_1 - z_1 + chi * z_2),
        ("C", e_1 - z_1 + chi * z_2), ("D", e_2 - chi * (z_2 - z_1)), ("Gamma", e_2 - chi * (z_2 - z_1))]
    DATA = [(x, Rational(PARAMETERS[name])) for name, x in zip(("chi", "eta", "V", "e1", "e2"), (chi, eta, v, e_1, e_2))]
    FUNCTIONS = dict(number=Rational, sin=sin, cos=cos, cot=cot, sqrt=sqrt, exp=exp, abs=Abs)


def at_switching(e, k):
    """What moves, at the end of phase k."""
    return e.subs([(m, Symbol(str(m).replace("(t)", "(%s)" % SWITCHING[k]))) for m in MOVING[:4]] + [
        (t, sum(LENGTHS[:k]))])


def exactly():
    """What MEETING says of the values there."""
    return [(at_switching(a, k), at_switching(b, k)) for k in range(5) for a, b in MEETING[k]]


def named(name):
    """z'_1b is z_1'(t_a + t_b), and x is z and what makes K z the sliding friction, eta times the second one's."""
    m = re.fullmatch(r"z('?)_([12])([abc])", name)
    if m:
        return named("z_%s%s(%s)" % (m[2], m[1], SWITCHING["0abc".index(m[3])]))
    name = re.sub(r"\(t_.*\)", lambda sum: "(%s)" % " + ".join(sorted(sum[0][1:-1].split(" + "))), name)
    if name.startswith("x_"):
        d = (u_s1 + u_s2) / (1 - chi) if name[2] == "1" else (chi * u_s1 + u_s2) / ((1 - chi) * chi)
        return named("z" + name[1:]) + (0 if "'" in name else d)
    return pi if name == "pi" else Symbol(name)


def margin(values, k):
    """As SymPy has it."""
    known = {}

    def value(i):
        if i not in known:
            known[i] = code[i]()
        return known[i]

    code = values(types.SimpleNamespace(**FUNCTIONS), named, value)
    return cancel(value(k).subs([(u_s1, u_r1 - e_1), (u_s2, u_r2 - e_2)]))


def enclosure(e, at):
    if e.is_Symbol:
        return at[e.name]
    if e.is_Rational:
        return iv.mpf(e.p) / e.q
    if e == pi:
        return iv.pi
    parts = [enclosure(part, at) for part in e.args[:1 if e.is_Pow else None]]
    if e.is_Pow and (2 * e.exp).is_Integer:
        root = parts[0] if e.exp.is_Integer else iv.sqrt(parts[0])
        return root ** int(e.exp if e.exp.is_Integer else 2 * e.exp)
    of = {sin: iv.sin, cos: iv.cos, exp: iv.exp, Abs: abs, cot: lambda x: iv.cos(x) / iv.sin(x)}.get(e.func)
    if of:
        return of(*parts)
    out = parts[0]
    for part in parts[1:]:
        out = out + part if e.is_Add else out * part
    assert e.is_Add or e.is_Mul
    return out


def rate(m, phase):
    rates = v_1, v_2, *RATES[phase], 1
    return cancel(sum(of * diff(m, x) for x, of in zip(MOVING, rates)).subs(STICKING[phase]))


def vanishes(m, k, known):
    return cancel(m.subs(MEETING[k] + [(t, sum(LENGTHS[:k]))]).subs(known)) == 0


def zero(m, phase, known, order=4):
    """Exactly, by what is known; along a phase it is so where that begins, and so is its rate."""
    if not phase:
        return any(cancel(m.subs(more).subs(DATA)) == 0 for more in (known, []))
    m = cancel(m.subs(STICKING[phase]))
    return m == 0 or order > 0 and vanishes(m, list(PHASES).index(phase), known) and zero(
        rate(m, phase), phase, known, order - 1)


def positive(m, phase, numbers, flow, known, weakly=False):
    """Everywhere within the phase, the ends left out, or at the numbers; weakly: or zero throughout."""
    def values(low, high):
        z = (*flow[phase](iv.mpf([low, high])), begin + iv.mpf([low, high])) if phase else ()
        return {**numbers, **{symbol.name: x for symbol, x in zip(MOVING, z)}}

    def sure(m, low, high, order=4):
        """By its enclosure; beside an end of the phase where it is zero by that of its rate."""
        if enclosure(m, values(low, high)).a > 0:
            return True
        return bool(phase) and order > 0 and (
            low == 0 and vanishes(m, number, known) and sure(rate(m, phase), low, high, order - 1)
            or high == end and vanishes(m, number + 1, known) and sure(-rate(m, phase), low, high, order - 1))

    if weakly and zero(m, phase, known):
        return True
    number = list(PHASES).index(phase) if phase else None
    end = mpf(numbers[PHASES[phase].name].b) if phase else mpf(1)
    begin = sum((numbers[x.name] for x in LENGTHS[:number]), iv.mpf(0)) if phase else None
    rest = [(mpf(0), end)]
    while rest:
        low, high = rest.pop()
        if not sure(m, low, high):
            if not phase or high - low < mpf(2) ** -12:
                return False
            rest += [(low, (low + high) / 2), ((low + high) / 2, high)]
    return True


def follows(m, phase, relation, premises, *at):
    """An equation holds exactly; else the margin is a premise's for each friction that it contains, times a positive
    number, and a positive rest."""
    if relation == "=":
        return zero(m, phase, at[-1])
    shares = []
    for u in (u_r1, u_r2):
        ratios = [(p, cancel(diff(m, u) / diff(p, u))) for p in premises if diff(p, u) != 0]
        shares += [[(p, q) for p, q in ratios if not q.free_symbols - {chi, eta, v} and enclosure(q, at[0]).a > 0]] if diff(
            m, u) != 0 else []
    for some in itertools.product(*shares):
        rest = cancel(m - sum(q * p for p, q in some))
        if not rest.has(u_r1, u_r2) and positive(rest, phase, *at, bool(some) or relation == ">="):
            return True
    return False


def inequalities():
    numbers, flow = orbit()
    word, order = WORD.split(), list(PHASES)
    assert numbers and (GOALS or word), "%s: there is no orbit, or nothing to prove" % CLAIM
    assert not word or word in [order[k:] + order[:k] for k in range(4)], "%s: the phases are others" % CLAIM
    data = {"chi": CHI, "eta": ETA, "V": V, "e_1": E1, "e_2": E2}
    places = [(numbers, flow, exactly())]
    if AS_PRINTED:
        places.append(({name: exact(PRINTED[name][1]) for name in PRINTED}, flow, []))
    for at, *_ in places:
        at.update(data, z_10=at["z10"], z_20=at["z20"])
    for k, (phase, length) in enumerate(PHASES.items()):
        for place, time in (k, iv.mpf(0)), (k + 1, numbers[length.name]):
            numbers.update(zip((at_switching(m, place).name for m in MOVING[:4]), flow[phase](time)))
    premises = [margin(*code) for _, phase, relation, *code in PREMISES if not phase and relation == ">"]
    premises += [u_r1 - e_1, u_r2 - e_2] if FRICTION else []
    for phase, m in LAW if WORD else []:
        assert positive(m, phase, *places[0]), "%s: %s may fail in phase %s" % (CLAIM, m, phase)
    if WORD:
        print("Checked by intervals on the periodic solution: the phases are %s; Coulomb's law (2) holds throughout." % WORD)
    for text, phase, relation, *code in GOALS:
        m = margin(*code)
        assert all(follows(m, phase, relation, premises, *at) for at in places), "%s: %s is not shown" % (CLAIM, text)
        print("Checked %s %s: %s%s." % (
            "exactly" if relation == "=" else "by intervals",
            "on the periodic solution" + " and at the printed numbers" * AS_PRINTED, text, phase and " in the phase " + phase))
    if LEFT_OUT:
        print("Not checked, since nothing gives u_r1 and u_r2: %s." % "; ".join(LEFT_OUT))


print(__doc__)
print("At %s." % ", ".join("%s = %s" % item for item in PARAMETERS.items()))
if GOALS is not None:
    inequalities()
    said = "proved"
else:
    said = number(NUMBER) if NUMBER else "refuted" if closing() else None
print("Not checked here: that the motions in this script are those of (1) and (2)%s." % (
    ", and whether there are other periodic solutions" if NUMBER or GOALS is not None else ""))
print("%s: %s" % (CLAIM, said or "not shown to be wrong"))
sys.exit(said is None)
