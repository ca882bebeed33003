"""depends.py VERIFY AUDIT: what each claim rests on, found from the text of the files alone, against audit.json.

A second reading that shares nothing with the program: records by indentation, names by a regular expression, closure by
names and sections.  One line for each claim that differs on stdout; exit status 0 without any, 1 with some.
"""
import glob
import json
import re
import sys

NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:'*_[A-Za-z0-9]+)*|\d+(?:\.\d*)?")
ATTRIBUTE = re.compile(r"([a-z][a-z-]*):(?!=)(.*)")


def records(path):
    """(kind, id, attributes, formulas), record 0's attributes under kind None."""
    found, head, kind, ident, fields = [], {}, None, None, []

    def close():
        attributes, formulas = {}, []
        for f in fields:
            m = ATTRIBUTE.match(f)
            if m:
                attributes[m.group(1)] = m.group(2).strip()
            else:
                formulas.append(f)
        found.append((kind, ident, attributes, formulas))

    for line in open(path, encoding="utf-8"):
        line = line.rstrip()
        if not line or line.lstrip().startswith("#"):
            continue
        depth = len(line) - len(line.lstrip())
        if depth == 0 and re.fullmatch(r"[a-z]+ \S+", line) and ":" not in line:
            close()
            kind, ident = line.split()
            fields, own = [], None
        elif kind is not None and fields and depth > own:
            fields[-1] += " " + line.strip()
        else:
            own = depth
            fields.append(line.strip())
    close()
    return found


def number(ident, attributes):
    """That of the equation: as the record says it, or as its id does."""
    found = re.fullmatch("(?:eq|err|stable)-([0-9]+)[a-z]*", ident)
    return attributes.get("equation", found and found.group(1))


def load(paths, rank):
    definitions, statements = [], []
    for path in paths:
        found = records(path)
        section = found[0][2].get("section", "")
        for kind, ident, a, formulas in found[1:]:
            where, equation = a.get("section", section), number(ident, a) or ""
            for f in formulas if kind == "define" else []:
                m = re.match(r"(?:root )?([^\s(:=]+)(?:\([^)]*\))?\s*(?::=|=|:)(.*)", f)
                definitions.append(dict(name=m.group(1), section=where, equation=equation, body=m.group(2), rank=rank))
            if kind != "define":
                statements.append(dict(id=a.get("replaces", ident), section=where, equation=equation, rank=rank, each=formulas,
                                       body=" ".join(f for f in formulas if not f.startswith("trajectory"))))
    return definitions, statements


def names(text):
    return [n for n in NAME.findall(text.replace("'(", "(")) if not n[0].isdigit()]


class View:
    def __init__(self, definitions, statements, own):
        keep = lambda r: r["rank"] == 0 or not (r["equation"] and r["equation"] == own)
        self.definitions = [d for d in definitions if keep(d)]
        self.statements = [s for s in statements if keep(s)]

    def lookup(self, name, section):
        of = [d for d in self.definitions if d["name"] == name]
        here = [d for d in of if d["section"] == section]
        best = here or of
        return max(best, key=lambda d: d["rank"]) if best else None

    def statement(self, ident):
        return max((s for s in self.statements if s["id"] == ident), key=lambda s: s["rank"], default=None)

    def reach(self, text, section, seen):
        for n in names(text):
            d = self.lookup(n, section)
            if d and (d["name"], d["section"]) not in seen:
                seen.add((d["name"], d["section"]))
                self.reach(d["body"], d["section"], seen)
        return seen


def formula(view, a):
    """The claim's formula; of "eq-53#2" the right side of that statement."""
    text = a.get("formula", "")
    m = re.fullmatch(r"(\S+)#(\d+)", text)
    return re.split("[<=>]", view.statement(m.group(1))["each"][int(m.group(2)) - 1])[-1] if m else text


def without_ranges(body):
    return re.sub(r" for \w+ in [(\[{][^)\]}]*[)\]}]", "", body)


