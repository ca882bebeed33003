"""Periodic stick-slip orbits of two masses on a moving belt, by the library libstickslip.

    import stickslip

    scene = stickslip.Scene("paper")                # chi, eta, V, e1, e2 of the paper's example
    for orbit in scene.orbits(digits=30):           # every periodic orbit, proved
        print(orbit.t_b, orbit.trace, orbit.stable, orbit.admissible)
    print(scene.jacobian(1).matrix)                 # J at orbit 1; orbits are counted from 0
    print(scene.simulate(1, returns=2).events)      # (1) and (2), event by event
    rows = scene.sweep("e2", "0.5", "3", 101)       # the orbits along a line
    print(scene.audit("eq-40")["claims"][0]["verdict"])

Numbers with proofs are decimal.Decimal: all digits are right, the last one rounded; those given exactly have no zeros
at their end.  as_mpmath and as_numpy make mpmath's and numpy's of them, where these are installed.  What runs in double
precision (sweep, simulate) gives floats.  Truth is True, False, or None where it is not known.  Parameters may be
numbers or constant expressions, "4/5", and are taken exactly as they are written.

What cannot be done raises Error.  Equations (1), (2), ... are the paper's; nothing has a dimension.  The library is
that of the environment's STICKSLIP_LIBRARY, or of the build or installation that this file is in, or the system's.  Its
headers, man pages stickslip-orbit(3) and others, say more of every function.  LC_NUMERIC must be left at "C"."""
import contextlib
import ctypes
import decimal
import enum
import json
import math
import os
import pathlib
import re
import sys
import threading
import weakref
from collections import namedtuple

_SONAME = "libstickslip.so.0"
_MADE_FOR = "0.1."  # the versions of the library in which all below is as the headers have it

# Of the headers, to the letter; tests/python has a C compiler hold them, and the structures below, against the headers.
_FUNCTIONS = """
const char *ss_status_text(int status);
const char *ss_error(void);
const char *ss_version(void);
void ss_text_free(char *text);
int ss_number_text(char **out, const ss_number *x, size_t digits);
size_t ss_number_digits(const ss_number *x);
double ss_number_radius(const ss_number *x);
int ss_scene_open(ss_scene **out, const char *spec, const char *data);
int ss_scene_read(ss_scene **out, const char *name, const char *text);
int ss_scene_set(ss_scene *s, const char *lines);
void ss_scene_free(ss_scene *s);
const char *ss_scene_name(const ss_scene *s);
const ss_number *ss_scene_parameter(const ss_scene *s, const char *name);
const ss_number *ss_scene_printed(const ss_scene *s, const char *name);
const char *ss_orbit_number_name(int number);
int ss_orbits_find(ss_orbits **out, const ss_scene *s, size_t digits);
void ss_orbits_free(ss_orbits *o);
size_t ss_orbits_count(const ss_orbits *o);
int ss_orbits_complete(const ss_orbits *o);
double ss_orbits_reach(const ss_orbits *o);
const char *ss_orbits_gap(const ss_orbits *o);
const ss_number *ss_orbit_number(const ss_orbits *o, size_t k, int number);
enum ss_truth ss_orbit_stable(const ss_orbits *o, size_t k);
enum ss_truth ss_orbit_admissible(const ss_orbits *o, size_t k);
const char *ss_orbit_violation(const ss_orbits *o, size_t k, size_t i);
int ss_orbit_certified(const ss_orbits *o, size_t k);
int ss_orbit_open(char **out, const ss_orbits *o, size_t k);
const char *ss_condition_name(int condition);
int ss_paper_open(ss_paper **out, const char *data);
void ss_paper_free(ss_paper *p);
const char *ss_layer_name(int layer);
const char *ss_method_name(int method);
int ss_jacobian_find(ss_jacobian **out, const ss_paper *p, const ss_scene *s, int method, int layer, long at,
    size_t digits);
void ss_jacobian_free(ss_jacobian *j);
const ss_number *ss_jacobian_entry(const ss_jacobian *j, int row, int column);
const ss_number *ss_jacobian_trace(const ss_jacobian *j);
const ss_number *ss_jacobian_det(const ss_jacobian *j);
int ss_motion_on_orbit(ss_motion **out, const ss_scene *s, size_t k);
int ss_motion_printed(ss_motion **out, const ss_scene *s);
int ss_motion_from(ss_motion **out, const ss_scene *s, const double start[4]);
void ss_motion_free(ss_motion *m);
int ss_motion_parameters(double params[7], const ss_motion *m);
int ss_motion_friction_is_own(const ss_motion *m);
double ss_motion_period(const ss_motion *m);
int ss_motion_run(ss_moment *end, const ss_motion *m, int route, double duration, long returns, double sample,
    ss_on_event event, ss_on_sample moment, void *self);
int ss_sweep(const ss_scene *s, const char *parameter, const char *from, const char *to, size_t n, size_t every,
    ss_on_orbit f, void *self);
int ss_audit_run(ss_audit **out, const ss_paper *p, const ss_scene *s, const char *only, int jobs,
    void (*progress)(void *self, size_t done, size_t of), void *self);
void ss_audit_free(ss_audit *a);
int ss_audit_json(char **out, const ss_audit *a);
"""


