"""said.py PROGRAM TEST...: what `PROGRAM orbit`, `jacobian` and `simulate` print, held against orbits.tsv and jacobian.tsv; what
`explain` and the help say; that every scene on file is proved.

Numbers are rounded here to the digits asked for, and compared as strings.  A test is a function of this file; the first thing that
is not as it should be ends it with a sentence and status 1.
"""
import decimal
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

ORACLE = os.path.dirname(os.path.abspath(__file__))
PROGRAM, FOLDER = sys.argv[1], tempfile.TemporaryDirectory()
NAMES = ["z10", "z20", "t_a", "t_b", "t_c", "t_d", "period", "trace", "u_r1_min", "u_r2_min"]  # in the order of orbits.tsv
PARAMETERS = ["chi", "eta", "V", "e1", "e2"]


def check(good, *what):
    if not good:
        sys.exit(" ".join(map(str, what)) or "wrong at line %d" % sys._getframe(1).f_lineno)


def same(got, want, *what):
    check(got == want, *what, "is", got, "not", want)


def near(got, want, within, *what):
    check(abs(float(got) - float(want)) <= within, *what, "is", got, "not", want)


def rounded(exact, digits):
    """A decimal, or a quotient of two, rounded to nearest in the notation that num.h promises."""
    top, _, den = exact.partition("/")
    with decimal.localcontext() as c:
        c.prec = 2 * digits + len(exact) + 50
        x = decimal.Decimal(top) / decimal.Decimal(den or 1)
        c.prec = digits
        x = +x
    sign, d, e = "-" if x < 0 else "", "".join(map(str, x.as_tuple().digits)).ljust(digits, "0"), x.adjusted()
    if e < -6 or e >= max(digits, 21):
        return "%s%s%se%+d" % (sign, d[0], "." + d[1:] if digits > 1 else "", e)
    if e < 0:
        return sign + "0." + "0" * (-e - 1) + d
    return sign + (d[:e + 1] + "." + d[e + 1:] if e + 1 < digits else d.ljust(e + 1, "0"))


class Set:
    """Parameters, and of their orbits the numbers, whether each is admissible, and what it breaks."""

    def __init__(self, fields):
        self.name, self.given, self.n, self.orbits = fields[0], dict(zip(PARAMETERS, fields[1:])), int(fields[6]), []

    def scene(self):
        return scene(self.name, **self.given)


class Orbit:
    def __init__(self, of, fields):
        self.set, self.at, self.number = of, "orbit:%d" % (int(fields[1]) + 1), dict(zip(NAMES, fields[2:]))
        self.admissible, self.violations = fields[12] == "yes", [] if fields[13] == "-" else fields[13].split(",")
        self.trace = float(self.number["trace"])


def rows(name):
    with open(os.path.join(ORACLE, name), encoding="utf-8") as f:
        return [line.rstrip("\n").split("\t") for line in f if not line.startswith("#")]


def sets():
    out = []
    for kind, *fields in rows("orbits.tsv"):
        if kind == "set":
            out.append(Set(fields))
        else:
            same(fields[0], out[-1].name)
            out[-1].orbits.append(Orbit(out[-1], fields))
    return {s.name: s for s in out}


SETS = sets()
ORBITS = [o for s in SETS.values() for o in s.orbits]


def returns():
    """The derivatives of one pass in jacobian.tsv: (orbit, its four entries)."""
    entries = {}
    for name, index, matrix, _, _, value in rows("jacobian.tsv"):
        if matrix == "return":
            entries.setdefault((name, int(index)), []).append(value)
    return [(SETS[name].orbits[index], four) for (name, index), four in entries.items()]


def scene(name, *lines, **given):
    path = os.path.join(FOLDER.name, name + ".scene")
    with open(path, "w", encoding="utf-8") as f:
        f.write("title: %s\n" % name + "".join("%s = %s\n" % pair for pair in given.items()) + "".join(x + "\n" for x in lines))
    return path


def said(*words):
    """What the program prints, which goes well and complains of nothing."""
    r = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    check(r.returncode == 0 and not r.stderr, *words, "status", r.returncode, r.stderr[:1500])
    return r.stdout


def answer(*words):
    return json.loads(said(*words, "--json"))


