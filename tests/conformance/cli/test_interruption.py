"""Ctrl-C in real commands: one line, exit code 130, no file, and no process that goes on.

Law: whenever all processes of a command get SIGINT, as a terminal sends it, the first one ends with
130 and one line, and soon none of them exists.
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner

from floatref.cli.main import COMMANDS as OF_FLOATREF
from floatref.cli.main import main as floatref
from floatref_conformance.cli.main import COMMANDS as OF_CONFORMANCE
from floatref_conformance.cli.main import main as conformance
from floatref_conformance.cli.no_verdict import MISSING

PROC = Path("/proc")
LONG = {
    "floatref process": (("process", "run", "--out", "p", "--plot", "p.png"), 0, "Interrupted"),
    "run": (("run", "--report", "report"), 0, "no verdict"),
    "simulate": (("simulate", "ref_72", "--runs", "9", "--out", "o"), 0, "no recording"),
    "sample": (("sample", "certification", "--out", "o"), 0, "no sample"),
    "export": (("export", "--out", "o"), 0, "no verdict"),
    "certify": (("certify", "runs", "--reference", "truth", "--report", "r"), 2, "no worksheet"),
    "table": (("table", "--plot", "t.png"), 0, "no table"),
    "table --jobs": (("table", "--family", "urban", "--jobs", "2"), 2, "no table"),
    "faults --jobs": (("faults", "--jobs", "2", "--out", "f.json"), 2, "no study"),
    "faults --clean": (("faults", "--clean", "9", "--jobs", "2"), 2, "no study"),
    "selftest": (("selftest",), 2, "no counts"),
}
"""By command: its words, how many processes it starts, and its line."""


@pytest.mark.parametrize("name", [*OF_FLOATREF, *OF_CONFORMANCE])
def test_every_command_ends_with_130_and_one_line(name, monkeypatch):
    group = floatref if name in OF_FLOATREF else conformance

    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(group.get_command(None, name), "make_context", interrupted)
    ended = CliRunner().invoke(group, [name])
    line = "" if name in OF_FLOATREF else f": {MISSING.get(name, 'no verdict')}"
    assert (ended.exit_code, ended.stdout, ended.stderr) == (130, "", f"Interrupted{line}\n")


@pytest.fixture(scope="module")
def recordings(tmp_path_factory):
    """Three passes of a road, and one alone."""
    folder = tmp_path_factory.mktemp("recordings")
    words = ("simulate", "ref_72", "--runs", "3", "--out", folder / "runs")
    done = CliRunner().invoke(conformance, [*map(str, words), "--truth", str(folder / "truths")])
    assert done.exit_code == 0, done.output
    return folder


@pytest.mark.posix
@pytest.mark.slow
@pytest.mark.skipif(not PROC.is_dir(), reason="what a process has loaded is read from /proc")
@pytest.mark.parametrize("name", LONG)
def test_a_real_command_ends_with_all_its_processes(name, recordings, tmp_path):
    words, count, line = LONG[name]
    package = "floatref" if name.startswith("floatref") else "floatref_conformance"
    os.symlink(recordings / "runs", tmp_path / "runs")
    os.symlink(recordings / "runs" / "run_001", tmp_path / "run")
    os.symlink(recordings / "truths" / "run_001", tmp_path / "truth")
    scratch = tmp_path.parent / f"{tmp_path.name}-scratch"
    scratch.mkdir()
    process = subprocess.Popen(
        [sys.executable, "-m", package, *words],
        cwd=tmp_path,
        env={**os.environ, "TMPDIR": str(scratch)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    wait_until(lambda: is_at_work(process, count), process)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=300)
    wait_until(lambda: not members(process.pid), None)
    assert process.returncode == 130, errors
    assert "Traceback" not in errors
    last = errors.splitlines()[-1]
    assert last.startswith("Interrupted")
    assert line in last
    assert {path.name for path in tmp_path.iterdir()} == {"run", "runs", "truth"}
    assert list(scratch.iterdir()) == []


def wait_until(condition, process):
    """Wait for ``condition``, and fail where ``process`` ends before."""
    while not condition():
        assert process is None or process.poll() is None, process.communicate()
        time.sleep(0.02)


def is_at_work(process, count):
    """Return whether ``process`` computes, or ``count`` others that it has started."""
    group = members(process.pid)
    if not count:
        return has_loaded(process.pid)
    return sum(has_loaded(pid) for pid in group if pid != process.pid) >= count


def has_loaded(pid):
    """Return whether a process has loaded the compiler of kernels."""
    try:
        return "llvmlite" in (PROC / str(pid) / "maps").read_text(encoding="utf-8")
    except OSError:
        return False


def members(group):
    """Return the processes of ``group`` that are not only waiting to be reaped."""
    found = []
    for entry in PROC.iterdir():
        if not entry.name.isdigit():
            continue
        try:
            fields = (entry / "stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        except OSError:
            continue
        state, own = fields[0], int(fields[2])
        if own == group and state != "Z":
            found.append(int(entry.name))
    return found
