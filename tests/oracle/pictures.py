"""pictures.py FOLDER SCENE [asked]: hold what stickslip plot SCENE has written against the equations of motion and other data.

States along the motions are recomputed by equality.py's flow from the start and the times that orbits.tsv,
paper_1000.tsv and arcs.tsv hold (SCENE is a name in orbits.tsv); samples along e2 by equality.py, changes on the paper's line by
bifurcations.tsv; the return map by Runge-Kutta steps of (1) with the events
found by bisection; its slopes, and the rates of the long runs, are the traces of orbits.tsv; the printed start keeps its word
for as many periods as longrun.tsv says.  With `asked` it is what the paper's scene gives with --along
e2=0.5:3, --over e1=2.6844:2.8844:3 --over e2=0.5:3:26 and --animate: changes and marks, in tables and pixels, by bifurcations.tsv, samples by
equality.py, other samples and cells by what $P orbit proves there, frames by orbits.tsv.  The pictures must be well-formed, named, told in words and free of
anything outside.  One line for each error; exit status 0 or 1.
"""
import functools
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ET

import equality
import mpmath
from mpmath import mpf

HERE = pathlib.Path(__file__).parent
STEP = 1 if os.environ.get("STICKSLIP_TESTS") == "all" else 5  # of what takes long; make long tries all
WORD = ("D", "Gamma", "H", "C")
SVG = "{http://www.w3.org/2000/svg}"


def table(path):
    lines = [l for l in path.read_text().splitlines() if not l.startswith("#")]
    assert path.read_text().startswith("# "), path
    head = lines[0].split("\t")
    return [dict(zip(head, l.split("\t"), strict=True)) for l in lines[1:]]


def number(text):
    return mpf(text) if text != "-" else None


class Scene:
    """Parameters and orbits of a set of orbits.tsv, and the printed start of arcs.tsv where there is one."""

    def __init__(self, name):
        mpmath.mp.dps = 30
        lines = [l.split("\t") for l in (HERE / "orbits.tsv").read_text().splitlines()]
        fields = next(l for l in lines if l[:2] == ["set", name])
        self.chi, self.eta, self.v, self.e1, self.e2 = (mpf(x.split("/")[0]) / mpf((x + "/1").split("/")[1])
                                                        for x in fields[2:7])
        head = next(l for l in lines if l[0] == "# orbit")
        self.orbits = [dict(zip(head, l)) for l in lines if l[:2] == ["orbit", name]]
        arcs = [l.split() for l in (HERE / "arcs.tsv").read_text().splitlines() if not l.startswith("#")]
        self.printed = next((a for a in arcs if name == "paper" and a[5:7] == ["0.8921", "-2.1958"]), None)

    def flow(self, phase, z, t):
        return equality.flow(phase[0], (self.chi, self.eta), z, t)

    def motion(self, z10, z20, times):
        """For each phase its start in time and its starting state."""
        z, t, out = [z10, z20, self.v, self.v], mpf(0), []
        for phase, last in zip(WORD, times):
            out.append((t, z))
            z, t = self.flow(phase, z, last), t + last
        return out, t

    def next_r(self, r):
        """r one period later, by fixed steps in floats."""
        chi, eta, v, e1, e2 = map(float, (self.chi, self.eta, self.v, self.e1, self.e2))
        z1 = (e1 + chi * r) / (1 - chi)
        y = [z1, z1 + r, v, v]

        def rates(y, phase):
            a1 = -(y[0] - chi * y[1]) if phase in ("Gamma", "H") else 0
            a2 = -eta * chi * (y[1] - y[0]) if phase in ("H", "C") else 0
            return [y[2], y[3], a1, a2]

        def step(y, h, phase):
            k1 = rates(y, phase)
            k2 = rates([p + h / 2 * q for p, q in zip(y, k1)], phase)
            k3 = rates([p + h / 2 * q for p, q in zip(y, k2)], phase)
            k4 = rates([p + h * q for p, q in zip(y, k3)], phase)
            return [p + h / 6 * (a + 2 * b + 2 * c + d) for p, a, b, c, d in zip(y, k1, k2, k3, k4)]

        below = {"Gamma": lambda y: chi * (y[1] - y[0]) < e2, "H": lambda y: y[2] < v, "C": lambda y: y[3] < v}
        for phase in WORD[1:]:
            h, n, side = 1 / 64, 0, below[phase](y)
            after = step(y, h, phase)
            while below[phase](after) == side:
                y, after, n = after, step(after, h, phase), n + 1
                assert n < 64 * 200
            low, high = 0, h
            for _ in range(50):
                mid = (low + high) / 2
                low, high = (mid, high) if below[phase](step(y, mid, phase)) == side else (low, mid)
            y = step(y, high, phase)
            if phase != "Gamma":
                y[2 if phase == "H" else 3] = v
        return y[1] - y[0]


