"""Which adapter reads a source, and what it reads; an adapter's own faults in one line."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from os.path import exists
from pathlib import Path
from typing import Any, TypeVar, cast

from floatref.architectures.adapter import (
    Adapter,
    NativeAdapter,
    RecordingAdapter,
    RecordingDirectory,
)
from floatref.architectures.plugins import plugins
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.values.native import NativeFile
from floatref.values.recording import Recording

T = TypeVar("T")


def reader_of(source: Path, name: str | None) -> Adapter:
    """Return the adapter called ``name``, else the one that recognises ``source``.

    Raises InputError if there is no such adapter, none recognises it, or several do.
    """
    if name is not None:
        return named_reader(name)
    if not exists(source):
        raise InputError(f"{source}: not found")
    found = recognising(source)
    if not found:
        names = ", ".join(plugins().adapters())
        raise InputError(f"{source}: no adapter recognises it; give --adapter, one of {names}")
    if len(found) > 1:
        both = " and ".join(adapter.name for adapter in found)
        raise InputError(f"{source}: adapters {both} both recognise it; choose with --adapter")
    return found[0]


def recognising(source: Path) -> list[Adapter]:
    """Return the adapters that recognise ``source``; one that fails at it is reported."""
    return [adapter for adapter in plugins().adapters().values() if _recognised(adapter, source)]


def named_reader(name: str) -> Adapter:
    """Return the adapter called ``name``; InputError if there is none."""
    known = plugins().adapters()
    if name not in known:
        raise InputError(f"adapter {name}: unknown; there are {', '.join(known)}")
    return known[name]


def is_native(reader: Adapter) -> bool:
    """Return whether ``reader`` lists what a file holds, for a channel map."""
    return callable(getattr(reader, "streams", None))


def read_source(reader: Adapter, source: Path) -> Recording:
    """Return the recording; PluginError if the adapter fails in a way it should not."""
    with guarding(reader.name, source):
        found = cast(RecordingAdapter, reader).read(source)
    return _checked(found, reader, source, Recording, "recording")


def native_of(reader: Adapter, source: Path, options: Mapping[str, str]) -> NativeFile:
    """Return what ``source`` holds; InputError if ``reader`` does not list files."""
    if not exists(source):
        raise InputError(f"{source}: not found")
    if not is_native(reader) or RecordingDirectory().recognises(source):
        name = RecordingDirectory.name if is_native(reader) else reader.name
        raise InputError(f"{source}: adapter {name} has our channels; it needs no map")
    with guarding(reader.name, source):
        found = cast(NativeAdapter, reader).streams(source, options)
    native = _checked(found, reader, source, NativeFile, "native file")
    names = [stream.name for stream in native.streams]
    if len(set(names)) < len(names):
        twice = next(name for at, name in enumerate(names) if name in names[:at])
        raise PluginError(f"adapter {reader.name}: {source}: gave two streams called {twice!r}")

    def close() -> None:
        with guarding(reader.name, source):
            native.close()

    return replace(native, close=close)


@contextmanager
def guarding(name: str, source: Path) -> Iterator[None]:
    """Turn what an adapter called ``name`` should not raise into a PluginError in one line."""
    try:
        yield
    except (FloatrefError, MemoryError):
        raise
    except OSError as error:
        place = error.filename or source
        raise InputError(f"{place}: {error.strerror or error}; copy the file again") from error
    except (Exception, SystemExit) as error:
        # contextlib takes a RuntimeError that a StopIteration has caused for that itself.
        cause = None if isinstance(error, StopIteration) else error
        raise PluginError(_failure(name, source, error)) from cause


def _checked(found: Any, reader: Adapter, source: Path, kind: type[T], said: str) -> T:
    if not isinstance(found, kind):
        raise PluginError(f"adapter {reader.name}: {source}: gave no {said}")
    return found


def _recognised(adapter: Adapter, source: Path) -> bool:
    try:
        return bool(adapter.recognises(source))
    except Exception as error:
        plugins().reports.append(_failure(adapter.name, source, error))
        return False


def _failure(name: str, source: Path, error: BaseException) -> str:
    return f"adapter {name}: {source}: {type(error).__name__}: {' '.join(str(error).split())}"
