"""documents.py PROGRAM CHECKER FILE[@WORDS]...: type every command of the documents, each in a folder of its own; of a file
with @WORDS those before the first line that begins so.


A command is a line indented by four blanks that begins with build/stickslip, with a variable set for it, or with cp; what
follows at least two blanks and "#" is a comment, and says "exit status N" where that is not 0.  A block of code whose first
line is "# NAME.scene" or "# NAME.eq", behind which words may follow, is the file NAME.  build/stickslip is PROGRAM there,
build/stickslip-checker is CHECKER, and /tmp the folder itself.  make and compilers are left to other tests.  A command that an
earlier document had typed is not typed again, unless it reads a file of this document's folder; what it would have written is
then not there for those that follow.  A plane is drawn with 3 values a side, and a scene of the document's own that is
asked everything is asked of two claims, unless STICKSLIP_TESTS=all in the environment.  One line for each error; then
how many commands ran.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile


def blocks(text):
    """Files that a document has its reader write."""
    for body in re.findall(r"^```\w+\n(.*?)^```", text, re.M | re.S):
        name = re.match(r"# ([\w-]+\.(?:scene|eq))\b", body)
        if name:
            yield name[1], body


def commands(text):
    for line in re.sub(r"^ *```.*?^ *```", "", text, flags=re.M | re.S).splitlines():
        if not re.match(r"    (?:[A-Z_]+=\S+ )?(?:build/stickslip|cp) ", line):
            continue
        command, _, comment = line.strip().partition("  #")
        status = re.search(r"exit status (\d)", comment)
        yield command.strip(), int(status[1]) if status else 0


GIVEN = ("verify", "tests", "examples", "build", "reports")


def typed_here(command, folder):
    """The same, or with less to do."""
    if os.environ.get("STICKSLIP_TESTS") == "all":
        return command
    scene = re.match(r"build/stickslip verify (\w+\.scene) --out ", command)
    if scene and "\nask:" not in pathlib.Path(folder, scene[1]).read_text(encoding="utf-8"):
        command += " --only eq-14,num-t_a"
    return re.sub(r"(--over \w+=[^ :]+:[^ :]+)(?= )", r"\1:3", command) if " plot " in command else command


def reads_a_file(command, folder):
    """Whether it names one that the document had its reader write, or that a command before it wrote."""
    words = re.sub(r"--out \S+", "", command).replace("/tmp/", "").split()
    return any(pathlib.Path(folder, word).exists() for word in words if word.split("/")[0] not in GIVEN)


def main():
    program, checker, root, n, failed, typed = sys.argv[1], sys.argv[2], pathlib.Path.cwd(), 0, 0, set()
    for path in sys.argv[3:]:
        path, _, words = path.partition("@")
        text = pathlib.Path(path).read_text(encoding="utf-8")
        if words:
            text = text[:text.index("\n" + words)]
        with tempfile.TemporaryDirectory() as folder:
            for name in GIVEN[:3]:
                pathlib.Path(folder, name).symlink_to(root / name)
            pathlib.Path(folder, "build").mkdir()
            for name, to in (("stickslip", program), ("stickslip-checker", checker)):
                pathlib.Path(folder, "build", name).symlink_to((root / to).resolve())
            subprocess.run(["cp", "-R", "reports", folder], check=True)
            for name, body in blocks(text):
                pathlib.Path(folder, name).write_text(body, encoding="utf-8")
            for command, status in commands(text):
                if (command, status) in typed and not reads_a_file(command, folder):
                    continue
                typed.add((command, status))
                shown = typed_here(command, folder).replace("/tmp/", folder + "/")
                done = subprocess.run(["bash", "-o", "pipefail", "-c", shown], cwd=folder, capture_output=True, text=True,
                                      check=False)
                n += 1
                if done.returncode != status:
                    failed = 1
                    print("%s: %s: exit status %d, not %d\n%s" % (path, command, done.returncode, status, done.stderr))
    print("%d commands" % n)
    return failed


if __name__ == "__main__":
    sys.exit(main())