def off(cell, value, places):
    return cell == "-" or abs(mpf(cell) - value) > mpf(10) ** -places * mpf("0.500001")


def motion_errors(folder, s):
    """Every row of figures 3 and 4 and of the margins."""
    history, portrait = table(folder / "figure-3.tsv"), table(folder / "figure-4.tsv")
    margins = iter(table(folder / "margins.tsv"))
    assert len(history) == len(portrait)
    orbit = s.orbits[nearest(s)]
    times = {"orbit": [mpf(orbit[k]) for k in ("t_a", "t_b", "t_c", "t_d")]}
    start = {"orbit": (mpf(orbit["z10"]), mpf(orbit["z20"]))}
    if s.printed:
        times["printed"], start["printed"] = [mpf(x) for x in s.printed[7:11]], (mpf("0.8921"), mpf("-2.1958"))
    motions = {m: s.motion(*start[m], times[m]) for m in times}
    marks = {m: [] for m in times}
    for h, p in zip(history, portrait):
        name, phase = h["motion"], WORD.index(h["phase"])
        (begin, z), last = motions[name][0][phase], times[name][phase]
        at = mpf(h["t"]) - begin
        parts = len([x for x in history if x["motion"] == name and x["phase"] == h["phase"]]) - 1
        exact = last * mpmath.nint(at / last * parts) / parts
        z = s.flow(h["phase"], z, exact)
        cells = [(h["t"], begin + exact), (h["z_1"], z[0]), (h["z_2"], z[1]), (p["z_1"], z[0]), (p["z'_1"], z[2]),
                 (p["z_2"], z[1]), (p["z'_2"], z[3])]
        if name == "orbit":
            m, ph = next(margins), h["phase"]
            want = [s.v - z[2] if ph in ("Gamma", "H") else None, s.v - z[3] if ph in ("H", "C") else None,
                    s.e1 - z[0] + s.chi * z[1] if ph in ("D", "C") else None,
                    s.e2 - s.chi * (z[1] - z[0]) if ph in ("D", "Gamma") else None]
            for cell, w in zip(list(m.values())[2:], want):
                if (cell == "-") != (w is None):
                    yield "a margin of the wrong phase: %s" % m
                elif w is not None:
                    cells.append((cell, w))
        for cell, w in cells:
            if off(cell, w, 6):
                yield "%s %s t %s: %s, not %s" % (name, h["phase"], h["t"], cell, mpmath.nstr(w, 10))
        if h["mark"] != "-":
            marks[name].append(h["mark"])
    if any(m != list("Oabcd") for m in marks.values()):
        yield "marks %s" % marks
    if next(margins, None):
        yield "margins without a row in figure 3"


def nearest(s):
    if not s.printed:
        return 0
    want = dict(z10=0.8921, z20=-2.1958, t_a=0.6784, t_b=2, t_c=1.5, t_d=2.34)
    return min(range(len(s.orbits)), key=lambda k: sum((float(s.orbits[k][n]) / v - 1) ** 2 for n, v in want.items()))


