#!/usr/bin/env python3
"""Checks that the arrows between rooms (the folders of src/, and bench/) go one way, by calls and by includes, and that no
room has a cycle of calls longer than MOST files.

usage: arrows.py BUILD   the folder of the objects, whose symbols say which file calls which"""
import collections
import pathlib
import re
import subprocess
import sys

# From the top down: a room calls and includes what stands below it.
ROOMS = ("main cli library bench report run readings power judge stability proof route value quote scene claim explore mech motion"
         " record model tape expr num base").split()
MOST = 4
HIGHEST = {"report": {"record", "base"}}  # rooms that see less than all that stands below them
LIBRARIES = {"gsl/": {"motion", "mech", "bench", "cli"}, "nettle/": {"quote"}}
CLOCKS = re.compile(r"\b(clock_gettime|gettimeofday|clock|time)\s*\((NULL|CLOCK_|\)|&)")  # the library knows no time
MAY_KNOW_TIME = {"main", "cli", "bench"}


def room_of(name):
    parts = pathlib.PurePath(name).parts
    if parts[0] == "bench":
        return "bench"
    return parts[1] if parts[0] == "src" and len(parts) > 2 else "main"


def calls(build):
    """{file: {file it takes a symbol from: the symbols}}, from the objects."""
    objects = [str(p) for d in ("src", "bench") for p in pathlib.Path(build, d).rglob("*.o")
               if p.relative_to(build).with_suffix(".c").exists()]
    text = subprocess.run(["nm", "-A", *objects], capture_output=True, text=True, check=True).stdout
    defined, wanted = {}, collections.defaultdict(set)
    for line in text.splitlines():
        path, rest = line.split(":", 1)
        *_, kind, symbol = rest.split()
        source = str(pathlib.PurePath(path).relative_to(build).with_suffix(".c"))
        wanted[source]
        if kind in "TDBRC":
            defined[symbol] = source
        elif kind == "U":
            wanted[source].add(symbol)
    arrows = {}
    for source, symbols in wanted.items():
        arrows[source] = collections.defaultdict(set)
        for s in symbols:
            if s in defined and defined[s] != source:
                arrows[source][defined[s]].add(s)
    return arrows


def may_see(a, b):
    if a not in ROOMS or b not in ROOMS:
        return False
    return a == b or (ROOMS.index(a) < ROOMS.index(b) and b in HIGHEST.get(a, {b}))


def cycles(nodes, arrows):
    """Strongly connected parts of more than one file (Tarjan)."""
    index, low, stack, found = {}, {}, [], []

    def visit(v):
        index[v] = low[v] = len(index)
        stack.append(v)
        for w in arrows[v]:
            if w not in nodes:
                continue
            if w not in index:
                visit(w)
            if w in stack:
                low[v] = min(low[v], low[w])
        if low[v] == index[v]:
            part = stack[stack.index(v):]
            del stack[stack.index(v):]
            if len(part) > 1:
                found.append(sorted(part))

    for v in nodes:
        if v not in index:
            visit(v)
    return found


def includes():
    for path in sorted(p for d in ("src", "bench") for p in pathlib.Path(d).rglob("*.[ch]")):
        for n, line in enumerate(path.read_text().splitlines(), 1):
            yield path, n, line


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.setrecursionlimit(10000)
    bad = []
    arrows = calls(sys.argv[1])
    if not arrows:
        sys.exit("arrows: no objects; build first")
    for a, others in sorted(arrows.items()):
        for b, symbols in sorted(others.items()):
            if not may_see(room_of(a), room_of(b)):
                bad.append(f"{a}: {room_of(a)} must not call {b} ({', '.join(sorted(symbols))})")
    for room in ROOMS:
        nodes = {f for f in arrows if room_of(f) == room}
        bad += [f"src/{room}: a cycle of {len(c)} files: {' '.join(c)}" for c in cycles(nodes, arrows) if len(c) > MOST]
    for path, n, line in includes():
        room = room_of(str(path))
        if room not in MAY_KNOW_TIME and CLOCKS.search(line):
            bad.append(f"{path}:{n}: only bench and the command line may read a clock")
        m = re.match(r'\s*#\s*include\s+[<"]([^>"]+)[>"]', line)
        if not m:
            continue
        name = m.group(1)
        other = pathlib.Path("src", name)
        if "/" in name and other.exists() and not may_see(room, room_of(str(other))):
            bad.append(f"{path}:{n}: {room} must not include {name}")
        bad += [f"{path}:{n}: only {', '.join(sorted(users))} may include {name}"
                for prefix, users in LIBRARIES.items() if name.startswith(prefix) and room not in users]
    print("\n".join(bad) or "arrows: one way between rooms, no long cycle")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