class _Moment(ctypes.Structure):
    _fields_ = [("t", ctypes.c_double), ("x", ctypes.c_double * 2), ("v", ctypes.c_double * 2),
                ("u", ctypes.c_double * 2), ("mode", ctypes.c_int * 2)]


class _Event(ctypes.Structure):
    _fields_ = [("at", _Moment), ("mass", ctypes.c_int), ("from", ctypes.c_int), ("to", ctypes.c_int),
                ("simultaneous", ctypes.c_int), ("grazing", ctypes.c_int)]


class _Swept(ctypes.Structure):
    _fields_ = [("point", ctypes.c_size_t), ("x", ctypes.c_double), ("orbits", ctypes.c_size_t),
                ("orbit", ctypes.c_size_t), ("out", ctypes.c_double * 10), ("violations", ctypes.c_uint),
                ("unsure", ctypes.c_uint), ("stable", ctypes.c_int), ("admissible", ctypes.c_int),
                ("status", ctypes.c_char_p)]


class Status(enum.IntFlag):
    """How a function of the library answers; the first two are what mathematics answers, the others are about the
    call."""
    DOMAIN = 1    # the value does not exist
    UNABLE = 2    # it could not be told or held
    ARGUMENT = 4  # a wrong argument
    INPUT = 8     # a file or a text is wrong, or asks for what cannot be had
    STOPPED = 16


# The lists below are in the order of the headers' enumerations.
_AT_PRINTED = -1
_TRUTH = (False, True, None)
_MODES = ("stick", "below", "above")
_ROUTES = ("integrated", "closed")
_PARAMETERS = ("chi", "eta", "V", "u_s1", "u_s2", "u_r1", "u_r2")


# --- The library and its functions ---

_KINDS = {"void": None, "double": ctypes.c_double, "int": ctypes.c_int, "long": ctypes.c_long,
          "size_t": ctypes.c_size_t}


def _kind(declared):
    """What ctypes calls a declared result or argument: "const char *name", "enum ss_truth", "double start[4]"."""
    if declared.startswith("const char *"):
        return ctypes.c_char_p
    if declared.startswith("enum "):
        return ctypes.c_int
    pointer = "*" in declared or "[" in declared
    return ctypes.c_void_p if pointer else _KINDS.get(declared.split()[0], ctypes.c_void_p)


def _argument(kind):
    """An argument: of a number that is too large ctypes would take the last bits.  What is negative the library says."""
    if not isinstance(kind(), ctypes._SimpleCData) or not isinstance(kind().value, int):
        return kind

    class Whole(kind):
        @classmethod
        def from_param(cls, value):
            if isinstance(value, int) and kind(value).value != value and not -2**31 <= value < 0:
                raise OverflowError(f"{value} is out of range")
            return kind.from_param(value)
    return Whole


