#!/usr/bin/env python3
"""Writes the parts of man/stickslip.1 that say what the program's own table says: manual.py PROGRAM [--check].

They stand between lines .\\" NAME: made by tools/manual.py and .\\" end of NAME, and are made from `PROGRAM help --table`.
--check only compares; exit status 1 when they differ."""
import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path("man/stickslip.1")


def rows(program):
    out = subprocess.run([program, "help", "--table"], check=True, capture_output=True, text=True).stdout
    return [line.split("\t") for line in out.splitlines()]


def prose(text):
    """A sentence a line, options in bold."""
    text = re.sub(r"(?<![\w-])--([a-z][a-z-]*)", lambda m: r"\fB\-\-" + m[1].replace("-", r"\-") + r"\fR", text)
    lines = re.sub(r"([.:;)])  +(?=\S)", r"\1\n", text).split("\n")
    return [("\\&" if line[0] in ".'" else "") + line for line in lines]


def words(item):
    """NAME... or --option VALUE, as macros."""
    out = []
    for word in item.split():
        out.append(f"Fl -{word[2:]}" if word.startswith("--") else f"{'Cm' if word.islower() and '.' not in word else 'Ar'} {word}")
    return " ".join(out)


def operands(text):
    """[X] is optional; an option takes the word behind it along."""
    for item in re.findall(r"\[[^\[\]]*\]|--\S+ \S+|\S+", re.sub(r"\[([,\w.]+)\]\.\.\.", r"[\1...]", text)):
        yield f".Op {words(item[1:-1])}" if item.startswith("[") else f".{words(item)}"


def of_command(table, command, what):
    return [r for r in table if r[0] == command and r[1].startswith(what)]


def synopsis(table):
    out = []
    for command, _, operand, _ in (r for r in table if r[1] == "usage"):
        out += [".Nm", f".Cm {command}"] + ([] if operand == "-" else list(operands(operand)))
        for _, name, value, _ in of_command(table, command, "--"):
            if name not in operand.split() and name != "--help":
                out.append(f".Op Fl -{name[2:]}" + ("" if value == "-" else f" {value_of(value)}"))
    return out + [".Nm", ".Cm help", ".Op Ar command", ".Nm", ".Fl -help | Fl -version"]


def value_of(value):
    """Alternatives stand apart: mdoc sets a bar between words."""
    return " | ".join(("Cm " if word.islower() else "Ar ") + word for word in value.split("|"))


def description(table):
    """What several commands say is said once, before them."""
    texts = [r[3] for r in table if r[1] == "text"]
    shared = [t for t in dict.fromkeys(texts) if texts.count(t) > 1]
    out = [line for t in shared for line in [".Pp", *prose(t)]] + [".Bl -tag -width Ds"]
    for command, _, _, _ in (r for r in table if r[1] == "usage"):
        own = [r[3] for r in of_command(table, command, "text") if r[3] not in shared]
        out.append(f".It Cm {command}")
        for n, text in enumerate(own):
            out += ([".Pp"] if n else []) + prose(text)
    return out + [".El"]


def options(table):
    """Each with the commands that take it so."""
    taken = {}
    for command, name, value, text in (r for r in table if r[1].startswith("--")):
        taken.setdefault((name, value, text), []).append(command)
    n_commands = sum(r[1] == "usage" for r in table)
    out = [".Bl -tag -width Ds"]
    for (name, value, text), commands in sorted(taken.items(), key=lambda item: item[0][0]):
        out.append(f".It Fl -{name[2:]}" + ("" if value == "-" else f" {value_of(value)}"))
        out += [f"({'every command' if len(commands) == n_commands else ', '.join(commands)})"] + prose(text)
    return out + [".El"]


def statuses(table):
    out = [".Bl -tag -width Ds"]
    for _, _, number, text in (r for r in table if r[1] == "status"):
        out += [f".It {number}"] + prose(text)
    return out + [".El"]


def examples(table):
    return [".Dl " + r[3] for r in table if r[1] == "example"]


def main():
    table, text = rows(sys.argv[1]), PAGE.read_text()
    new = text
    for make in (synopsis, description, options, statuses, examples):
        begin, end = f'.\\" {make.__name__}: made by tools/manual.py\n', f'.\\" end of {make.__name__}\n'
        head, rest = new.split(begin)
        new = head + begin + "\n".join(make(table)) + "\n" + end + rest.split(end)[1]
    if "--check" in sys.argv:
        if new != text:
            print(f"{PAGE}: says other than the program; run tools/manual.py {sys.argv[1]}")
        return int(new != text)
    PAGE.write_text(new)
    return 0


if __name__ == "__main__":
    sys.exit(main())
