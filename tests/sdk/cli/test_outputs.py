"""Standard streams that are closed, as some schedulers leave them, or that lack letters."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from floatref import Profile, ProfileTrack, write_profile

WRITES = """
import os, sys
from floatref.cli.lazy import open_outputs
open_outputs()
number = os.open(sys.argv[1], os.O_WRONLY)
print("printed", flush=True)
print("printed", file=sys.stderr, flush=True)
os.write(number, b"our own")
"""


@pytest.mark.posix
@pytest.mark.parametrize("closed", [(0,), (1,), (2,), (0, 1, 2)])
def test_a_closed_stream_is_no_fault_and_no_other_file(
    tmp_path: Path, closed: tuple[int, ...]
) -> None:
    target = tmp_path / "file"
    target.touch()
    command = [sys.executable, "-c", WRITES, str(target)]
    done = subprocess.run(command, preexec_fn=lambda: list(map(os.close, closed)), timeout=600)
    assert done.returncode == 0
    assert target.read_bytes() == b"our own"


@pytest.mark.posix
@pytest.mark.slow
def test_a_command_says_what_it_says_to_nobody(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "floatref", "pipelines"]
    with (tmp_path / "errors").open("w") as errors:
        done = subprocess.run(command, stderr=errors, preexec_fn=lambda: os.close(1), timeout=600)
    assert (done.returncode, (tmp_path / "errors").read_text()) == (0, "")


@pytest.mark.slow
@pytest.mark.parametrize("encoding", ["cp437", "cp850"])
@pytest.mark.parametrize("words", [("iri", "road"), ("iri", "œ")])
def test_no_letter_is_too_much_for_the_encoding_of_an_output(
    words: tuple[str, ...], encoding: str, tmp_path: Path
) -> None:
    write_profile(Profile(0.25, (ProfileTrack.of("σ", 1e-3 * np.arange(99)),)), tmp_path / "road")
    done = subprocess.run(
        [sys.executable, "-m", "floatref", *words],
        cwd=tmp_path,
        env={**os.environ, "PYTHONIOENCODING": encoding},
        capture_output=True,
        timeout=600,
    )
    assert b"Traceback" not in done.stderr
    assert done.returncode == (2 if "œ" in words else 0)
    assert (done.stdout + done.stderr).decode(encoding)
