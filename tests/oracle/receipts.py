"""receipts.py FILE...: run each script in a child of one process, which has taken SymPy in once for all of them.

What a script prints goes to FILE.out.  One line for each: its exit status, and FILE.  One that a reader would have to
wait for is ended, which is a failure.
"""
import os
import resource
import runpy
import sys

import sympy  # noqa: F401  the scripts import it again, for nothing

LONGEST = 20  # seconds of a processor; the slowest takes four


def child(file):
    out = os.open(file + ".out", os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
    os.dup2(out, 1)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    sys.argv = [file]
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))
    status = 0
    try:
        runpy.run_path(file, run_name="__main__")
    except SystemExit as e:
        status = e.code if isinstance(e.code, int) else int(e.code is not None)
    except (SyntaxError, LookupError, NameError):  # no refusal: it is no script, or of nothing that it knows
        status = 2
    except BaseException:  # pylint: disable=broad-except  as the interpreter itself ends
        status = 1
    sys.stdout.flush()
    os._exit(status)


for name in sys.argv[1:]:
    pid = os.fork()
    if pid == 0:
        child(name)
    print(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), name, flush=True)
