#!/usr/bin/env python3
"""Writes the generated parts of README.md: the verdict table from reports/paper/audit.json, with the mutation score of
the whole population from reports/mutation/mutation.json, and which method to use from reports/bench/bench.json.  What was
not made, or by a quick run, leaves what README.md says as it is.  --check only compares."""
import json
import pathlib
import sys

VERDICTS = "<!-- verdicts: made by tools/readme.py -->", "<!-- end of verdicts -->"
BENCH = "<!-- bench: made by tools/readme.py -->", "<!-- end of bench -->"
PEERS = ("gsl-", "cvode-", "scipy-", "mpmath-", "pari-", "python")

SCORE = "Mutation: "


def score(old):
    path = pathlib.Path("reports/mutation/mutation.json")
    kept = [line for line in old.splitlines() if line.startswith(SCORE)]
    r = json.loads(path.read_text()) if path.exists() else None
    audit = json.loads(pathlib.Path("reports/paper/audit.json").read_text())
    if not r or r["schema"] != "stickslip-mutation-2" or r["tried"] != r["population"]:
        return kept
    if r.get("subject") != audit.get("subject"):  # a study of other formulas, or of another scene
        return []
    s = r["score"]
    text = f"{s['needs_text']} that only the paper's text can tell, " if s["needs_text"] else ""
    return [f"{SCORE}{s['noticed']} of {s['counted']} damages that change a meaning are noticed ({s['formulas']} of them are one token of "
            f"a formula; the others are of TeX, quotations, numbers, claims, controls and titles).  Left out: {s['equivalent']} that are "
            f"proved or known to mean the same, {s['on_motions']} that make no difference on any motion, {text}and {s['errata']} of "
            f"the corrections, which are not the paper's (`make mutate`)."]


def table(old):
    audit = json.loads(pathlib.Path("reports/paper/audit.json").read_text())
    summary = audit["summary"]
    noticed = sum(c["noticed"] for c in audit["controls"])
    checks = audit["checks"]
    substance = [r for r in audit["roots"] if r["severity"] == "substance"]
    lines = ["What is wrong in the paper, in order of consequence ([errata](reports/paper/errata.md)):", ""]
    lines += [f"{i}. **{r['where']}**: {r['title']}. {r['wrong']} {r['consequence']}" for i, r in enumerate(substance, 1)]
    lines += ["", f"Besides, {len(audit['roots']) - len(substance)} remarks and slips of notation.", ""]
    lines += ["| verdict | statements of the paper | checks of the suite |", "| --- | ---: | ---: |"]
    lines += [f"| {k} | {v} | {checks[k]} |" for k, v in summary.items() if v or checks[k]]
    numbers = {c["root"] for c in audit["claims"] if c["fault"] == "number" and c["root"]}
    refuted = [c for c in audit["claims"] if c["verdict"] == "refuted" and c["of"] == "paper"]
    lines += ["", f"Of the {len(refuted)} refuted statements {sum(c['root'] in numbers for c in refuted)} are about the numbers of the "
              f"one example and {sum(c['severity'] == 'notation' for c in refuted)} are misprints or slips of notation."]
    asserted = summary["total"] - summary["definition"]
    decided = summary["proved"] + summary["conditional"] + summary["refuted"]
    lines += ["", f"Of the {asserted} statements that assert something, {decided} are decided, that is proved, conditional or "
              "refuted.", "", *score(old)]
    lines += ["", f"Controls (wrong on purpose): {noticed} of {len(audit['controls'])} noticed."]
    return "\n".join(lines)


def duration(ns):
    ns = float(ns)
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "us")):
        if ns >= size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


def named(row):
    setting = f" at {row['setting']} {row['kind']}" if row["kind"] == "bits" else ""
    return f"`{row['method']}`{setting} ({duration(row['ns_least'])})"


def advice(job, errors, which="fastest"):
    """Methods with the least of these errors that each is advised for."""
    chosen = {}
    for error in errors:
        row = next((g[which] for g in job["guide"] if g["error"] == error), None)
        chosen[named(row) if row else "none"] = error
    return " and ".join(f"{name} down to {error}" for name, error in chosen.items())


def fastest_peer(job, error):
    """Of those that find events themselves."""
    bare = {m["method"] for m in job["methods"] if m["bare"]}
    rows = [r for r in job["rows"] if r["state"] == "ok" and r["method"].startswith(PEERS) and r["method"] not in bare
            and float(r["error_worst"]) <= error]
    return min(rows, key=lambda r: float(r["ns_least"]), default=None)


def bench(old):
    path = pathlib.Path("reports/bench/bench.json")
    r = json.loads(path.read_text()) if path.exists() else {"quick": True, "jobs": []}
    jobs = {j["job"]: j for j in r["jobs"]}
    if r["quick"] or not {"map", "orbit"} <= set(jobs):
        return old
    machine = dict(line.split(": ", 1) for line in r["machine"].splitlines())
    job, orbit, peer = jobs["map"], jobs["orbit"], fastest_peer(jobs["map"], 1e-12)
    ours = next((g["fastest"] for g in job["guide"] if g["error"] == "1e-12"), None)
    first = f"On {machine.get('cpu', 'an unnamed processor')} with {machine['compiler']}, the fastest method for one Poincare map "
    first += f"with its events is {advice(job, ('1e-6', '1e-12', '1e-30'))}, errors being the worst of many inputs, and as an enclosure "
    first += advice(job, ("1e-12",), "enclosed")
    if peer and ours:
        times = float(peer["ns_least"]) / float(ours["ns_least"])
        first += f"; the fastest integrator that reaches 1e-12, `{peer['method']}`, needs {times:.3g} times as long"
    second = f"For the periodic orbit with its multiplier, from the printed guess, it is {advice(orbit, ('1e-12',))}; enclosed, with "
    second += f"first events and conditions proved, {advice(orbit, ('1e-30',), 'enclosed')}."
    states = [q["state"] for q in r["ratios"]]
    third = f"{states.count('met')} of {states.count('met') + states.count('not met')} speed goals are met; every method at "
    third += "every setting, with figures, is in [reports/bench](reports/bench/bench.md)."
    return f"{first}.\n{second}\n{third}"


def replace(text, marks, make):
    """The text with what stands between the marks made anew; a README without them has no such part."""
    if marks[0] not in text:
        return text
    head, rest = text.split(marks[0])
    old, tail = rest.split(marks[1])
    return f"{head}{marks[0]}\n{make(old.strip())}\n{marks[1]}{tail}"


def main():
    path = pathlib.Path("README.md")
    text = path.read_text()
    new = replace(replace(text, VERDICTS, table), BENCH, bench)
    if "--check" in sys.argv:
        if new != text:
            print("README.md: a generated part is stale; run tools/readme.py")
        return int(new != text)
    path.write_text(new)
    return 0


if __name__ == "__main__":
    sys.exit(main())
