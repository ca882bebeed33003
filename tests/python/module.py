#!/usr/bin/env python3
"""The Python module, held against tests/oracle and the headers: module.py [CLASS...], in the project's folder, with
python/ in PYTHONPATH; STICKSLIP_LIBRARY names the library, with its whole path, and CC the compiler."""
import ctypes
import decimal
import gc
import importlib.util
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import stickslip

sys.path.insert(0, "tests/python")
import notebook

ORACLE = pathlib.Path("tests/oracle")
NUMBERS = "z10 z20 t_a t_b t_c t_d period trace u_r1_min u_r2_min".split()
NOTEBOOK = pathlib.Path("examples/paper.ipynb")
PAPER = "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = 0.8587\n"


def rows(name):
    for line in (ORACLE / name).read_text().splitlines():
        if not line.startswith("#"):
            yield line.split("\t")


def rounded(text, digits):
    return decimal.Context(prec=digits).create_decimal(text)


def sets():
    """Each set's scene file, with the rows of its orbits."""
    found = []
    for kind, name, *fields in rows("orbits.tsv"):
        if kind == "set":
            scene = "".join(f"{key} = {value}\n" for key, value in zip(("chi", "eta", "V", "e1", "e2"), fields))
            found.append((name, scene, []))
        else:
            found[-1][2].append(fields)
    return found


def paper(index):
    """The number of the paper's orbit: paper(1)["t_a"]."""
    fields = next(f for kind, name, *f in rows("orbits.tsv") if (kind, name, f[0]) == ("orbit", "paper", str(index)))
    return dict(zip(NUMBERS, fields[1:]))


def alone(program):
    """How a Python of its own ends."""
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)


class Declared(unittest.TestCase):
    """What the module says of functions, structures and enumerations is what the headers say: a C compiler reads
    both."""

    def compile(self, text):
        with tempfile.NamedTemporaryFile("w", suffix=".c") as source:
            source.write('#include <stddef.h>\n#include "stickslip.h"\n' + text)
            source.flush()
            command = [*os.environ.get("CC", "cc").split(), "-std=c17", "-Iinclude", "-fsyntax-only", source.name]
            return subprocess.run(command, capture_output=True, text=True)

    def holds(self, text):
        done = self.compile(text)
        self.assertEqual(done.returncode, 0, done.stderr)

    def equal(self, pairs):
        self.holds("".join(f'_Static_assert({c} == {value}, "{c}");\n' for c, value in pairs))

    def test_functions(self):
        self.holds(stickslip._FUNCTIONS)
        for wrong in ("int ss_orbits_count(const ss_orbits *o);", "size_t ss_orbits_count(ss_orbits *o);",
                      "int ss_orbits_find(ss_orbits **out, const ss_scene *s);"):
            self.assertIn("conflicting types", self.compile(wrong).stderr)

    def test_structures(self):
        for name, kind in (("ss_moment", stickslip._Moment), ("ss_event", stickslip._Event),
                           ("ss_swept", stickslip._Swept)):
            pairs = [(f"sizeof({name})", ctypes.sizeof(kind))]
            for field, _ in kind._fields_:
                of = getattr(kind, field)
                pairs += [(f"offsetof({name}, {field})", of.offset), (f"sizeof((({name} *)0)->{field})", of.size)]
            self.equal(pairs)

    def test_enumerations(self):
        lists = [("SS_", stickslip._MODES), ("SS_", stickslip._ROUTES), ("SS_", stickslip._NUMBERS),
                 ("SS_OUT_", stickslip._OUTPUTS), ("SS_COND_", stickslip._CONDITIONS)]
        pairs = [(prefix + name.upper(), i) for prefix, names in lists for i, name in enumerate(names)]
        pairs += [("SS_" + status.name, status.value) for status in stickslip.Status]
        pairs += [("SS_FALSE", 0), ("SS_TRUE", 1), ("SS_UNKNOWN", 2), ("SS_AT_PRINTED", stickslip._AT_PRINTED)]
        pairs += [("SS_OUTPUTS", len(stickslip._OUTPUTS)), ("SS_CONDITIONS", len(stickslip._CONDITIONS))]
        self.equal(pairs)

    def test_version(self):
        text = pathlib.Path("include/stickslip/status.h").read_text()
        self.assertEqual(stickslip.__version__, re.search(r'SS_VERSION +"(.*)"', text)[1])
        done = alone("import ctypes; f = ctypes.CDLL.__getattr__\n"
                     "class Other: argtypes = restype = None; __call__ = lambda self: b'0.2.0'\n"
                     "ctypes.CDLL.__getattr__ = lambda lib, name: Other() if name == 'ss_version' else f(lib, name)\n"
                     "import stickslip")
        self.assertIn("is version 0.2.0, and this module is for 0.1.x", done.stderr)

    def test_no_library(self):
        done = alone("import os; os.environ['STICKSLIP_LIBRARY'] = '/nowhere/lib.so'; import stickslip")
        self.assertIn("ImportError: /nowhere/lib.so: ", done.stderr)


