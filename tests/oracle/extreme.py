"""No wrong digit is printed: python3 extreme.py PROGRAM SCENE...

Every number that orbit and jacobian print at 15 and at 40 digits, by every method, is held against the same number at 120
digits by implicit derivatives: it must be that number rounded to the digits shown, half a unit of the last one.  Each phase by
each method has the implicit method's numbers beside it, but for the paper's formulas as printed, which may be wrong, and what
the program itself marks as departing from the others.  A refusal (status 3) is an answer, except of orbit and implicit; fd-double
and ode, which refuse for what they know in double precision, are asked for 40 digits where they knew 15.  Where the search
for more orbits runs through its budget, which takes each command a second, a method is asked for 15 digits or for 40.  Without
STICKSLIP_TESTS=all in the environment it is so in every scene, every second method is asked on every second orbit, in turn from scene
to scene, and phases in every second scene; where the search is so dear one method on one orbit, and no phases.
"""
import json
import os
import subprocess
import sys
from decimal import Decimal, getcontext

getcontext().prec = 300
MANY = 120
ALL = os.environ.get("STICKSLIP_TESTS") == "all"


def run(program, *arguments):
    r = subprocess.run([program, *arguments, "--json"], capture_output=True, text=True, timeout=240)
    if r.returncode == 3:
        return None
    if r.returncode != 0:
        sys.exit("%s: status %d: %s" % (" ".join(arguments), r.returncode, r.stderr))
    return json.loads(r.stdout)


def holds(shown, more, where):
    x, y = Decimal(shown), Decimal(more)
    unit = Decimal(0) if shown == "0" else Decimal(1).scaleb(x.as_tuple().exponent)
    if abs(x - y) > unit * Decimal("0.5000001"):
        sys.exit("%s: %s is printed for %s" % (where, shown, more))


def numbers_of_orbits(o):
    names = "z10 z20 t_a t_b t_c t_d e1 e2 period trace u_r1_min u_r2_min".split()
    return [(k, i[k]) for i in o["orbits"] for k in names if i[k] is not None]


def numbers_of_jacobian(j):
    return [("J", x) for row in j["J"] for x in row] + [("trace", j["trace"])]


def compare(some, more, where):
    if len(some) != len(more):
        sys.exit("%s: %d numbers and %d" % (where, len(some), len(more)))
    for (name, x), (_, y) in zip(some, more):
        holds(x, y, where + " " + name)
    return len(some)


def check(program, scene, nth):
    n = 0
    orbits = run(program, "orbit", scene, "--digits", str(MANY))
    if not orbits or not orbits["orbits"]:
        sys.exit(scene + ": no orbit")
    dear = not ALL and not orbits["complete"]
    for digits in ((15, 40)[nth % 2],) if dear else (15, 40):
        some = run(program, "orbit", scene, "--digits", str(digits))
        n += compare(numbers_of_orbits(some), numbers_of_orbits(orbits), scene)
    many = len(orbits["orbits"])
    for k in range(many) if ALL else (nth % many,) if dear else range(nth % min(many, 2), many, 2):
        at = ["jacobian", scene, "--at", "orbit:%d" % (k + 1), "--method"]
        truth = run(program, *at, "implicit", "--digits", str(MANY))
        for i, method in enumerate(("implicit", "analytic", "saltation", "fd", "fd-double", "ode")):
            if not ALL and (i != 1 + nth % 5 if dear else i > 0 and (i + (k + nth) // 2) % 2):
                continue
            for digits in (15, 40) if ALL and orbits["complete"] else (15,) if (i // 2 + k // 2 + nth) % 2 else (40,):
                j = run(program, *at, method, "--digits", str(digits))
                if j:
                    n += compare(numbers_of_jacobian(j), numbers_of_jacobian(truth), scene + " " + method)
                elif method == "implicit":
                    sys.exit(scene + ": no Jacobian")
                elif method in ("fd-double", "ode"):
                    break
    return n + check_phases(program, scene) if ALL or nth % 2 and not dear else n


def check_phases(program, scene):
    """Entry by entry of each phase; one orbit, since the methods are the same for each: the usual one, which is found by a
    search of its own, or the first."""
    phases = run(program, "jacobian", scene, "--phases", "--digits", "40")
    n = 0
    for a in phases["phases"]:
        for x in a["entries"]:
            truth = x["values"]["implicit"]["value"]
            for method, v in x["values"].items():
                if method == "analytic-printed" or v["value"] is None:
                    continue
                where = "%s %s[%d,%d] %s" % (scene, a["name"], x["row"], x["col"], method)
                shown, off = Decimal(v["value"]), Decimal(v["accuracy"])
                if shown == 0 and abs(Decimal(truth)) > 2 * off:
                    sys.exit("%s: 0 is printed for %s" % (where, truth))
                if shown != 0:
                    holds(v["value"], truth, where)
                n += 1
    return n


n = sum(check(sys.argv[1], scene, i) for i, scene in enumerate(sys.argv[2:]))
print("%d numbers hold" % n)
sys.exit(n == 0)
