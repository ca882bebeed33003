"""As claims.py, of what fails when overlay.eq is put over the paper."""
from mpmath import mpf

from model import orbit


def eq_2b(c):
    """m_1 slips with u_s2 in the place of u_s1."""
    f, lag = c["x_1"] - c["chi"] * c["x_2"], c["V"] - c["x_1'"]
    branch = "slips" if lag else "sticks" if abs(f) < c["u_r1"] else "breaks"
    eps = 1 if (lag or f) > 0 else -1
    return (c.text("mass") == "1" and c.text("applies") == c.text("branch") == branch == "slips"
            and c.near(eps * c["u_s1"], "right") and c.near(eps * c["u_s2"], "left") and c["left"] != c["right"])


def rank(rows):
    """Of two rows of two."""
    det = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    return 2 if abs(det) > mpf(10) ** -9 else int(any(x for row in rows for x in row))


def eq_22c(c):
    """By u and v."""
    orbit(c)
    return rank([[1, -1], [c["e_1"], -c["e_1"]]]) == c["right"] == 1 and c["left"] == 2


def eq_31c(c):
    """By x_b and y_b."""
    z = orbit(c).z[3]
    return rank([[1, -1], [c["V"] * (z[0] - c["chi"] * z[1]), -c["e_2"]]]) == c["right"] == 2 and c["left"] == 1


def eq_27b(c):
    """2 chi - (1 + chi) + (1 - chi) has the coefficients 0 and 0."""
    return c.text("divisor") == "2*chi - (1 + chi) + (1 - chi)" and (2 - 1 - 1, -1 + 1) == (0, 0) and c["value"] == 0


def text_constraints(c):
    """The force on m_2, which sticks in the first two phases, against the closed form of its least u_r2."""
    p = orbit(c)
    force = [c["chi"] * (z[1] - z[0]) for k in (0, 1) for z in (p.z[k], *p.moments(k), p.z[k + 1])]
    least, form = (c["e_2"] - min(force)) / 2, (c["e_2"] - c["chi"] * (p.z[0][1] + p.z[0][0])) / 2
    return (p.is_motion() and c.text("mass") == "2" and c.near(least, "right") and c.near(form, "left")
            and abs(least - form) > 1e-6)


def premises_53(c, p):
    """As put over the paper, and u_s1, u_s2 > 0."""
    return (c["e_1"] + c["u_s1"] > (c["e_1"] - (p.z[3][0] - c["chi"] * p.z[3][1])) / 2
            and c["e_2"] + c["u_s2"] > (c["e_2"] - c["chi"] * (p.z[0][1] + p.z[0][0])) / 2 and min(c["u_s1"], c["u_s2"]) > 0)


def eq_54(c):
    """While both masses stick the force on m_1 is e_1 + V (t - t_a) (1 - chi), at any time."""
    p = orbit(c)
    def apart(share):
        z = p.along(0, share)
        return z[0] - c["chi"] * z[1] - (c["e_1"] - c["V"] * p.t[0] * (1 - share) * (1 - c["chi"]))
    return (p.is_motion() and premises_53(c, p) and c.text("fails") == "e_1 + V*(t - t_a)*(1 - chi) < z_1(t) - chi*z_2(t)"
            and c.text("margin") == "0" and all(abs(apart(mpf(k) / 8)) < mpf(10) ** -13 for k in range(1, 8)))


def eq_57(c):
    """Inside the slip-stick phase the force on m_2 is another than where that begins."""
    p, share = orbit(c), c["of the phase"]
    force = [c["chi"] * (z[1] - z[0]) for z in (p.along(1, 0), p.along(1, share))]
    return (p.is_motion() and premises_53(c, p) and c.text("fails") == "h(t_a) = h(t)" and 0 < share < 1
            and c.near(force[0] - force[1], "margin") and abs(force[0] - force[1]) > 1e-6)


def text_depends_on_e(c):
    return (c.text("record"), c.text("symbol")) == ("eq-46", "u_s1")
