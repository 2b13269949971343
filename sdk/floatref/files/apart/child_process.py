"""Reading in a process of its own, which may crash, hang or swell without harm.

Some libraries of C do all three over damaged files. The other process sends what it reads, piece
by piece; if it ends, or is silent for long, the file is refused. It ends with this process, however
this one ends.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Timer
from typing import Any

from floatref.errors import InputError
from floatref.files.apart.served_reading import END, Refused, Request

LONGEST_SILENCE_S = 60.0
"""Time in s for the start of the other process, and for each answer unless another is given."""
MOST_MEMORY = 1 << 30
"""Bytes that the other process may take beyond what it starts with, where the system counts."""
COMMAND = "from floatref.files.apart.served_reading import serve; serve()"


def read_apart(
    reader: str,
    arguments: tuple[Any, ...],
    broken: str,
    silence_s: float | None = None,
    most_memory: int = MOST_MEMORY,
) -> Iterator[Any]:
    """Yield what a function yields that runs in a process of its own.

    ``reader`` is the function, as `package.module:name`; ``arguments`` and what it yields can be
    pickled. The process may take ``most_memory`` bytes beyond those it starts with, and
    ``silence_s`` s (60, unless another is given) for each answer, and 60 s to start. InputError
    with the function's own text if it raises one, or with the text ``broken`` if the process ends,
    is silent for longer, or raises anything else.
    """
    # Not the current folder but our own modules: a data folder may hold a numpy.py.
    paths = os.pathsep.join(path for path in sys.path if path)
    silence_s = LONGEST_SILENCE_S if silence_s is None else silence_s
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", COMMAND],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        # Nobody reads it, see `served_reading`.
        stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"},
        # Ctrl-C goes to a whole group: this process answers it, and the file is not at fault.
        process_group=0,
    )
    with process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            request = pickle.dumps(Request(reader, arguments, most_memory, os.getpid()))
            with _ended_after(LONGEST_SILENCE_S, process):
                process.stdin.write(request)
                process.stdin.flush()
            _next(process, process.stdout, LONGEST_SILENCE_S)
            while (answer := _next(process, process.stdout, silence_s)) != END:
                if isinstance(answer, Refused):
                    raise InputError(answer.text)
                yield answer[0]
        except (OSError, _BrokenDownError) as error:
            raise InputError(broken) from error
        finally:
            process.kill()
            # What it has not taken of the request cannot be written any more.
            with suppress(OSError):
                process.stdin.close()


class _BrokenDownError(Exception):
    """The other process has ended, is silent, or says what cannot be read."""


def _next(process: "subprocess.Popen[bytes]", stream: Any, silence_s: float) -> Any:
    with _ended_after(silence_s, process):
        try:
            return pickle.load(stream)
        except Exception as error:
            # Half an answer can make pickle raise anything.
            raise _BrokenDownError from error


@contextmanager
def _ended_after(silence_s: float, process: "subprocess.Popen[bytes]") -> Iterator[None]:
    """Kill ``process`` if what is done inside takes longer than ``silence_s`` s."""
    watch = Timer(silence_s, process.kill)
    # Ctrl-C may come before it is cancelled, and at its end Python waits for other threads.
    watch.daemon = True
    try:
        watch.start()
        yield
    finally:
        watch.cancel()
