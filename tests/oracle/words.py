#!/usr/bin/env python3
"""Orbits of words other than D-Gamma-H-C, straight from the equations of motion (1) and Coulomb's law (2), in mpmath.

    tests/oracle/words.py > tests/oracle/words.tsv        about half a minute

Each phase is the exponential of a 5x5 matrix on (x1, x2, v1, v2, 1): no frequencies, no shifted coordinates, nothing of
the program.  Unknowns are the lengths of the phases and the whole state at the first one's entry, equations the events
and the return; the multipliers are those of the return map in the coordinates x1, x2, v1, v2 that are free there, by central
differences at 60 digits with every event solved anew.  A line: name, word, chi, eta, V, e1, e2, u_r1, u_r2 (0: any), lengths,
multipliers (re, im by increasing real part, then imaginary part; moduli below 1e-25 left out), x1, x2, v1, v2 at the entry of the
first phase, without sliding friction where u_r is any.

The last line is solution II: Gamma-H-C, where m2 comes to stick at the moment at which m1 breaks loose (t_a = 0), e2 given
and e1 unknown; its place of e1 holds the solution.
"""
import sys

from mpmath import mp, mpf, matrix, expm, findroot, eig, lu_solve

mp.dps = 60
STICK, SLOWER, FASTER = 0, 1, -1  # the friction is +u_s or -u_s
PHASE = {"D": (0, 0), "Gamma": (1, 0), "H": (1, 1), "C": (0, 1), "gamma": (-1, 0), "h": (-1, -1), "c": (0, -1),
         "X": (1, -1), "x": (-1, 1)}


class Model:
    def __init__(self, chi, eta, V, e, u_r):
        self.chi, self.eta, self.V, self.u_r = chi, eta, V, u_r
        self.u_s = [u_r[i] - e[i] for i in range(2)]

    def forces(self, s):
        return s[0] - self.chi * s[1], self.chi * (s[1] - s[0])

    def system(self, mode):
        a = matrix(5, 5)
        for i in range(2):
            if mode[i] == STICK:
                a[i, 4] = self.V
            else:
                a[i, 2 + i] = 1
                k = 1 if i == 0 else self.eta
                row = (1, -self.chi) if i == 0 else (-self.chi, self.chi)
                a[2 + i, 0], a[2 + i, 1], a[2 + i, 4] = -k * row[0], -k * row[1], k * mode[i] * self.u_s[i]
        return a

    def flow(self, mode, state, t):
        s = matrix([*state, 1])
        for i in range(2):
            if mode[i] == STICK:
                s[2 + i] = self.V
        s = expm(self.system(mode) * t, method="taylor") * s
        return [s[i] for i in range(4)]

    def event(self, mode, after, state):
        i = 0 if mode[0] != after[0] else 1
        if mode[i] == STICK:
            return self.forces(state)[i] - (self.u_r[i] if after[i] == SLOWER else -self.u_r[i])
        return state[2 + i] - self.V


def run(model, word, times, state, events=None):
    for k, mode in enumerate(word):
        state = model.flow(mode, state, times[k])
        if events is not None:
            events.append(model.event(mode, word[(k + 1) % len(word)], state))
    for i in range(2):
        if word[0][i] == STICK:
            state[2 + i] = model.V
    return state


def residual(make, word, x, n_extra):
    n = len(word)
    model = make(x[n + 4:])
    events, start = [], list(x[n:n + 4])
    end = run(model, word, x[:n], start, events)
    out = events + [end[0] - start[0], end[1] - start[1]]
    for i in range(2):
        out.append(start[2 + i] - model.V if word[0][i] == STICK else end[2 + i] - start[2 + i])
    if n_extra:  # both masses change at the end of the last phase: besides m1's force, m2's speed is at its limit
        for k in range(n):
            start = model.flow(word[k], start, x[k])
        out.append(start[3] - model.V)
    return out


def newton(f, x):
    """Newton's iteration with a forward difference Jacobian."""
    h = mpf(10) ** -30
    for _ in range(60):
        y = f(x)
        j = matrix(len(x), len(x))
        for k in range(len(x)):
            moved = list(x)
            moved[k] += h
            z = f(moved)
            for i in range(len(x)):
                j[i, k] = (z[i] - y[i]) / h
        step = lu_solve(j, matrix(y))
        x = [x[i] - step[i] for i in range(len(x))]
        if max(abs(s) for s in step) < mpf(10) ** -45:
            return x
    raise SystemExit("no convergence")


