"""stability.py > stability.tsv: formulas of the paper at extreme points, by mpmath.

The formulas are written here from the paper, in mpmath and in 400 digits, with matrices as matrices (Lambda B Lambda^-1 by
mpmath's inverse, frequencies from the quadratic for omega^2); the condition number is the sum over the inputs of
|x df/dx|/|f| by mpmath's numerical derivative.  Columns: formula, point (exact doubles), true value to 40 digits,
condition number.  A point's numbers are drawn from a generator of its own, near 1 and at extremes.
"""
import random

from mpmath import cos, cot, diff, inverse, matrix, mp, mpf, nstr, sin, sqrt, workdps

mp.dps = 400


def omegas(chi, eta):
    b, c = 1 + chi * eta, chi * eta * (1 - chi)
    high = (b + sqrt(b * b - 4 * c)) / 2
    return sqrt(c / high), sqrt(high)


def lambdas(chi, eta):
    return [(1 - w**2) / chi for w in omegas(chi, eta)]


def h_matrix(chi, eta, t):
    w = omegas(chi, eta)
    l1, l2 = lambdas(chi, eta)
    lam = matrix([[1, 1], [l1, l2]])
    b1 = matrix([[cos(w[0] * t), 0], [0, cos(w[1] * t)]])
    b2 = matrix([[sin(w[0] * t) / w[0], 0], [0, sin(w[1] * t) / w[1]]])
    b3 = matrix([[-w[0] * sin(w[0] * t), 0], [0, -w[1] * sin(w[1] * t)]])
    h1, h2, h3 = (lam * b * inverse(lam) for b in (b1, b2, b3))
    return [[h1, h2], [h3, h1]]


def h_entry(i, j):
    return lambda chi, eta, t: h_matrix(chi, eta, t)[(i - 1) // 2][(j - 1) // 2][(i - 1) % 2, (j - 1) % 2]


def gamma_2(chi, t):
    sigma = matrix([[1, chi], [0, 1]])
    return sigma * matrix([[sin(t), 0], [0, t]]) * inverse(sigma)


def k4(chi, eta, V, t_d, z_100, z_200):
    w = sqrt(chi * eta)
    return sin(w * t_d) / (V * w * (z_200 - z_100))


FORMULAS = {
    "omega_1": ("chi eta", lambda chi, eta: omegas(chi, eta)[0]),
    "omega_2": ("chi eta", lambda chi, eta: omegas(chi, eta)[1]),
    "lambda_1": ("chi eta", lambda chi, eta: lambdas(chi, eta)[0]),
    "lambda_2": ("chi eta", lambda chi, eta: lambdas(chi, eta)[1]),
    "H[1,2]": ("chi eta t", h_entry(1, 2)),
    "H[1,4]": ("chi eta t", h_entry(1, 4)),
    "H[2,1]": ("chi eta t", h_entry(2, 1)),
    "H[3,2]": ("chi eta t", h_entry(3, 2)),
    "H[4,4]": ("chi eta t", h_entry(4, 4)),
    "Gamma[1,4]": ("chi t", lambda chi, t: gamma_2(chi, t)[0, 1]),
    "gammatilde_1": ("chi V z'_1b", lambda chi, V, v: (chi - v / V) / (1 - v / V)),
    "gammatilde_2": ("chi V z_1b z_2b z'_1b",
                     lambda chi, V, z1, z2, v: (chi * z2 - z1) * (chi - 1) / (V * (1 - v / V))),
    "ktilde_1": ("chi V z_1c z_2c", lambda chi, V, z1, z2: V / (z1 - chi * z2)),
    "ktilde_3": ("chi eta V z_1c z_2c", lambda chi, eta, V, z1, z2: chi * eta * (z1 - z2) / (z1 - chi * z2)),
    "ktilde_4": ("chi eta V t_d z_100 z_200", k4),
    "ktilde_6": ("chi eta V t_d z_100 z_200", lambda *a: cos(sqrt(a[0] * a[1]) * a[3]) - k4(*a)),
    "ktilde_7": ("chi eta V t_d z_100 z_200",
                 lambda *a: sin(sqrt(a[0] * a[1]) * a[3]) / sqrt(a[0] * a[1])
                 + k4(*a) / sqrt(a[0] * a[1]) * cot(sqrt(a[0] * a[1]) * a[3])),
    "eq-53.2": ("V t_a chi", lambda V, t, chi: V * t * (1 - chi) / 2),
}


def number(name, r, extreme):
    """A double; extreme: far from 1, for chi near an end."""
    if name == "chi":
        return r.uniform(0.05, 0.95) if not extreme else r.choice([10 ** r.uniform(-12, -2), 1 - 2 ** -r.uniform(5, 40)])
    size = 10 ** (r.uniform(-8, 8) if extreme else r.uniform(-1, 1))
    return size * r.choice([-1, 1]) if name.startswith("z") else size


def condition(f, x):
    value, total = f(*x), mpf(0)
    for k in range(len(x)):
        def scaled(s, k=k):
            return f(*[v * s if i == k else v for i, v in enumerate(x)])
        total += abs(diff(scaled, 1, h=mpf(10) ** -150))
    return value, total / abs(value)


def main():
    print("# formula, point, true value, condition number; made by stability.py with mpmath")
    for name, (inputs, f) in FORMULAS.items():
        inputs = inputs.split()
        r = random.Random(name)
        for row in range(4):
            x = [number(n, r, row >= 2) for n in inputs]
            value, kappa = condition(f, [mpf(v) for v in x])
            point = ",".join(f"{n}={v.hex()}" for n, v in zip(inputs, x))
            with workdps(60):
                print(name, point, nstr(value, 40), nstr(kappa, 12), sep="\t")


if __name__ == "__main__":
    main()
