"""stickslip orbit against a program that shares the equations of motion with it and nothing else.

    python3 differ.py PROGRAM [--count N] [--random R] [--seed S] [--seconds T] [--done FILE] [--page FILE]

Draws N scenes, in turn from the classes below, and R more from the first.  The peer looks for the orbits itself in double precision (scan.py: Taylor series, two
searches), and solves the six equations near each orbit by mpmath with matrix exponentials by power series (orbits.py).  Held against each other:
how many orbits there are, each of the 40 digits that the program prints of each number, stability, admissibility with the
conditions that are broken, and the least static frictions.  An orbit that the peer's search has not found counts as one
where mpmath confirms it.  Where the search would take the peer too long, or a verdict is too close for double precision,
the rest is checked; the table says how often.  Status 1 where something differs.  What was found of each scene is appended
to the FILE of --done as soon as it is known, and a scene that stands there is not studied again, so that a long run can be ended at any
time; the file is for one build of the program.
"""
import argparse
import json
import math
import multiprocessing
import os
import random
import signal
import subprocess
import sys
import time
from fractions import Fraction

try:
    import mpmath
except ImportError:
    print("skipped: Python has no mpmath")
    sys.exit(0)
import orbits
import scan

DPS = 130
LONGEST = 12  # seconds of processor time for the peer's search
NAMES = ("chi", "eta", "V", "e1", "e2")
# parameters at a fold, a flip, a grazing event; from verify/scenes and tests/extreme
NEAR = {"fold": (("0.66", "0.93", "0.75", "0.647", "2.71"), ("0.8", "1", "1", "2.7844", "1.1121101100551")),
        "flip": (("0.8", "1", "1", "2.7844", "1.811058203021902"), ("0.7832116263051993", "2", "1", "4", "0.25")),
        "grazing": (("0.87", "0.32", "0.45", "0.242", "0.2734335049290934"), ("0.8", "1", "1", "2.7844", "1.3590793"))}


def rounded(x):
    return Fraction("%.4g" % x)


def about(rng, lo, hi):
    return rounded(math.exp(rng.uniform(math.log(lo), math.log(hi))))


def ordinary(rng):
    return [Fraction(rng.randint(50, 950), 1000), about(rng, 0.05, 20), about(rng, 0.5, 3), about(rng, 0.2, 6), about(rng, 0.05, 3)]


def near(what):
    def draw(rng, program):
        p = [Fraction(x) for x in rng.choice(NEAR[what])]
        p[rng.randrange(5)] *= 1 + rng.choice((-1, 1)) * rounded(10 ** -rng.uniform(3, 10))
        return p
    return draw


def stick_of_no_length(rng, program):
    p = [Fraction(rng.randint(760, 840), 1000), Fraction(1), Fraction(1), Fraction("2.7844"), Fraction(1)]
    t_a = rng.choice((-1, 1)) * rounded(10 ** -rng.uniform(2, 12))
    found = ask(program, {**dict(zip(NAMES, p)), "e2": "", "t_a": t_a})
    values = [o["e2"] for o in found["orbits"]] if found else []
    p[4] = Fraction(rng.choice(values)) if values else Fraction("0.3")
    return p


def changed(index, value):
    def draw(rng, program):
        p = ordinary(rng)
        p[index] = value(rng, p)
        return p
    return draw


def coincidence(rng, program):
    """The two frequencies of phase H are rational numbers in a simple ratio."""
    while True:
        w1 = Fraction(rng.randint(1, 19), 20)
        w2 = w1 * Fraction(rng.randint(2, 6), rng.randint(1, 3))
        stiff = w1 ** 2 + w2 ** 2 - 1
        if w2 > 1 and stiff > 0 and 0 < (1 - w1 ** 2) * (w2 ** 2 - 1) / stiff < 1:
            chi = (1 - w1 ** 2) * (w2 ** 2 - 1) / stiff
            return [chi, stiff / chi, Fraction(1)] + [Fraction(rng.randint(1, 30), 10) for _ in range(2)]


