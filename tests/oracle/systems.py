"""systems.py PROGRAM SCENE [SCENE...]: every orbit that `PROGRAM orbit SCENE --json` gives of a system file, recomputed.

It reads the system file itself and knows nothing of the program but its JSON: from the equations of motion
m x'' = u - K x - C x' + loads, and the rebounds from obstacles, it carries each state through its phase in 40 digits (matrix
exponential by mpmath) and holds the next state against it; looks at the event and at the law at 60 times of each phase; and makes
the multipliers from central differences of the first return.  Prints what it found; status 1 where something disagrees.
"""
import json
import math
import re
import subprocess
import sys
from fractions import Fraction

import mpmath as mp

mp.mp.dps = 40
CLOSE = mp.mpf(10) ** -25


def value(text, names):
    """A constant expression: numbers, names, + - * / ^ and parentheses, exactly."""
    text = re.sub(r"\d+\.?\d*(?:[eE][-+]?\d+)?", lambda m: f'Fraction("{m.group()}")', text)
    return eval(text.replace("^", "**"), {"Fraction": Fraction, **names})


def read(path):
    """Masses, the matrices K and C, the loads and the obstacles."""
    names, masses, links, loads, stops, here = {}, {}, [], [], [], None
    for line in open(path, encoding="utf-8"):
        line = line.split("#")[0].rstrip()
        if not line.strip():
            continue
        if line[0] != " ":
            head = line.split()
            here = None
            if "=" in line:
                name, text = line.split("=", 1)
                names[name.strip()] = value(text, names)
            elif not line.startswith("title:"):
                here = {"kind": head[0]}
                if head[0] == "mass":
                    masses[head[1]] = here
                else:
                    {"load": loads, "obstacle": stops}.get(head[0], links).append(here)
            continue
        key, text = line.strip().split(":", 1)
        here[key] = text.strip() if key in ("between", "on", "stops") else value(text, names)
    order = list(masses)
    n = len(order)
    k, c = ([[Fraction(0)] * n for _ in range(n)] for _ in range(2))
    for link in links:
        matrix = k if link["kind"] == "spring" else c
        size = link["stiffness" if link["kind"] == "spring" else "constant"]
        ends = [order.index(e) if e != "ground" else None for e in re.split(r"[, ]+", link["between"])]
        for i in ends:
            for j in ends:
                if i is not None and j is not None:
                    matrix[i][j] += size if i == j else -size
    for load in loads:
        load["on"] = order.index(load["on"])
    for stop in stops:
        stop["stops"] = order.index(stop["stops"])
    return [masses[name] for name in order], k, c, loads, stops


def base_of(loads):
    """The largest number of which the frequencies are whole multiples."""
    over = math.lcm(*(Fraction(l["frequency"]).denominator for l in loads))
    return Fraction(math.gcd(*(int(l["frequency"] * over) for l in loads)), over)


def mpf(q):
    return mp.mpf(q.numerator) / q.denominator if isinstance(q, Fraction) else mp.mpf(q)