def _load():
    """The library, each of _FUNCTIONS with its types."""
    here = pathlib.Path(__file__).resolve()
    beside = [path for path in (here.parents[1] / "build" / _SONAME, here.parents[2] / _SONAME) if path.exists()]
    path = os.environ.get("STICKSLIP_LIBRARY") or str((beside + [_SONAME])[0])
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"{error}; STICKSLIP_LIBRARY names the library where it is elsewhere") from None
    for result, name, arguments in re.findall(r"(\S.*?)(ss_\w+)\((.*?)\);", " ".join(_FUNCTIONS.split())):
        plain = re.sub(r"\w+ \(\*\w+\)\(.*?\)", "void *", arguments)  # of functions that are told
        function = getattr(library, name)
        function.restype = _kind(result)
        function.argtypes = [_argument(_kind(a)) for a in plain.split(", ") if a != "void"]
    version = library.ss_version().decode()
    if not version.startswith(_MADE_FOR):
        raise ImportError(f"{path} is version {version}, and this module is for {_MADE_FOR}x")
    return library


_lib = _load()
__version__ = _lib.ss_version().decode()


class Error(Exception):
    """What the library could not do: status and its text, message, which counts orbits from 1 as the commands do, and
    where an input is wrong the file, line and column, which are None elsewhere."""

    def __init__(self, status, message):
        super().__init__(status, message)
        self.status = Status(status)
        self.text = _lib.ss_status_text(status).decode()
        self.message = message
        place = re.match(r"(.+?):(\d+):(\d+): ", message)
        self.file, self.line, self.column = (place[1], int(place[2]), int(place[3])) if place else (None, None, None)

    def __str__(self):
        return self.message


class _Rows(list):
    """A list that the library fills.  What happens in between (Ctrl-C) stops the library, and is raised after it."""

    def __init__(self, kind, read):
        super().__init__()
        self.read, self.trouble = read, None
        self._as_parameter_ = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, kind)(self.take)

    def take(self, _, row):
        try:
            if self.trouble is None:
                self.append(self.read(row))
        except BaseException as trouble:  # an exception does not pass through C
            self.trouble = trouble
        return self.trouble is None


@contextlib.contextmanager
def _kept(rows):
    """An interrupt that meets take outside its try: ctypes would print it and go on.  Only the main thread has them."""
    before, main = sys.unraisablehook, threading.current_thread()

    def own(what):  # from Python 3.13 on its text alone says what was called
        return what.object in [r.take for r in rows] if what.object else "_Rows.take" in (what.err_msg or "")

    def keep(what):
        if threading.current_thread() is not main or not own(what):
            before(what)
            return
        for r in rows:
            r.trouble = r.trouble or what.exc_value
    if rows and threading.current_thread() is threading.main_thread():
        sys.unraisablehook = keep
    try:
        yield
    finally:
        if sys.unraisablehook is keep:
            sys.unraisablehook = before


def _call(function, *arguments):
    rows = [a for a in arguments if isinstance(a, _Rows)]
    with _kept(rows):
        status = getattr(_lib, function)(*arguments)
    for r in rows:
        if r.trouble:
            raise r.trouble
    if status:
        raise Error(status, _lib.ss_error().decode("utf-8", "replace"))


@contextlib.contextmanager
def _made(function, free, *arguments):
    """A handle, for as long as it is needed."""
    handle = ctypes.c_void_p()
    _call(function, ctypes.byref(handle), *arguments)
    try:
        yield handle
    finally:
        getattr(_lib, free)(handle)


def _text(value):
    """A text as C has it."""
    if value is None:
        return None
    text = os.fsencode(value) if isinstance(value, os.PathLike) else str(value).encode()
    if b"\0" in text:
        raise ValueError("a text with a null character")
    return text


def _taken(function, *arguments):
    """The text that a function makes."""
    with _made(function, "ss_text_free", *arguments) as text:
        return ctypes.string_at(text.value).decode()


def _said(text):
    return None if text is None else text.decode()