def return_errors(folder, s):
    rows = table(folder / "return-map.tsv")
    fixed = [r for r in rows if r["curve"] in ("orbit", "formal")]
    if len(fixed) != len(s.orbits):
        yield "%d fixed points, not %d" % (len(fixed), len(s.orbits))
    for row, o in zip(fixed, s.orbits):
        if off(row["r"], mpf(o["z20"]) - mpf(o["z10"]), 6) or off(row["slope"], mpf(o["trace"]), 6):
            yield "orbit %s: %s" % (o["index"], row)
        if (row["curve"] == "orbit") != (o["admissible"] == "yes"):
            yield "orbit %s is %s, here %s" % (o["index"], o["admissible"], row["curve"])
    curve = [r for r in rows if r["curve"] == "map"]
    for row in curve[::9] + [r for r in rows if r["curve"] == "near"][::40] + [r for r in rows if r["curve"] == "iterate"]:
        got, want = float(row["r'"]), s.next_r(float(row["r"]))
        if abs(got - want) > 1e-5 + 1e-6 * abs(float(row["slope"])):
            yield "r = %s: r' = %s, not %.8f" % (row["r"], row["r'"], want)
    for a, b in zip(curve, curve[1:]):  # slopes are those of the curve
        if a["piece"] != b["piece"] or abs(float(a["slope"]) - float(b["slope"])) > 0.02:
            continue
        slope = (float(b["r'"]) - float(a["r'"])) / (float(b["r"]) - float(a["r"]))
        if abs(slope - (float(a["slope"]) + float(b["slope"])) / 2) > 0.01:
            yield "slope %s at r = %s, differences say %.5f" % (a["slope"], a["r"], slope)


def long_errors(folder, s):
    runs = {}
    for row in table(folder / "long-run.tsv"):
        runs.setdefault(row["run"], []).append(float(row["log10"]))
    for k, o in enumerate(s.orbits):
        run = runs.get("orbit %d" % (k + 1)) or runs.get("formal %d" % (k + 1))
        rate = math.log10(abs(float(o["trace"])))
        step = run[1] - run[0] if rate > 0 else run[-1] - run[-2]  # where the motion is nearest to the orbit
        if run[0] != -3 or abs(step - rate) > 0.02 * max(1, abs(rate)):
            yield "orbit %d: %s, by %.4f a period" % (k + 1, run[:3], rate)
    if s.printed:
        words = dict(l.split("\t")[0::8] for l in (HERE / "longrun.tsv").read_text().splitlines())
        kept = int(re.match(r"\(GHCD\)\^(\d+) ", words["paper"])[1])
        steps = [b - a for a, b in zip(runs["printed"], runs["printed"][1:])]
        rate = math.log10(abs(float(s.orbits[nearest(s)]["trace"])))
        if not all(0 < x < 2 * rate for x in steps[:kept - 2]) or any(abs(x) > rate / 2 for x in steps[kept + 2:]):
            yield "the printed start keeps its word for other than %d periods" % kept


def step_errors(folder):
    rows = table(folder / "differences.tsv")
    least = {c: min(float(r[c]) for r in rows if r[c] != "-") for c in list(rows[0])[1:]}
    for bits, (low, high) in {"bits_53": (-14, -8), "bits_113": (-25, -20), "bits_256": (-55, -45)}.items():
        # eps^(2/3) is where h^2 and eps/h meet
        if not low < least[bits] < high:
            yield "least error with %s: %.1f" % (bits, least[bits])
    fine = [(float(r["log10_h"]), float(r["bits_256"])) for r in rows if r["bits_256"] != "-"]
    for (h, e), (g, f) in zip(fine[20:60], fine[21:60]):
        if abs((f - e) - 2 * (g - h)) > 0.02:
            yield "the error with 256 bits does not fall as the square at 10^%.1f" % h