def every(n):
    """The stride through cases of which every n-th will do in make check."""
    return 1 if os.environ.get("STICKSLIP_TESTS") == "all" else n


def entries(jacobian):
    return [x for row in jacobian["J"] for x in row]


# --- orbit ---

def the_own_rounding():
    for exact, digits, want in [("2.7844", 15, "2.78440000000000"), ("-0.0000012345678", 3, "-0.00000123"),
                                ("-0.00000012345678", 3, "-1.23e-7"), ("28/9", 5, "3.1111"), ("9.9996", 4, "10.00"),
                                ("143.54", 3, "144"), ("143.54", 1, "100"), ("1e30", 2, "1.0e+30")]:
        same(rounded(exact, digits), want)


def check_orbits(out, of, digits):
    """Every orbit of a set and no other, in the order of the data, which is that of z10."""
    same([out[k] for k in ("scene", "layer", "complete", "gap", "t_c_max")], [of.name, "model", True, None, None], of.name)
    same(len(of.orbits), of.n, of.name)
    same(len(out["orbits"]), of.n, of.name, "number of orbits")
    for got, want in zip(out["orbits"], of.orbits):
        where = "%s, %s:" % (of.name, want.at)
        for k in NAMES:
            same(got[k], rounded(want.number[k], digits), where, k)
        for k in ("e1", "e2"):
            same(got[k], rounded(of.given[k], digits), where, k)
        same(got["eigenvalues"], ["0", rounded(want.number["trace"], digits)], where)
        same(got["stable"], -1 < want.trace < 1, where, "stable")
        same(got["admissible"], want.admissible, where, "admissible")
        same(got["violations"], want.violations, where)
        same(got["certified"], True, where, "certified")
        check(0 < float(got["radius"]) < 10.0 ** (3 - digits), where, "radius", got["radius"])


def orbits_of_every_set():
    check(len(SETS) >= 30, len(SETS), "sets")
    for s in SETS.values():
        check_orbits(answer("orbit", s.scene(), "--digits", 50), s, 50)


def digits_as_asked():
    for digits in (1, 2, 7, 15, 50):
        check_orbits(answer("orbit", "paper", "--digits", digits), SETS["paper"], digits)
    same(said("orbit", "--digits=15", "--json", "paper"), said("orbit", "paper", "--json"))


def a_thousand_digits():
    second = answer("orbit", "paper", "--digits", 1000)["orbits"][1]
    numbers = rows("paper_1000.tsv")
    same(len(numbers), 6)
    for name, exact in numbers:
        same(second[name], rounded(exact, 1000), name)


def solution_ii_has_three_phases():
    """t_a = 0 and the three phases Gamma-H-C; times and e1 of words.tsv."""
    row = next(x for x in rows("words.tsv") if x[0] == "solution-ii")
    text = said("orbit", scene("two", "word: Gamma H C", chi="0.8", eta="1", V="1", t_a="0", e2="0.8587"), "--digits", 25)
    for name, want in zip(("t_b", "t_c", "t_d", "e1"), row[9].split()[:3] + [row[5]]):
        check("  %-8s %.22s" % (name, want) in text, name, want, "is not in", text)


