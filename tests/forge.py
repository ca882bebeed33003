"""No false certificate is verified: python3 tests/forge.py [--every N] PROGRAM SCENE...

Makes forgeries of the certificate that `PROGRAM orbit SCENE --certificate` writes: every value moved, by its radius, by a unit
of its last place, by much; swapped, twice, gone, of another type; lists shortened; other parameters, words and verdicts.  Each
goes to PROGRAM-checker; N: every other truth, phase and condition, and one in N of the rest.  One that is verified must still be
true, which is found here from the values alone, however they came about: each ball holds the number that the program, which
shares no source with the checker, encloses to 60 digits; where a parameter was changed the program is asked the question with
that parameter.  Of a box that reaches out of the original one it is shown that its orbit is inside, not that there is only one.
"""
import argparse
import copy
import json
import os
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

BALL = re.compile(r"-?[0-9a-f]+ -?[0-9a-f]+ [0-9a-f]+ -?[0-9a-f]+")
RATIONAL = re.compile(r"-?[0-9]+(/[0-9]+)?")
TIMES = "t_a", "t_b", "t_c", "t_d"


class Members(list):
    """An object as its [name, value] pairs, in which a name can stand twice."""

    def get(self, name):
        return next((v for k, v in self if k == name), None)


def read(text):
    return json.loads(text, object_pairs_hook=lambda pairs: Members([list(p) for p in pairs]))


def write(v):
    if isinstance(v, Members):
        return "{%s}" % ", ".join("%s: %s" % (json.dumps(k), write(x)) for k, x in v)
    return "[%s]" % ", ".join(map(write, v)) if isinstance(v, list) else json.dumps(v)


# --- Numbers ---

def ball(text):
    """(mantissa, exponent, radius) of the midpoint, exactly."""
    m, e, r, f = (int(x, 16) for x in text.split())
    return m, e, r * Fraction(2) ** f


def dump(middle, radius):
    """The ball; the radius is rounded up to 30 bits."""
    bits = 400
    e = 30 - bits if radius == 0 else (radius.numerator.bit_length() - radius.denominator.bit_length()) - 29
    return "%x %x %x %x" % (int(middle * 2 ** bits), -bits, -int(-radius / Fraction(2) ** e), e)


def bounds(text):
    m, e, r = ball(text)
    return m * Fraction(2) ** e - r, m * Fraction(2) ** e + r


def inside(a, b):
    """Whether the ball a lies in the ball b."""
    (a, c), (b, d) = bounds(a), bounds(b)
    return b <= a and c <= d


def other_balls(text):
    m, e, r = ball(text)
    unit = Fraction(2) ** e
    x, step = m * unit, r or Fraction(1)
    for move in (step, -step, 4 * step, -4 * step, unit, -unit, Fraction(1), x, -2 * x):
        yield dump(x + move, r)
    yield from (dump(x, r * 16), dump(x + r / 2, r / 2), dump(x - r / 2, r / 2), dump(x, Fraction(0)))
    yield from (True, False, "", "nan", text + " 0", str(float(x)))


def other_rationals(text):
    q = Fraction(text)
    yield from (str(x) for x in (q + 1, q + Fraction(1, 10 ** 12), 2 * q, 3 * q, q / 2, -q, Fraction(0)) if x != q)
    yield from (True, False, "", "nan", "1/0", text + "/", "%g" % q + "e0")


# --- Forgeries: (what was done, the whole), made in place and undone ---

def other_values(v):
    if isinstance(v, bool):
        yield from (not v, "true", "false", "yes", "tfalse", "", "1 -1 0 0")
    elif BALL.fullmatch(v):
        yield from other_balls(v)
    elif RATIONAL.fullmatch(v):
        yield from other_rationals(v)
    else:
        yield from (v[:i] + c + v[i + 1:] for i in range(len(v)) for c in "s-+.x>1yn" if v[i] != c)
        yield from (True, v + "1", "")


