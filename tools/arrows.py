#!/usr/bin/env python3
"""Checks that each module includes only what stands below it (README, "How it is built")."""
import pathlib
import re
import sys

HEADERS = {  # header -> module
    "status": "base", "arena": "base", "text": "base", "record": "base", "json": "base", "part": "base",
    "work": "base",
    "decimal": "base",
    "num": "num", "ops": "num", "flint_compat": "num",
    "expr": "expr", "edit": "expr",
    "tape": "tape", "exact": "tape",
    "model": "model",
    "dynamics": "dynamics", "coulomb": "dynamics", "given": "dynamics", "complete": "dynamics",
    "paper_route": "dynamics", "long_run": "dynamics", "margins": "dynamics", "certify": "dynamics",
    "chain": "dynamics", "bifurcate": "dynamics", "box": "dynamics", "basin": "dynamics", "warm": "dynamics",
    "batch": "dynamics", "return_map": "dynamics", "family": "dynamics", "word": "dynamics",
    "audit": "audit", "scene": "audit", "stable": "audit", "plan": "audit",
    "result": "result", "mutation": "result", "stability": "result",
    "report": "report", "report_mutation": "report", "report_stability": "report",
}
ALLOWED = {
    "base": {"base"},
    "num": {"base", "num"},
    "expr": {"base", "expr"},
    "tape": {"base", "num", "expr", "tape"},
    "model": {"base", "num", "expr", "tape", "model"},
    "dynamics": {"base", "num", "dynamics"},
    "result": {"base", "result"},
    "audit": {"base", "num", "expr", "tape", "model", "dynamics", "result", "audit"},
    "report": {"base", "result", "report"},
    "library": {"base", "num", "expr", "tape", "model", "dynamics", "result", "audit", "report"},
    "bench": {"base", "num", "expr", "tape", "model", "dynamics", "result", "audit", "bench"},
}
ROOM = {r: "audit" for r in "scene claim value proof judge route power stability readings run".split()}
ROOM.update(motion="dynamics", explore="dynamics", record="result")
LIBRARY_OF = {"gsl/": {"dynamics", "bench"}}
CLOCKS = re.compile(r"\b(clock_gettime|gettimeofday|clock|time)\s*\((NULL|CLOCK_|\)|&)")  # the library knows no time


def module_of(path):
    if path.parts[0] == "bench":
        return "bench"
    if path.parts[0] == "include":
        return HEADERS[path.stem]
    return ROOM.get(path.parts[1], path.parts[1]) if len(path.parts) > 2 else "main"


def main():
    bad = 0
    for path in sorted(list(pathlib.Path("src").rglob("*.[ch]")) + list(pathlib.Path("include").rglob("*.h"))
                       + list(pathlib.Path("bench").rglob("*.[ch]"))):
        module = module_of(path)
        for n, line in enumerate(path.read_text().splitlines(), 1):
            if module not in ("main", "cli", "bench") and CLOCKS.search(line):
                print(f"{path}:{n}: only bench and the command line may read a clock")
                bad += 1
            m = re.match(r'\s*#\s*include\s+[<"]([^>"]+)[>"]', line)
            if not m or module in ("main", "cli"):
                continue
            name = m.group(1)
            own = re.match(r"stickslip/(\w+)\.(h|def)$", name)
            if own and HEADERS.get(own.group(1)) not in ALLOWED[module]:
                print(f"{path}:{n}: {module} must not include {name}")
                bad += 1
            for prefix, users in LIBRARY_OF.items():
                if name.startswith(prefix) and module not in users:
                    print(f"{path}:{n}: only {', '.join(sorted(users))} may include {name}")
                    bad += 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
