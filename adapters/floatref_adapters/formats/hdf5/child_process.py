"""HDF5 files read in a process of their own, which may crash, hang or swell without harm.

The library that reads HDF5 does all three over damaged files. The other process says what a file
holds, or sends the rows of a stream; if it ends, or is silent for long, the file is refused.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from threading import Timer
from typing import Any, BinaryIO

from floatref import InputError, NativeFile, Rows, real_path
from floatref_adapters.shared.row_pieces import keep_freed_memory

LONGEST_SILENCE_S = 60.0
MOST_MEMORY = 1 << 30
"""Bytes that the other process may take beyond what it starts with, where the system counts."""
COMMAND = "from floatref_adapters.formats.hdf5.child_process import serve; serve()"


@dataclass(frozen=True)
class _Request:
    """What is asked of the other process: a listing, or columns ``names`` of a stream."""

    source: Path
    options: Mapping[str, str]
    stream: int | None = None
    names: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Refused:
    """The text of an InputError in the other process."""

    text: str


_END = "end"


def read_in_child(source: Path, options: Mapping[str, str]) -> NativeFile:
    """Return what the HDF5 file ``source`` holds; InputError if it cannot be used."""
    request = _Request(real_path(source), dict(options))
    listed: NativeFile
    (listed,) = _answers(request)
    streams = [
        replace(stream, read=_Reader(replace(request, stream=k)))
        for k, stream in enumerate(listed.streams)
    ]
    return replace(listed, streams=tuple(streams))


@dataclass(frozen=True)
class _Reader:
    """Reads columns of one stream, as `Stream.read` does."""

    request: _Request

    def __call__(self, names: Sequence[str]) -> Iterator[Rows]:
        """Yield the rows of the columns ``names``."""
        keep_freed_memory()
        yield from _answers(replace(self.request, names=tuple(names)))


def _answers(request: _Request) -> Iterator[Any]:
    """Yield what the other process answers; InputError if it refuses, ends or is silent."""
    # Not the current folder but our own modules: a data folder may hold a numpy.py.
    paths = os.pathsep.join(path for path in sys.path if path)
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", COMMAND],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"},
    )
    with process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(pickle.dumps(request))
            process.stdin.close()
            while (answer := _next(process, process.stdout)) != _END:
                if isinstance(answer, _Refused):
                    raise InputError(answer.text)
                yield answer
        except OSError as error:
            raise _broken() from error
        finally:
            process.kill()


def _next(process: "subprocess.Popen[bytes]", stream: Any) -> Any:
    watch = Timer(LONGEST_SILENCE_S, process.kill)
    watch.start()
    try:
        return pickle.load(stream)
    except Exception as error:
        # Half an answer can make pickle raise anything.
        raise _broken() from error
    finally:
        watch.cancel()


def _broken() -> InputError:
    return InputError(
        "no sound HDF5 (the library that reads it broke down); copy the complete file again"
    )


def serve() -> None:
    """Answer the request on stdin in this process, the one apart."""
    from floatref_adapters.formats.hdf5.dataset_rows import native_file

    request: _Request = pickle.load(sys.stdin.buffer)
    out = sys.stdout.buffer
    try:
        _limit_memory()
        native = native_file(request.source, request.options)
        if request.stream is None:
            bare = [replace(stream, read=_nothing) for stream in native.streams]
            _send(out, replace(native, streams=tuple(bare)))
        else:
            for rows in native.streams[request.stream].read(request.names):
                _send(out, rows)
        _send(out, _END)
    except InputError as error:
        _send(out, _Refused(str(error)))
    except BrokenPipeError:
        # Nobody wants the rest; not even a flush at the end.
        os._exit(0)


def _send(out: BinaryIO, answer: Any) -> None:
    pickle.dump(answer, out, protocol=pickle.HIGHEST_PROTOCOL)
    out.flush()


def _nothing(names: Sequence[str]) -> Iterator[Rows]:
    """Stand for the reader of a stream on its way to the other process."""
    return iter(())


def _limit_memory() -> None:
    """Have allocations fail beyond what a file should take, where the system can do that."""
    try:
        import resource

        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    except (ImportError, OSError):
        return
    most = pages * resource.getpagesize() + MOST_MEMORY
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    if hard == resource.RLIM_INFINITY or most < hard:
        resource.setrlimit(resource.RLIMIT_AS, (most, hard))