def scenes_on_file_are_proved():
    """Every scene on file has a list proved complete and orbits that are certified, to 30 digits, but for those below, and for lists
    of other words than the paper's, whose search is not exhaustive and says so; of these the checker verifies the one orbit that each
    has.  It verifies every certificate, which all have but those whose orbits break the word, and solution II, where the masses
    never stick together.  The longer chains, which take more time than all the others, are for make long."""
    incomplete = ["solution-II"] + ["paper-" + x for x in ("e1-t_a", "e1-t_c", "e2-t_a", "t_a-t_b", "t_c-t_d")]
    scenes, proved, verified, ones = glob.glob("verify/scenes/*.scene"), 0, 0, 0
    check(len(scenes) >= 25, len(scenes), "scenes")
    for path in sorted(scenes):
        name, certificate = os.path.basename(path)[:-6], os.path.join(FOLDER.name, "certificate.json")
        if every(2) == 2 and name in ("chain4", "chain5"):
            continue
        with open(path, encoding="utf-8") as f:
            text = f.read()
        if os.path.exists(certificate):
            os.remove(certificate)
        r = subprocess.run([PROGRAM, "orbit", path, "--digits", "30", "--json", "--certificate", certificate],
                           capture_output=True, text=True)
        out, there = r.stdout, os.path.exists(certificate)
        if there:
            check(r.returncode == 0 and not r.stderr, name, r.stderr)
        else:
            check("--certificate is of" in r.stderr or "there is no certificate" in r.stderr, name, r.stderr)
            out = said("orbit", path, "--digits", 30, "--json")
        if '"system": ' in out:
            check("there may be others" in out, name, out[:300])
        elif '"fate": "open"' in out:
            check("no proof of completeness" in out, name, out[:300])
        else:
            same('"complete": true' in out, name not in incomplete, name, "complete")
            check(name not in incomplete or "no complete search for this pair of given quantities" in out, name, out[:300])
        check('"certified": false' not in out, name, "is not certified")
        proved += out.count('"certified": true')
        if there:
            r = subprocess.run([PROGRAM + "-checker", certificate], capture_output=True, text=True)
            check(r.returncode == 0, name, r.stdout, r.stderr)
            verified += 1
        if "\nsystem: " in text or ("\nword: " in text and "\nword: Gamma H C\n" not in text):
            same(there and r.stdout, "verified: 1 orbit; whether there are others is not checked\n", name)
            ones += 1
    more = 0 if every(2) == 2 else 2
    check(proved >= 33 + more and verified >= 34 + more and ones >= 7 + more, proved, verified, ones)


# --- jacobian ---

def three_methods_agree_with_differences_made_elsewhere():
    check(len(returns()) >= 4, len(returns()), "maps")
    for k, (orbit, want) in enumerate(returns()):
        digits = (30, 38, 15)[k % 3]
        for method in ("analytic", "implicit", "fd"):
            out = answer("jacobian", orbit.set.scene(), "--at", orbit.at, "--method", method, "--digits", digits)
            where = orbit.set.name, orbit.at, method
            same(entries(out), [rounded(x, digits) for x in want], *where)
            same(out["trace"], rounded(orbit.number["trace"], digits), *where)
            same((out["det"], out["method"], out["at"]), ("0", method, orbit.at), *where)
            same(out["layer"], "corrected" if method == "analytic" else "model", *where)


def layers_differ_in_the_entries_not_in_the_trace():
    """ktilde_4 as printed is V^-2 of what it should be.  It moves x_f and y_f alike, and tr J sees their difference alone: so where
    V is not 1 every entry is wrong and the trace is right; where V = 1 all are right."""
    for name, right, at in [("paper", True, "orbit:2"), ("stable", False, "orbit:1")]:  # the first admissible one
        printed = answer("jacobian", SETS[name].scene(), "--layer", "printed", "--digits", 20)
        corrected = answer("jacobian", SETS[name].scene(), "--digits", 20)
        same([x == y for x, y in zip(entries(printed), entries(corrected))], [right] * 4, name)
        same(printed["trace"], corrected["trace"], name)
        same((printed["layer"], corrected["layer"], printed["at"]), ("printed", "corrected", at), name)


def at_the_printed_numbers():
    """J_a = (-1, 1)/(1 - chi) stands at the right end of every chain: the columns of J are opposite."""
    for method in ("analytic", "implicit", "fd"):
        out = answer("jacobian", "paper", "--at", "printed", "--method", method)
        for left, right in out["J"]:
            check(left.lstrip("-") == right.lstrip("-") and left != right, method, left, right)
        same((out["at"], out["det"]), ("printed", "0"), method)


def every_method_states_its_accuracy():
    """"accuracy 2.4e-11 (...)" stands in the text of every method, and the entries are as near as it says."""
    want = next(four for orbit, four in returns() if orbit.set.name == "paper")
    same(next(orbit.at for orbit, four in returns() if orbit.set.name == "paper"), "orbit:2")
    for method, most in {"analytic": 1e-15, "implicit": 1e-15, "saltation": 1e-15, "fd": 1e-15, "fd-double": 1e-9,
                         "ode": 1e-7}.items():
        lines = said("jacobian", "paper", "--at", "orbit:2", "--method", method).split("\n")
        stated = next(float(m.group(1)) for m in (re.match(r"accuracy (\S+) \([a-z]", x) for x in lines) if m)
        check(0 < stated < most, method, stated)
        got = lines[1].split() + lines[2].split()
        same(len(got), 4, method)
        for x, exact in zip(got, want):
            near(x, exact, stated + 0.51 * 10.0 ** -len(x.split(".")[1]), method)


