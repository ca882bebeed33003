"""readings.py: printed examples that come from a known procedure, for the tests of the search over readings.

Nothing of the C program is used: each phase is propagated by mpmath.expm of its 4x4 matrix, the equations are written
out here again, and each procedure is carried out with mpmath.findroot at 50 digits.

  python3 readings.py scenes DIR   writes one scene for each procedure
  python3 readings.py values       readings.tsv: what the quantities of each procedure are before they are printed; for
                                   the paper's example what every equation gives from two of its numbers, and from the
                                   corners of what the digits of e1 and e2 stand for
"""
import os
import sys

from mpmath import expm, findroot, lu_solve, matrix, mp, mpf, nint

mp.dps = 50
NAMES = ["z10", "z20", "t_a", "t_b", "t_c", "t_d", "e1", "e2"]


def first_order(k):
    a = matrix(4, 4)
    a[0, 2] = a[1, 3] = 1
    for i in range(2):
        for j in range(2):
            a[2 + i, j] = -k[i][j]
    return a


class Example:
    def __init__(self, chi, eta, v, printed_d=False):
        self.given = chi, eta, v
        self.chi, self.eta, self.v = mpf(chi), mpf(eta), mpf(v)
        c, s = self.chi, self.chi * self.eta
        self.a = [first_order(k) for k in ([[0, 0], [0, 0]], [[1, -c], [0, 0]], [[1, -c], [-s, s]], [[0, 0], [-s, s]])]
        self.printed_d = printed_d  # D of (10) as printed, with V t in place of t

    def states(self, x):
        z = [matrix([x["z10"], x["z20"], self.v, self.v])]
        for k, t in enumerate(("t_a", "t_b", "t_c", "t_d")):
            time = x[t] * self.v if self.printed_d and k == 0 else x[t]
            z.append(expm(self.a[k] * time) * z[-1])
        return z

    def whole_map(self, x):
        m = matrix([[int(i == j) for j in range(4)] for i in range(4)])
        for k, t in enumerate(("t_a", "t_b", "t_c", "t_d")):
            m = expm(self.a[k] * (x[t] * self.v if self.printed_d and k == 0 else x[t])) * m
        return m

    def start_from(self, x, rows):
        """z_0 from the rows of (44): 0 the positions, 2 the velocities."""
        n = self.whole_map(x)
        a, b = matrix(2, 2), matrix(2, 1)
        for i in range(2):
            for j in range(2):
                a[i, j] = n[rows + i, j] - (1 if rows == 0 and i == j else 0)
            b[i] = -(n[rows + i, 2] + n[rows + i, 3]) * self.v + (self.v if rows == 2 else 0)
        return lu_solve(a, b)

    def residual(self, name, x):
        if name in ("F1", "F2"):
            return x["z10" if name == "F1" else "z20"] - self.start_from(x, 0)[int(name[1]) - 1]
        if name in ("G1", "G2"):
            return x["z10" if name == "G1" else "z20"] - self.start_from(x, 2)[int(name[1]) - 1]
        z = self.states(x)
        return {"12": lambda: z[1][0] - self.chi * z[1][1] - x["e1"],
                "14": lambda: self.chi * (z[2][1] - z[2][0]) - x["e2"],
                "16": lambda: z[3][2] - self.v,
                "v2": lambda: z[4][3] - self.v,
                "z1": lambda: z[4][0] - z[0][0],
                "z2": lambda: z[4][1] - z[0][1]}[name]()

    def solve(self, equations, inputs, near, steps=60):
        out = [n for n in NAMES if n not in inputs]
        assert len(out) == len(equations)

        def f(*v):
            x = dict(inputs, **dict(zip(out, v)))
            return [self.residual(e, x) for e in equations]

        root = findroot(f, [near[n] for n in out], tol=mpf(10) ** (-mp.dps), maxsteps=steps)
        x = dict(inputs, **{n: root[i] for i, n in enumerate(out)})
        return {n: x[n] for n in NAMES}


def decimal(x, places):
    n = int(nint(x * 10 ** places))
    s = str(abs(n)).rjust(places + 1, "0")
    return ("-" if n < 0 else "") + (s if places == 0 else s[:-places] + "." + s[-places:])


def numbers(d):
    return {k: mpf(v) for k, v in d.items()}


NEAR = numbers({"z10": "0.98", "z20": "-2.12", "t_a": "0.53", "t_b": "2.0", "t_c": "1.49", "t_d": "2.35", "e1": "2.78",
                "e2": "0.86"})
ALL = ["12", "14", "16", "v2", "z1", "z2"]


def whole():
    """Every equation, inputs e1 and e2."""
    return Example("0.78", "1.1", "1"), ALL, {"e1": "2.7123", "e2": "0.8412"}, 4


def times():
    """Every equation, inputs t_b and t_c; e1 and e2 are called data but were computed."""
    return Example("0.78", "1.1", "1"), ALL, {"t_b": "1.95", "t_c": "1.52"}, 6


def dropped():
    """z_1 does not return; inputs e1, e2 and t_b."""
    return Example("0.78", "1.1", "1"), ["12", "14", "16", "v2", "z2"], {"e1": "2.7123", "e2": "0.8412",
                                                                              "t_b": "2.04"}, 4


