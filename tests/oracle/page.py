"""page.py FOLDER [MOST_RAW]: hold index.html, audit.csv and junit.xml of a folder against their grammars and audit.json.

index.html must be well-formed XML and read alike by an HTML parser; ids are unique and every link into the page has its
target; headings go down one level at a time; tables have captions and heads with scopes; pictures have names; nothing is
loaded from elsewhere; MathML elements have the children that they need, and the signs of each formula are those of the TeX
in its annotation, by a reading of TeX of this file's own.  Every claim of audit.json has its row, with its title as text.
MOST_RAW: how many formulas may be shown as TeX (any number without it).  One line for each error; exit status 0 or 1.
"""
import collections
import csv
import html.parser
import json
import pathlib
import re
import sys
import xml.etree.ElementTree as ET

GREEK = dict(zip(
    "alpha beta gamma delta epsilon varepsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi "
    "varphi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega infty".split(),
    "αβγδϵεζηθικλμνξπρστυϕφχψωΓΔΘΛΞΠΣΥΦΨΩ∞"))
SIGNS = {"cdot": "⋅", "times": "×", "equiv": "≡", "neq": "≠", "ne": "≠", "le": "≤", "leq": "≤", "ge": "≥", "geq": "≥",
         "lt": "<", "gt": ">", "in": "∈", "to": "→", "rightarrow": "→", "Rightarrow": "⇒", "pm": "±", "mp": "∓",
         "dots": "…", "ldots": "…", "cdots": "⋯", "circ": "∘", "vert": "|", "prime": "′", "lbrace": "{", "rbrace": "}",
         "tilde": "˜", "bar": "¯", "hat": "^", "dot": "˙", "ddot": "¨", "sin": "sin", "cos": "cos", "tan": "tan",
         "cot": "cot", "det": "det"}
SILENT = "frac sqrt left right quad qquad text mathrm mathsf mathbf mathcal operatorname begin end".split()
FENCES = {"pmatrix": "()", "bmatrix": "[]", "cases": "{", "matrix": "", "aligned": ""}
ARITY = {"mfrac": 2, "msub": 2, "msup": 2, "msubsup": 3, "mover": 2, "semantics": 2}
VOID = {"meta", "link", "br", "input"}


def tex_signs(tex):
    """The visible signs of a formula, as a multiset."""
    out = []
    tex = re.sub(r"\\begin\{(\w+)\}", lambda m: "\\{" * ("{" in FENCES[m[1]]) + FENCES[m[1]].replace("{", ""), tex)
    tex = re.sub(r"\\end\{\w+\}", "", tex)
    tex = re.sub(r"\\(left|right)\.", "", tex)
    tex = re.sub(r"\\mathcal\{([A-Z])\}", lambda m: {"X": "\U0001d4b3", "B": "ℬ"}.get(m[1], m[1]), tex)
    for m in re.finditer(r"\\([A-Za-z]+)|\\(.)|(.)", tex, re.S):
        word, control, char = m.groups()
        if word in GREEK:
            out.append(GREEK[word])
        elif word in SIGNS:
            out.extend(SIGNS[word])
        elif word:
            assert word in SILENT, word
        elif control:
            out.extend(control if control in "{}" else "")
        elif char not in "{}^_& ":
            out.append({"-": "−", "'": "′"}.get(char, char))
    return collections.Counter(out)


def math_signs(row):
    return collections.Counter(c for c in "".join(row.itertext()) if c not in " \u00a0\u2061")


def math_errors(math):
    tex = math.findtext(".//annotation")
    for e in math.iter():
        if e.tag in ARITY and len(e) != ARITY[e.tag]:
            yield "%s with %d children in %s" % (e.tag, len(e), tex)
        for child, parent in (("mtr", "mtable"), ("mtd", "mtr")):
            if e.tag == parent and {c.tag for c in e} != {child}:
                yield "%s holds other than %s in %s" % (parent, child, tex)
        if e.tag in ("mi", "mn", "mo", "mtext") and (len(e) or not e.text):
            yield "an empty %s, or one that holds elements, in %s" % (e.tag, tex)
    a, b = tex_signs(tex), math_signs(math.find("semantics")[0])
    if a != b:
        yield "the signs of %s are not those set: %s, %s" % (tex, dict(a - b), dict(b - a))
    widths = [len(r) for r in math.iter("mtr")]
    if "pmatrix" in tex and tex.count("pmatrix") == 2 and len(set(widths)) != 1:
        yield "a matrix with rows of %s cells: %s" % (widths, tex)