def follow(s, samples, exact):
    """Samples along e2 by equality.py's return map, from the scene's orbit on; exact: e2 of a row."""
    word = {"yes": True, "no": False}
    mpmath.mp.dps = 60
    orbit = s.orbits[nearest(s)]
    r = mpf(orbit["z20"]) - mpf(orbit["z10"])
    for row in samples:
        par = [s.chi, s.eta, s.v, s.e1, exact(row)]
        times = equality.around(par, r)[1]
        r, slope = equality.fixed(par, r, times)
        times = equality.around(par, r, times)[1]
        z = mpmath.matrix([(s.e1 + s.chi * r) / (1 - s.chi), (s.e1 + r) / (1 - s.chi), s.v, s.v])
        for phase, t in zip("GHC", times):
            z = equality.flow(phase, par, z, t)
        stick = (s.e1 - (z[0] - s.chi * z[1])) / ((1 - s.chi) * s.v)
        if off(row["trace"], slope, 6) or off(row["period"], sum(times) + stick, 6):
            yield "along e2: %s, not tr J = %s and period %s" % (row, mpmath.nstr(slope, 9),
                                                                  mpmath.nstr(sum(times) + stick, 9))
        if word[row["stable"]] != (abs(slope) < 1) or (word[row["admissible"]] and stick <= 0):
            yield "along e2: %s" % row
    mpmath.mp.dps = 30


def known_changes():
    """On the paper's line over e2, by kind."""
    rows = [l.split("\t") for l in (HERE / "bifurcations.tsv").read_text().splitlines() if not l.startswith("#")]
    return {k[8]: mpf(k[9]) for k in rows if k[:6] == ["0.8", "1", "1", "2.7844", "-", "e2"]}


def along_errors(folder, s):
    """Some samples by equality.py's return map; changes by bifurcations.tsv, and by what stands on both sides."""
    rows = table(folder / "along-e2.tsv")
    samples = [r for r in rows if r["change"] == "-"]
    first = min(range(len(samples)), key=lambda i: abs(mpf(samples[i]["e2"]) - s.e2))
    stride = 4 if STEP == 1 else 16
    ways = (range(first, len(samples), stride), range(first, -1, -stride)) if s.printed else (range(first, -1, -1)[STEP > 1:2],)
    if mpf(samples[first]["period"]) > 100:
        ways = ()  # equality.py would look for events for minutes
    for way in ways:
        yield from follow(s, [samples[i] for i in way], lambda row: s.e2 * (round(mpf(row["e2"]) / s.e2 * 16)) / 16)
    known = known_changes() if s.printed else {}
    kinds = {"tr J passes -1": "flip", "t_a becomes zero": "t_a"}
    seen = set()
    for before, r, after in zip([None, *rows], rows, [*rows[1:], None]):
        kind = kinds.get(r["change"])
        low, high = (mpf(r[k]) if r[k] != "-" else mpf(0) for k in ("e2", "e2_to"))
        if r["change"] != "-" and not 0 < high - low < low / 10000:
            yield "along e2: no bracket: %s" % r
        if kind in known and low <= known[kind] <= high:
            seen.add(kind)
        flips = kind and before and after and before["change"] == after["change"] == "-"
        if flips and kind == "flip" and (mpf(before["trace"]) + 1) * (mpf(after["trace"]) + 1) > 0:
            yield "along e2: no change of stability: %s" % r
        if flips and kind == "flip" and r["stable"] != after["stable"]:
            yield "along e2: the other side is stable: %s" % r
    if s.printed and seen != {"flip", "t_a"}:
        yield "along e2: only %s of the known changes" % seen


# --- What is asked for by --along, --over and --animate of the paper's scene ---

KIND = {"flip": "tr J passes -1", "t_a": "t_a becomes zero", "c_v2": "both masses reach the velocity of the belt at the same time",
        "h_v1": "the first mass reaches the velocity of the belt earlier in the global slip phase",
        "fold": "the solution merges with another one"}


