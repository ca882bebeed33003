"""typed.py PROGRAM TEST...: what a person at a terminal meets: colours where they are wanted, lines that fit, progress, completion;
and that the program reads every block of the documents.  A test is a function of this file, as in said.py.
"""
import os
import re
import shutil
import subprocess
import sys

from said import FOLDER, ORACLE, PROGRAM, check, rows, said, same

CASES = os.path.join(ORACLE, "..", "cases")


def shell(line, status=0, **where):
    """What a line of shell prints, as it is printed."""
    r = subprocess.run(line, shell=True, stdout=subprocess.PIPE, **where)
    check(r.returncode == status, line, "ends with", r.returncode)
    return r.stdout.decode()


def on_a_terminal(settings, words):
    return shell('"%s" %s/terminal.py %s -- "%s" %s' % (sys.executable, ORACLE, settings, PROGRAM, words))


def in_folder(name):
    return os.path.join(FOLDER.name, name)


# --- Colours and tables ---

def colours_only_where_they_are_wanted():
    """Without its colours the text is the same, and the last line, the contract's, is all that is said quietly."""
    audit = "verify paper --only eq-14,eq-29,eq-52 --out '%s'" % in_folder("r")
    plain = shell('TERM=xterm "%s" %s' % (PROGRAM, audit), stderr=subprocess.STDOUT)
    check("\033" not in plain and "\r" not in plain, plain)
    last = plain[plain.index("\npaper: 4 statements: ") + 1:]
    check(last.endswith("as recorded\n") and last.count("\n") == 1, last)
    for settings, colours in [("TERM=xterm NO_COLOR=", True), ("TERM=xterm-256color NO_COLOR=", True), ("TERM=dumb NO_COLOR=", False),
                              ("TERM= NO_COLOR=", False), ("TERM=xterm NO_COLOR=1", False), ("TERM=xterm NO_COLOR=0", False)]:
        text = on_a_terminal(settings, audit).split("\033[K")[-1]  # progress comes first, and wipes itself away
        check(not colours or "\033[1;31mrefuted\033[0m     eq-29 " in text, settings, text)
        same(text.count("\033[0m") * 2, text.count("\033["), settings)
        same(re.sub("\033[^m]*m", "", text) if colours else text, plain, settings)
    same(on_a_terminal("TERM=xterm NO_COLOR=1", audit + " --quiet"), last)


def what_fails_is_shown_worst_first():
    """verify --only shows what is wrong, what shows it and what mends it, in order of consequence (paper.roots), and where the
    report is; the numbers are those of the certificate in audit.json."""
    text = said("verify", "--only", "eq-36b,eq-40,num-t_a", "--out", in_folder("r"))
    at = 0
    for part in ("refuted     num-t_a t_a = 0.6784", "printed = 0.6784, unit = 1/10000", "correction  t_a = 0.5323 (proved)\n",
                 "conditional eq-40   J_f is", "\n                    holds when  V = 1\n",
                 "entry = [1,3], left = 0.2473125776, right = 0.4675753421\n",
                 "correction  ktilde_4 := V*sin(omega*t_d)/(omega*(z_200 - z_100)) (proved)\n", "refuted     eq-36b  the indices",
                 "wrong       a slip of notation", "\nsection ", "\nwritten to %s\npaper: " % in_folder("r")):
        check(part in text[at:], part, "is not in its place in", text)
        at = text.index(part, at)


def explain_has_colours():
    """What explain marks is coloured like the verdicts of verify, and nothing else."""
    plain = said("explain", "eq-29")
    check(not re.search("[\001-\005\033]", plain), plain)
    same(on_a_terminal("TERM=xterm NO_COLOR=1", "explain eq-29"), plain)
    text = on_a_terminal("TERM=xterm NO_COLOR=", "explain eq-29")
    for part in ("\nverdict     \033[1;31mrefuted\033[0m (on record", "\ndouble left  \033[1;31m", "*\033[0m  1.0000000000000000\n"):
        check(part in text, part, "is not in", text)


def orbits_and_motions_are_tables():
    """That a person can read: every number says what it is, and columns stand under each other."""
    lines = said("orbit", "paper", "--digits", 30).split("\n")
    column = next(x.index("position of m_1") for x in lines if "position of m_1" in x)
    for part in ("duration of the global stick", "of the slip-stick", "tr J: ", "least static friction", "the same of m_2; besides, u_r2 > e2"):
        same(next((x.index(part) for x in lines if part in x), None), column, part)
    text = said("simulate", "paper", "--at", "orbit:2")
    check("lengths in one unit" in text and "\n          t mass change" in text, text)


def lines_fit_the_terminal():
    """With the same words: those that are wider elsewhere are broken at blanks."""
    for command, width, alike in rows(os.path.join(CASES, "terminal_lines.tsv")):
        text, wide = on_a_terminal("NO_COLOR=1 COLUMNS=" + width, command), shell('"%s" %s' % (PROGRAM, command))
        lines = text.splitlines()
        check(" \n" not in text and len(lines) > 15, command, len(lines), "lines, or blanks at the end of one")
        for line in lines:
            check(0 < len(line.encode()) <= int(width), command, width, line)
        check(width == "130" or any(len(x.encode()) > int(width) for x in wide.splitlines()), command, width, "nothing to break")
        if alike == "yes":
            same(re.sub("[ \n]", "", text), re.sub("[ \n]", "", wide), command, width)


def a_sweep_tells_how_long():
    """Who waits at a terminal is told how far it is and how long it takes."""
    text = on_a_terminal("TERM=xterm", "sweep paper --jobs 1 --over e1=2:4:20 --over e2=0.5:3:300 --search-every 1 --csv '%s'" % in_folder("rows"))
    check(text.index(" left\r\033[K") - text.index("\r\033[K[") > 10, text[:300])