class Tags(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.names = []

    def handle_starttag(self, tag, attrs):
        self.names.append(tag)


def page_errors(text, root, folder):
    tags = Tags()
    tags.feed(text)
    lower = [e.tag.lower() for e in root.iter()]
    if tags.names != lower:
        yield "an HTML parser reads other elements than an XML parser"
    ids = collections.Counter(e.get("id") for e in root.iter() if e.get("id") is not None)
    for i, n in ids.items():
        if n > 1 or not re.fullmatch(r"[A-Za-z][\w.-]*", i):
            yield "the id %r stands %d times" % (i, n)
    for e in root.iter():
        for name, value in e.attrib.items():
            if name in ("href", "src", "action", "data", "xlink:href"):
                if value.startswith("#"):
                    if value[1:] not in ids:
                        yield "a link to %s, which is not there" % value
                elif re.fullmatch(r"[\w-]+\.tsv|\.\./(?:[\w-]+/)+[\w-]+\.(svg|md)", value):
                    if not (folder / value).is_file():
                        yield "a link to no file: " + value
                elif value not in ("audit.json", "audit.md", "audit.csv", "errata.md", "junit.xml", "claims.dot", "data:,"):
                    yield "a link out of the folder: " + value
            if name.startswith("on") or name == "style":
                yield "an attribute %s" % name
            if name == "for" and value not in ids:
                yield "a label for nothing: " + value
            if name == "aria-labelledby" and not set(value.split()) <= set(ids):
                yield "named by nothing: " + value
    if root.get("lang") != "en":
        yield "no language"
    scripts = list(root.iter("script"))
    styles = list(root.iter("style"))
    if len(scripts) != 1 or len(styles) != 1 + sum(len(list(s.iter("style"))) for s in root.iter("svg")):
        yield "%d scripts, %d style sheets" % (len(scripts), len(styles))
    if re.search(r"url\(|@import|https?:|fetch|XMLHttp|import\(", scripts[0].text + "".join(s.text for s in styles)):
        yield "the script or the style sheet loads something"
    levels = [int(e.tag[1]) for e in root.iter() if re.fullmatch("h[1-6]", e.tag)]
    if levels.count(1) != 1 or levels[0] != 1 or any(b > a + 1 for a, b in zip(levels, levels[1:])):
        yield "headings out of order: %s" % levels
    for t in root.iter("table"):
        if t.find("caption") is None or not "".join(t.find("caption").itertext()).strip():
            yield "a table without a caption"
        if any(not e.get("scope") for e in t.iter("th")) or t.find("thead") is None:
            yield "a table without heads, or a head without scope"
    for s in root.iter("svg"):
        told = [s.find(x) for x in ("title", "desc")]
        inside = all(e is not None and e.text and e.get("id") in s.get("aria-labelledby", "").split() for e in told)
        if s.get("aria-hidden") != "true" and not (s.get("role") == "img" and (s.get("aria-label") or inside)):
            yield "a picture without a name"
        clips = {e for c in s.iter("clipPath") for e in c}
        bare = [e for e in s.iter() if e.tag in ("path", "rect", "circle") and not e.get("fill") and e not in clips]
        if any(e.get("class") != "head" for e in bare):
            yield "a shape that is black where no style sheet is read"
    said = re.search(r"(?<![\w.,/-])1 (terms|points|orbits|trials|equations|unknowns|statements|claims|are)\b",
                     " ".join("".join(root.find("body").itertext()).split()))
    if said:
        yield "one in the plural: " + said[0]
    for e in root.iter("select"):
        if e.get("id") not in {x.get("for") for x in root.iter("label")}:
            yield "a choice without a label"
    for m in root.iter("math"):
        yield from math_errors(m)


def shown(s):
    """A string as the page shows it: what XML cannot hold is replaced, blanks are one."""
    s = re.sub(r"[\t\n\r]", " ", s)
    s = re.sub(r"[\x00-\x1f\x7f-\x9f\ufffe\uffff]", "\ufffd", s)
    return " ".join(s.split())


def plain(s):
    """Without what the page sets as a book does: lowered indices, Greek letters, primes, exponents, powers of ten."""
    signs = {"'": "\u2032", "+/-": "\u00b1", "-": "\u2212", "e": "\u00b7", "*": "\u22c5"}
    for name, letter in (GREEK | signs).items():
        s = s.replace(letter, name)
    s = re.sub(r"\^(\{?)(-?[0-9]+)(\}?)", lambda m: m[2] if len(m[1]) == len(m[3]) else m[0], s)
    return re.sub(r"\b10-", "1e-", s.replace("_", ""))


def claim_errors(root, audit):
    bodies = [b for b in root.iter("tbody") if b.get("class") == "claim"]
    rows = {}
    for b in bodies:
        cells = b.find("tr")
        rows[shown("".join(cells[0].itertext()))] = cells
    if len(bodies) != len(audit["claims"]):
        yield "%d rows for %d claims" % (len(bodies), len(audit["claims"]))
    for c in audit["claims"]:
        cells = rows.get(shown(c["id"]))
        if cells is None:
            yield "no row for %r" % c["id"]
            continue
        title = " ".join("".join(cells[1].itertext()).split())
        if "$" not in c["title"] and plain(title) != plain(shown(c["title"])):
            yield "%s: the title is %r, not %r" % (c["id"], title, shown(c["title"]))
        if not "".join(cells[2].itertext()).strip().startswith(c["verdict"]):
            yield "%s: another verdict" % c["id"]


def csv_errors(path, audit):
    with open(path, newline="", encoding="utf-8") as f:
        rows = list(csv.DictReader(f, strict=True))
    if [r["id"] for r in rows] != [re.sub(r"[\x00-\x09\x0b-\x1f\x7f]", " ", c["id"]) for c in audit["claims"]]:
        yield "audit.csv has other claims"
    for r, c in zip(rows, audit["claims"]):
        if None in r or None in r.values():
            yield "audit.csv: %s has not as many fields as the head" % c["id"]
        for name in ("title", "verdict", "quote", "printed", "effect"):
            text = re.sub(r"[\x00-\x09\x0b-\x1f\x7f]", " ", c[name] or "")
            marked = ["'" + text] if text[:1] in ("=", "@") else [text, "'" + text] if text[:1] in ("+", "-") else [text]
            if r[name] not in marked:
                yield "audit.csv: %s: %s is %r" % (c["id"], name, r[name])


def junit_errors(path, audit):
    suites = ET.parse(path).getroot()
    if [s.get("name") for s in suites] != ["claims", "controls", "routes"]:
        yield "junit.xml: other suites"
    for s in suites:
        found = (len(s), sum(c.find("failure") is not None for c in s), sum(c.find("skipped") is not None for c in s))
        if found != tuple(int(s.get(k)) for k in ("tests", "failures", "skipped")):
            yield "junit.xml: %s counts other than %s" % (s.get("name"), found)
    if len(suites[0]) != len(audit["claims"]):
        yield "junit.xml: %d cases for %d claims" % (len(suites[0]), len(audit["claims"]))


def main():
    folder = pathlib.Path(sys.argv[1])
    most_raw = int(sys.argv[2]) if len(sys.argv) > 2 else None
    text = (folder / "index.html").read_bytes().decode("utf-8")
    audit = json.loads((folder / "audit.json").read_bytes().decode("utf-8", "replace"), strict=False)
    errors = []
    if len(text.encode()) >= 3 << 20:
        errors.append("the page has %d bytes" % len(text.encode()))
    root = ET.fromstring(text)
    errors += page_errors(text, root, folder)
    errors += claim_errors(root, audit)
    if most_raw is not None:
        raw = [e.text for e in root.iter("code") if e.get("class") == "raw"]
        if len(raw) > most_raw or not list(root.iter("math")):
            errors.append("shown as TeX: %s" % raw)
    errors += csv_errors(folder / "audit.csv", audit)
    errors += junit_errors(folder / "junit.xml", audit)
    for e in errors[:40]:
        print(e)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