class Numbers(unittest.TestCase):
    """What other programs have found (tests/oracle)."""

    def test_orbits(self):
        seen = 0
        for name, text, expected in sets():
            with stickslip.Scene.read(text) as scene:
                orbits = scene.orbits(digits=40)
            self.assertEqual(len(orbits), len(expected), name)
            for orbit, (_, *fields) in zip(orbits, expected):
                seen += 1
                for key, value in zip(NUMBERS, fields):
                    self.assertEqual(getattr(orbit, key), rounded(value, 40), (name, key))
                self.assertEqual((orbit.admissible, ",".join(orbit.violations) or "-"),
                                 (fields[10] == "yes", fields[11]), name)
                self.assertIs(orbit.stable, abs(decimal.Decimal(fields[7])) < 1)
                self.assertTrue(orbit.certified and orbit.open == "")
        self.assertGreater(seen, 50)

    def test_complete(self):
        with stickslip.Scene.read(PAPER) as scene:
            orbits = scene.orbits()
            self.assertEqual((orbits.complete, orbits.reach, orbits.gap), (True, float("inf"), None))
            scene.set(e1=None, e2=None, t_b="2", t_c="1.5")
            self.assertTrue(scene.orbits().complete)

    def test_exact(self):
        with stickslip.Scene() as scene:
            self.assertEqual(str(scene.parameter("e1")), "2.7844")
            self.assertEqual(str(scene.printed("z20")), "-2.1958")
            self.assertIsNone(scene.parameter("u_r1"))
            self.assertIsNone(scene.printed("V"))
            scene.set(e2="1/3", V=100, eta=0.5)
            self.assertEqual(str(scene.parameter("e2", 5)), "0.33333")
            self.assertEqual((scene.parameter("V"), scene.parameter("eta")), (100, decimal.Decimal("0.5")))
            self.assertIn("e2=1/3", scene.name)

    def test_jacobian(self):
        want = [value for name, index, matrix, _, _, value in rows("jacobian.tsv")
                if (name, index, matrix) == ("paper", "1", "return")]
        scene = stickslip.Scene()
        precise = [(method, 30) for method in ("analytic", "implicit", "saltation", "fd")]
        for method, digits in [*precise, ("fd-double", 8), ("ode", 6)]:
            j = scene.jacobian(1, method, digits=digits)
            self.assertEqual([x for row in j.matrix for x in row], [rounded(x, digits) for x in want], method)
            self.assertEqual((j.trace, j.det), (rounded(paper(1)["trace"], digits), 0), method)
        self.assertLess(len(scene.jacobian(1, "ode").trace.as_tuple().digits), 12)  # says what it knows
        scene.set(V=2)  # where the printed (40) is wrong
        self.assertNotEqual(scene.jacobian(1, layer="printed").matrix, scene.jacobian(1, layer="corrected").matrix)

    def test_motion(self):
        scene, want = stickslip.Scene(), {key: float(value) for key, value in paper(1).items()}
        for route in ("closed", "integrated"):
            motion = scene.simulate(1, returns=1, sample=0.25, route=route)
            times, at = [], 0
            for key in ("t_a", "t_b", "t_c", "t_d"):
                at += want[key]
                times.append(at)
            for event, t in zip(motion.events, times, strict=True):
                self.assertAlmostEqual(event.at.t, t, 9)
            self.assertEqual([(e.mass, e.before) for e in motion.events],
                             [(0, "stick"), (1, "stick"), (0, "below"), (1, "below")])
            self.assertEqual([e.after for e in motion.events], ["below", "below", "stick", "stick"])
            self.assertEqual(len(motion.samples), 26)  # 6.37 / 0.25
            for before, after in zip(motion.samples[0].x, motion.end.x):
                self.assertAlmostEqual(before, after, 9)
            self.assertAlmostEqual(motion.period, want["period"], 9)
            self.assertAlmostEqual(motion.parameters["chi"], 0.8)
            self.assertTrue(motion.friction_is_own)
        self.assertEqual(scene.simulate((0, 0, 0.5, 0.25), duration=1e-9).end.mode, ("below", "below"))
        self.assertNotAlmostEqual(scene.simulate("printed", returns=1).end.t, want["period"], 1)

    def test_sweep(self):
        for name, text, expected in sets():
            with stickslip.Scene.read(text) as scene:
                found = scene.sweep("e2", scene.parameter("e2"), scene.parameter("e2"), 1)
                x = float(scene.parameter("e2"))
            self.assertEqual((found[0].x, found[0].orbits), (x, len(expected)))
            for row, (_, *fields) in zip(found, expected):
                for key, value in zip(NUMBERS, fields):
                    self.assertAlmostEqual(getattr(row, key) / float(value), 1, 13, (name, key))
                self.assertEqual((row.admissible, ",".join(row.violations) or "-", row.unsure, row.status),
                                 (fields[10] == "yes", fields[11], (), "ok"), name)
            self.assertTrue(expected or found[0].z10 != found[0].z10)
        with stickslip.Scene() as scene:
            self.assertEqual([row.x for row in scene.sweep("V", 1, 2, 5) if row.orbit == 0], [1, 1.25, 1.5, 1.75, 2])

    def test_verdicts(self):
        audit = stickslip.Scene().audit("eq-40,num-t_a", jobs=2)
        claims = {claim["id"]: claim for claim in audit["claims"]}
        self.assertEqual((claims["eq-40"]["verdict"], claims["eq-40"]["condition"]), ("conditional", "V = 1"))
        self.assertEqual(claims["num-t_a"]["verdict"], "refuted")

    def test_mpmath(self):
        if not importlib.util.find_spec("mpmath"):
            self.skipTest("no mpmath")
        import mpmath
        scene = stickslip.Scene()
        orbit = stickslip.as_mpmath(scene.orbits(digits=1000))[1]
        with mpmath.workdps(1000):
            for name, value in rows("paper_1000.tsv"):
                self.assertLess(abs(getattr(orbit, name) / mpmath.mpf(value) - 1), mpmath.mpf(10) ** -998, name)
        j = stickslip.as_mpmath(scene.jacobian(1, digits=40))
        with mpmath.workdps(40):
            self.assertLess(abs(j.matrix[0, 0] + j.matrix[1, 1] - j.trace), mpmath.mpf(10) ** -38)

    def test_numpy(self):
        if not importlib.util.find_spec("numpy"):
            self.skipTest("no numpy")
        import numpy
        scene, none = stickslip.Scene(), stickslip.Scene.read(dict((n, t) for n, t, _ in sets())["none"])
        orbits = stickslip.as_numpy(scene.orbits())
        self.assertEqual(list(orbits["t_a"]), [float(rounded(paper(k)["t_a"], 15)) for k in range(2)])
        self.assertEqual((list(orbits["admissible"]), list(orbits["violations"])), ([False, True], ["h_v2", ""]))
        swept = stickslip.as_numpy(none.sweep("e2", "0.287", "0.288", 3))
        self.assertTrue(numpy.isnan(swept["trace"]).all() and swept["x"].dtype == float)
        self.assertEqual(stickslip.as_numpy(scene.simulate(1, duration=2, sample=1).samples)["x"].shape, (3, 2))
        self.assertEqual(stickslip.as_numpy([]), {})


