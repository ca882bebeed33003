"""sheets.py FOLDER: claims.dot, errata.md and errata.tex of a report held against its audit.json, and against the grammars
of their languages as far as that can be seen without Graphviz and TeX.  One line for each error; exit status 0 without.

The arrows of the graph must have the same closure as depends_on, and every numeral of the errata must stand in audit.json.
"""
import json
import re
import sys


def closure(pairs):
    reach, after = {}, {}
    for a, b in pairs:
        after.setdefault(a, set()).add(b)
    for a in after:
        seen, todo = set(), [a]
        while todo:
            for c in after.get(todo.pop(), ()):
                if c not in seen:
                    seen.add(c)
                    todo.append(c)
        reach[a] = seen
    return {(a, b) for a, s in reach.items() for b in s}


def dot_errors(text, audit):
    string = r'"((?:[^"\\]|\\.)*)"'
    plain = lambda escaped: re.sub(r"\\(.)", r"\1", escaped)
    nodes, edges, fatal = {}, set(), set()
    body = [l for l in text.splitlines() if not l.startswith("//")]
    if body[0] != "digraph claims {" or body[-1] != "}":
        yield "claims.dot: no digraph"
    for l in body[1:-1]:
        node = re.fullmatch(r"  " + string + r" \[shape=\w+, fillcolor=" + string + r", tooltip=" + string +
                            r"((?:, \w+=(?:\w+|" + string + r"))*)\];", l)
        edge = re.fullmatch(r"  " + string + r" -> " + string + r"( \[color=" + string + r", penwidth=2\])?;", l)
        if node:
            nodes[plain(node.group(1))] = l
        elif edge:
            edges.add((plain(edge.group(2)), plain(edge.group(1))))
            if edge.group(3):
                fatal.add((plain(edge.group(2)), plain(edge.group(1))))
        elif not re.fullmatch(r"  (rankdir=LR|node \[.*\]|label=" + string + r");", l):
            yield "claims.dot: %s" % l
    for a, b in edges:
        if a not in nodes or b not in nodes:
            yield "claims.dot: no node for %s -> %s" % (b, a)
    line = lambda s: re.sub(r"[\0-\x1f]", " ", s)
    rests = {(line(c["id"]), line(d)) for c in audit["claims"] for d in c["depends_on"]}
    falls = {(line(c), line(q["failure"])) for q in audit["consequences"] for c in q["falls"]}
    if fatal != falls:
        yield "claims.dot: the marked arrows are not what falls"
    if closure(edges) != closure(rests | falls):
        yield "claims.dot: the arrows have not the closure of depends_on"
    for c in audit["claims"]:
        node = nodes.get(line(c["id"]))
        if not node:
            yield "claims.dot: %s is missing" % c["id"]
        elif ("penwidth=3" in node) != (c["verdict"] in ("refuted", "conditional")):
            yield "claims.dot: %s is marked wrongly" % c["id"]


def tex_errors(text):
    """Groups, environments and mathematics closed in order; nothing special outside of them."""
    stack, math, i = [], False, 0
    while i < len(text):
        m = re.match(r"\\(begin|end)\{(\w+)\}", text[i:])
        c = text[i]
        if m and m.group(1) == "begin":
            stack.append(m.group(2))
            i += m.end() - 1
        elif m:
            if not stack or stack.pop() != m.group(2):
                yield "errata.tex: \\end{%s} at %d" % (m.group(2), i)
            i += m.end() - 1
        elif c == "\\":
            word = re.match(r"\\([A-Za-z]+|.)", text[i:], re.S)
            if word.group(1) in ("input", "include", "write", "def", "csname", "openout", "catcode"):
                yield "errata.tex: %s at %d" % (word.group(), i)
            i += len(word.group()) - 1
        elif c == "{":
            stack.append("{")
        elif c == "}":
            if not stack or stack.pop() != "{":
                yield "errata.tex: } at %d" % i
        elif c == "$":
            math = not math
        elif c in "^_" and not math or c == "&" and not any("matrix" in s or "tabular" in s for s in stack):
            yield "errata.tex: %s at %d: %s" % (c, i, text[max(0, i - 30):i + 10])
        elif c in "%~" or c == "#" and "newcolumntype" not in text[:i].rsplit("\n", 1)[-1] or ord(c) > 126:
            yield "errata.tex: %r at %d" % (c, i)
        i += 1
    if stack or math:
        yield "errata.tex: open at the end: %s" % stack


def markdown_errors(text):
    width = None
    for n, l in enumerate(text.splitlines(), 1):
        l = re.sub(r"\\[\\`*_\[\]<>#|~&$]", "", l)  # what is escaped; in formulas this takes nothing that matters here
        if l.startswith("|"):
            cells = l.count("|")
            if width is not None and cells != width:
                yield "errata.md:%d: %d bars in a table of %d" % (n, cells, width)
            width = cells
        else:
            width = None
        plain = re.sub(r"`[^`]*`", "", l)
        if plain.count("$") % 2:
            yield "errata.md:%d: an odd dollar" % n
        plain = re.sub(r"\$.*?\$", "", plain)
        for bad in re.findall(r"[_<>]", plain):
            yield "errata.md:%d: %s outside mathematics" % (n, bad)


def numeral_errors(name, text, audit):
    known = set(re.findall(r"\d+(?:\.\d+)?", json.dumps(audit)))
    known |= {str(sum(c["verdict"] in ("refuted", "conditional") for c in audit["claims"]))}
    substance = sum(r["severity"] == "substance" for r in audit["roots"])
    known |= {str(substance), str(len(audit["roots"]) - substance)}
    controls = audit.get("controls", [])
    known |= {str(len(controls)), str(sum(c["noticed"] for c in controls))}
    for n in re.findall(r"\d+(?:\.\d+)?", text):
        if n not in known:
            yield "%s: the numeral %s is not in audit.json" % (name, n)


def main():
    read = lambda name: open(sys.argv[1] + "/" + name, encoding="utf-8").read()
    audit, dot, md, tex = json.loads(read("audit.json")), read("claims.dot"), read("errata.md"), read("errata.tex")
    begin = tex.index("\\begin{document}")
    errors = list(dot_errors(dot, audit)) + list(tex_errors(tex[begin:])) + list(markdown_errors(md))
    errors += list(numeral_errors("errata.md", md, audit))
    for e in errors:
        print(e)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
