"""Ctrl-C while a command is loaded: one line and exit code 130, whichever module it comes in."""

import os
import subprocess
import sys

import pytest

LINES = {"floatref": "Interrupted\n", "floatref_conformance": "Interrupted: no verdict\n"}
RUN = """
import os, runpy, signal, sys

class Hit:
    def find_spec(name, path=None, target=None):
        if name == where:
            exec(hit) if text else eval(hit)

hit = "os.kill(os.getpid(), signal.SIGINT), [0 for _ in range(10**6)]"
where, text, package = sys.argv[1:]
sys.meta_path.insert(0, Hit)
sys.argv[1:] = ["--version"]
runpy.run_module(package, run_name="__main__")
"""
FIRST = """
import sys

class Stop:
    def find_spec(name, path=None, target=None):
        if name == "floatref.cli.program.interrupts":
            print(*sorted({n.partition(".")[0] for n in set(sys.modules) - before}))
            sys.exit()

before = set(sys.modules)
sys.meta_path.insert(0, Stop)
from MODULE import start
start()
"""


def python(text, *words):
    done = [sys.executable, "-c", text, *words]
    return subprocess.run(done, capture_output=True, text=True, check=False)


@pytest.mark.posix
@pytest.mark.parametrize("text", ["", "exec"])
@pytest.mark.parametrize("module", ["click", "floatref.cli.lazy", "MAIN"])
@pytest.mark.parametrize("package", LINES)
def test_ctrl_c_while_a_command_is_loaded(package, module, text):
    """Python runs the text of a named tuple; what interrupts that would end it by the signal."""
    where = f"{package}.cli.main" if module == "MAIN" else module
    done = python(RUN, where, text, package)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", LINES[package])


@pytest.mark.parametrize(
    "module", ["floatref.cli.program.starting", "floatref_conformance.__main__"]
)
def test_next_to_nothing_is_loaded_before_ctrl_c_is_a_line(module):
    """What is loaded before has a traceback: our packages alone, and not `typing` or `click`."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    words = [sys.executable, "-S", "-c", FIRST.replace("MODULE", module)]
    done = subprocess.run(words, capture_output=True, text=True, check=True, env=environment)
    ours = {"floatref", "floatref_conformance"}
    assert set(done.stdout.split()) - ours <= {"importlib", "warnings", "_warnings"}
