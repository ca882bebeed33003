"""t_a, z_10, z_20 by the paper's (45) and (46) from t_b, t_c, t_d with few digits, by readings.py's matrix exponentials.

Equation i of (45) says that (44) gives the same z_i0 by its rows of positions and by those of velocities, and is linear in
t_a: it is looked at for t_a = 0 and 1, and the zero of the line taken; then (46).  The example's data.
The times are those of the second orbit of set paper in orbits.tsv, rounded to 2, 3, 4 and 8 significant digits.

  python3 tests/oracle/procedure.py > tests/oracle/procedure.tsv
"""
from mpmath import __version__, mpf, nstr

from readings import Example


def orbit():
    for line in open("tests/oracle/orbits.tsv"):
        field = line.split("\t")
        if field[:3] == ["orbit", "paper", "1"]:
            return field[6:9]


def main():
    print("# tests/oracle/procedure.py, mpmath", __version__)
    print("# digits	row	t_b	t_c	t_d	t_a	z10	z20")
    example = Example("0.8", "1", "1")
    for digits in (2, 3, 4, 8):
        printed = [nstr(mpf(t), digits, strip_zeros=False) for t in orbit()]
        times = dict(zip(("t_b", "t_c", "t_d"), map(mpf, printed)))
        for row in (0, 1):
            at = [example.start_from(x, 0)[row] - example.start_from(x, 2)[row]
                  for x in (dict(times, t_a=mpf(t)) for t in (0, 1))]
            ta = at[0] / (at[0] - at[1])
            z = example.start_from(dict(times, t_a=ta), 0)
            print(digits, row, *printed, *(nstr(x, 30) for x in (ta, z[0], z[1])), sep="\t")


if __name__ == "__main__":
    main()