JUDGES_ITS_ID = ("definition", "identity", "sharp", "inequality", "index-range", "criterion", "rank", "solutions")
LISTS = ("premises", "conclusion", "repair", "constraints", "statements")


def cited(attributes, key):
    """The records of a list such as "eq-52#1.2, eq-56 D"."""
    return [re.split(r"[# ]", item.strip())[0] for item in attributes.get(key, "").split(",") if item.strip()]


def steps(attributes, key):
    """(record, statement, step, phase) of each item; None for all of them."""
    found = []
    for item in filter(None, (i.strip() for i in attributes.get(key, "").split(","))):
        m = re.match(r"([^#\s]+)(?:#(\d+)(?:\.(\d+))?)?(?:\s+(\w+))?$", item)
        found.append(m.groups())
    return found


def deduces(a):
    """An argument that says more than its premises in other words, and of all orbits."""
    return a.get("kind") == "argument" and not ({"converse", "converse-of"} & set(a)) and a.get("over") != "scene"


def shares(a, b):
    return any(all(x is None or y is None or x == y for x, y in zip(s, t)) for s in a for t in b)


def main():
    verify, audit = sys.argv[1], json.load(open(sys.argv[2]))
    definitions, statements = load(sorted(glob.glob(verify + "/paper/*.eq")), 0)
    more = load([verify + "/errata.eq"], 1)
    definitions, statements = definitions + more[0], statements + more[1]
    for s in statements:
        s["section"] = s["section"] or next(o["section"] for o in statements if o["id"] == s["id"])
    claims = [(i, found[0][2] | a) for found in map(records, sorted(glob.glob(verify + "/claims/*.claim")))
              for k, i, a, _ in found[1:] if k == "claim"]
    for ident, a in claims:
        if a["kind"] in JUDGES_ITS_ID and "value" not in a:
            a.setdefault("statement", ident)
        a.update({key: dict(claims)[text[3:]][key] for key, text in a.items() if key in ("at", "constraints") and text.startswith("as ")})
    about, reach = {}, {}
    for ident, a in claims:
        view = View(definitions, statements, a.get("own", number(ident, a) or ident))
        section, seen = a.get("section", ""), set()
        about[ident] = set()
        for n in names(a.get("value", "").split("(")[0]) + re.split(r",\s*", a.get("about", "")):
            d = view.lookup(n, section)
            if d:
                about[ident].add((d["name"], d["section"]))
        for text in (a.get("value", ""), formula(view, a)):
            view.reach(text, section, seen)
        for rec in map(view.statement, [a.get("statement", "")] + [i for key in LISTS for i in cited(a, key)]):
            if rec:
                view.reach(without_ranges(rec["body"]), rec["section"], seen)
        reach[ident] = seen
    bad = 0
    judged = {c["id"]: c for c in audit["claims"]}
    for ident, a in claims:
        want = set(filter(None, re.split(r",\s*", a.get("depends-on", ""))))
        for other, b in claims:
            if other == ident:
                continue
            if (reach[ident] & about[other]) - about[ident]:
                want.add(other)
            about_record = b.get("statement")
            if about_record in cited(a, "premises") + cited(a, "constraints") and about_record != a.get("statement"):
                want.add(other)
            if deduces(a) and deduces(b) and shares(steps(a, "premises"), steps(b, "conclusion")):
                want.add(other)
            if "number" in a and "number" in b:
                symbols = {n.replace("_", "") for n in names(formula(View(definitions, statements, None), a))}
                if a["number"] != b["number"] and b["number"].replace("_", "") in symbols:
                    want.add(other)
        have = judged[ident]["depends_on"]
        order = [i for i, _ in claims if i in want]
        if have != order:
            bad += 1
            print("%s: %s, not %s" % (ident, " ".join(have), " ".join(order)))
    if not claims:
        print("no claims")
    return 1 if bad or not claims else 0


if __name__ == "__main__":
    sys.exit(main())
