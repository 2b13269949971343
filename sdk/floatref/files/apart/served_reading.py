"""The side of the other process: it reads, and ends with the one that has started it."""

import os
import pickle
import signal
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from threading import Thread
from typing import Any, BinaryIO

from floatref.errors import InputError

GONE = 1
"""Exit code of a process whose parent has ended."""


@dataclass(frozen=True)
class Request:
    """What is asked of the other process: what ``reader`` yields for ``arguments``."""

    reader: str
    arguments: tuple[Any, ...]
    most_memory: int
    parent: int


@dataclass(frozen=True)
class Refused:
    """The text of an InputError in the other process."""

    text: str


BEGUN, END = "begun", "end"


def serve() -> None:
    """Answer the request on stdin in this process, the one apart."""
    request: Request = pickle.load(sys.stdin.buffer)
    out = sys.stdout.buffer
    _end_with(request.parent)
    try:
        module, _, name = request.reader.partition(":")
        reader: Callable[..., Iterable[Any]] = getattr(import_module(module), name)
        _limit_memory(request.most_memory)
        _send(out, BEGUN)
        for answer in reader(*request.arguments):
            _send(out, (answer,))
        _send(out, END)
    except InputError as error:
        _send(out, Refused(str(error)))
    except BrokenPipeError:
        # Nobody wants the rest; not even a flush at the end.
        os._exit(0)


def _end_with(parent: int) -> None:
    """End this process as soon as process ``parent``, which reads its output, has ended.

    The system sends a signal where it can: a library that hangs may not let Python run. For that
    the standard error is a pipe into which nothing is written; what is, is dropped.
    """
    try:
        import fcntl

        end = os.dup(2)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        signal.signal(signal.SIGIO, signal.SIG_DFL)
        fcntl.fcntl(end, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(end, fcntl.F_SETFL, fcntl.fcntl(end, fcntl.F_GETFL) | os.O_ASYNC)
        if os.getppid() != parent:
            # It has ended before.
            os._exit(GONE)
    except (ImportError, AttributeError, OSError):
        end_with_input()


def end_with_input() -> None:
    """End this process at the end of its input: once the process that could write it has ended."""
    Thread(target=_wait_for_end, args=(sys.stdin.fileno(),), daemon=True).start()


def _wait_for_end(stream: int) -> None:
    os.read(stream, 1)
    os._exit(GONE)


def _send(out: BinaryIO, answer: Any) -> None:
    pickle.dump(answer, out, protocol=pickle.HIGHEST_PROTOCOL)
    out.flush()


def _limit_memory(most_memory: int) -> None:
    """Have allocations fail beyond what a file should take, where the system can do that."""
    try:
        import resource

        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    except (ImportError, OSError):
        return
    most = pages * resource.getpagesize() + most_memory
    before = resource.getrlimit(resource.RLIMIT_AS)
    limits = [most, *(each for each in before if each != resource.RLIM_INFINITY)]
    resource.setrlimit(resource.RLIMIT_AS, (min(limits), before[1]))