def multipliers(model, word, times, start):
    """Of the map from the entry of the first phase to the next one."""
    last, first = word[-1], word[0]
    i = 0 if last[0] != first[0] else 1
    # coordinates of the section: f1, f2, v1, v2 but for what sticks or is fixed by the event
    free = [k for k in range(4) if not (k >= 2 and (first[k - 2] == STICK or k - 2 == i)) and
            not (k == i and last[i] == STICK)]

    def state_of(c):
        f = list(model.forces(start))
        v = list(start[2:])
        for k, y in zip(free, c):
            if k < 2:
                f[k] = y
            else:
                v[k - 2] = y
        x1 = (f[0] + f[1]) / (1 - model.chi)
        return [x1, x1 + f[1] / model.chi, *v]

    def coordinates(s):
        all4 = [*model.forces(s), s[2], s[3]]
        return [all4[k] for k in free]

    def image(c):
        s = state_of(c)
        for k, mode in enumerate(word):
            after = word[(k + 1) % len(word)]
            t = findroot(lambda u: model.event(mode, after, model.flow(mode, s, u)), times[k], tol=mpf(10) ** -90)
            s = model.flow(mode, s, t)
            for m in range(2):
                if after[m] == STICK:
                    s[2 + m] = model.V
        return coordinates(s)

    c, h = coordinates(start), mpf(10) ** -18
    j = matrix(len(free), len(free))
    for k in range(len(free)):
        up, down = list(c), list(c)
        up[k] += h
        down[k] -= h
        a, b = image(up), image(down)
        for m in range(len(free)):
            j[m, k] = (a[m] - b[m]) / (2 * h)
    values = [j[0, 0]] if len(free) == 1 else list(eig(j, left=False, right=False))
    values = [mp.mpc(v) for v in values if abs(v) > mpf(10) ** -25]
    return sorted(values, key=lambda v: (round(float(v.real), 12), v.imag))


def q(text):
    return mpf(text) if "/" not in text else mpf(text.split("/")[0]) / mpf(text.split("/")[1])


CASES = [  # name, word, chi, eta, V, e1, e2, u_r1, u_r2, lengths to a few digits, and w1, w2, p1, p2 at the entry
    ("other-word", "Gamma H Gamma D", "0.8", "1", "1", "2.7844", "0.8587", "0", "0", (0.906, 10.144, 0.952, 27.676),
     (2.7844, -0.0144, 0, 0)),
    ("overrun", "Gamma H Gamma gamma", "0.8", "1", "1", "0.5", "0.4", "0.52", "0.42", (1.747, 14.292, 1.447, 2.572),
     (0.6429, -0.3265, 0, 0)),
    ("two-phases", "H C", "0.8", "1", "1", "0.5", "0.4", "0.52", "0.42", (4.249, 0.5758), (0.5, None, 0, None)),
    ("solution-ii", "Gamma H C", "0.8", "1", "1", None, "0.8587", "0", "0", (2.047, 1.457, 2.358), None),
]


def settle_start(model, word, times):
    """A start for H C: simulate the linear phases from a guess until the return is near."""
    best, least = None, None
    for k in range(60):
        for m in range(60):
            f2, v2 = model.u_s[1] - mpf(k) / 40, model.V - mpf(m) / 20
            f1 = model.u_r[0]
            x1 = (f1 + f2) / (1 - model.chi)
            s = [x1, x1 + f2 / model.chi, model.V, v2]
            e = run(model, word, times, s)
            d = sum(abs(e[i] - s[i]) for i in range(4))
            if least is None or d < least:
                best, least = s, d
    return best


def main():
    for name, text, chi, eta, V, e1, e2, u1, u2, times, entry in CASES:
        if len(sys.argv) > 1 and name not in sys.argv[1:]:
            continue
        word = [PHASE[p] for p in text.split()]
        chi, eta, V, e2 = q(chi), q(eta), q(V), q(e2)
        n_extra = 0 if e1 else 1
        given = q(u1) > 0

        def make(extra):
            first = q(e1) if e1 else extra[0]
            u_r = [q(u1), q(u2)] if given else [first, e2]
            return Model(chi, eta, V, [first, e2], u_r)

        x = [mpf(t) for t in times]
        model = make([mpf("2.536")])
        if entry and entry[1] is not None:
            f = [entry[0] + model.u_s[0], entry[1] + model.u_s[1]]
            x1 = (f[0] + f[1]) / (1 - chi)
            start = [x1, x1 + f[1] / chi, V + entry[2], V + entry[3]]
        elif entry:
            mp.dps = 15
            start = settle_start(model, word, x)
            mp.dps = 60
        else:  # m1 at its limit, m2 sticking: r = z20 - z10, roughly
            f = [model.u_r[0], model.u_s[1] + mpf("-2.286")]
            x1 = (f[0] + f[1]) / (1 - chi)
            start = [x1, x1 + f[1] / chi, V, V]
        x += start + ([mpf("2.536")] if n_extra else [])
        x = newton(lambda y: residual(make, word, y, n_extra), x)
        n = len(word)
        model = make(x[n + 4:])
        # solution II's return map is not smooth there: no multipliers
        values = [] if n_extra else multipliers(model, word, x[:n], x[n:n + 4])
        first = e1 or mp.nstr(x[n + 4], 32)
        print("\t".join([name, text.replace(" ", "-"), *(mp.nstr(v, 12) for v in (chi, eta, V)), first, mp.nstr(e2, 12), u1,
                         u2, " ".join(mp.nstr(t, 32) for t in x[:n]),
                         " ".join(f"{mp.nstr(v.real, 20)},{mp.nstr(v.imag, 20)}" for v in values) or "-",
                         " ".join(mp.nstr(y, 32) for y in x[n:n + 4])]), flush=True)


main()
