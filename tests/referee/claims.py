"""One function for each statement of the paper that audit.json refutes or finds conditional: it takes the certificate
(model.py), recomputes both sides from the paper's printed formula and from the definition, and says whether it confirms.
None is longer than 20 lines; none knows a formula of the program."""
import re

from mpmath import ceil, cos, cot, findroot, lu_solve, matrix, mpf, sin, sqrt

from model import Passage, derivative, ends, first_zero, flow, moments, orbit, passage, sides, stick, system


# --- (10): D = (I, V t I; 0, I)

def printed_d(c):
    vt = c["V"] * c["t"]
    return matrix([[1, 0, vt, 0], [0, 1, 0, vt], [0, 0, 1, 0], [0, 0, 0, 1]])


def eq_10(c):
    return sides(c, printed_d(c), flow(c, "D", c["t"])) and c["V"] != 1 and c.claim["condition"] == "V = 1"


def eq_10c(c):
    p = passage(c)
    true = flow(c, "D", c["t"]) * p.z[0]
    return (sides(c, true, printed_d(c) * p.z[0]) and 0 < c["t"] < p.t[0] and c["V"] != 1
            and c.claim["condition"] == "V = 1")


# --- (29) to (32): the perturbed slip-stick phase

def eq_29(c):
    p = passage(c)
    q = Passage(c, p.z[0][0] + c["x"], p.z[0][1] + c["y"])
    return sides(c, q.z[2], flow(c, "G", q.t[1]) * q.z[2])  # Z_b + dZ_b is the perturbed Z_b


def eq_30(c):
    p = passage(c)
    *dz_b, dt_b = derivative(lambda q: list(q.z[2]) + [q.t[1]], c)
    dz_b, gamma = matrix(dz_b), flow(c, "G", p.t[1])
    printed = gamma * dz_b + system(c, "G") * gamma * p.z[2] * dt_b  # the end of the line
    between = gamma * p.z[2] - p.z[2] + printed  # its middle by (29), to first order
    return sides(c, dz_b, between) and abs(dz_b[0] - printed[0]) > 1e-6


def eq_31(c):
    p = passage(c)
    q = Passage(c, p.z[0][0] + c["x"], p.z[0][1] + c["y"])
    shift = [(c["u_s1"] + c["u_s2"]) / (1 - c["chi"]), (c["u_s1"] * c["chi"] + c["u_s2"]) / ((1 - c["chi"]) * c["chi"])]
    x = [q.z[2][i] + shift[i] for i in (0, 1)]  # (3)
    return sides(c, c["chi"] * (x[1] - x[0]), c["e_1"] + c["u_s1"])


def eq_32b(c):
    z_b = passage(c).z[2]
    return sides(c, matrix([z_b[2] / c["V"]] * 2), matrix([z_b[2] / c["V"], z_b[3] / c["V"]]))


def eq_32c(c):
    z_b = passage(c).z[2]
    chi, v, chi_b = c["chi"], c["V"], z_b[2] / c["V"]
    y_b, u_b = derivative(lambda q: [q.z[2][1], q.z[2][2]], c)
    j_b = matrix([(chi - chi_b) / (1 - chi_b), (chi * z_b[1] - z_b[0]) * (chi - 1) / (v * (1 - chi_b))])
    return sides(c, matrix([y_b, u_b]), j_b * y_b)


def eq_32d(c):
    p = passage(c)
    return sides(c, p.z[2][2] / c["V"], p.at(p.t[1])[2] / c["V"])


# --- (36), (40)

def eq_36b(c):
    """H_41 and H_42 stand in J_c, whose indices are said to run from 1 to 3."""
    return "H_{41} + H_{42}" in c.claim["printed"] and "H_{ij} = H_{ij}(t_c), (i, j = 1, 2, 3)" in c.claim["quote"]


def printed_jf(c, t_d, r):
    """J_f of (40), with r = z_200 - z_100."""
    omega = sqrt(c["chi"] * c["eta"])
    k4 = sin(omega * t_d) / (c["V"] * omega * r)
    k5 = k4 / omega * cot(omega * t_d)
    k6 = cos(omega * t_d) - k4
    return matrix([[1 + k4, -k4, k5], [1 - k6, k6, sin(omega * t_d) / omega + k5]])