@functools.lru_cache(maxsize=None)
def orbits_at(**values):
    """The orbits that the program proves there."""
    sets = ["--set=%s=%s" % v for v in values.items()]
    run = subprocess.run([os.environ["P"], "orbit", "paper", "--json", *sets], capture_output=True, check=True)
    return json.loads(run.stdout)["orbits"]


def pixel(value, low, high):
    """Across a picture: PLOT_LEFT 46 and PLOT_RIGHT 14 of 360."""
    return 46 + (float(value) - low) / (high - low) * 300


def bifurcation_errors(folder, s):
    rows = table(folder / "bifurcations.tsv")
    rings = [float(c.get("cx")) for c in ET.parse(folder / "bifurcations.svg").getroot().iter(SVG + "circle")]
    for kind, at in known_changes().items():
        there = [r for r in rows if r["change"] == KIND[kind] and mpf(r["e2"]) < at < mpf(r["e2_to"])]
        if len(there) != 1 or not mpf(there[0]["e2_to"]) - mpf(there[0]["e2"]) < at / 10 ** 5:
            yield "along: %s is not enclosed: %s" % (kind, there)
        if len([x for x in rings if abs(x - pixel(at, 0.5, 3)) < 0.06]) < 2:
            yield "along: %s is not marked in both panels" % kind
        if there and kind in ("flip", "fold") and off(there[0]["trace"], {"flip": -1, "fold": 1}[kind], 5):
            yield "along: tr J at %s" % there
    branch = {r["branch"] for r in rows if r["change"] == KIND["flip"]}
    own = sorted((r for r in rows if r["change"] == "-" and {r["branch"]} == branch and mpf(r["e2"]) < 2.4),
                 key=lambda r: mpf(r["e2"]))
    first = min(range(len(own)), key=lambda i: abs(mpf(own[i]["e2"]) - s.e2))
    stride = 10 if STEP == 1 else 20
    for way in (own[first::stride], own[first::-stride]):
        yield from follow(s, way, lambda row: mpf(row["e2"]))
    samples = [r for r in rows if r["change"] == "-"]
    if len({r["branch"] for r in samples}) < 6:
        yield "along: branches are missing"
    shown = period_panel(folder, rows)
    for row in samples[::7 * STEP]:
        near = [o for o in orbits_at(e2=row["e2"]) if not off(row["trace"], mpf(o["trace"]), 6)]
        said = {"yes": True, "no": False}
        if not any(o["stable"] == said[row["stable"]] and o["admissible"] == said[row["admissible"]] for o in near):
            yield "along: %s, orbit says %s" % (row, near)
        curve = "c2" if row["admissible"] == "no" else "c0" if row["stable"] == "yes" else "c1"
        if curve not in shown(row):
            yield "along: %s is drawn as %s, not %s" % (row, shown(row), curve)


def period_panel(folder, rows):
    """The classes of the curves through a row's point of the lower panel, whose scale two rings tell."""
    root, at = ET.parse(folder / "bifurcations.svg").getroot(), []
    for kind in ("fold", "c_v2"):
        x = pixel(known_changes()[kind], 0.5, 3)
        row = min((r for r in rows if r["change"] == KIND[kind]), key=lambda r: abs(pixel(r["e2"], 0.5, 3) - x))
        at.append((float(row["period"]), max(float(c.get("cy")) for c in root.iter(SVG + "circle")
                                             if abs(float(c.get("cx")) - x) < 0.06)))
    slope = (at[1][1] - at[0][1]) / (at[1][0] - at[0][0])
    points = [(p.get("class").split()[1], *map(float, xy)) for p in root.iter(SVG + "path")
              if p.get("class").startswith("curve c") for xy in re.findall(r"([\d.-]+) ([\d.-]+)", p.get("d"))]

    def classes(row):
        x, y = pixel(row["e2"], 0.5, 3), at[0][1] + slope * (float(row["period"]) - at[0][0])
        return {c for c, px, py in points if abs(px - x) < 0.06 and abs(py - y) < 0.6}
    return classes


