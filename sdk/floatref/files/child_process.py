"""Reading in a process of its own, which may crash, hang or swell without harm.

Some libraries of C do all three over damaged files. The other process sends what it reads, piece
by piece; if it ends, or is silent for long, the file is refused.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from threading import Timer
from typing import Any, BinaryIO

from floatref.errors import InputError

LONGEST_SILENCE_S = 60.0
MOST_MEMORY = 1 << 30
"""Bytes that the other process may take beyond what it starts with, where the system counts."""
COMMAND = "from floatref.files.child_process import serve; serve()"


@dataclass(frozen=True)
class _Request:
    """What is asked of the other process: what ``reader`` yields for ``arguments``."""

    reader: str
    arguments: tuple[Any, ...]
    most_memory: int


@dataclass(frozen=True)
class _Refused:
    """The text of an InputError in the other process."""

    text: str


_END = "end"


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
    ``silence_s`` s (60, unless another is given) for each answer. InputError with the function's
    own text if it raises one, or with the text ``broken`` if the process ends, is silent for
    longer, or raises anything else.
    """
    # Not the current folder but our own modules: a data folder may hold a numpy.py.
    paths = os.pathsep.join(path for path in sys.path if path)
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", COMMAND],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"},
    )
    silence_s = LONGEST_SILENCE_S if silence_s is None else silence_s
    with process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(pickle.dumps(_Request(reader, arguments, most_memory)))
            process.stdin.close()
            while (answer := _next(process, process.stdout, silence_s)) != _END:
                if isinstance(answer, _Refused):
                    raise InputError(answer.text)
                yield answer[0]
        except (OSError, _BrokenDownError) as error:
            raise InputError(broken) from error
        finally:
            process.kill()


class _BrokenDownError(Exception):
    """The other process has ended, is silent, or says what cannot be read."""


def _next(process: "subprocess.Popen[bytes]", stream: Any, silence_s: float) -> Any:
    watch = Timer(silence_s, process.kill)
    watch.start()
    try:
        return pickle.load(stream)
    except Exception as error:
        # Half an answer can make pickle raise anything.
        raise _BrokenDownError from error
    finally:
        watch.cancel()


def serve() -> None:
    """Answer the request on stdin in this process, the one apart."""
    request: _Request = pickle.load(sys.stdin.buffer)
    out = sys.stdout.buffer
    try:
        module, _, name = request.reader.partition(":")
        reader: Callable[..., Iterable[Any]] = getattr(import_module(module), name)
        _limit_memory(request.most_memory)
        for answer in reader(*request.arguments):
            _send(out, (answer,))
        _send(out, _END)
    except InputError as error:
        _send(out, _Refused(str(error)))
    except BrokenPipeError:
        # Nobody wants the rest; not even a flush at the end.
        os._exit(0)


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
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    if hard == resource.RLIM_INFINITY or most < hard:
        resource.setrlimit(resource.RLIMIT_AS, (most, hard))