def eq_40(c):
    p = passage(c)
    printed = printed_jf(c, p.t[3], p.z[4][1] - p.z[4][0])
    def end(moved):  # positions at the end of the stick-slip phase
        z = p.z[3] + matrix(moved)
        return (flow(c, "C", first_zero(c, "C", z, ends(c, "C"))) * z)[:2]
    h, true = mpf(10) ** -8, matrix(2, 3)
    for k, i in enumerate((0, 1, 3)):
        plus, minus = ([s * h if n == i else 0 for n in range(4)] for s in (1, -1))
        true[:, k] = (matrix(end(plus)) - matrix(end(minus))) / (2 * h)
    return sides(c, printed, true) and c["V"] != 1 and c.claim["condition"] == "V = 1"


# --- Behaviour

def text_otherwise_unstable(c):
    """At tr J = -1 the return map is R(r + s) = r - s + c_2 s^2 + c_3 s^3: stable where c_2^2 + c_3 > 0."""
    p = orbit(c)
    r, h = p.z[4][1] - p.z[4][0], mpf(1) / 1000
    def back(s):
        z = stick(c, c["e_1"], r + s)
        q = Passage(c, z[0], z[1])
        return q.z[4][1] - q.z[4][0] - r
    f = {k: back(k * h) for k in (-2, -1, 1, 2)}
    slope = (8 * (f[1] - f[-1]) - f[2] + f[-2]) / (12 * h)
    c_2 = (16 * (f[1] + f[-1]) - f[2] - f[-2]) / (24 * h**2)
    c_3 = (f[2] - 2 * f[1] + 2 * f[-1] - f[-2]) / (12 * h**3)
    third = c_2**2 + c_3
    return abs(slope - c["trace"]) < 1e-8 and third > 0 and abs(third - c["c_2^2 + c_3"]) < 1e-4 and p.is_motion()


# --- The printed example

def printed_number(value):
    """Confirms a printed number by what it should be on the orbit; it stands for all that round or cut off to it."""
    def confirms(c):
        here, printed, unit = value(c, orbit(c)), c["printed"], c["unit"]
        away = here - printed if printed >= 0 else printed - here
        return c.near(here, "value") and unit == mpf(10) ** -4 and c.text("printed") in c.claim["quote"] and not (
            abs(away) <= unit / 2 or 0 <= away <= unit)
    return confirms


num_t_a = printed_number(lambda c, p: p.t[0])
num_t_b = printed_number(lambda c, p: p.t[1])
num_t_c = printed_number(lambda c, p: p.t[2])
num_t_d = printed_number(lambda c, p: p.t[3])
num_z10 = printed_number(lambda c, p: p.z[0][0])
num_z20 = printed_number(lambda c, p: p.z[0][1])
num_u_r1 = printed_number(lambda c, p: c["V"] * p.t[0] * (1 - c["chi"]) / 2)
num_u_r2 = printed_number(lambda c, p: (c["e_2"] - c["chi"] * (p.z[0][1] - p.z[0][0])) / 2)


def text_periodic(c):
    """From the printed start, and from the corners of what prints so, one period does not lead back."""
    p = Passage(c, c["z_10"], c["z_20"])
    off = p.z[4] - p.z[0]
    def gap(a, b):  # of z_2 - z_1, which alone fixes the end of the stick phase
        q = Passage(c, c["z_10"] + a * c["unit"], c["z_20"] - b * c["unit"])
        return (q.z[4] - q.z[0])[1] - (q.z[4] - q.z[0])[0]
    half = mpf(1) / 2
    corners = [gap(a, b) for a in (-half, 1) for b in (-half, 1)]
    return c.near(off[0], "off in z_1") and c.near(off[1], "off in z_2") and max(corners) < -0.02 and c["unit"] <= 1e-4


# --- Arguments: the premises hold on an orbit, and the conclusion fails

def force_at(c, p, share):
    z = p.along(3, share)
    return z[0] - c["chi"] * z[1]


def text_59_concluded(c):
    p = orbit(c)
    margin = force_at(c, p, c["of the phase"]) - (c["e_1"] - 2 * c["u_r1"])
    inside = c["e_1"] - 2 * c["u_r1"] < force_at(c, p, 1) < c["e_1"]  # (52), by (61)
    increasing = all(z[3] * c["chi"] < c["V"] for z in p.moments(3))
    return p.is_motion() and inside and increasing and margin < 0 and c.near(margin, "margin")


# --- The six equations, and (45), (46)

def solves(c):
    """Do the certified start and times satisfy (12), (14), (16) and (18), with positive times?"""
    z, rest = stick(c, c["z_10"] - c["chi"] * c["z_20"], c["z_20"] - c["z_10"]), []
    start = z
    for phase, name in zip("DGHC", ("t_a", "t_b", "t_c", "t_d")):
        z = flow(c, phase, c[name]) * z
        rest.append(ends(c, phase)(z))
    return max(abs(x) for x in rest + list(z - start)) < 1e-7 and min(c[n] for n in ("t_a", "t_b", "t_c", "t_d")) > 0