def places(v):
    """Every list of values with the index of one: the pair of a name and its value, or a list's place."""
    if isinstance(v, list):
        for i, x in enumerate(v):
            yield (x, 1) if isinstance(v, Members) else (v, i)
            yield from places(x[1] if isinstance(v, Members) else x)


def other_lists(v):
    """Lists and objects with something gone, twice, swapped, or in two parts that have one name."""
    for i, x in enumerate(v):
        yield "gone", v[:i] + v[i + 1:]
        yield "twice", v[:i + 1] + [x] + v[i + 1:]
        if isinstance(v, Members) and isinstance(x[1], list):
            for part in ([], x[1][:1], x[1][1:]):
                yield "twice, parted", v[:i] + [[x[0], type(x[1])(part)]] + v[i:]
        if i > 0 and isinstance(v, Members):
            yield "swapped", v[:i - 1] + [[v[i - 1][0], x[1]], [x[0], v[i - 1][1]]] + v[i + 1:]
        elif i > 0:
            yield "swapped", v[:i - 1] + [x, v[i - 1]] + v[i + 1:]
    yield "emptied", []
    if isinstance(v, Members):
        yield from (("more", v + [["complete", x]]) for x in (True, [], Members(), "1"))


def kind(old, new):
    form = next((f for f in (BALL, RATIONAL) if isinstance(old, str) and f.fullmatch(old)), None)
    if form:
        return "number" if isinstance(new, str) and form.fullmatch(new) and new != "1/0" else "other"
    letters = isinstance(old, str) and isinstance(new, str) and any(set(old + new) <= set(x) for x in ("s-+", "yn"))
    return "verdict" if letters and len(old) == len(new) or isinstance(old, bool) and isinstance(new, bool) else "other"


def forgeries(whole):
    root = [whole]
    for holder, i in [(root, 0)] + list(places(whole)):
        kept = holder[i]
        if isinstance(kept, list):
            others = ((what, type(kept)(x)) for what, x in other_lists(kept))
        else:
            others = ((kind(kept, x), x) for x in other_values(kept))
        for what, x in others:
            holder[i] = x
            yield what, root[0]
        holder[i] = kept


# --- What is true ---

def leaves(v, path=()):
    if isinstance(v, list):
        for i, x in enumerate(v):
            yield from leaves(x[1], path + (x[0],)) if isinstance(v, Members) else leaves(x, path + (i,))
    else:
        yield path, v


def in_order(v):
    """The certificate with springs, dampers, loads and multipliers, which may stand in any order, in one; without masses' names."""
    if not isinstance(v, Members):
        return type(v)(map(in_order, v)) if isinstance(v, list) else v
    v = Members([k, sorted(x) if k == "between" and isinstance(x, list) else in_order(x)] for k, x in v
                if not (x == [] and k in ("springs", "dampers", "loads") or k == "name" and isinstance(x, str)))
    for pair in v:
        if pair[0] in ("springs", "dampers", "loads"):
            pair[1] = type(pair[1])(sorted(pair[1], key=str))
        if pair[0] == "multipliers":
            pair[1] = type(pair[1])(sorted(pair[1], key=lambda z: [round(float(sum(bounds(x))), 6) for _, x in z]))
    return v


def shape(v):
    """The certificate without its numbers and its free texts; a name that stands twice or out of its place shows."""
    if isinstance(v, Members):
        return {"names": sorted(k for k, _ in v), **{k: shape(x) for k, x in v if k != "scene"}}
    if isinstance(v, list):
        return [shape(x) for x in v]
    return "ball" if isinstance(v, str) and BALL.fullmatch(v) else v