def progress_has_one_total():
    """So is who waits for other commands: by one total from the beginning to the end, never more than it, and nothing where standard
    error is no terminal (there with less to do)."""
    for command, elsewhere in [
            ("mutate --count 2 --only 4-stability.eq --out $D", "mutate --count 2 --only title --out $D"),
            ("repair eq-10 eq-31 --out $D", "repair eq-10 --out $D"),
            ("stability lambda_2 Gamma --quick --out $D", "stability lambda_2 --quick --out $D"),
            ("bifurcate beside-wall --along V=0.99:1.01", "bifurcate paper --along e2=0.85:0.86"),
            ("orbit chain3", "orbit beside-wall"), ("simulate chain3", "simulate beside-wall"),
            ("verify --only eq-52,num-t_a --out $D", "verify --only eq-52,num-t_a --out $D")]:
        command, elsewhere = (x.replace("$D", "'%s'" % in_folder("p")) for x in (command, elsewhere))
        shown = re.findall(r"\r\033\[K\[(.*?)\]", on_a_terminal("TERM=xterm", command))
        check(shown and all(re.fullmatch(r"\d+/\d+", x) for x in shown), command, shown)
        done, of = zip(*[map(int, x.split("/")) for x in shown])
        check(list(done) == sorted(done) and done[-1] <= of[0] and len(set(of)) == 1, command, shown)
        same(shell('"%s" %s 2>&1 >/dev/null' % (PROGRAM, elsewhere)), "", elsewhere)


# --- Completion ---

def offered(line):
    """What bash offers for the line, a word a line."""
    script = in_folder("try.bash")
    with open(script, "w", encoding="utf-8") as f:
        f.write("source tools/completion.bash\nCOMP_LINE=$1 COMP_POINT=${#1} COMP_WORDBREAKS=$' \\t\\n=:'\n"
                "read -ra COMP_WORDS <<< \"$1\"\n[[ $1 == *' ' ]] && COMP_WORDS+=('')\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                "_stickslip\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n")
    r = subprocess.run(["bash", script, "%s %s" % (PROGRAM, line)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    check(r.returncode == 0, line, r.stdout)
    return r.stdout


def bash_completes():
    for line, words in rows(os.path.join(CASES, "completion.tsv")):
        same(offered(line), words.replace("\\n", "\n"), line)


def other_shells_complete():
    """zsh and fish ask the same file as a command; where they are installed, they are tried."""
    with open(in_folder("try.zsh"), "w", encoding="utf-8") as f:
        f.write("compadd() { while [[ $1 != -- ]]; do shift; done; shift; (( $# )) && print -l -- $@; }\n"
                "words=(${(s: :)LINE}) CURRENT=$#words\nsource %s\n" % in_folder("c.zsh"))
    for name in ("zsh", "fish"):
        with open("tools/completion." + name, encoding="utf-8") as f, open(in_folder("c." + name), "w", encoding="utf-8") as out:
            out.write(f.read().replace("@COMPDIR@/stickslip", os.path.abspath("tools/completion.bash")))
    for line, words in [("orb", "orbit\n"), ("orbit paper --set et", "eta=\n"), ("verify --only eq-60", "eq-60\neq-60b\n")]:
        same(shell("bash tools/completion.bash %s %s 2>&1" % (PROGRAM, line)), words, line)
        if shutil.which("zsh"):
            same(shell('LINE="%s %s" zsh -f %s 2>&1' % (PROGRAM, line, in_folder("try.zsh"))), words, "zsh", line)
        if shutil.which("fish"):
            same(shell("PATH=%s:$PATH fish --no-config -c \"source %s; complete -C 'stickslip %s'\" 2>&1"
                       % (os.path.dirname(os.path.realpath(PROGRAM)), in_folder("c.fish"), line)), words, "fish", line)


def what_is_offered_is_known():
    """Every option that is offered belongs to its command."""
    tried = 0
    for command in offered("").split("\n"):
        for option in offered(command + " --").split("\n") if command and command[0] != "-" else []:
            if option:
                r = subprocess.run([PROGRAM, command, option + "=x=y", "--no-such"], capture_output=True, text=True)
                check(r.returncode == 2 and "belong" not in r.stderr and (option not in r.stderr or "takes no value" in r.stderr),
                      command, option, r.stderr)
                tried += 1
    check(tried > 40, tried)


# --- Documents ---

def documents_hold_what_the_program_reads():
    """Each block that begins with ``` and a kind of file, less its indentation, is checked, or refused where it says so."""
    refused = 0
    for name, least, wrong in [("language", 7, 4), ("scenes", 7, 0), ("another-paper", 1, 0)]:
        blocks, body = 0, None
        with open("docs/%s.md" % name, encoding="utf-8") as f:
            lines = f.readlines()
        for line in lines:
            mark = line.find("```")
            if mark >= 0 and body is None:
                indent, head, body = mark, line[mark + 3:].split(), ""
                check(head, name, "a block of no kind")
            elif mark >= 0:
                path = in_folder("block." + head[0])
                with open(path, "w", encoding="utf-8") as f:
                    f.write(body)
                r = subprocess.run([PROGRAM, "check", path], capture_output=True, text=True)
                same(r.returncode, 3 if head[1:] == ["refused"] else 0, name, body, r.stderr)
                blocks, refused, body = blocks + 1, refused + (head[1:] == ["refused"]), None
            elif body is not None:
                body += line[indent if len(line) > indent else 0:]
        check(blocks >= least and refused >= wrong, name, blocks, "blocks,", refused, "refused")


for test in sys.argv[2:]:
    globals()[test]()
