"""The messages of the program that no test has reached: tools/untested.py BUILD, where BUILD holds what `make cover` has built and run.

A message is a call of one of the functions below on a line of src/.  It is reached when every basic block of the line was: a line
may ask and complain at once.  Those that no test can reach are listed in tests/unreached.tsv, each with why; exit status 1 when
the two lists differ."""
import collections
import gzip
import json
import pathlib
import re
import subprocess
import sys
import tempfile

CALL = re.compile(r"\b((diag_set|diag_at|usage|fail|fail_[a-z]+|failed|complain\w*|claim_error|constant_complain|wrong|not_an_audit"
                  r"|unknown|undefined|give_up)\(|fprintf\(stderr|fputs\([^;]*stderr)")
KNOWN = pathlib.Path("tests/unreached.tsv")


def statement(text, at):
    """From line `at` (from 0) to the end of the statement."""
    out = ""
    for line in text[at:at + 12]:
        out += " " + line.strip()
        if line.rstrip().endswith((";", "{", "}")):
            break
    return " ".join(out.split())


def is_message(text, at):
    """A call with words in it; not the definition of a function, which begins in the first column."""
    if not CALL.search(text[at]) or not text[at].startswith(" ") or re.match(r"\s*\*|\s*/\*", text[at]):
        return False
    words = statement(text, at)
    called = words[CALL.search(words).start():]
    return '"' in called and r"\r\033[K" not in called  # the line of progress on a terminal


def reached_lines(build):
    """{file: {line: whether all of it was reached}}, by any of the programs."""
    reached = collections.defaultdict(dict)
    data = sorted(pathlib.Path(build).rglob("*.gcda"))
    with tempfile.TemporaryDirectory() as folder:
        for one in data:
            subprocess.run(["gcov", "--json-format", "--object-directory", str(one.parent.resolve()), str(one.resolve())],
                           cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for path in pathlib.Path(folder).glob("*.gcov.json.gz"):
                report = json.loads(gzip.decompress(path.read_bytes()))
                path.unlink()
                for f in report["files"]:
                    lines = reached[f["file"]]
                    for line in f["lines"]:
                        whole = line["count"] > 0 and not line["unexecuted_block"]
                        lines[line["line_number"]] = lines.get(line["line_number"], False) or whole
    return reached


def main():
    untested, messages = [], 0
    reached = reached_lines(sys.argv[1])
    for path in sorted(pathlib.Path("src").rglob("*.c")):
        text = path.read_text().splitlines()
        lines = reached.get(str(path), {})
        for at in range(len(text)):
            if not is_message(text, at) or path.name == "sweep_mpi.c":
                continue
            messages += 1
            if not lines.get(at + 1, False):
                untested.append((str(path), at + 1, statement(text, at)))
    known = dict(line.split("\t", 1) for line in KNOWN.read_text().splitlines() if line and not line.startswith("#"))
    print(f"{messages} messages, {len(untested)} that no test has reached")
    new, used = 0, set()
    for path, line, words in untested:
        keys = [k for k in known if k.split(": ", 1)[0] == path and k.split(": ", 1)[1] in words]
        used.update(keys)
        if not keys:
            new += 1
            print(f"{path}:{line}: {words}")
    print(f"{new} of them without a reason in {KNOWN}")
    reached_after_all = [k for k in known if k not in used]
    for k in reached_after_all:
        print(f"{KNOWN}: reached, or no message: {k}")
    return 1 if new or reached_after_all else 0


if __name__ == "__main__":
    sys.exit(main())