def overtakes(c):
    """Is a mass faster than the belt at one of 200 moments of the phases in which it slips?"""
    z = flow(c, "D", c["t_a"]) * stick(c, c["z_10"] - c["chi"] * c["z_20"], c["z_20"] - c["z_10"])
    for phase, name, masses in (("G", "t_b", [2]), ("H", "t_c", [2, 3]), ("C", "t_d", [3])):
        step = flow(c, phase, c[name] / 200)
        for _ in range(199):
            z = step * z
            if any(z[i] > c["V"] for i in masses):
                return True
        z = step * z
    return False


def text_18_motion(c):
    return solves(c) and overtakes(c)


def text_six_determine(c):
    """Another solution than the one nearest to the printed numbers, whose t_c is 1.48988."""
    return solves(c) and overtakes(c) and abs(c["t_c"] - mpf("1.48988")) > 0.1


def text_inverses(c):
    """det(N_1 - I) has both signs on periodic solutions that differ in e_2."""
    values = []
    for d in (c, c.second()):
        p = Passage(d, d["z_10"], d["z_20"])
        n = flow(d, "C", p.t[3]) * flow(d, "H", p.t[2]) * flow(d, "G", p.t[1]) * flow(d, "D", p.t[0])
        values.append((n[0, 0] - 1) * (n[1, 1] - 1) - n[0, 1] * n[1, 0])
        if not (p.closes() and p.is_motion() and d.near(values[-1], "value")):
            return False
    return values[0] * values[1] < 0


def touching(c, e_2, r, t_b, t_c, t_d):
    """The equations of a periodic solution with z_1c - chi z_2c = 0, and its states from t_a on."""
    chi, v, z = c["chi"], c["V"], [stick(c, c["e_1"], r)]
    for phase, t in zip("GHC", (t_b, t_c, t_d)):
        z.append(flow(c, phase, t) * z[-1])
    return [chi * (z[1][1] - z[1][0]) - e_2, z[2][2] - v, z[2][0] - chi * z[2][1], z[3][3] - v, z[3][1] - z[3][0] - r], z


def eq_36d(c):
    """The equations are solved anew; no mass is faster than the belt, m_1 sticks when it touches, t_a > 0."""
    names = "t_a", "t_b", "t_c", "t_d", "e_2", "z_10", "z_20"
    of = {name: c[name] for name in names}
    start = of["e_2"], of["z_20"] - of["z_10"], of["t_b"], of["t_c"], of["t_d"]
    x = list(findroot(lambda *x: touching(c, *x)[0], start))
    z, t = touching(c, *x)[1], x[2:]
    t_a = (c["e_1"] - z[3][0] + c["chi"] * z[3][1]) / (c["V"] * (1 - c["chi"]))
    slower = all(inside[m] < c["V"] for k, masses in enumerate(([2], [2, 3], [3]))
                 for inside in moments(c, "GHC"[k], z[k], t[k]) for m in masses)
    same = all(c.near(value, name) for value, name in zip([t_a, *t, x[0], z[3][0], z[3][1]], names))
    return same and slower and min(t_a, *t) > 0


# --- Symbols: the certificate is the paper's own text

def quoted(*parts):
    """Do these stand in the quotation, in this order?"""
    def confirms(c):
        at = 0
        for part in parts:
            at = c.claim["quote"].find(part, at)
            if at < 0:
                return False
            at += len(part)
        return True
    return confirms


text_friction_names = quoted("u_{si}, u_{si}", "are the sliding and the sticking friction forces")
text_free_index = quoted("V - x'_i = 0", "u_1 = x_1", "V - x'_2 = 0", r"u_2 = \chi(x_2 - x_1)")
text_time_name = quoted("$t^*$ = time", r"t = \omega_3 t'")
text_transpose = quoted(r"(o') = \frac{d(o)}{dt}", "z = (z_1, z_2)'", "z'_a = (V, V)^t", "z'_0 = (V, V)'")
text_switch_times = quoted("$t_a, t_b, t_c, t_d$ = non dimensional times of switches")
text_mass_name = quoted("masses $m_1, m_2$", "$M_1$ performs", "$M_2$ is still")
text_start_name = quoted(r"Z_0 = \begin{pmatrix} z_0 \\ z'_0", "D(t_a + dt_a)(Z_0 + dZ_0)")
text_trace_bars = quoted(r"$|\text{tr}(J) < 1|$")
text_dimensions = quoted("$u_1, u_2$ = non dimensional friction forces", r"u_i = \frac{F_i}{k_1 + k_2}")
text_belt_name = quoted("$V$ = belt velocity", r"u_{si} \text{sign}(V - x'_i)")
text_letters = quoted("P = P_4", r"\omega^2 = \chi", r"P(\lambda)", r"\omega^2) = 0")
text_motion_name = quoted("Z(t_a + dt_a) = D(t_a + dt_a)(Z_0 + dZ_0)", "Z(t_a + dt_a) - Z(t_a)")