def printed_layer():
    """Every equation, inputs e1 and e2, but D(t) of (10) as printed, which is another matrix when V is not 1."""
    return Example("0.8", "1", "1.25", True), ALL, {"e1": "3.4805", "e2": "1.0734"}, 4


def chain():
    """t_b, t_c, t_d chosen; t_a and z_10 from row 1 of (45); then z_20, e_1, e_2 one after another, each from the
    numbers before it as they are printed."""
    return Example("0.8", "1", "1"), None, {"t_b": "2", "t_c": "1.5", "t_d": "2.34"}, 4


def paper():
    """The reading of the paper's own example that the search ranks first."""
    return (Example("0.8", "1", "1"), ["12", "14", "F1", "G1", "G2"], {"t_b": "2", "t_c": "1.5", "t_d": "2.34"}, 4)


PROCEDURES = {"whole": whole, "times": times, "dropped": dropped, "printed_layer": printed_layer, "chain": chain,
              "paper": paper}


def run(name):
    ex, equations, inputs, places = PROCEDURES[name]()
    chosen = numbers(inputs)
    if name != "chain":
        scale = ex.v
        near = {k: v if k.startswith("t_") else v * scale for k, v in NEAR.items()}
        return ex, ex.solve(equations, chosen, near), places, inputs
    f = lambda ta, z10: [ex.residual("F1", dict(chosen, t_a=ta, z10=z10)), ex.residual("G1", dict(chosen, t_a=ta, z10=z10))]
    root = findroot(f, [mpf("0.68"), mpf("0.89")], tol=mpf(10) ** -70)
    exact = dict(chosen, t_a=root[0], z10=root[1])
    show = lambda v: mpf(decimal(v, places))
    fed = dict(chosen, t_a=show(root[0]), z10=show(root[1]))
    exact["z20"] = ex.start_from(fed, 2)[1]
    fed["z20"] = show(exact["z20"])
    zero = mpf(0)
    exact["e1"] = ex.residual("12", dict(fed, e1=zero, e2=zero))
    exact["e2"] = ex.residual("14", dict(fed, e1=zero, e2=zero))
    return ex, {n: exact[n] for n in NAMES}, places, inputs


def scene(name):
    ex, x, places, inputs = run(name)
    text = lambda n: inputs.get(n) or decimal(x[n], places)
    lines = ["# Made by tests/oracle/readings.py: " + " ".join(PROCEDURES[name].__doc__.split()), "title: " + name]
    lines += ["%s = %s" % pair for pair in zip(("chi", "eta", "V"), ex.given)]
    lines += ["%s = %s" % (n, text(n)) for n in ("e1", "e2")]
    lines += ["printed: %s = %s" % (n, text(n)) for n in NAMES]
    return "\n".join(lines) + "\n"


PAPER = {"z10": "0.8921", "z20": "-2.1958", "t_a": "0.6784", "t_b": "2", "t_c": "1.5", "t_d": "2.34", "e1": "2.7844",
         "e2": "0.8587", "u_r1": "0.0678", "u_r2": "1.6645"}


def fits(x, decimal):
    """The printed numbers have four decimals; what a shorter one leaves out are zeros."""
    unit = mpf(10) ** -max(len(d.partition(".")[2]) for d in PAPER.values())
    p, x = abs(mpf(decimal)), x if decimal[0] != "-" else -x
    return abs(x - p) <= unit / 2 or p <= x <= p + unit


def line(kind, name, x):
    print(kind + "\t" + name + "\t" + "\t".join(n + "=" + mp.nstr(x[n], 20) for n in NAMES))


def paper_lines():
    mp.dps = 25
    ex, printed = Example("0.8", "1", "1"), {n: mpf(PAPER[n]) for n in NAMES}
    for i, a in enumerate(NAMES):
        for b in NAMES[i + 1:]:
            try:
                x = ex.solve(ALL, {a: printed[a], b: printed[b]}, printed, 10)
            except (ValueError, ZeroDivisionError):
                print("pair\t%s, %s\tno solution found" % (a, b))
                continue
            if max(abs(x[n] - printed[n]) - abs(printed[n]) for n in NAMES) > 1:
                print("pair\t%s, %s\tfar" % (a, b))
                continue
            x["u_r1"] = ex.v * x["t_a"] * (1 - ex.chi) / 2
            x["u_r2"] = (x["e2"] - ex.chi * (x["z20"] - x["z10"])) / 2
            print("pair\t%s, %s\t%s" % (a, b, ", ".join(n for n in PAPER if n not in (a, b) and not fits(x[n], PAPER[n]))))
    for d1 in ("-0.00005", "0", "0.0001"):
        for d2 in ("-0.00005", "0", "0.0001"):
            x = ex.solve(ALL, {"e1": printed["e1"] + mpf(d1), "e2": printed["e2"] + mpf(d2)}, NEAR)
            line("corner", d1 + "," + d2, x)


def main(args):
    if len(args) == 2 and args[0] == "scenes":
        for name in PROCEDURES:
            if name == "paper":
                continue
            with open(os.path.join(args[1], name + ".scene"), "w", encoding="utf-8") as f:
                f.write(scene(name))
        return 0
    if args == ["values"]:
        for name in PROCEDURES:
            _, x, _, _ = run(name)
            line("procedure", name, x)
        paper_lines()
        return 0
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
