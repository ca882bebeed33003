#!/usr/bin/env python3
"""Writes the verdict table of README.md from reports/paper/audit.json, with the mutation score of the whole population
from reports/mutation/mutation.json; where that was not made, the score that README.md has stays.  --check only compares."""
import json
import pathlib
import sys

BEGIN, END = "<!-- verdicts: made by tools/readme.py -->", "<!-- end of verdicts -->"


SCORE = "Damaged on purpose: "


def score(old):
    path = pathlib.Path("reports/mutation/mutation.json")
    kept = [line for line in old.splitlines() if line.startswith(SCORE)]
    r = json.loads(path.read_text()) if path.exists() else None
    if not r or r["tried"] != r["population"]:
        return kept
    t = r["total"]
    seen = t["noticed"] + t["unreadable"] + t["unproved"]
    return [f"{SCORE}{seen} of {t['total']} one-token damages of the formulas are noticed ({t['unreadable']} cannot be read, "
            f"{t['unproved']} lose no more than a proof); of the "
            f"others {t['equivalent']} are proved equivalent, {t['on_motions']} say the same on every motion, "
            f"{t['undecided'] + t['unread']} are open (`make mutate`)."]


def table(old):
    audit = json.loads(pathlib.Path("reports/paper/audit.json").read_text())
    summary = audit["summary"]
    noticed = sum(c["noticed"] for c in audit["controls"])
    lines = ["| verdict | claims |", "| --- | ---: |"]
    lines += [f"| {k} | {v} |" for k, v in summary.items() if v]
    lines += ["", *score(old)] if score(old) else []
    lines += ["", f"Controls (wrong on purpose): {noticed} of {len(audit['controls'])} noticed. Refuted:", ""]
    for c in audit["claims"]:
        if c["verdict"] not in ("refuted", "conditional"):
            continue
        fix = c["correction"]
        holds = f" (proved where {c['condition']})" if c["verdict"] == "conditional" else ""
        lines.append(f"- `{c['id']}`: {c['title']}{holds}" + (f"; corrected: `{fix['text']}` ({fix['verdict']})" if fix else ""))
    return "\n".join(lines)


def main():
    path = pathlib.Path("README.md")
    text = path.read_text()
    head, rest = text.split(BEGIN)
    old, tail = rest.split(END)
    new = f"{head}{BEGIN}\n{table(old)}\n{END}{tail}"
    if "--check" in sys.argv:
        if new != text:
            print("README.md: the verdict table is stale; run tools/readme.py")
        return int(new != text)
    path.write_text(new)
    return 0


if __name__ == "__main__":
    sys.exit(main())
