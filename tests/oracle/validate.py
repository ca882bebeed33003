"""validate.py SCHEMA FILE [SCHEMA FILE]...: hold outputs of the program against their JSON Schemas, and against what no schema can say.

For audit.json that is: the counts are those of the claims and add up to the total, roots and claims agree, ids are unique, and
every verdict other than skipped and definition has evidence.  For orbits: increasing z10.  For phases: entries row by row,
each value either there or left out, and only methods that have a value depart.  One line for each error on
stdout; exit status 0 without errors, 1 with errors, 2 for wrong usage.
"""
import json
import pathlib
import sys
from decimal import ROUND_DOWN, ROUND_HALF_UP, Decimal

import jsonschema


def no_twins(pairs):
    """An object whose keys are all different; JSON readers would silently keep the last of two."""
    names = [k for k, _ in pairs]
    twins = sorted({k for k in names if names.count(k) > 1})
    if twins:
        raise ValueError("the same key twice in one object: " + ", ".join(twins))
    return dict(pairs)


def no_constant(name):
    raise ValueError(name + " is not JSON")


def audit_errors(audit):
    for member, of in (("summary", "paper"), ("checks", "suite")):
        verdicts = [c["verdict"] for c in audit["claims"] if c["of"] == of]
        for name, count in audit[member].items():
            found = len(verdicts) if name == "total" else verdicts.count(name)
            if count != found:
                yield "%s/%s: says %d, the claims make %d" % (member, name, count, found)
        parts = sum(n for name, n in audit[member].items() if name != "total")
        if parts != audit[member]["total"]:
            yield "%s/total: the verdicts add up to %d, not %d" % (member, parts, audit[member]["total"])
    yield from root_errors(audit)
    for part in ("claims", "controls"):
        ids = [c["id"] for c in audit.get(part, [])]
        for twin in sorted({i for i in ids if ids.count(i) > 1}):
            yield "%s: the id %s stands %d times" % (part, twin, ids.count(twin))
    for i, c in enumerate(audit["claims"]):
        if c["verdict"] not in ("skipped", "definition") and not c["evidence"]:
            yield "claims/%d: %s is %s without evidence" % (i, c["id"], c["verdict"])
    if audit.get("readings"):
        yield from readings_errors(audit["readings"])


def root_errors(audit):
    """Each claim that fails has one root, which lists it; the roots stand in order of severity."""
    order = ["substance", "remark", "notation"]
    severities = [order.index(r["severity"]) for r in audit["roots"]]
    if severities != sorted(severities):
        yield "roots: not in order of severity"
    listed = {i: r for r in audit["roots"] for i in r["claims"]}
    for c in audit["claims"]:
        fails = c["verdict"] in ("refuted", "conditional")
        root = listed.get(c["id"])
        if fails != (root is not None) or c["root"] != (root and root["id"]) or c["severity"] != (root and root["severity"]):
            yield "claims: %s is %s and its root is %s" % (c["id"], c["verdict"], c["root"])
    for r in audit["roots"]:
        if not set(r["claims"]) <= {c["id"] for c in audit["claims"]}:
            yield "roots/%s: names claims that are not there" % r["id"]


def readings_errors(readings):
    for level in readings["levels"]:
        if level["unrounded"] > level["reproduce"] or level["reproduce"] + level["undetermined"] > level["tried"]:
            yield "levels: the counts of %d dropped equations do not fit" % level["dropped"]
    for i, r in enumerate(readings["found"]):
        for n in r["numbers"]:
            way = {"rounded": ROUND_HALF_UP, "truncated": ROUND_DOWN}.get(n["how"])
            if way and Decimal(n["value"]).quantize(Decimal(n["printed"]), way) != Decimal(n["printed"]):
                yield "found/%d: %s = %s is not %s" % (i, n["name"], n["value"], n["printed"])
        if len(r["solved"]) + len(r["dropped"]) != 6 or len(r["inputs"]) + len(r["solved"]) != 8:
            yield "found/%d: inputs and equations do not add up" % i


def orbit_errors(out):
    z = [Decimal(o["z10"]) for o in out["orbits"]]
    if z != sorted(z):
        yield "orbits: not by increasing z10"


FATES = ("noticed", "unreadable", "unproved", "refused", "equivalent", "on_motions", "needs_text", "undecided", "unread")
SURVIVORS = ("equivalent", "on_motions", "undecided", "unread")
NO_TEST = ("equivalent", "on_motions", "needs_text")
NOT_THE_PAPERS = "TeX of errata.eq"


