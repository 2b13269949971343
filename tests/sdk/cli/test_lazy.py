"""What fails outside of the program's own checks is one line with exit code 2, too."""

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import click
import numpy as np
import pytest
from click.testing import CliRunner

from floatref.cli.lazy import LazyGroup
from floatref.files import write_profile
from floatref.values.profile import Profile, ProfileTrack


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (MemoryError(), "Error: not enough memory; cut the run into shorter ones\n"),
        (MemoryError("1 PiB"), "Error: not enough memory (1 PiB); cut the run into shorter ones\n"),
        (OSError(28, "No space left", "a.f64"), "Error: a.f64: No space left\n"),
        (OSError(28, "No space left"), "Error: No space left\n"),
    ],
)
def test_an_error_of_the_system_is_one_line(
    monkeypatch: pytest.MonkeyPatch, error: BaseException, line: str
) -> None:
    @click.command("fail")
    def fail() -> None:
        raise error

    monkeypatch.setitem(sys.modules, "failing", SimpleNamespace(fail=fail))
    group = LazyGroup("group", lazy={"fail": ("failing:fail", "")})
    result = CliRunner().invoke(group, ["fail"])
    assert (result.exit_code, result.stderr) == (2, line)


@pytest.mark.posix
@pytest.mark.slow
@pytest.mark.parametrize("unbuffered", [pytest.param("", marks=pytest.mark.slow), "1"])
@pytest.mark.parametrize("words", [["--help"], ["iri", "--help"], ["iri", "P"]])
def test_a_full_standard_output_is_named(tmp_path: Path, unbuffered: str, words: list[str]) -> None:
    z = np.cumsum(np.random.default_rng(1).normal(0.0, 4e-4, 1000))
    write_profile(Profile(0.05, (ProfileTrack.of("main", z),)), tmp_path / "P")
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run(
            [sys.executable, "-c", "from floatref.cli.main import main; main()", *words],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            cwd=tmp_path,
            env=os.environ | {"PYTHONUNBUFFERED": unbuffered},
            check=False,
        )
    assert done.returncode == 2
    assert done.stderr == "Error: standard output: No space left on device\n"


@pytest.mark.posix
@pytest.mark.parametrize("text", ["", "exec"])
def test_ctrl_c_is_130_wherever_it_comes(tmp_path: Path, text: str) -> None:
    """Python runs the text of a named tuple; what interrupts that would end `python -m` by -2."""
    hit = "import os, signal; os.kill(os.getpid(), signal.SIGINT); [0 for _ in range(10**6)]"
    (tmp_path / "work.py").write_text(f"def command(): {f'exec({hit!r})' if text else hit}\n")
    (tmp_path / "prog.py").write_text(
        "import click\nfrom floatref.cli.lazy import LazyGroup\nimport work\n"
        "work.command = click.command()(work.command)\n"
        "LazyGroup('prog', lazy={'work': ('work:command', 'works')})()\n"
    )
    words = [sys.executable, "-m", "prog", "work"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (130, "Interrupted\n")
