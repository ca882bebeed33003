#!/usr/bin/env python3
"""Prints the digest of a text's tokens as src/quote/quote.h describes them, by regular expressions alone.

usage: quotes.py FILE"""
import hashlib
import re
import sys

TAG = r"\\q?quad\s*\((\d+)\)(?=\s*\$\$)"
DROPPED = r"\\q?quad(?![A-Za-z])|\\(?:left|right)(?![A-Za-z])|\\[,:;! ]|\\[()\[\]]|\s|\$|~"
KEPT = r"\\[A-Za-z]+|\\.|[0-9]+(?:\.[0-9]+)*|."
SCAN = re.compile(rf"(?P<tag>{TAG})|(?P<drop>{DROPPED})|\\(?P<what>begin|end)\{{(?P<env>[^}}]*)\}}"
                  rf"|(?P<cell>&|\\\\)|(?P<star>(?<![\^{{])\*)|(?P<keep>{KEPT})", re.DOTALL)


def lines(text):
    counts = []
    for m in SCAN.finditer(text):
        if m["tag"]:
            yield f"({m[2]})"
        elif m["what"]:
            layout = m["env"] in ("aligned", "cases")
            if m["what"] == "begin":
                counts.append(not layout)
            elif counts:
                counts.pop()
            if not layout:
                yield m[0]
        elif m["keep"] or (m["cell"] and counts and counts[-1]):
            yield m[0]


text = open(sys.argv[1], encoding="utf-8").read()
print("sha256", hashlib.sha256("".join(f"{x}\n" for x in lines(text)).encode()).hexdigest())
