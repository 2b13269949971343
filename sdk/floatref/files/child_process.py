"""Reading in a process of its own, which may crash, hang or swell without harm.

Some libraries of C do all three over damaged files. The other process sends what it reads, piece
by piece; if it ends, or is silent for long, the file is refused. It ends with this process, however
this one ends.
"""

import os
import pickle
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from threading import Thread, Timer
from typing import Any, BinaryIO

from floatref.errors import InputError

LONGEST_SILENCE_S = 60.0
"""Time in s for the start of the other process, and for each answer unless another is given."""
MOST_MEMORY = 1 << 30
"""Bytes that the other process may take beyond what it starts with, where the system counts."""
GONE = 1
"""Exit code of a process whose parent has ended."""
COMMAND = "from floatref.files.child_process import serve; serve()"


@dataclass(frozen=True)
class _Request:
    """What is asked of the other process: what ``reader`` yields for ``arguments``."""

    reader: str
    arguments: tuple[Any, ...]
    most_memory: int
    parent: int


@dataclass(frozen=True)
class _Refused:
    """The text of an InputError in the other process."""

    text: str


_BEGUN, _END = "begun", "end"


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
        # Nobody reads it, see `_end_with`.
        stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"},
        # Ctrl-C goes to a whole group: this process answers it, and the file is not at fault.
        process_group=0,
    )
    with process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            request = pickle.dumps(_Request(reader, arguments, most_memory, os.getpid()))
            with _ended_after(LONGEST_SILENCE_S, process):
                process.stdin.write(request)
                process.stdin.flush()
            _next(process, process.stdout, LONGEST_SILENCE_S)
            while (answer := _next(process, process.stdout, silence_s)) != _END:
                if isinstance(answer, _Refused):
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


def serve() -> None:
    """Answer the request on stdin in this process, the one apart."""
    request: _Request = pickle.load(sys.stdin.buffer)
    out = sys.stdout.buffer
    _end_with(request.parent)
    try:
        module, _, name = request.reader.partition(":")
        reader: Callable[..., Iterable[Any]] = getattr(import_module(module), name)
        _limit_memory(request.most_memory)
        _send(out, _BEGUN)
        for answer in reader(*request.arguments):
            _send(out, (answer,))
        _send(out, _END)
    except InputError as error:
        _send(out, _Refused(str(error)))
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