def _decimal(number, digits):
    """So many digits, fewer where fewer are sure; None where none is, or where there is no number."""
    if not number:
        return None
    try:
        text = _taken("ss_number_text", number, digits)
    except Error as error:
        known = _lib.ss_number_digits(number)
        if error.status != Status.UNABLE:
            raise
        if not known:
            return None
        text = _taken("ss_number_text", number, known)
    if _lib.ss_number_radius(number) == 0:
        text = re.sub(r"(\.\d*?)0+(?=e|$)", r"\1", text)
    return decimal.Decimal(text)


def _names(function):
    """The names of an enumeration: all that the function knows."""
    names = []
    while (name := _said(getattr(_lib, function)(len(names)))) is not None:
        names.append(name)
    return names


def _index(name, names):
    if name not in names:
        raise ValueError(f"{name!r} is none of {', '.join(names)}")
    return names.index(name)


def _orbit(at):
    """Checked here: ctypes would take a negative number for a large one, and the library for another place."""
    if at < 0:
        raise Error(Status.ARGUMENT, f"orbits are counted from 0: there is no orbit {at}")
    return at


# --- What comes back ---

_NUMBERS = _names("ss_orbit_number_name")
_OUTPUTS = [name for name in _NUMBERS if name not in ("e1", "e2")]
_CONDITIONS = _names("ss_condition_name")

Orbit = namedtuple("Orbit", _NUMBERS + ["stable", "admissible", "violations", "certified", "open"])
Orbit.__doc__ = """A periodic orbit of the word D-Gamma-H-C.

z10, z20: positions where the global stick phase begins; t_a, t_b, t_c, t_d: lengths of the phases D, Gamma, H, C;
e1, e2: u_ri - u_si; period: t_a + t_b + t_c + t_d; trace: tr J, the multiplier; u_r1_min, u_r2_min: infimum of the
static friction by (54), (57), (59); stable: |tr J| < 1; admissible: (51), (54), (57), (59) hold; violations: the names of
conditions that it breaks; certified: all of this is proved; open: what of it is not, "" when nothing is."""

Jacobian = namedtuple("Jacobian", "matrix trace det")
Jacobian.__doc__ = "J of one period, (z10, z20) -> (z1f, z2f), by rows; its trace, which is the multiplier; det J = 0."

Moment = namedtuple("Moment", "t x v u mode")
Moment.__doc__ = """A time, and of the two masses positions, velocities, friction forces and modes: "stick", "below" or
"above" the belt's velocity."""

Event = namedtuple("Event", "at mass before after simultaneous grazing")
Event.__doc__ = """Mass 0 or 1 changes its mode, the moment being just after; simultaneous: the other one does too;
grazing: its speed touched V, or crossed it so flatly that rounding decides."""

Simulation = namedtuple("Simulation", "events samples end period parameters friction_is_own")
Simulation.__doc__ = """A motion: its events, its samples and its last moment; the period of the orbit that it began on
(else of the scene's first one, 0 when it has none); chi, eta, V, u_s1, u_s2, u_r1, u_r2; whether a u_ri is not the
scene's."""

Swept = namedtuple("Swept", ["point", "x", "orbits", "orbit"] + _OUTPUTS +
                   ["violations", "unsure", "stable", "admissible", "status"])
Swept.__doc__ = """An orbit at a point of a line: which point, from 0, and its value x; how many orbits there are, which
one this is (none: one row, numbers NaN); its numbers as in Orbit, in double precision; conditions that it breaks, and
those undecided; status: "ok", or a word for what is open at the point."""


class Orbits(list):
    """Orbits by increasing z10.  complete: it is proved that there is no other, for t_c up to reach; gap: else why
    not."""

    def __init__(self, handle, digits):
        super().__init__(self._orbit(handle, k, digits) for k in range(_lib.ss_orbits_count(handle)))
        self.complete = bool(_lib.ss_orbits_complete(handle))
        self.reach = _lib.ss_orbits_reach(handle)
        self.gap = _said(_lib.ss_orbits_gap(handle))

    @staticmethod
    def _orbit(handle, k, digits):
        numbers = [_decimal(_lib.ss_orbit_number(handle, k, i), digits) for i in range(len(_NUMBERS))]
        violations = []
        while (name := _said(_lib.ss_orbit_violation(handle, k, len(violations)))) is not None:
            violations.append(name)
        return Orbit(*numbers, _TRUTH[_lib.ss_orbit_stable(handle, k)], _TRUTH[_lib.ss_orbit_admissible(handle, k)],
                     tuple(violations), bool(_lib.ss_orbit_certified(handle, k)), _taken("ss_orbit_open", handle, k))


