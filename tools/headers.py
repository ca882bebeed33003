#!/usr/bin/env python3
"""Makes the man pages 3 of the library, man/stickslip-NAME.3, from include/stickslip/NAME.h: headers.py [--check].

A header's first comment is its description; then each comment stands below what is declared under it.  --check only
compares; exit status 1 when a page differs, is missing, or has no header."""
import pathlib
import re
import sys
import textwrap

HEADERS = pathlib.Path("include/stickslip")
PAGES = pathlib.Path("man")
# what is for the compiler alone
FRAME = re.compile(r"^(#ifndef|#define) SS_\w+_H\n|^#include .*\n|\n#endif\n\Z"
                   r"|^#if defined\(__GNUC__\)\n(.*\n){3}#endif\n"
                   r'|^#ifdef __cplusplus\n(extern "C" \{|\})\n#endif\n', re.M)


def escaped(line):
    """A line as mdoc has it."""
    line = line.replace("\\", r"\e").replace("-", r"\-")
    return r"\&" + line if line.startswith((".", "'")) else line


def comment_lines(comment):
    """A comment's lines without its marks and its indentation."""
    return [line[3:] if line.startswith("   ") else line for line in comment[3:-2].rstrip().split("\n")]


def literal(lines):
    return [".Bd -literal", *map(escaped, lines), ".Ed"]


def prose(comment):
    """Paragraphs; what is indented in the comment stays as it is."""
    out = []
    for paragraph in "\n".join(comment_lines(comment)).split("\n\n"):
        lines = paragraph.split("\n")
        if all(line.startswith(" ") for line in lines if line):
            out += literal(lines)
        else:
            text = " ".join(line.strip() for line in lines)
            sentences = re.sub(r"([a-z0-9)\"][.:;])  +", r"\1\n", text).split("\n")
            out += [".Pp", *(escaped(part) for line in sentences for part in textwrap.wrap(line, 110))]
    return out


def blocks(text):
    """What follows the header's first comment: each comment with the groups of declarations, between blank lines, under
    it."""
    comment = ""
    for part in re.split(r"(^/\*.*?\*/\n)", text, flags=re.S | re.M):
        if part.startswith("/*"):
            comment = part.strip()
        else:
            groups = part.replace("SS_API ", "").strip("\n").split("\n\n")
            yield comment, [group.split("\n") for group in groups if group]


def page(path):
    first, rest = re.match(r"(/\*.*?\*/)\n(.*)", path.read_text(), re.S).groups()
    name, idea = path.stem, re.split(r"(?<=[.:])\s", first[3:-2].strip() + " ")[0]
    functions = list(dict.fromkeys(re.findall(r"^SS_API [^(;]*?(ss_\w+)\(", rest, re.M)))
    out = [rf'.\" made by tools/headers.py from {path}', ".Dd November 23, 2026", f".Dt STICKSLIP-{name.upper()} 3",
           ".Os", ".Sh NAME"]
    names = [f"stickslip-{name}", *functions]
    out += [f".Nm {n} ," for n in names[:-1]] + [f".Nm {names[-1]}"]
    out += [".Nd " + escaped(" ".join(idea.split()).rstrip(".:")), ".Sh SYNOPSIS", f".In stickslip/{name}.h", ".Pp",
            ".Dl cc ... $(pkg\\-config \\-\\-cflags \\-\\-libs stickslip)", ".Sh DESCRIPTION", *prose(first)[1:]]
    for comment, groups in blocks(FRAME.sub("", rest)):
        out += literal(groups[0]) if groups else []
        out += prose(comment) if comment else []
        for group in groups[1:]:
            out += literal(group)
    others = sorted(h.stem for h in HEADERS.glob("*.h") if h != path)
    return "\n".join(out + [".Sh SEE ALSO", ".Xr stickslip 1 ,"] + [f".Xr stickslip-{o} 3 ," for o in others[:-1]]
                     + [f".Xr stickslip-{others[-1]} 3"]) + "\n"


def main():
    wanted = {PAGES / f"stickslip-{path.stem}.3": page(path) for path in sorted(HEADERS.glob("*.h"))}
    wrong = [path for path in PAGES.glob("*.3") if path not in wanted]
    wrong += [path for path, text in wanted.items() if not path.exists() or path.read_text() != text]
    if "--check" in sys.argv:
        for path in wrong:
            print(f"{path}: is not what the header says; run tools/headers.py")
        return int(bool(wrong))
    for path, text in wanted.items():
        path.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