def text_scaling(c):
    """With V and all z twice as large, every term of (10) should be twice as large, and k_4, k_4/omega cot as before."""
    def terms_10(s):
        return s * 3, (s * 2) * 5 * (s * 2)  # z_1(0) and V t z_1'(0) at z_1(0) = 3, V = z_1'(0) = 2, t = 5
    def k_4(s):
        return 1 / ((s * 2) * (s * 7))  # sin(omega t_d)/omega = 1, V = 2, z_200 - z_100 = 7
    wrong = [name for name, ratios, degree in (
        ("10", [b / a for a, b in zip(terms_10(mpf(1)), terms_10(mpf(2)))], 2), ("40", [k_4(mpf(2)) / k_4(mpf(1))], 1)
    ) if any(x != degree for x in ratios)]
    parts = [re.fullmatch(r"\((\d+)\): .* \(degree (-?\d)\)", part) for part in c.text("degrees").split(". ")]
    named = [part and part.groups() for part in parts]
    return wrong == ["10", "40"] and named == [("10", "2"), ("40", "-2")]


def text_closed_forms(c):
    """A mass faster than the belt has the friction -u_s1 by (2); (3), in x = z + d_0, always gives it +u_s1."""
    chi, u_1, u_2 = mpf(4) / 5, mpf(3), mpf(2)
    d_1, d_2 = (u_1 + u_2) / (1 - chi), (u_1 * chi + u_2) / ((1 - chi) * chi)
    by_3, by_2 = d_1 - chi * d_2, -u_1  # x_1'' + x_1 - chi x_2
    says = "For each kind of motions, the close form solution is obtained" in c.claim["quote"]
    return says and abs(by_3 - u_1) < 1e-20 and abs(by_3 - by_2 - 2 * u_1) < 1e-20 and "faster" in c.claim["condition"]


# --- Numbers in the sentences of the roots: as texts, each from the certificates of the root's claims

def rounded(x, decimals):
    return "%.*f" % (decimals, x)


def starts(c, times):
    """z_0 by the first and by the second line of (44)."""
    n = matrix([[mpf(i == k) for k in range(4)] for i in range(4)])
    for phase, t in zip("DGHC", times):
        n = flow(c, phase, t) * n
    v, one = matrix([c["V"]] * 2), matrix([[1, 0], [0, 1]])
    return lu_solve(n[:2, :2] - one, -n[:2, 2:] * v), lu_solve(n[2:, :2], (one - n[2:, 2:]) * v)


def slope(c, z, h=mpf(10) ** -8):
    """Of the return map of r = z_2 - z_1 on the orbit that begins at z, which is tr J."""
    def back(s):
        start = stick(c, c["e_1"], z[1] - z[0] + s)
        q = Passage(c, start[0], start[1])
        return q.z[4][1] - q.z[4][0]
    return (back(h) - back(-h)) / (2 * h)


def printed_times(of):
    return [of[number]["printed"] for number in ("num-t_a", "num-t_b", "num-t_c", "num-t_d")]


def kept_times(of, apart):
    """The solution with t_b, t_c as printed: times, start, e_1, e_2, the bounds (53) and tr J."""
    c, (_, t_b, t_c, _) = of["text-periodic"], printed_times(of)
    t_a, t_d = findroot(apart, (mpf(1) / 2, mpf("2.342")))
    z = starts(c, (t_a, t_b, t_c, t_d))[0]
    z_a = matrix([z[0] + c["V"] * t_a, z[1] + c["V"] * t_a, c["V"], c["V"]])
    z_b = flow(c, "G", t_b) * z_a
    e = z_a[0] - c["chi"] * z_a[1], c["chi"] * (z_b[1] - z_b[0])
    data = {"chi": c["chi"], "eta": c["eta"], "V": c["V"], "e_1": e[0], "e_2": e[1]}
    return [t_a, t_d, *z, *e, c["V"] * t_a * (1 - c["chi"]) / 2, (e[1] - c["chi"] * (z[1] - z[0])) / 2, slope(data, z)]


