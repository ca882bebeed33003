"""later.py: solutions of the paper's six equations with positive times and t_c below 20, later roots included.

The common zeros of scan.py's two functions of (t_b, t_c) by a grid of 1/50 and Newton's iteration, whether the events are first
ones or not; then every t_d that brings phase C to (r0, 0) and leaves t_a > 0.  A search, no proof.
Rows: set, chi, eta, V, e1, e2; solution, t_a, t_b, t_c, t_d.
"""
import math

from scan import Flow, Model, dot

SETS = [("paper", "0.8", "1", "1", "2.7844", "0.8587", 40), ("two-admissible", "0.71", "1.2", "1.9", "5.9", "0.158", 40),
        ("mixed", "0.44", "1.6", "0.35", "3.18", "2.58", 90)]
STEP, LAST = 0.02, 20.0


def newton(m, flow, x):
    for _ in range(50):
        f, g, fb, fc, gb, gc = m.plane(flow, *x)
        det = fb * gc - fc * gb
        if det == 0:
            return None
        step = (gc * f - fc * g) / det, (fb * g - gb * f) / det
        x = x[0] - step[0], x[1] - step[1]
        if not 0 < x[0] < 1e3 or not 0 < x[1] < 1e3:
            return None
        if abs(step[0]) + abs(step[1]) < 1e-12:
            break
    good = abs(f) + abs(g) < 1e-8 and x[0] > 1e-4 and 1e-4 < x[1] < LAST
    return x if good else None


def ends(m, flow, tb, tc):
    """Every (t_d, t_a)."""
    r0, _, zb, _ = m.slip_start(tb)
    z, omega = flow.at(zb, tc), math.sqrt(m.chi * m.eta)
    r, q = z[1] - z[0], z[3] - m.v
    td = math.atan2(q / omega * r0, r * r0) % (2 * math.pi) / omega
    ta = (m.stick_end(r0)[0] - z[0]) / m.v - td
    while ta > 0:
        yield td, ta
        td, ta = td + 2 * math.pi / omega, ta - 2 * math.pi / omega


def apart(values):
    return min(values) > 0 or max(values) < 0


def cells(m, flow, last_tb):
    before, stiffness = None, m.chi * m.eta
    for i in range(round(last_tb / STEP) + 1):
        r0, _, z, _ = m.slip_start(max(i * STEP, 1e-9))
        row = []
        for _ in range(round(LAST / STEP) + 1):
            row.append((z[2] - m.v, (z[1] - z[0]) ** 2 - r0 * r0 + (z[3] - m.v) ** 2 / stiffness))
            z = tuple(dot(line, z) for line in flow.powers[0])
        for k in range(len(row) - 1 if before else 0):
            corners = row[k], row[k + 1], before[k], before[k + 1]
            if not apart([c[0] for c in corners]) and not apart([c[1] for c in corners]):
                yield (i - 0.5) * STEP, (k + 0.5) * STEP
        before = row


for name, *numbers, last in SETS:
    model, zeros, rows = Model(*map(float, numbers)), [], []
    step = Flow(model.flow["H"].k, STEP)
    for cell in cells(model, step, last):
        zero = newton(model, step, cell)
        if zero and all(abs(zero[0] - z[0]) + abs(zero[1] - z[1]) > 1e-5 for z in zeros):
            zeros.append(zero)
    for tb, tc in zeros:
        rows += [(tc, td, ta, tb) for td, ta in ends(model, step, tb, tc)]
    print("set", name, *numbers, sep="\t")
    for tc, td, ta, tb in sorted(rows):
        print("solution", *("%.6f" % t for t in (ta, tb, tc, td)), sep="\t")