class Question:
    """A scene, the program that answers it, and what it answers."""

    def __init__(self, program, scene, folder):
        self.program, self.scene, self.folder = program, scene, folder
        self.original = in_order(read(self.certificate(15, scene)))
        self.answers = {}

    def certificate(self, digits, *scene):
        path = os.path.join(self.folder, "answer.json")
        r = subprocess.run([self.program, "orbit", *scene, "--digits", str(digits), "--certificate", path],
                           capture_output=True, text=True)
        if r.returncode != 0:
            return "{}"
        with open(path, encoding="utf-8") as f:
            return f.read()

    def changed_system(self, asked):
        """A scene of the system file, next to it, with the masses' numbers as the forgery has them."""
        with open(os.path.join("verify/scenes", self.scene + ".scene"), encoding="utf-8") as f:
            scene = f.read()
        name = re.search(r"^system: *(\S+)", scene, re.M).group(1)
        with open(os.path.join("verify/systems", name + ".system"), encoding="utf-8") as f:
            parts = re.split(r"(?m)^(?=mass )", f.read())
        for i, mass in enumerate(asked.get("masses")):
            for k in ("inertia", "sliding", "static", "surface"):
                parts[i + 1] = re.sub(r"(?m)^( +%s: ).*$" % k, lambda m: m.group(1) + str(mass.get(k)), parts[i + 1])
        system = os.path.join(self.folder, "asked.system")
        with open(system, "w", encoding="utf-8") as f:
            f.write("".join(parts))
        word = " ".join(self.original.get("orbits")[0].get("word"))
        with open(os.path.join(self.folder, "asked.scene"), "w", encoding="utf-8") as f:
            f.write("title: asked\nsystem: %s\nword: %s\n" % (system, word))
        return [f.name]

    def still_moves_so(self, asked):
        """Where static limits or surfaces alone are others: has the motion from the orbit's start, integrated with them, its events?"""
        masses = copy.deepcopy(asked.get("masses"))
        for mass, other in zip(masses, self.original.get("system").get("masses")):
            for pair in mass:
                pair[1] = other.get(pair[0]) if pair[0] in ("static", "surface") else pair[1]
        if write(masses) != write(self.original.get("system").get("masses")):
            return False
        orbit, time = self.original.get("orbits")[0], 0.0
        times, start = ([float(sum(bounds(x)) / 2) for x in orbit.get("enclosures").get(k)] for k in ("times", "start"))
        r = subprocess.run([self.program, "simulate", *self.changed_system(asked), "--start", ",".join(map(str, start)), "--time",
                            str(1.001 * sum(times)), "--json"], capture_output=True, text=True)
        events = [e for e in json.loads(r.stdout or "{}").get("events", []) if float(e["t"]) > 1e-9]  # not that of the start
        for length, event, phase in zip(times, events, orbit.get("word")[1:] + orbit.get("word")[:1]):
            time += length
            if event["phase"] != phase or abs(float(event["t"]) - time) > 1e-9:
                return False
        return len(events) == len(times)

    def asked(self, whole):
        """To 60 digits, what the program answers to the question of a certificate; it may find the orbit from another phase on."""
        given = whole.get("system")
        key = write(question(whole))
        if key not in self.answers:
            same = key == write(question(self.original))
            if same:
                scene = [self.scene]
            elif is_left_open(self.original):
                scene = [self.scene] + two_masses(whole)
            else:
                scene = self.changed_system(given)
            self.answers[key] = [read(self.certificate(60, *scene))]
            if not same and not is_left_open(self.original) and self.still_moves_so(given):
                moved = read(self.certificate(60, self.scene))
                next(pair for pair in moved if pair[0] == "system")[1] = given
                self.answers[key].append(moved)
        return self.answers[key]

    def holds(self, claim, truth):
        """Whether an orbit's entry is true of an orbit."""
        start = "start" if is_left_open(self.original) else "free"  # what is free at another start is in the box alone
        claim, truth = dict(leaves(claim)), dict(leaves(truth))
        if any(k not in truth for k in claim):
            return False
        for k, v in claim.items():
            if isinstance(v, str) and BALL.fullmatch(v):
                enclosed = ("enclosures", start if k[1] == "free" else k[1]) + k[2:]
                good = inside(truth[enclosed if k[0] == "box" and enclosed in truth else k], v)
            else:
                good = v == truth[k]
            if not good:
                return False
        return True

    def is_true(self, whole):
        if names_differ(whole, self.original):
            return False
        whole = in_order(whole)
        return any(self.is_answered(whole, in_order(answer)) for answer in self.asked(whole))

    def is_answered(self, whole, answer):
        if "orbits" not in dict(answer) or shape_without_orbits(whole) != shape_without_orbits(answer):
            return False
        left = list(answer.get("orbits"))
        for claim in whole.get("orbits"):
            of = next((t for t in left if shape(claim) == shape(t)
                       and self.holds(claim, t)), None)
            if of is None:
                return False
            left.remove(of)
        return len(left) < len(answer.get("orbits"))


