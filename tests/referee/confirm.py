"""confirm.py audit.json [--damage] [--overlay]: a referee's scripts against the certificates of an audit.

Every refuted or conditional claim of the paper must have a function in claims.py, no function more than 20 lines, and
each must confirm, those of checks too; the numbers in the sentences of the roots are found again.  --damage: a certificate
that is damaged, one value or one quotation at a time, must not be confirmed.  --overlay: the scripts are those of overlay.py.
Exit status 0 when all is so; else each fault on a line, and 1."""
import copy
import inspect
import json
import re
import sys

import claims
import overlay
from model import Certificate

MOST_LINES = 20
scripts = overlay if "--overlay" in sys.argv else claims


def script_of(claim_id):
    return getattr(scripts, claim_id.replace("-", "_"), None)


def confirms(claim, read=None):
    """True, or why not; the names of the values that were read are added to the set read."""
    certificate = Certificate(claim)
    try:
        answer = bool(script_of(claim["id"])(certificate)) or "its two sides are not as certified"
    except (AssertionError, LookupError, ValueError, TypeError, ArithmeticError) as e:
        answer = "%s: %s" % (type(e).__name__, e)
    if read is not None:
        read |= certificate.read
    return answer


def damaged_value(value):
    """Another digit in the fourth place of a number, or the last where it has fewer; anything else gets a mark."""
    p, slash, q = value.partition("/")
    places = [i for i, x in enumerate(p) if x.isdigit()]
    if not places or set(p) - set("-.0123456789"):
        return value + "?"
    at = places[min(3, len(places) - 1)]
    return p[:at] + str((int(p[at]) + 1) % 10) + p[at + 1:] + slash + q


INPUTS = {"chi", "eta", "V", "e_1", "e_2", "z_10", "z_20", "x", "y", "t", "z_1", "z_2", "z_1'", "z_2'", "x_1", "x_2", "x_1'",
          "x_2'", "u_r1", "u_r2", "u_s1", "u_s2", "mass"}


def damages(claim, read):
    """The claim with all inputs damaged, since one of them may not matter to what the others certify; with each result
    damaged that its script reads; without a certificate, with its quotation damaged."""
    inputs = copy.deepcopy(claim)
    for i, item in enumerate(claim.get("certificate", [])):
        worse = damaged_value(item["value"])
        if item["name"] in INPUTS:
            inputs["certificate"][i]["value"] = worse
        elif item["name"] in read:
            other = copy.deepcopy(claim)
            other["certificate"][i]["value"] = worse
            yield "%s = %s" % (item["name"], worse), other
    if inputs != claim:
        yield "all inputs damaged", inputs
    if not claim.get("certificate"):
        other = claim["quote"].replace("1", "2").replace("_", "^").replace("^*", "'")
        yield "its quotation", dict(claim, quote=other if other != claim["quote"] else other[::-1])


def too_long():
    for name, f in vars(scripts).items():
        if inspect.isfunction(f) and f.__module__ == scripts.__name__ and len(inspect.getsource(f).splitlines()) > MOST_LINES:
            yield "%s has more than %d lines" % (name, MOST_LINES)


def unexplained(audit):
    """Numbers of two decimals or more, and counts of two digits or more, in the sentences of a root that its function in claims.py
    does not find.  (12) is an equation, and what stands in indices no number."""
    of = {c["id"]: Certificate(c) for c in audit["claims"]}
    for root in audit["roots"]:
        find = getattr(claims, "numbers_" + root["id"].replace("-", "_"), lambda of: set())
        text = " ".join(root.get(part) or "" for part in ("wrong", "correct", "consequence", "by_hand"))
        numbers = re.findall(r"-?\d+\.\d{2,}|(?<![\d.({_])\d{2,}(?![\d.)}])", text)
        for stray in set(numbers) - find(of):
            yield "the root %s says %s" % (root["id"], stray)


def main(path, *options):
    with open(path, encoding="utf-8") as f:
        audit = json.load(f)
    failing = [c for c in audit["claims"]
               if c["verdict"] in ("refuted", "conditional") and (c.get("of", "paper") == "paper" or script_of(c["id"]))]
    faults = list(too_long()) + list(unexplained(audit))
    for claim in failing:
        if script_of(claim["id"]) is None:
            faults.append("%s is %s and has no script" % (claim["id"], claim["verdict"]))
            continue
        read = set()
        answer = confirms(claim, read)
        if answer is not True:
            faults.append("%s is not confirmed: %s" % (claim["id"], answer))
        if "--damage" in options:
            faults += ["%s is confirmed with %s" % (claim["id"], what) for what, other in damages(claim, read)
                       if confirms(other) is True]
    for fault in faults:
        print(fault)
    print("%d statements confirmed, %d faults" % (len(failing), len(faults)))
    return 1 if faults or not failing else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
