"""Silence of worker processes: what they and the cluster print goes nowhere."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

OUTPUTS = (1, 2)
"""File descriptors of standard output and standard error."""


@contextmanager
def silence() -> Iterator[TextIO]:
    """Send what is printed inside nowhere, and yield a stream that still reaches standard error.

    Processes that are started inside are silent for all of their lives, as are libraries that
    write through the file descriptors.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(number) for number in OUTPUTS]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    shown = _shown(kept[1])
    try:
        for number in OUTPUTS:
            os.dup2(nowhere, number)
        yield shown
    finally:
        shown.flush()
        sys.stdout.flush()
        sys.stderr.flush()
        for number, copy in zip(OUTPUTS, kept, strict=True):
            os.dup2(copy, number)
            os.close(copy)
        os.close(nowhere)


def _shown(copy: int) -> TextIO:
    """Return standard error on descriptor ``copy``; as it is if it is not a descriptor's."""
    try:
        if sys.stderr.fileno() != OUTPUTS[1]:
            return sys.stderr
    except OSError:
        return sys.stderr
    encoding, errors = sys.stderr.encoding, sys.stderr.errors
    return open(copy, "w", buffering=1, encoding=encoding, errors=errors, closefd=False)