class System:
    def __init__(self, path):
        self.mass, self.k, self.c, self.loads, self.stops = read(path)
        self.n = len(self.mass)
        self.omega = mpf(base_of(self.loads)) if self.loads else None
        self.states = 2 * self.n + 2 * len(self.loads)  # each load has a cosine and a sine of its own

    def places(self):
        """The loads, each with the place of its cosine in the state."""
        return [(l, 2 * self.n + 2 * i) for i, l in enumerate(self.loads)]

    def force(self, y, i):
        n = self.n
        pull = sum((mpf(l.get("cosine", 0)) * y[at] + mpf(l.get("sine", 0)) * y[at + 1]
                    for l, at in self.places() if l["on"] == i), mp.mpf(0))
        return sum(mpf(self.k[i][j]) * y[j] + mpf(self.c[i][j]) * y[n + j] for j in range(n)) - pull

    def rate(self, phase):
        n = self.n
        a = mp.zeros(self.states + 1)
        for l, at in self.places():
            a[at, at + 1], a[at + 1, at] = -mpf(l["frequency"]), mpf(l["frequency"])
        for i, m in enumerate(self.mass):
            a[i, n + i] = 1
            if phase[i] in "sab":
                continue
            for j in range(n):
                a[n + i, j] = -mpf(self.k[i][j]) / mpf(m["inertia"])
                a[n + i, n + j] = -mpf(self.c[i][j]) / mpf(m["inertia"])
            for l, at in self.places():
                if l["on"] == i:
                    a[n + i, at] = mpf(l.get("cosine", 0)) / mpf(m["inertia"])
                    a[n + i, at + 1] = mpf(l.get("sine", 0)) / mpf(m["inertia"])
            u = {"-": 1, "+": -1, ".": 0}[phase[i]]
            a[n + i, self.states] = u * mpf(m.get("sliding", 0)) / mpf(m["inertia"])
        return a

    def carry(self, phase, y, t):
        return self.carried(mp.expm(self.rate(phase) * t), y)

    def carried(self, by, y):
        out = by * mp.matrix(list(y) + [1])
        return [out[i] for i in range(self.states)]

    def hit(self, after):
        """The obstacle that a phase begins with a rebound from."""
        if not after[self.n:]:
            return None
        side = {"<": "below", ">": "above"}[after[self.n]]
        (stop,) = [s for s in self.stops if s["stops"] == int(after[self.n + 1:]) - 1 and side in s]
        return stop

    def rest(self, i, mode):
        """The obstacle at which a mass rests in the mode a (above it) or b."""
        (stop,) = [s for s in self.stops if s["stops"] == i and ("above" if mode == "a" else "below") in s]
        return stop

    def contact(self, y, i):
        """The force on a mass at rest at an obstacle, without that of the obstacle."""
        m = self.mass[i]
        return mp.sign(mpf(m.get("surface", 0))) * mpf(m.get("sliding", 0)) - self.force(y, i)

    def event(self, phase, after, y):
        """What is zero where the first phase gives way to the second, its mass, and of what it is a function."""
        stop = self.hit(after)
        if stop:
            return y[stop["stops"]] - mpf(stop.get("above", stop.get("below"))), stop["stops"], "position"
        (i,) = [i for i in range(self.n) if phase[i] != after[i]]
        m = self.mass[i]
        if after[i] in "ab":
            stop = self.rest(i, after[i])
            return y[i] - mpf(stop.get("above", stop.get("below"))), i, "position"
        if phase[i] in "ab":
            return -self.contact(y, i), i, "force"
        if phase[i] != "s":
            return y[self.n + i] - mpf(m["surface"]), i, "velocity"
        return self.force(y, i) - (1 if after[i] == "-" else -1) * mpf(m["static"]), i, "force"

    def broken(self, phase, y, slack):
        """The masses that do not do what the phase says."""
        out = []
        for i, m in enumerate(self.mass):
            if phase[i] == ".":
                continue
            if phase[i] in "ab":
                stop, push = self.rest(i, phase[i]), self.contact(y, i) * (1 if phase[i] == "a" else -1)
                place = mpf(stop.get("above", stop.get("below")))
                if push < -slack or abs(y[i] - place) > slack or abs(y[self.n + i]) > slack:
                    out.append(i)
                continue
            lead = y[self.n + i] - mpf(m["surface"])
            ok = (abs(self.force(y, i)) < mpf(m["static"]) + slack if phase[i] == "s"
                  else lead < slack if phase[i] == "-" else lead > -slack)
            if not ok:
                out.append(i)
        for stop in self.stops:
            x = y[stop["stops"]]
            if x > mpf(stop.get("above", mp.inf)) + slack or x < mpf(stop.get("below", -mp.inf)) - slack:
                out.append(stop["stops"])
        return out

    def to_event(self, phase, after, y, t):
        a = self.rate(phase)
        for _ in range(30):
            y = self.carry(phase, y, t)
            dy = self.carried(a, y)
            f, i, of = self.event(phase, after, y)
            slope = {"position": dy[i], "velocity": dy[self.n + i], "force": self.force(dy, i)}[of]
            t = -f / slope  # from here
            if abs(t) < mp.mpf(10) ** -38:
                break
        return y

    def switched(self, phase, after, y):
        """The state behind an event at which the state is y."""
        y, stop = list(y), self.hit(after)
        if stop:
            y[self.n + stop["stops"]] *= -mpf(stop["restitution"])
        else:
            (i,) = [i for i in range(self.n) if phase[i] != after[i]]
            rests = phase[i] in "ab" or after[i] in "ab"
            y[self.n + i] = 0 if rests else mpf(self.mass[i]["surface"])
        return y

    def first_return(self, word, times, y):
        for k, phase in enumerate(word):
            after = word[(k + 1) % len(word)]
            y = self.to_event(phase, after, y, times[k])
            y = self.switched(phase, after, y)
        return y

    def free(self, word):
        """Coordinates of the start that can be varied (2n: the loads' angle), and the one that follows from the others, if any."""
        before, now, n = word[-1], word[0], self.n
        stop = self.hit(now)
        if stop:
            i = stop["stops"]
            return ([j for j in range(n) if j != i] + [n + j for j in range(n) if now[j] != "s"] + [2 * n] * bool(self.loads),
                    None, 0)
        (i,) = [i for i in range(n) if before[i] != now[i]]
        loose = i if before[i] == "s" and now[i] != "a" and now[i] != "b" else None
        at_rest = [j for j in range(n) if now[j] in "ab" or (j == i and before[j] in "ab")]
        return ([j for j in range(n) if j != loose and j not in at_rest]
                + [n + j for j in range(n) if j != i and now[j] not in "sab"]
                + [2 * n] * bool(self.loads), loose, 1 if now[i] == "-" else -1)

    def angle(self, theta):
        return [f(theta * mpf(l["frequency"]) / self.omega) for l in self.loads for f in (mp.cos, mp.sin)]

    def apart(self, a, b):
        """The angle between two states that are close, by the first load."""
        c, s = 2 * self.n, 2 * self.n + 1
        return mp.asin(a[s] * b[c] - a[c] * b[s]) * self.omega / mpf(self.loads[0]["frequency"])

    def multipliers(self, word, times, y, angle):
        free, loose, side = self.free(word)
        if not free:
            return []
        h = mp.mpf(10) ** -12
        columns = []
        for l in free:
            ends = []
            for sign in (1, -1):
                z = list(y)
                if l == 2 * self.n:
                    z[l:] = self.angle(angle + sign * h)
                else:
                    z[l] += sign * h
                if loose is not None:  # its force stays at the limit
                    z[loose] -= (self.force(z, loose) - side * mpf(self.mass[loose]["static"])) / mpf(self.k[loose][loose])
                ends.append(self.first_return(word, times, z))
            columns.append([(self.apart(*ends) if r == 2 * self.n else ends[0][r] - ends[1][r]) / (2 * h) for r in free])
        if len(free) == 1:
            return [columns[0][0]]
        return list(mp.eig(mp.matrix(columns).T, left=False, right=False))