def mutation_errors(out):
    def adds_up(where, row):
        if sum(row[f] for f in FATES) != row["total"]:
            yield "%s: the fates do not add up to %d" % (where, row["total"])

    for part in ("formulas", "corrected_elsewhere", "errata"):
        yield from adds_up(part, out[part])
    for part in ("files", "kinds", "classes"):
        for row in out[part]:
            yield from adds_up(part + "/" + row["name"], row)
    for part in ("files", "kinds"):
        for f in FATES + ("total",):
            if sum(row[f] for row in out[part]) != out["formulas"][f]:
                yield "%s: %s does not add up to the formulas" % (part, f)
    rows = [out["formulas"], out["errata"]] + out["classes"]
    if sum(row["total"] for row in rows) != out["tried"] or out["tried"] > out["population"]:
        yield "tried: %d, which the rows or the population contradict" % out["tried"]
    counted = [row for row in rows if row is not out["errata"] and row.get("name") != NOT_THE_PAPERS]
    score = out["score"]
    for f in NO_TEST:
        if sum(row[f] for row in counted) != score[f]:
            yield "score: %s is not what the rows say" % f
    if sum(row[f] for row in counted for f in FATES if f not in NO_TEST) != score["counted"]:
        yield "score: counted is not what the rows say"
    if sum(row[f] for row in counted for f in ("noticed", "unreadable", "unproved", "refused")) != score["noticed"]:
        yield "score: noticed is not what the rows say"
    if score["errata"] != sum(row["total"] for row in rows if row not in counted):
        yield "score: errata is not what the rows say"
    for f in SURVIVORS:
        n = sum(s["fate"] == f for s in out["survivors"])
        if n != out["formulas"][f] + out["errata"][f]:
            yield "survivors: %d %s, the rows say %d" % (n, f, out["formulas"][f] + out["errata"][f])
        n = sum(s["fate"] == f and s["corrected_elsewhere"] for s in out["survivors"])
        if n != out["corrected_elsewhere"][f]:
            yield "survivors: %d %s of corrected text, the row says %d" % (n, f, out["corrected_elsewhere"][f])
    for row in out["classes"]:
        n = sum(d["class"] == row["name"] and d["fate"] == "undecided" for d in out["damages"])
        if n != row["undecided"]:
            yield "damages: %d of class %s undecided, the row says %d" % (n, row["name"], row["undecided"])
    for i, s in enumerate(out["survivors"]):
        if s["text"] == s["original"] or (s["fate"] == "unread") != (s["read_by"] == ""):
            yield "survivors/%d: undamaged, or read by somebody and by nobody" % i


def repair_errors(out):
    for c in out["claims"]:
        sizes = [(r["edits"], r["distance"]) for r in c["repairs"]]
        if sizes != sorted(sizes):
            yield "claims/%s: not the smallest first" % c["claim"]
        if c["not_searched"] is not None and (c["repairs"] or c["singles"]):
            yield "claims/%s: searched and not searched" % c["claim"]


def phases_errors(out):
    methods = ("analytic-printed", "analytic-corrected", "implicit", "saltation", "fd", "fd-double", "ode")
    absent = {(x["name"], x["method"]) for x in out["left_out"]}
    for m in out["phases"] + [out["period"]]:
        places = [(e["row"], e["col"]) for e in m["entries"]]
        if places != [(r + 1, c + 1) for r in range(m["rows"]) for c in range(m["cols"])]:
            yield m["name"] + ": the entries are not row by row"
        for e in m["entries"]:
            where = "%s[%d,%d]" % (m["name"], e["row"], e["col"])
            for method in methods:
                if (method in e["values"]) == ((m["name"], method) in absent):
                    yield "%s: %s is neither there nor left out, or both" % (where, method)
            for method in e["departs"]:
                if method not in e["values"]:
                    yield "%s: %s departs without a value" % (where, method)


EXTRA = {"phases.schema.json": phases_errors, "audit.schema.json": audit_errors,
         "readings.schema.json": lambda out: readings_errors(out["readings"]), "orbit.schema.json": orbit_errors,
         "mutation.schema.json": mutation_errors, "repairs.schema.json": repair_errors}


def schema_with_others(schema_file):
    """A schema, and in it those of its folder: a part that two outputs share is described once."""
    folder = {path.name: json.loads(path.read_text("utf-8"))
              for path in pathlib.Path(schema_file).parent.glob("*.schema.json")}
    schema = folder.pop(pathlib.Path(schema_file).name)
    schema.setdefault("$defs", {}).update(folder)
    return schema


def errors(schema_file, file):
    schema = schema_with_others(schema_file)
    jsonschema.Draft202012Validator.check_schema(schema)
    try:
        with open(file, encoding="utf-8") as f:
            data = json.load(f, object_pairs_hook=no_twins, parse_constant=no_constant)
    except ValueError as e:
        return [str(e)]
    found = [("/".join(map(str, e.absolute_path)) or "(top)") + ": " + e.message
             for e in jsonschema.Draft202012Validator(schema).iter_errors(data)]
    return found or list(EXTRA.get(schema["$id"], lambda _: ())(data))


def main(args):
    if not args or len(args) % 2 != 0:
        print(__doc__, file=sys.stderr)
        return 2
    failed = 0
    for schema, file in zip(args[::2], args[1::2]):
        for e in errors(schema, file):
            print(file + ": " + " ".join(e.split()))
            failed = 1
    return failed


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