CLASSES = {
    "random": lambda rng, program: ordinary(rng),
    "near a fold": near("fold"), "near a flip": near("flip"), "near a grazing event": near("grazing"),
    "t_a near 0": stick_of_no_length,
    "chi to 0": changed(0, lambda rng, p: rounded(10 ** -rng.uniform(1, 9))),
    "chi to 1": changed(0, lambda rng, p: 1 - rounded(10 ** -rng.uniform(1, 9))),
    "eta from 1e-12 to 1e12": changed(1, lambda rng, p: rounded(10 ** rng.uniform(-12, 12))),
    "V from 1e-6 to 1e6": changed(2, lambda rng, p: rounded(10 ** rng.uniform(-6, 6))),
    "e2 above e1": changed(4, lambda rng, p: p[3] * about(rng, 1, 10)),
    "rational coincidences": coincidence,
}


def ask(program, values):
    sets = [x for k, v in values.items() for x in ("--set", "%s=%s" % (k, v))]
    r = subprocess.run([program, "orbit", "paper", *sets, "--json", "--digits", "40"], capture_output=True, text=True, timeout=300)
    return json.loads(r.stdout) if r.returncode == 0 else None


class TooLong(Exception):
    pass


def ring(*_):
    raise TooLong


def search(model):
    """What either search finds; None where that takes too long."""
    stiff = model.chi * model.eta
    if model.fastest > 40 or stiff < 1e-4 or scan.longest_gamma(model) > 300:
        return None
    signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    try:
        return scan.distinct(scan.by_return_map(model, 1500)[0] + scan.by_plane(model))
    except TooLong:
        return None
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def same(orbit, guess):
    return all(abs(float(orbit[k]) - g) < 1e-6 * (1 + abs(g)) for k, g in zip(("t_b", "t_c"), guess[3:5]))


def is_rounded(shown, x):
    """Whether a printed decimal is x, rounded to the digits shown."""
    mantissa, _, exponent = shown.lower().partition("e")
    unit = mpmath.mpf(10) ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(mpmath.mpf(shown) - x) <= unit * mpmath.mpf("0.5000001")


def confirm(params, model, o):
    """What differs between an orbit of the program and the solution by mpmath next to it; what the peer leaves open."""
    with mpmath.workdps(DPS):
        v = orbits.exact(params[2])
        system = orbits.System([params[0], params[1], Fraction(1), params[3] / params[2], params[4] / params[2]])
        shown = [mpmath.mpf(o[k]) / (v if k[0] == "z" else 1) for k in orbits.UNKNOWNS]
        x = list(system.solve(shown))
        j = system.return_jacobian(x, mpmath.mpf(10) ** -40)
        trace = j[0, 0] + j[1, 1]
        values = dict(zip(orbits.UNKNOWNS, [x[0] * v, x[1] * v] + x[2:]), period=sum(x[2:]), trace=trace)
        if sum(map(abs, x[2:])) * model.fastest > 200:  # t_a can be negative
            return [k for k in values if not is_rounded(o[k], values[k])], True
        off = ["stable"] if o["stable"] != (abs(trace) < 1) else []
        try:
            values["u_r1_min"], values["u_r2_min"] = (v * u for u in orbits.friction_bounds(system, model, x))
            # w at the end of C is e1 - (1 - chi) V t_a, whose sign counts where double precision takes it for zero
            broken = set(orbits.violations(model, x)) | ({"c_w"} if x[2] < 0 else set())
            off += ["conditions"] if sorted(broken) != sorted(o["violations"]) or o["admissible"] == bool(broken) else []
            undecided = False
        except ArithmeticError:
            undecided = True
        return off + [k for k in values if not is_rounded(o[k], values[k])], undecided