def the_table_of_phases():
    """Every method once, a row for each entry, and a star and a sentence where the printed (40) departs: at V = 2 in all of J_f
    and J."""
    text = said("jacobian", scene("two", chi="0.59", eta="3.1", V="2", e1="3.54", e2="0.0657"), "--phases")
    right = ["J_a[1,1]", "J_a[1,2]", "J_b[1,1]", "J_b[2,1]"] + ["J_c[%d,%d]" % (i, j) for i in (1, 2, 3) for j in (1, 2)]
    wrong = ["J_f[%d,%d]" % (i, j) for i in (1, 2) for j in (1, 2, 3)] + ["J[%d,%d]" % (i, j) for i in (1, 2) for j in (1, 2)]
    for name in right + wrong:
        row = next((x for x in text.split("\n") if x.startswith(name + " ")), None)
        check(row, "no row", name, "in", text)
        same(row.count("*"), int(name in wrong), row)
        x = [float(y.rstrip("*")) for y in row.split()[1:8]]
        check(len(x) == 7 and (row.split()[1][-1] == "*") == (name in wrong) and len(row) - len(name) - 1 <= 110, row)
        check(all(abs(y - x[1]) < 1e-6 for y in x[2:]) and (abs(x[0] - x[1]) > 1e-3) == (name in wrong), row)
    check("\nprinted departs from the other methods at " + ", ".join(wrong) + "\n" in text, text)
    check("\neigenvalues of J 0 and " in text, text)


# --- simulate ---

def simulation_follows_admissible_orbits():
    """From (1)-(2) an admissible orbit meets its four events at the oracle's times, printed to seven decimals, and returns."""
    followed = [o for o in ORBITS if o.admissible]
    check(len(followed) >= 15, len(followed))
    for orbit in followed:
        text = said("simulate", orbit.set.scene(), "--at", orbit.at)
        where = orbit.set.name, orbit.at
        check("\nword (GHCD)^1\n" in text and "the first 4 of 4 events are the same" in text, *where, text)
        time, lines = 0.0, text[text.index(" t mass change"):].split("\n")[1:5]
        for k, line in zip(NAMES[2:6], lines):
            time += float(orbit.number[k])
            near(line.split()[0], time, 0.5e-7 + 1e-8, *where, k)


def the_papers_system_from_a_file():
    """Simulated with the file's parameters, and with others that the scene gives, it meets the events of the paper's scene."""
    def events(path, start):
        rows = (re.match(r" *([\d.]+) (m\d) +(\S+ > \S+) +(?:[s+-]{2} +)?([-\d.e+]+) +([-\d.e+]+) +([-\d.e+]+) +([-\d.e+]+)$", x)
                for x in said("simulate", path, "--start", start, "--time", 60).split("\n"))
        return [m.groups() for m in rows if m]

    for start, given, chi, v in [("2,3/2,1,1", {}, "0.8", "1"), ("0,0,0,0", {"chi": "7/10", "V": "6/5"}, "0.7", "1.2"),
                                 ("6,5,-1,2", {"V": "6/5"}, "0.8", "1.2")]:
        system = events(scene("system", "system: two-masses", **given), start)
        paper = events(scene("same", chi=chi, V=v, eta="1", e1="2.7844", e2="0.8587", u_r1="3.7844", u_r2="1.8587"), start)
        check(len(system) == len(paper) >= 6, start, len(system), len(paper))
        for got, want in zip(system, paper):
            same(got[1:3], want[1:3], start)
            for x, y in zip(got[:1] + got[3:], want[:1] + want[3:]):
                near(x, y, 2e-6, start, got)


