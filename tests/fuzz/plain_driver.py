"""A driver without atheris: mutates a corpus for some seconds, and stops at the first finding.

A finding is an error other than a refusal, an input that takes longer than `LONGEST_S`, a process
that grows by more than `MOST_BYTES`, or a temporary file or a handle left behind. An input that is
refused by words that are new joins the corpus: there is no other guide to what a parser has
reached.
"""

import gc
import os
import random
import re
import resource
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

from mutations import mutate

LONGEST_S = 20.0
"""A busy machine reads any of these inputs in a hundredth of it."""
MOST_BYTES = 1 << 30
"""Twice what the libraries of all formats take."""
MORE_HANDLES = 8
"""Libraries open files of their own once, and keep them."""
HANDLES = Path("/proc/self/fd")
MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
"""Where files of inputs are: a disk takes longer to write one than a parser to read it."""

Read = Callable[[bytes], None]


class Found(Exception):
    """What an input has shown, in a line."""


class TooLong(BaseException):
    """The input takes too long; no parser catches it by chance."""


class Driver:
    """Gives inputs to ``read``; ``refusal`` returns the words of the last refusal, or None."""

    def __init__(self, read: Read, refusal: Callable[[], str | None], place: Path) -> None:
        """Write an input that finds something, or ends the process, to ``place``."""
        self._read, self._refusal, self._place = read, refusal, place
        self._answers: set[str] = set()
        self._before = _peak_bytes()
        self.corpus: list[bytes] = []
        self.count = 0

    def run(self, seeds: list[bytes], seconds: float, draw: random.Random) -> None:
        """Read ``seeds``, then mutations for ``seconds``; raise Found at the first finding."""
        with _temporary_folder() as folder:
            for seed in seeds:
                self._try(seed, folder)
            self.corpus += [seed for seed in seeds if seed not in self.corpus]
            handles, end = _count_handles(), time.monotonic() + seconds
            while time.monotonic() < end:
                self._try(mutate(draw.choice(self.corpus), self.corpus, draw), folder)
            if _count_handles() > handles + MORE_HANDLES:
                raise Found(f"{_count_handles() - handles} handles are left open")

    def _try(self, data: bytes, folder: Path) -> None:
        self._place.write_bytes(data)
        self.count += 1
        _read_in_time(self._read, data)
        if left := sorted(os.listdir(folder)):
            raise Found(f"left behind in the temporary folder: {', '.join(left)}")
        if _peak_bytes() > self._before + MOST_BYTES:
            raise Found(f"the process has grown by more than {MOST_BYTES >> 20} MiB")
        answer = re.sub(r"[\d.]+|'.*?'", "#", self._refusal() or "read")
        if answer not in self._answers and len(self._answers) < 1000:
            self._answers.add(answer)
            self.corpus.append(data)


def _read_in_time(read: Read, data: bytes) -> None:
    def stop(number: int, frame: FrameType | None) -> None:
        raise TooLong

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, LONGEST_S)
    try:
        read(data)
    except TooLong as error:
        raise Found(f"not read within {LONGEST_S:g} s") from error
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        raise Found(f"{type(error).__name__}: {error}") from error
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def _peak_bytes() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def _count_handles() -> int:
    gc.collect()
    return len(os.listdir(HANDLES)) if sys.platform == "linux" else 0


@contextmanager
def _temporary_folder() -> Iterator[Path]:
    """Let this process make its temporary files in a new folder."""
    before = tempfile.tempdir
    with tempfile.TemporaryDirectory(prefix="fuzz-temporary-", dir=MEMORY) as name:
        tempfile.tempdir = name
        try:
            yield Path(name)
        finally:
            tempfile.tempdir = before
