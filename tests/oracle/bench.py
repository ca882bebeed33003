#!/usr/bin/env python3
"""H(t) for tests/check_bench.c: the exponential of the first-order system of z_1'' = -(z_1 - chi z_2),
z_2'' = -chi eta (z_2 - z_1), by mpmath.expm at 80 digits, 45 of them printed.

    python3 bench.py > bench.tsv
"""
from fractions import Fraction

import mpmath as mp

mp.mp.dps = 80
POINTS = [("0.75", "1.25", "0.5"), ("0.125", "6", "3.25"), ("0.9375", "0.25", "37.5")]

print("# H(t), 45 significant digits.  Made by bench.py.")
print("# chi	eta	t	row	column	value")
for chi, eta, t in POINTS:
    c, e, x = (mp.mpf(Fraction(v).numerator) / Fraction(v).denominator for v in (chi, eta, t))
    a = mp.matrix([[0, 0, 1, 0], [0, 0, 0, 1], [-1, c, 0, 0], [c * e, -c * e, 0, 0]])
    h = mp.expm(a * x, method="taylor")
    for i in range(4):
        for k in range(4):
            print(chi, eta, t, i + 1, k + 1, mp.nstr(h[i, k], 45, strip_zeros=False), sep="\t")