class Wrong(unittest.TestCase):
    """What cannot be done is an exception that says why and where."""

    def fails(self, status, function, *arguments, **named):
        with self.assertRaises(stickslip.Error) as caught:
            function(*arguments, **named)
        self.assertEqual(caught.exception.status, status)
        self.assertEqual(str(caught.exception), caught.exception.message)
        self.assertTrue(caught.exception.message and caught.exception.text)
        return caught.exception

    def test_place(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bad.scene"
            path.write_text("chi = 0.8\neta = 1\nV = 1 + * 2\ne1 = 1\ne2 = 1\n")
            error = self.fails(stickslip.Status.INPUT, stickslip.Scene, path)
        self.assertEqual((error.file, error.line, error.column), (str(path), 3, 9))
        self.assertEqual(error.text, "a wrong input")
        self.assertEqual(len(error.message.splitlines()), 3)
        self.assertEqual(error.message.splitlines()[2].index("^"), error.message.splitlines()[1].index("*"))
        error = self.fails(stickslip.Status.INPUT, stickslip.Scene, "nowhere")
        self.assertEqual((error.line, error.column), (None, None))

    def test_arguments(self):
        scene, status = stickslip.Scene(), stickslip.Status
        self.fails(status.ARGUMENT, scene.orbits, 0)
        self.fails(status.ARGUMENT, scene.orbits, -1)
        self.fails(status.INPUT, scene.jacobian, 2)
        self.fails(status.ARGUMENT, scene.simulate, -1, returns=1)
        self.fails(status.ARGUMENT, scene.jacobian, -1)
        self.assertTrue(self.fails(status.ARGUMENT, scene.orbits, -1).message.endswith("digits can be had"))
        for neither in (5, None):
            self.assertRaises(TypeError, stickslip.Scene, neither)
        for says, wrong in {"duration, or returns": {}, "duration is": {"duration": -1}, "returns is": {"returns": -1},
                            "sample is": {"duration": 1, "sample": -1}}.items():
            self.assertIn(says, self.fails(status.ARGUMENT, scene.simulate, 1, **wrong).message)
        self.fails(status.ARGUMENT, scene.sweep, "u_r1", 1, 2, 3)
        self.fails(status.INPUT, scene.sweep, "chi", "1/2", 2, 3)
        self.fails(status.INPUT, scene.audit, "no-such-claim")
        self.fails(status.INPUT, scene.set, chi=2)
        self.assertEqual(scene.parameter("chi"), decimal.Decimal("0.8"))
        for wrong in (lambda: scene.jacobian(1, "no method"), lambda: scene.jacobian(1, layer="no layer"),
                      lambda: scene.simulate((1, 2, 3), 1), lambda: stickslip.Scene("pa\0per"),
                      lambda: scene.simulate(1, 1, route="no route")):
            self.assertRaises(ValueError, wrong)
        for wrong in (lambda: scene.orbits("x"), lambda: scene.orbits(1.5), lambda: scene.simulate(1, "x"),
                      lambda: scene.orbits(2**64 + 15), lambda: scene.jacobian(2**64)):
            self.assertRaises(ctypes.ArgumentError, wrong)

    def test_closed(self):
        scene = stickslip.Scene()
        orbits = scene.orbits()
        scene.close()
        scene.close()
        for again in (scene.orbits, lambda: scene.name, lambda: scene.parameter("V"), lambda: scene.printed("t_a"),
                      lambda: scene.set(V=1), lambda: scene.jacobian(1), lambda: scene.simulate(1, 1),
                      lambda: scene.sweep("V", 1, 2, 3), lambda: scene.audit("eq-1"), scene.__enter__().orbits):
            self.assertRaisesRegex(ValueError, "closed", again)
        self.assertEqual(orbits[1].e1, decimal.Decimal("2.7844"))

    def test_interrupt(self):
        def ring(*_):
            raise KeyboardInterrupt
        before = signal.signal(signal.SIGALRM, ring)
        try:
            scene = stickslip.Scene()
            for k in range(40):  # at any place of what is done for a row
                with self.assertRaises(KeyboardInterrupt):
                    signal.setitimer(signal.ITIMER_REAL, 0.01 + 0.001 * k)
                    scene.sweep("e2", "0.5", "3", 10**8)
            self.assertEqual(len(scene.orbits()), 2)
        finally:
            signal.signal(signal.SIGALRM, before)

    def test_callbacks_of_others(self):
        """What goes wrong in one that an interrupt calls is told where it would be without the library."""
        told, hook = [], sys.unraisablehook
        before = signal.signal(signal.SIGALRM, lambda *_: ctypes.CFUNCTYPE(None)(lambda: 1 / 0)())
        sys.unraisablehook = lambda what: told.append(what.exc_type)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
            self.assertGreaterEqual(len(stickslip.Scene().sweep("e2", "0.5", "3", 10**4)), 10**4)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            sys.unraisablehook = hook
            signal.signal(signal.SIGALRM, before)
        self.assertEqual(set(told), {ZeroDivisionError})


class Memory(unittest.TestCase):
    """Nothing is lost, and nothing used after its end."""

    def grown(self, times, work):
        """By how many KiB the process grows."""
        def resident():
            gc.collect()
            status = pathlib.Path("/proc/self/status").read_text()
            return int(re.search(r"VmRSS:\s+(\d+)", status)[1])
        for _ in range(times // 5):
            work()
        before = resident()
        for _ in range(times):
            work()
        return resident() - before

    def test_no_leak(self):
        scene = stickslip.Scene()

        def fail():
            self.assertRaises(stickslip.Error, stickslip.Scene.read, "chi = 2")
        self.assertLess(self.grown(400, scene.orbits), 400)
        self.assertLess(self.grown(1000, lambda: stickslip.Scene.read(PAPER).name), 1000)
        self.assertLess(self.grown(1000, fail), 1000)
        self.assertLess(self.grown(200, lambda: scene.jacobian(1)), 1000)
        self.assertLess(self.grown(200, lambda: scene.simulate(1, returns=1, sample=0.1)), 1000)
        self.assertLess(self.grown(80, lambda: scene.sweep("e2", 1, 2, 11)), 400)

    def test_exit(self):
        open_scene = "import stickslip, threading\nscene = stickslip.Scene()\nscene.self = scene\nscene.orbits()\n"
        busy = ("def go():\n    while True: scene.orbits(2000)\n"
                "threading.Thread(target=go, daemon=True).start()\n")
        for program in (open_scene, open_scene + busy, open_scene + "import sys\nsys.exit(0)\n"):
            done = alone(program)
            self.assertEqual((done.returncode, done.stderr), (0, ""), program)

    def test_threads(self):
        """One closes a scene that others use."""
        scene, said, others = stickslip.Scene(), [], []

        def use():
            try:
                while len(scene.orbits(50)) == 2:
                    pass
            except ValueError as error:
                said.append(str(error))
        for _ in range(4):
            others.append(threading.Thread(target=use))
            others[-1].start()
        threading.Event().wait(0.2)
        scene.close()
        for thread in others:
            thread.join()
        self.assertEqual(said, ["the scene is closed"] * 4)


class Notebook(unittest.TestCase):
    """The notebook prints what it shows, and that is what the oracle has."""

    def test_cells(self):
        cells = [cell for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]
        self.assertEqual(notebook.differences(cells, notebook.run(cells)), [])
        said = "".join(line for cell in cells for output in cell["outputs"] for line in output["text"])
        for name in ("t_a", "t_b", "t_c", "t_d", "z10", "z20"):
            value = re.search(rf"^{name} +\S+ +(\S+)", said, re.M)[1]
            self.assertEqual(decimal.Decimal(value), rounded(paper(1)[name], 12), name)
        found = dict(zip(("flip", "t_a"), re.search(r"for e2 from (\S+) to (\S+)", said).groups()))
        ends = {row[8]: row[9] for row in rows("bifurcations.tsv") if row[:7] == "0.8 1 1 2.7844 - e2 0.5".split()}
        for what, value in found.items():
            self.assertAlmostEqual(float(value), float(ends[what]), 8, what)

    def test_nbconvert(self):
        if not all(map(importlib.util.find_spec, ("nbconvert", "ipykernel"))):
            self.skipTest("no nbconvert with ipykernel (Debian: jupyter-nbconvert, python3-ipykernel)")
        command = [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--stdout", str(NOTEBOOK)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, env=os.environ | {
            "PYTHONPATH": os.pathsep.join([str(pathlib.Path("python").resolve()), os.environ.get("PYTHONPATH", "")])})
        self.assertEqual(done.returncode, 0, done.stderr)
        cells = [cell for cell in json.loads(done.stdout)["cells"] if cell["cell_type"] == "code"]
        said = ["".join(line for output in cell["outputs"] if output.get("name") == "stdout" for line in output["text"])
                for cell in cells]
        stored = [cell for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]
        self.assertEqual(notebook.differences(stored, said), [])


if __name__ == "__main__":
    unittest.main()
