#!/usr/bin/env python3
"""Puts into a notebook what its cells print, run in their order: notebook.py FILE; the tests hold the two against each
other.

What the cell with matplotlib prints or draws is not kept."""
import contextlib
import io
import json
import pathlib
import sys


def run(cells):
    """What each prints."""
    names, said = {"__name__": "__main__"}, []
    for cell in cells:
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec("".join(cell["source"]), names)
        said.append(out.getvalue())
    return said


def kept(cell):
    return "matplotlib" not in "".join(cell["source"])


def differences(cells, said):
    """Cells that print other than they show, with both."""
    shown = ["".join(line for output in cell["outputs"] for line in output["text"]) for cell in cells]
    return [(cell["id"], s, t) for cell, s, t in zip(cells, shown, said, strict=True) if kept(cell) and s != t]


def main():
    path = pathlib.Path(sys.argv[1])
    book = json.loads(path.read_text())
    cells = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    for cell, said in zip(cells, run(cells)):
        if kept(cell):
            cell["outputs"] = [{"name": "stdout", "output_type": "stream", "text": said.splitlines(keepends=True)}]
    path.write_text(json.dumps(book, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