def csv_has_a_row_for_each_sample_and_event():
    head, *lines = said("simulate", "paper", "--at", "orbit:2", "--csv", "--samples", 10, "--periods", 3).splitlines()
    same(head, "t,x1,x2,v1,v2,mode1,mode2,u1,u2")
    check(all(line.count(",") == 8 for line in lines))
    times = [float(line.split(",")[0]) for line in lines]
    check(times == sorted(times) and times[0] >= -1)
    check(3 * (10 + 4) <= len(lines) <= 3 * (10 + 4) + 2, len(lines))


def the_printed_start_runs_on():
    """For long both routes meet the same events."""
    text = said("simulate", "paper", "--at", "printed", "--periods", 120)
    found = re.search(r"closed forms: the first (\d+) of (\d+)", text)
    check(found and found.group(1) == found.group(2) and int(found.group(2)) > 400 and "after 120 returns" in text, text)


def routes_compared_over_many_periods():
    """The distances from MPFR and their growth, against the trace; and a table of three lines a period."""
    orbit = SETS["chi-large"].orbits[1]
    text = said("simulate", orbit.set.scene(), "--at", "orbit:2", "--periods", 60, "--compare")
    same(text.count("\n"), 2 + 3 * 60 + 3 + 1)
    found = re.search(r"\ntr J = (\S+): factor (\S+) a period expected; a displacement of x1 has (\S+) from (\d+) to (\d+)", text)
    check(found, text)
    near(found.group(1), orbit.trace, 1e-6, "tr J")
    near(found.group(2), -orbit.trace, 1e-4, "expected")
    near(found.group(3), -orbit.trace, 1e-3, "measured")
    apart = re.search(r"\nclosed and mpfr: apart by more than 1e-06 at period .*?; factor ([-.e\d]+)", text, re.S)
    check(apart, text)
    near(apart.group(1), -orbit.trace, 0.02, "factor")


# --- explain ---

def numbers(text):
    return [float(x) for x in re.findall(r"(?<![\w.])-?\d[\d.]*(?:e[-+]?\d+)?", text)]


def sides(text, rows):
    """The entries of both sides by each number type."""
    for kind in ("double", "mpfr  ", "arb   "):
        found = re.search(r"^%s left ((?:.*\n){%d})%s right((?:.*\n){%d})" % (kind, rows, kind, rows), text, re.M)
        check(found and re.match(r".*(\n .*)*\n$", found.group(1)), kind, text)
        yield kind, numbers(found.group(1)), numbers(found.group(2))


def explain_shows_both_sides():
    """(10) prints D with V t where t is meant: at V = 2, t = 3 the entry [1,3] is 6 against 3.  GSL's exponential rounds."""
    text = said("explain", "eq-10", "--at", "V=2,t=3")
    check(text.startswith("eq-10, the claim: ") and "conditional" in text and "V = 2, t = 3" in text, text)
    for kind, left, right in sides(text, 4):
        same((len(left), left[::5], left[2], right[0]), (16, [1] * 4, 6, 1), kind)
        near(right[2], 3, 1e-13, kind)
    for line in ("double left  1.0000000000000000  0  6.0000000000000000*  0\n", "\nas read     D(t) := [I, V*t*I; 0, I]\n",
                 "\n*           the two sides differ here\n"):
        check(line in text, line, "is not in", text)
    text = said("explain", "eq-3", "--at", "chi=1/2,eta=3", "--tape")  # K from (3)
    _, left, right = next(sides(text, 2))
    same((left, right), ([1, -0.5, -1.5, 1.5],) * 2)
    check("%0 = " in text, text)


def what_the_page_shows_can_be_explained():
    """Be it a claim, one that a restriction makes, a root or a control; and there are as many claims in the list as in the report."""
    with open("reports/paper/index.html", encoding="utf-8") as f:
        roots = re.findall(r' id="r-([^"]+)"', f.read())
    with open("reports/paper/audit.json", encoding="utf-8") as f:
        audit = json.load(f)
    check(len(roots) > 15 and len(audit["controls"]) > 100, len(roots), len(audit["controls"]))
    for name in roots[::every(3)]:
        text = said("explain", name)
        check(text.startswith(name) and "\nwrong       " in text and "\nclaims      " in text, text)
    for control in audit["controls"][::24]:
        text = said("explain", control["id"])
        check(", a control, " in text and "\nclaim       " in text, control["id"], text)
    same(said("list").count("\n"), len(audit["claims"]), "claims in the list")
    text = said("explain", "eq-10d")
    check(text.startswith("eq-10d, the claim: Z(t) = D(t) Z_0 in the global stick phase, when V = 1\n"), text)
    check("\nverdict     proved (on record: proved)\ncondition   V = 1\n" in text, text)


