"""A signal while a file is opened is what it is, and no error of the file."""

import gc
import os
import random
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from floatref.files.sources import open_bytes

pytestmark = pytest.mark.posix

ROUNDS = 20_000
LATEST_S = 60e-6
"""A file is opened and closed within that."""


@pytest.fixture
def alarm() -> Iterator[None]:
    """Let the alarm of the system raise KeyboardInterrupt."""

    def ring(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, ring)
    # Hypothesis has a callback of the collector, in which Python drops what a signal raises.
    gc.disable()
    yield
    gc.enable()
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    signal.signal(signal.SIGALRM, before)


def open_until(alarm_s: float, path: Path) -> bool:
    """Open the file at ``path`` and close it; return whether the alarm has rung before."""
    try:
        try:
            signal.setitimer(signal.ITIMER_REAL, alarm_s)
            with open_bytes(path):
                pass
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
    except KeyboardInterrupt:
        return True
    return False


@pytest.mark.filterwarnings("ignore::ResourceWarning")
def test_an_interruption_at_any_moment_is_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, alarm: None
) -> None:
    """A handle that was closed twice was "Bad file descriptor", and exit code 2."""
    path = tmp_path / "file"
    path.write_bytes(b"content")
    dropped: list[object] = []
    monkeypatch.setattr(sys, "unraisablehook", dropped.append)
    draw = random.Random()
    with path.open("rb") as other:
        rung = sum(open_until(draw.uniform(1e-6, LATEST_S), path) for _ in range(ROUNDS))
        assert os.read(other.fileno(), 7) == b"content"
    assert rung > 0
    assert dropped == []