def shade_at(root, x, y):
    """The shade of the picture at a point."""
    for path in root.iter(SVG + "path"):
        if path.get("class").startswith("shade"):
            for box in re.findall(r"M([\d.-]+) ([\d.-]+)H([\d.-]+)V([\d.-]+)H", path.get("d")):
                left, bottom, right, top = map(float, box)
                if left < x < right and top < y < bottom:
                    return path.get("class")
    return "shade s0"


def map_errors(folder, s):
    rows, root = table(folder / "stability-map.tsv"), ET.parse(folder / "stability-map.svg").getroot()
    frame = next(r for r in root.iter(SVG + "rect") if r.get("class") == "frame")
    top, height = float(frame.get("y")), float(frame.get("height"))
    known = known_changes()
    for kind in ("flip", "t_a"):
        low = [r for r in rows if r["what"] == kind and mpf(r["e1"]) == s.e1 and r["e2_to"] != "-"]
        if not any(mpf(r["e2"]) < known[kind] < mpf(r["e2_to"]) for r in low):
            yield "map: %s is not enclosed: %s" % (kind, low)
        y = top + height - (float(known[kind]) - 0.5) / 2.5 * height
        if not any(abs(float(c.get("cx")) - 196) < 0.06 and abs(float(c.get("cy")) - y) < 0.06
                   for c in root.iter(SVG + "circle")):
            yield "map: %s is not marked" % kind
    cells = [r for r in rows if r["what"] == "cell"]
    if len(cells) != (78 if STEP == 1 else 18):
        yield "map: %d cells" % len(cells)
    for i, c in enumerate(cells):
        e2 = mpf(c["e2"])
        if mpf(c["e1"]) == s.e1:  # stable and admissible between the flip and t_a, unstable below, not admissible above
            want = "s2" if e2 < known["flip"] else "s3" if e2 < known["t_a"] else "s1"
            x, y = pixel(2.7844, 2.6844, 2.8844), top + height - (float(e2) - 0.5) / 2.5 * height
            y = min(max(y, top + 0.5), top + height - 0.5)
            if shade_at(root, x, y) != "shade " + want:
                yield "map: %s has %s, not %s" % (c, shade_at(root, x, y), want)
        elif i % (3 * STEP) == 0:
            there = orbits_at(e1=c["e1"], e2=c["e2"])
            good = [o for o in there if o["admissible"]]
            want = [str(len(there)), str(len(good)), str(len([o for o in good if o["stable"]]))]
            if [c["orbits"], c["admissible"], c["stable"]] != want:
                yield "map: %s, orbit says %s" % (c, want)


def frames(text, name):
    """Keyframes: percent and what stands there."""
    body = re.search(r"@keyframes animation-%s \{(.*) \}\n" % name, text)[1]
    return {p: v for p, v in re.findall(r"([\d.]+)% \{ \w+: ([^;]*); \}", body)}