def printed_trace(c, times):
    """tr J by (27), (32), (36) and (40) as they are printed, at the printed numbers."""
    z, v, chi = matrix([c["z_10"], c["z_20"], c["V"], c["V"]]), c["V"], c["chi"]
    b, h = flow(c, "G", times[1]) * flow(c, "D", times[0]) * z, flow(c, "H", times[2])
    chi_b, e = b[2] / v, h * b
    j_b = matrix([(chi - chi_b) / (1 - chi_b), (chi * b[1] - b[0]) * (chi - 1) / (v * (1 - chi_b))])
    k1 = v / (e[0] - chi * e[1])
    k2, k3 = k1 * e[3] / v, k1 * chi * c["eta"] * (e[0] - e[1]) / v
    j_c = matrix([[h[i, 0] + h[i, 1] + k * (h[2, 0] + h[2, 1]), h[i, 2] + k * h[0, 0]]
                  for i, k in ((0, k1), (1, k2), (3, k3))])
    x = printed_jf(c, times[3], z[1] - z[0]) * j_c * j_b
    return (x[1] - x[0]) / (1 - chi)


def numbers_example(of):
    """The passage from the printed start; z_20 by either line of (44) at the printed times; the solution with t_b, t_c as printed."""
    c, (t_a, t_b, t_c, t_d) = of["text-periodic"], printed_times(of)
    def apart(t_a, t_d):
        first, second = starts(c, (t_a, t_b, t_c, t_d))
        return [first[i] - second[i] for i in range(2)]
    kept, once, nearest = kept_times(of, apart), Passage(c, c["z_10"], c["z_20"]), orbit(of["num-t_a"])
    found = [findroot(lambda t: apart(t, t_d)[0], (mpf(1) / 2, mpf(7) / 10)), *once.t, *once.z[4][:2], *kept]
    found += [start[1] for start in starts(c, (t_a, t_b, t_c, t_d))] + [slope(of["num-t_a"], nearest.z[0]), *nearest.t]
    found.append(printed_trace(c, (t_a, t_b, t_c, t_d)))
    return {rounded(x, 4) for x in found} | {of["num-t_d"].text("printed"), rounded(kept[1], 6)}


def numbers_otherwise(of):
    c = of["text-otherwise-unstable"]
    return {c.text("chi")[:10], rounded(c["e_2"], 2)}


def numbers_first_roots(of):
    """How many solutions, up to which t_c; the data of the claim that has several, p/q of its title as decimals, and their t_c."""
    six, several = of["text-six-determine"].claim, of["text-several-motions"].claim
    count, last = re.match(r"\d+", six["evidence"][0]["note"])[0], re.search(r"t_c up to (\d+)", six["title"])[1]
    longest = max(mpf(times.split(", ")[2]) for times in re.findall(r"\(([\d., ]+)\)", several["evidence"][1]["note"]))
    return {count, last, str(int(ceil(longest)))} | {
        rounded(mpf(p) / mpf(q), 2) for p, q in re.findall(r"(\d+)/(\d+)", several["title"])}


def reach(c, delta):
    """By how much the first mass comes nearest to the belt's velocity in the global slip phase, from r + delta on."""
    z, t = stick(c, c["e_1"], c["z_20"] - c["z_10"] + delta), c["t_b"]
    t = findroot(lambda t: (lambda x: c["chi"] * (x[1] - x[0]) - c["e_2"])(flow(c, "G", t) * z), t)
    z = flow(c, "G", t) * z
    t = findroot(lambda t: (lambda x: x[0] - c["chi"] * x[1])(flow(c, "H", t) * z), c["t_c"])
    return (flow(c, "H", t) * z)[2] - c["V"]


def numbers_touching(of):
    """The solution, and the slope of the return map on the side on which the first mass reaches the belt's velocity."""
    c = of["eq-36d"]
    r, delta = c["z_20"] - c["z_10"], mpf(10) ** -6
    z = stick(c, c["e_1"], r + (delta if reach(c, delta) > 0 else -delta))
    def back(z):
        p = Passage(c, z[0], z[1])
        return p.z[4][1] - p.z[4][0]
    slope = (back(z) - r) / (z[1] - z[0] - r)
    return {rounded(slope, 2), c.text("e_2")[:10]} | {rounded(c[t], 4) for t in ("t_a", "t_b", "t_c", "t_d")}