def question(whole):
    """The system, and what each orbit is asked with."""
    rationals = [v for k, v in leaves(whole.get("orbits")) if k[1] == "box" and RATIONAL.fullmatch(str(v))]
    return [whole.get("system"), rationals]


def is_left_open(whole):
    """Whether sliding friction is: the paper's two masses."""
    return "sliding" not in dict(whole.get("system").get("masses")[0])


def two_masses(whole):
    """Their parameters; none that the program takes where they are not the paper's."""
    masses, springs = (whole.get("system").get(k) for k in ("masses", "springs"))
    boxes = [dict(orbit.get("box")) for orbit in whole.get("orbits")]
    chi = next((Fraction(s.get("stiffness")) for s in springs if sorted(s.get("between")) == ["1", "2"]), Fraction(0))
    ground = next((Fraction(s.get("stiffness")) for s in springs if sorted(s.get("between")) == ["0", "1"]), Fraction(0))
    if chi + ground != 1 or masses[0].get("inertia") != "1" or len({m.get("surface") for m in masses}) > 1:
        return ["--set", "chi=-1"]
    given = {"chi": chi, "eta": 1 / Fraction(masses[1].get("inertia")), "V": masses[0].get("surface")}
    given.update(("u_r%d" % (i + 1), m.get("static") or "") for i, m in enumerate(masses))
    for names, values in (TIMES, "times"), (("e1", "e2"), "excess"):
        for name, value in zip(names, boxes[0][values]):
            given[name] = value if RATIONAL.fullmatch(value) else ""
    return [x for k, v in given.items() for x in ("--set", "%s=%s" % (k, v))]


def names_differ(whole, original):
    """A name twice somewhere, or other names than those of a certificate of this kind."""
    return twice(whole) or not {k for k, _ in whole} <= {k for k, _ in original}


def twice(v):
    names = [k for k, _ in v] if isinstance(v, Members) else []
    parts = [x for _, x in v] if isinstance(v, Members) else v if isinstance(v, list) else []
    return len(names) != len(set(names)) or any(map(twice, parts))


def shape_without_orbits(whole):
    return {**shape(whole), "orbits": None}


def checked(program, what, text, folder):
    path = os.path.join(folder, "forged.json")
    with open(path, "w", encoding="utf-8") as f:
        f.write(text)
    r = subprocess.run([program + "-checker", path], capture_output=True, text=True, timeout=60)
    if r.returncode not in ((0, 1) if what == "number" else (0, 1, 3)):
        sys.exit("status %d: %s\n%s" % (r.returncode, r.stderr, text))
    return r.returncode == 0


def attack(program, scene, every, folder):
    q = Question(program, scene, folder)
    original = write(q.original)
    if not checked(program, "number", original, folder) or not q.is_true(q.original):
        sys.exit(scene + ": its own certificate is not verified, or not true to 60 digits")
    tried = verified = true = 0
    for n, (what, whole) in enumerate(forgeries(copy.deepcopy(q.original))):
        if n % every and what != "verdict":
            continue
        text = write(whole)
        if text == original:
            continue
        tried += 1
        if checked(program, what, text, folder):
            verified += 1
            if not q.is_true(whole):
                sys.exit("%s: verified, and not shown to be true (%s):\n%s" % (scene, what, text))
    print("%s: %d forgeries, %d rejected, %d verified and still true" % (scene, tried, tried - verified, verified), flush=True)
    return verified


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--every", type=int, default=1)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        sys.exit(sum(attack(args.program, s, args.every, folder) for s in args.scenes) == 0)


main()