def check(system, orbit):
    word, times = orbit["word"], [mp.mpf(t) for t in orbit["times"]]
    states = [[mp.mpf(x) for x in s] for s in orbit["states"]]
    out, angle = [], None
    if system.loads:
        angle = mp.mpf(orbit["load_angle"])
        for k, s in enumerate(states):
            s += system.angle(angle + system.omega * sum(times[:k]))
        turns = system.omega * sum(times) / (2 * mp.pi)
        if abs(turns - orbit["load_turns"]) > CLOSE:
            out.append(f"{mp.nstr(turns, 20)} turns of the loads, not {orbit['load_turns']}")
    broken = False
    for k, phase in enumerate(word):
        after, then = word[(k + 1) % len(word)], states[(k + 1) % len(word)]
        end = system.carry(phase, states[k], times[k])
        off = max(abs(a - b) for a, b in zip(system.switched(phase, after, end), then))
        f, _, _ = system.event(phase, after, end)
        if off > CLOSE or abs(f) > CLOSE:
            out.append(f"phase {k + 1}: ends {mp.nstr(off, 3)} beside the next state, event {mp.nstr(f, 3)}")
        if times[k] > 0:
            step, y = mp.expm(system.rate(phase) * times[k] / 60), states[k]
            for _ in range(61):
                broken |= bool(system.broken(phase, y, mp.mpf(10) ** -20))
                y = system.carried(step, y)
        else:
            broken = True
    if orbit["admissible"] and broken:
        out.append("called admissible, and the law is broken")
    if orbit["admissible"] is False and not broken:
        print("  (not admissible between the times looked at)")
    if orbit["multipliers"] is not None:
        mine = system.multipliers(word, times, states[0], angle)
        for m in orbit["multipliers"]:
            z = mp.mpc(m["re"], m["im"])
            near = min(mine, key=lambda x: abs(x - z))
            if abs(near - z) > mp.mpf(10) ** -9 * (1 + abs(z)):
                out.append(f"multiplier {mp.nstr(z, 12)}: differences give {mp.nstr(near, 12)}")
            mine.remove(near)
        inside = all(abs(mp.mpc(m["re"], m["im"])) < 1 for m in orbit["multipliers"])
        if orbit["stable"] is not None and orbit["stable"] is not inside:
            out.append("stable is not what the multipliers say")
    return out


def main():
    program, scenes, wrong = sys.argv[1], sys.argv[2:], 0
    for scene in scenes:
        said = subprocess.run([program, "orbit", scene, "--digits", "35", "--json"], capture_output=True, text=True, check=True)
        orbits = json.loads(said.stdout)["orbits"]
        print(f"{scene}: {len(orbits)} orbits")
        for i, orbit in enumerate(orbits):
            name = orbit["system"]
            path = name if "/" in name else f"verify/systems/{name}.system"
            for line in check(System(path), orbit):
                print(f"  orbit {i + 1}: {line}")
                wrong += 1
        if not orbits:
            wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