def study(task):
    """The class, its seed, what was found, a line about what differs, and how many orbits."""
    program, name, seed = task
    params = CLASSES[name](random.Random("%s %s" % (name, seed)), program)
    where = name + ": " + " ".join("%s=%s" % q for q in zip(NAMES, params))
    try:
        answer = ask(program, dict(zip(NAMES, params)))
    except subprocess.TimeoutExpired:
        return name, seed, ["no answer"], where + ": none in 300 s", 0
    if answer is None:
        return name, seed, ["no answer"], where + ": refused", 0
    model = scan.Model(*(float(q) for q in (params[0], params[1], 1, params[3] / params[2], params[4] / params[2])))
    found, facts, differ = search(model), set(), []
    for o in answer["orbits"]:
        try:
            off, undecided = confirm(params, model, o)
        except (ArithmeticError, ValueError) as e:
            off, undecided = ["the peer: %s" % str(e).split("\n")[0][:80]], False
        differ += ["t_c=%s: %s" % (o["t_c"], ", ".join(off))] if off else []
        facts |= {"verdict open"} if undecided else set()
        facts |= {"digits"}
    missed = [g for g in found or [] if not any(same(o, g) for o in answer["orbits"])]
    if missed and answer["complete"]:
        differ += ["missing: %r" % (g,) for g in missed]
    facts |= {"no search"} if found is None else set()
    facts |= {"incomplete"} if not answer["complete"] else set()
    facts |= {"missed"} if missed and not answer["complete"] else set()
    facts |= {"differs"} if differ else set() if "incomplete" in facts else {"held"}
    return name, seed, sorted(facts), where + ": " + "; ".join(differ) if differ else "", len(answer["orbits"])


COLUMNS = (("held", "held"), ("incomplete", "said to be incomplete"), ("missed", "of these: an orbit missed"), ("differs", "differences"),
           ("no answer", "no answer"), ("no search", "no search by the peer"), ("verdict open", "a verdict left open by the peer"))


def table(results):
    lines = ["| class | tried | orbits | " + " | ".join(t for _, t in COLUMNS) + " |", "| --- |" + " --- |" * (2 + len(COLUMNS))]
    for name in list(CLASSES) + ["all"]:
        own = [r for r in results if name in ("all", r[0])]
        counts = [len(own), sum(r[4] for r in own)] + [sum(k in r[2] for r in own) for k, _ in COLUMNS]
        lines.append("| %s | %s |" % (name, " | ".join(map(str, counts))))
    return "\n".join(lines)


PAGE = """# Orbits held against an independent program

`python3 tests/oracle/differ.py build/stickslip --count N --random R --seed S --page FILE` draws scenes from classes of ordinary and extreme
parameters and holds what `stickslip orbit` prints to 40 digits against a peer: two searches in double precision by Taylor
series, and solutions of the six equations by mpmath with matrix exponentials. The peer shares with the program the equations
of motion (1) and Coulomb's law (2), and the six equations that make a motion of this word periodic; no formula, no source, no number type.

- held: the program says that its list is complete, the peer finds no other orbit, and every digit, verdict and static friction agrees.
- said to be incomplete: the program's own words; the orbits that it prints are checked all the same.
- no search by the peer: it would take too long, so that only the orbits that the program prints are checked.
- a verdict left open by the peer: a condition is too close, or a phase too long, for its double precision; digits are checked.

Counts of %d scenes, seed %d:

%s
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=len(CLASSES))
    parser.add_argument("--random", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=math.inf)
    parser.add_argument("--done")
    parser.add_argument("--page")
    args = parser.parse_args()
    names = [list(CLASSES)[i % len(CLASSES)] for i in range(args.count)] + ["random"] * args.random
    tasks = [(args.program, name, "%d %d" % (args.seed, i)) for i, name in enumerate(names)]
    results, begin = [], time.time()
    if args.done and os.path.exists(args.done):
        with open(args.done, encoding="utf-8") as f:
            results = [r for r in map(json.loads, f) if (args.program, *r[:2]) in tasks]
    known = {tuple(r[:2]) for r in results}
    with multiprocessing.Pool() as pool:
        for r in pool.imap_unordered(study, [t for t in tasks if t[1:] not in known]):
            results.append(r)
            if args.done:
                with open(args.done, "a", encoding="utf-8") as f:
                    f.write(json.dumps(r) + "\n")
            if r[3]:
                print(r[3], flush=True)
            if time.time() - begin > args.seconds:
                pool.terminate()
                break
    print(table(results))
    if args.page:
        with open(args.page, "w", encoding="utf-8") as f:
            f.write(PAGE % (len(results), args.seed, table(results)))
    sys.exit(any("differs" in r[2] for r in results))


if __name__ == "__main__":
    main()
