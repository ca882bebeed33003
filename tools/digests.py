#!/usr/bin/env python3
"""Holds the bytes of the program's outputs against the digests on file, tests/digests.tsv.

usage: digests.py PROGRAM [--quick] [--record]

A row of the file is: digest, scope, command line.  The digest is that of the exit status, standard output, standard error
(this checkout's own path as ".") and every file that the command writes into its --out folder but run.json, which holds
times.  A row of scope `libm` rests on the last bits of the C library's functions; it is left out, and said to be, where
these differ from those recorded with.  --quick asks for the rows marked so alone.  --record writes the digests of these rows into the file: only for a change that is meant."""
import concurrent.futures
import hashlib
import math
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

FILE = pathlib.Path("tests/digests.tsv")
OUT = "OUT"  # stands for a new folder in a command line
LIBM = "libm"


def commands():
    """(quick, scope, command line) of every output that is held."""
    scenes = sorted(p.stem for p in pathlib.Path("verify/scenes").glob("*.scene"))
    for s in scenes:
        if "\nsystem:" not in pathlib.Path(f"verify/scenes/{s}.scene").read_text(encoding="utf-8"):
            yield s in ("paper", "jacobians", "paper-e1-t_b", "solution-II"), "any", f"verify {s} --out {OUT}"
        yield True, "any", f"orbit {s} --json"
        yield True, "any", f"orbit {s}"
    yield True, "any", "verify paper --plan"
    yield True, "any", f"verify paper --only eq-40 --out {OUT}"
    yield True, "any", f"verify paper --set V=2 --only eq-10,eq-40,text-periodic --out {OUT}"
    for s in ("paper", "stable"):
        yield True, "any", f"orbit {s} --basin --digits 40 --json"
        yield True, "any", f"plot {s} --out {OUT}"
        for method in ("analytic", "implicit", "saltation", "fd"):
            yield True, "any", f"jacobian {s} --method {method} --digits 30 --json"
        for layer in ("printed", "corrected", "stable"):
            yield True, "any", f"jacobian {s} --layer {layer} --at orbit:2 --json"
        yield True, LIBM, f"jacobian {s} --method ode --json"
        yield True, LIBM, f"jacobian {s} --phases"
        yield True, LIBM, f"simulate {s} --periods 20 --compare"
        yield True, LIBM, f"simulate {s} --csv --samples 50"
    yield True, "any", "orbit paper --method paper --json"
    yield True, "any", "orbit paper --set e2=[0.86,0.87] --json"
    yield True, LIBM, "simulate paper --at printed --periods 50"
    for s in ("paper", "overrun", "two-admissible"):
        yield s == "paper", "any", f"words {s} --json"
    for s in ("chain3", "beside-wall", "driven", "den-hartog"):
        yield True, "any", f"jacobian {s} --json"
        yield s == "driven", "any", f"words {s} --json"
    yield True, "any", "bifurcate paper --along e2=0.5:3 --json"
    yield True, "any", "bifurcate paper --along e2=0.5:3"
    yield False, "any", "bifurcate stable --along e1=2:4 --json"
    yield True, "any", "readings paper --json"
    yield True, "any", "readings paper"
    yield False, "any", f"repair --json --out {OUT}"
    yield True, "any", "repair eq-40"
    yield True, "any", "sweep paper --over e2=0.5:3:40"
    yield True, "any", "sweep paper --over e1=2:4:20 --over e2=0.8:0.9:200"
    yield True, "any", "sweep paper --over e2=0.5:3:40 --json"
    yield False, "any", f"mutate --count 1500 --out {OUT} --json"
    yield False, LIBM, f"stability --quick --after stable --out {OUT} --json"
    yield True, "any", "stability lambda_2 --at chi=0x1p-35,eta=0x1p-2"
    yield True, "any", "list"
    yield True, "any", "list scenes"
    yield True, "any", "list --scene-keys"
    for claim in ("eq-27", "eq-40", "eq-53", "num-t_a", "text-otherwise-unstable", "text-59-concluded"):
        yield True, "any", f"explain {claim}"
    yield True, "any", "explain eq-40 --at V=2 --tape"
    yield True, "any", "explain eq-27 --receipt"
    yield True, "any", "check verify/paper/1-model.eq verify/scenes/paper.scene"


def libm_digest():
    """Of the C library's elementary functions at 20000 arguments of all sizes: which library, on which kind of processor."""
    d = hashlib.sha256()
    x = 1e-8
    for _ in range(20000):
        x *= 1.0023
        d.update(repr((math.sin(x), math.cos(x), math.exp(-x), math.log(x), math.atan2(x, 1.5), math.cbrt(x)
                       if hasattr(math, "cbrt") else 0)).encode())
    return d.hexdigest()


def digest(program, line):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        words = [out if w == OUT else w for w in shlex.split(line)]
        p = subprocess.run([program, *words], stdin=subprocess.DEVNULL, capture_output=True, check=False)
        d = hashlib.sha256(str(p.returncode).encode())
        for text in (p.stdout, p.stderr):
            d.update(b"\0" + text.replace(out.encode(), OUT.encode()).replace(os.getcwd().encode(), b"."))
        for path in sorted(pathlib.Path(out).rglob("*")) if os.path.isdir(out) else []:
            if path.is_file() and path.name != "run.json":
                d.update(path.name.encode() + b"\0" + path.read_bytes())
        return d.hexdigest()


def main():
    program, options = sys.argv[1], sys.argv[2:]
    rows = [c for c in commands() if c[0] or "--quick" not in options]
    libm = libm_digest()
    recorded = {}
    if FILE.exists():
        for line in FILE.read_text().splitlines():
            value, scope, command = line.split("\t")
            recorded[command] = (value, scope)
    same_libm = recorded.get("libm", ("", ""))[0] == libm
    if "--record" not in options:
        left_out = [r for r in rows if r[1] == LIBM and not same_libm]
        rows = [r for r in rows if r not in left_out]
        if left_out:
            print(f"digests: {len(left_out)} outputs left out: recorded with another C library or processor")
    # most commands use two processes of their own
    with concurrent.futures.ThreadPoolExecutor(max(1, (os.cpu_count() or 2) // 2)) as pool:
        found = list(pool.map(lambda r: digest(program, r[2]), rows))
    if "--record" in options:
        recorded |= {line: (v, scope) for v, (_, scope, line) in zip(found, rows)}
        kept = [(recorded[line][0], scope, line) for _, scope, line in commands() if line in recorded]
        FILE.write_text("".join(f"{v}\t{scope}\t{line}\n" for v, scope, line in [(libm, LIBM, "libm"), *kept]))
        print(f"digests: {len(rows)} recorded")
        return 0
    bad = [line for v, (_, _, line) in zip(found, rows) if recorded.get(line, ("", ""))[0] != v]
    for line in bad:
        print(f"digests: other bytes: stickslip {line}")
    print(f"digests: {len(rows) - len(bad)} of {len(rows)} outputs have the bytes on file")
    return 1 if bad or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