def animation_errors(folder, s):
    rows, text = table(folder / "animation.tsv"), (folder / "animation.svg").read_text()
    orbit = s.orbits[nearest(s)]
    times = [mpf(orbit[k]) for k in ("t_a", "t_b", "t_c", "t_d")]
    motion, period = s.motion(mpf(orbit["z10"]), mpf(orbit["z20"]), times)
    for row in rows:
        begin, z = motion[WORD.index(row["phase"])]
        z = s.flow(row["phase"], z, mpf(row["t"]) - begin)
        want = {"z_1": z[0], "z_2": z[1], "z'_1": z[2], "z'_2": z[3], "pull_1": z[0] - s.chi * z[1],
                "pull_2": s.chi * (z[1] - z[0])}
        if any(abs(mpf(row[k]) - want[k]) > 5e-6 for k in want):
            yield "animation: %s, not %s" % (row, want)
        limits = ["-" if row["phase"] in slips else e for slips, e in ((("Gamma", "H"), s.e1), (("H", "C"), s.e2))]
        if any((row["limit_%d" % (k + 1)] == "-") != (e == "-") or e != "-" and off(row["limit_%d" % (k + 1)], e, 6)
               for k, e in enumerate(limits)):
            yield "animation: limits of %s" % row
    ends = [sum(times[:k]) for k in range(5)]
    at = ["%.2f" % (100 * t / period) for t in ends]
    states = [z for _, z in motion] + [motion[0][1]]
    x = [[float(re.search(r"[\d.-]+", frames(text, "m%d" % k)[p])[0]) for p in at] for k in (1, 2)]
    scale = (x[0][2] - x[0][0]) / float(states[2][0] - states[0][0])
    for k in range(2):
        for i in range(5):
            if scale < 1 or abs(x[k][i] - x[k][0] - scale * float(states[i][k] - states[0][k])) > 0.2:
                yield "animation: mass %d at %s %%: %s" % (k + 1, at[i], x[k][i])
    spring = [float(re.search(r"[\d.]+", frames(text, "k2")[p])[0]) for p in at]
    if any(abs(100 * f - (x[1][i] - x[0][i] - 46)) > 0.2 for i, f in enumerate(spring)):
        yield "animation: the spring between the blocks"
    for k in range(4):
        seen = frames(text, "p%d" % k)
        if seen.get(at[k]) != "visible" or (k < 3 and seen.get(at[k + 1]) != "hidden"):
            yield "animation: phase %s is shown at %s" % (WORD[k], seen)
    still = re.sub(r"@media \(prefers-reduced-motion: no-preference\) \{\n.*?\n\}\n", "", text, flags=re.S)
    if "@keyframes" not in text or re.search(r"animation:|@keyframes|<animate", still):
        yield "animation: it moves for who asks for no motion"


def svg_errors(path):
    text = path.read_text(encoding="utf-8")
    root = ET.fromstring(text)
    ids = [e.get("id") for e in root.iter() if e.get("id")]
    named = root.get("aria-labelledby", "").split()
    if len(ids) != len(set(ids)) or not all(i.split("-")[0] in ("t", "d") or i.startswith(path.stem) for i in ids):
        yield "ids %s" % ids
    if [root.find(SVG + "title").get("id"), root.find(SVG + "desc").get("id")] != named or root.get("role") != "img":
        yield "not named"
    if len(root.find(SVG + "title").text) < 10 or not re.search(r"\d\.\d", root.find(SVG + "desc").text):
        yield "not told"
    if re.search(r"nan|inf\b|href|@import|https?:(?!//www\.w3\.org/2000/svg\")|<script", text, re.I):
        yield "holds what it must not"
    for u in re.findall(r"url\(#([^)]*)\)", text):
        if u not in ids:
            yield "url(#%s) is not there" % u
    if re.search(r'(fill|stroke)="(?!(?:none|currentColor)")', text):
        yield "a fixed colour"


def main():
    folder, s, asked = pathlib.Path(sys.argv[1]), Scene(sys.argv[2]), sys.argv[3:] == ["asked"]
    moves = s.orbits[nearest(s)]["admissible"] == "yes"
    checks = ([bifurcation_errors, map_errors] if asked else [motion_errors, return_errors, long_errors, along_errors])
    checks += [animation_errors] if moves else []
    errors = [e for check in checks for e in check(folder, s)] + ([] if asked else [*step_errors(folder)])
    pictures = sorted(folder.glob("*.svg"))
    if len(pictures) != (2 if asked else 7) + moves:
        errors.append("%d pictures" % len(pictures))
    for p in pictures:
        errors += ["%s: %s" % (p.name, e) for e in svg_errors(p)]
    for e in errors[:20]:
        print(e)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