def _moment(m):
    return Moment(m.t, tuple(m.x), tuple(m.v), tuple(m.u), tuple(_MODES[mode] for mode in m.mode))


def _event(e):
    return Event(_moment(e.at), e.mass, _MODES[getattr(e, "from")], _MODES[e.to], bool(e.simultaneous), bool(e.grazing))


def _conditions(bits):
    return tuple(name for i, name in enumerate(_CONDITIONS) if bits >> i & 1)


def _swept(row):
    return Swept(row.point, row.x, row.orbits, row.orbit, *row.out, _conditions(row.violations),
                 _conditions(row.unsure), _TRUTH[row.stable], _TRUTH[row.admissible], row.status.decode())


# --- What is asked ---

class Scene:
    """Exact parameters chi, eta, V, two of e1, e2, t_a, t_b, t_c, t_d, and u_r1, u_r2 if given; from a file, whose path
    has a slash or ends in .scene, or by its name on file.  Threads that share a scene wait for each other."""

    def __init__(self, spec="paper", data=None):
        os.fspath(spec)  # TypeError where it is neither a text nor a path: 5 is not the file 5.scene
        self._hold(data, "ss_scene_open", _text(spec), _text(data))

    @classmethod
    def read(cls, text, name="scene", data=None):
        """From a text in the language of scene files, stickslip-scene(5)."""
        scene = cls.__new__(cls)
        scene._hold(data, "ss_scene_read", _text(name), _text(text))
        return scene

    def _hold(self, data, function, *arguments):
        self._data, self._lock, self._handle = data, threading.RLock(), ctypes.c_void_p()
        _call(function, ctypes.byref(self._handle), *arguments)
        self._free = weakref.finalize(self, _lib.ss_scene_free, self._handle)
        self._free.atexit = False  # a thread may still use it then

    @contextlib.contextmanager
    def _open(self):
        with self._lock:
            if not self._free.alive:
                raise ValueError("the scene is closed")
            yield self._handle

    def close(self):
        """Gives back its memory, as its end does too."""
        with self._lock:
            self._free()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    @property
    def name(self):
        """What messages call it; after set with what was changed."""
        with self._open() as s:
            return _said(_lib.ss_scene_name(s))

    def parameter(self, name, digits=28):
        """The value of chi, eta, V, e1, ...; None where it is not given, or given as an interval."""
        with self._open() as s:
            return _decimal(_lib.ss_scene_parameter(s, _text(name)), digits)

    def printed(self, name, digits=28):
        """The number that the paper prints under a name; None where it prints none."""
        with self._open() as s:
            return _decimal(_lib.ss_scene_printed(s, _text(name)), digits)

    def set(self, **lines):
        """Lines anew, all or none: set(e2="1/2"), set(e2=None, t_a="0.5")."""
        with self._open() as s:
            _call("ss_scene_set", s, _text("\n".join(f"{k}={'' if v is None else v}" for k, v in lines.items())))

    def orbits(self, digits=15):
        """Every periodic orbit, its numbers to so many digits."""
        with self._open() as s, _made("ss_orbits_find", "ss_orbits_free", s, digits) as orbits:
            return Orbits(orbits, digits)

    def jacobian(self, at, method="analytic", layer="corrected", digits=15):
        """J at orbit `at`, or at the "printed" numbers.  method: analytic, the paper's J_f J_c J_b J_a (26)-(43) in a
        layer (printed, corrected, stable); or implicit, saltation, fd, fd-double, ode, which use no formula of the
        paper."""
        method, layer = _index(method, _names("ss_method_name")), _index(layer, _names("ss_layer_name"))
        at = _AT_PRINTED if at == "printed" else _orbit(at)
        with self._open() as s, _made("ss_paper_open", "ss_paper_free", _text(self._data)) as paper:
            with _made("ss_jacobian_find", "ss_jacobian_free", paper, s, method, layer, at, digits) as j:
                rows = [[_decimal(_lib.ss_jacobian_entry(j, i, k), digits) for k in range(2)] for i in range(2)]
                trace, det = _decimal(_lib.ss_jacobian_trace(j), digits), _decimal(_lib.ss_jacobian_det(j), digits)
                return Jacobian(tuple(map(tuple, rows)), trace, det)

    def simulate(self, start, duration=math.inf, returns=0, sample=0, route="closed"):
        """The motion under Coulomb's law (2) from orbit `start`, from the "printed" numbers, or from (x_1, x_2, x_1',
        x_2'), until the duration is over or both masses have come to stick so many times, of which one must be given;
        samples so far apart.  route: closed forms in each mode, or integrated."""
        if start == "printed":
            asked = ("ss_motion_printed",)
        elif hasattr(start, "__index__"):
            asked = ("ss_motion_on_orbit", _orbit(start))
        else:
            x1, x2, v1, v2 = start
            asked = ("ss_motion_from", (ctypes.c_double * 4)(x1, x2, v1, v2))
        events = _Rows(ctypes.POINTER(_Event), lambda e: _event(e.contents))
        samples = _Rows(ctypes.POINTER(_Moment), lambda m: _moment(m.contents))
        end, parameters = _Moment(), (ctypes.c_double * 7)()
        with self._open() as s, _made(asked[0], "ss_motion_free", s, *asked[1:]) as motion:
            _call("ss_motion_parameters", parameters, motion)
            _call("ss_motion_run", ctypes.byref(end), motion, _index(route, _ROUTES), duration, returns, sample, events,
                  samples, None)
            return Simulation(list(events), list(samples), _moment(end), _lib.ss_motion_period(motion),
                              dict(zip(_PARAMETERS, parameters)), bool(_lib.ss_motion_friction_is_own(motion)))

    def sweep(self, parameter, first, last, points, every=0):
        """The orbits at so many values of chi, eta, V, e1 or e2, the ends included, each a Swept; searched for at every
        so many points, and followed between."""
        rows = _Rows(ctypes.POINTER(_Swept), lambda row: _swept(row.contents))
        with self._open() as s:
            _call("ss_sweep", s, _text(parameter), _text(first), _text(last), points, every, rows, None)
        return list(rows)

    def audit(self, only=None, jobs=1):
        """The paper's claims, judged: audit.json as a dictionary.  only: ids with commas between, "eq-40,num-t_a";
        without, all that the scene asks for, which takes seconds.  jobs: how many processes."""
        with self._open() as s, _made("ss_paper_open", "ss_paper_free", _text(self._data)) as paper:
            with _made("ss_audit_run", "ss_audit_free", paper, s, _text(only), jobs, None, None) as audit:
                return json.loads(_taken("ss_audit_json", audit))


# --- Other kinds of numbers ---

def as_mpmath(value):
    """The same with every Decimal an mpmath.mpf of all its digits, at least of mpmath's precision, and a matrix an
    mpmath.matrix."""
    import mpmath
    if isinstance(value, decimal.Decimal):
        with mpmath.workdps(max(mpmath.mp.dps, len(value.as_tuple().digits) + 2)):
            return mpmath.mpf(str(value))
    if hasattr(value, "_fields"):
        return type(value)(*map(as_mpmath, value))
    if isinstance(value, tuple) and value and isinstance(value[0], tuple):
        return mpmath.matrix([[as_mpmath(x) for x in row] for row in value])
    return [as_mpmath(x) for x in value] if isinstance(value, list) else value


def as_numpy(rows):
    """The columns of orbits, of a sweep or of samples, by name: numbers as doubles; conditions and modes as one text,
    with commas between."""
    import numpy

    def plain(value):
        if isinstance(value, decimal.Decimal):
            return float(value)
        names = isinstance(value, tuple) and all(isinstance(x, str) for x in value)
        return ",".join(value) if names else value
    fields = rows[0]._fields if rows else ()
    return {name: numpy.array([plain(getattr(row, name)) for row in rows]) for name in fields}