# --- Help ---

def mentions(text, word):
    """Is the option or word in the text, not as the beginning of a longer one?"""
    return re.search(r'(^|[ \n\[(|"])%s([ \n=\],.)|;:]|$)' % re.escape(word), text) is not None


def table():
    out = [line.split("\t") for line in said("help", "--table").splitlines()]
    check(all(len(row) == 4 and all(row) for row in out), [row for row in out if len(row) != 4])
    return out


def fits(what, text, most):
    lines = text.splitlines()
    check(len(lines) <= most and all(len(x.encode()) <= 80 for x in lines), what, len(lines), max(lines, key=len))


def help_fits_a_screen():
    text = said("--help")
    fits("--help", text, 24)
    check(mentions(text, "COMMAND --help") and mentions(text, "0 as recorded"), text)
    for asked in ("-h", "help", "--help"):
        same(said(asked), text, asked)
        same(said("help", asked), text, "help", asked)
    usages = [row for row in table() if row[1] == "usage"]
    check(len(usages) >= 18, len(usages))
    for command, _, _, line in usages:
        check("\n  %-10s %.80s\n" % (command, line) in text, "no line for", command)


def each_command_has_its_page():
    """The page of the command holds its rows, and no more options than these."""
    rows = table()
    for command in [row[0] for row in rows if row[1] == "usage"]:
        text = said(command, "--help")
        same(said("help", command), text)
        same(said(command, "-h"), text)
        fits(command, text, 100)
        own = [row for row in rows if row[0] == command and row[1] != "usage"]
        flat = re.sub("[ \n]", "", text)
        for _, name, value, line in own:
            check(re.sub("[ \n]", "", line) in flat, command, line)
            if name.startswith("--"):
                check("\n  %s%s\n" % (name, "" if value.startswith("-") else " " + value) in text, command, name)
        options = text[text.index("\noptions:\n"):text.index("\nexamples:\n")]
        same(options.count("\n  --"), sum(row[1].startswith("--") for row in own), command, "options")
        same(sum(row[1] == "example" for row in own), 2, command, "examples")


def examples_of_the_help_are_commands():
    """With an option that nobody has behind them nothing is done, and nothing else is wrong with them."""
    examples = [(row[0], row[3]) for row in table() if row[1] == "example"]
    check(len(examples) >= 36, len(examples))
    for command, line in examples:
        check((line + " ").startswith("stickslip %s " % command), line)
        r = subprocess.run([line.replace("stickslip", PROGRAM, 1) + " --no-such-option"], shell=True, capture_output=True, text=True)
        check(r.returncode == 2 and "unknown option --no-such-option" in r.stderr, line, r.stderr)


def help_names_every_job():
    """The jobs that --job takes are those that the help names."""
    r = subprocess.run([PROGRAM, "bench", "--job", "nobody"], capture_output=True, text=True)
    found = re.search("--job takes one of (.*?), not nobody", r.stderr)
    check(r.returncode == 2 and found, r.stderr)
    jobs = [x for x in re.split("[, ]+", found.group(1)) if x != "or"]
    says = re.search("JOB is [^.]*[.]", said("help", "bench")).group(0)  # what follows describes them
    check(len(jobs) + 1 >= 10 and all(mentions(says, job) for job in jobs), jobs, says)


def help_and_version():
    text = said("orbit", "--help")
    for name in ("t_a", "gamma_v1", "h_v2", "c_v2", "c_w", "u_r1", "u_r2"):  # what orbits.tsv finds broken
        check(mentions(text[text.index("violations"):], name), "the help says nothing of", name)
    text = said("--version")
    check(text.startswith("stickslip ") and text.count("\n") == 1 and text.endswith("\n"), text)


for test in sys.argv[2:] if __name__ == "__main__" else []:
    globals()[test]()
