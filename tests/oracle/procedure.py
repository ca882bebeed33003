"""t_a, z_10, z_20 by the paper's (45) and (46) from t_b, t_c, t_d with few digits, by mpmath's matrix exponentials.

N = C H Gamma D with D = (I, t_a I; 0, I); equation i of (45) is linear in t_a.  It is evaluated at t_a = 0 and 1 from
N itself, as (45) stands, and the zero of the line taken; then (46).  The example's data.
The times are those of the second orbit of set paper in orbits.tsv, rounded to 2, 3, 4 and 8 significant digits.

  python3 tests/oracle/procedure.py > tests/oracle/procedure.tsv
"""
import mpmath as mp

mp.mp.dps = 50


def exponentials(chi, eta, times):
    k = chi * eta
    rows = {"Gamma": ([-1, chi], [0, 0]), "H": ([-1, chi], [k, -k]), "C": ([0, 0], [k, -k])}
    out = []
    for phase, t in zip(("Gamma", "H", "C"), times):
        a = mp.zeros(4)
        a[0, 2] = a[1, 3] = 1
        for i in range(2):
            for j in range(2):
                a[2 + i, j] = rows[phase][i][j]
        out.append(mp.expm(a * t))
    return out


def blocks(chi, eta, times, ta):
    gamma, h, c = exponentials(chi, eta, times)
    d = mp.eye(4)
    d[0, 2] = d[1, 3] = ta
    n = c * h * gamma * d
    return n[0:2, 0:2], n[0:2, 2:4], n[2:4, 0:2], n[2:4, 2:4]


def left_side(chi, eta, times, ta, row):
    n1, n2, n3, n4 = blocks(chi, eta, times, ta)
    m = (n1 - mp.eye(2)) ** -1 * n2 - n3 ** -1 * (n4 - mp.eye(2))
    return m[row, 0] + m[row, 1]


def start(chi, eta, v, times, ta):
    n1, n2, _, _ = blocks(chi, eta, times, ta)
    return -((n1 - mp.eye(2)) ** -1) * n2 * mp.matrix([v, v])


def orbit():
    for line in open("tests/oracle/orbits.tsv"):
        field = line.split("\t")
        if field[:3] == ["orbit", "paper", "1"]:
            return field[6:9]


def main():
    print("# tests/oracle/procedure.py, mpmath", mp.__version__)
    print("# digits	row	t_b	t_c	t_d	t_a	z10	z20")
    chi, eta, v = mp.mpf(4) / 5, mp.mpf(1), mp.mpf(1)
    for digits in (2, 3, 4, 8):
        printed = [mp.nstr(mp.mpf(t), digits, strip_zeros=False) for t in orbit()]
        times = [mp.mpf(t) for t in printed]
        for row in (0, 1):
            at = [left_side(chi, eta, times, mp.mpf(t), row) for t in (0, 1)]
            ta = at[0] / (at[0] - at[1])
            z = start(chi, eta, v, times, ta)
            print(digits, row, *printed, *(mp.nstr(x, 30) for x in (ta, z[0], z[1])), sep="\t")


if __name__ == "__main__":
    main()
