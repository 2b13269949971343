"""Choosing the adapter of a recording and calling it; its own failures as one line."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from os.path import exists, islink
from pathlib import Path
from typing import Any, TypeVar, cast

from floatref.engine.plugins import plugins
from floatref.engine.recordings.plug_in_files import failure
from floatref.engine.recordings.recognising_profiles import has_profile_form
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.files.sources import check_source
from floatref.interfaces.adapter import (
    Adapter,
    NativeAdapter,
    RecordingAdapter,
    RecordingDirectory,
)
from floatref.values.display.similar_names import suggest
from floatref.values.native import NativeFile
from floatref.values.recording import Recording

T = TypeVar("T")


def reader_of(source: Path, name: str | None) -> Adapter:
    """Return the adapter called ``name``, else the one that recognises ``source``.

    Raises InputError if there is no such adapter, or not exactly one recognises it.
    """
    if name is not None:
        return get_reader(name)
    if not exists(source) and not islink(source):
        raise InputError(f"{source}: not found")
    check_source(source)
    found = find_readers(source)
    if not found:
        raise InputError(f"{source}: {_why_no_reader(source)}")
    if len(found) > 1:
        both = " and ".join(adapter.name for adapter in found)
        raise InputError(f"{source}: adapters {both} both recognise it; choose with --adapter")
    return found[0]


def _why_no_reader(source: Path) -> str:
    if has_profile_form(source):
        return (
            "is a profile, no recording; give the recording that it was made from; floatref iri, "
            "roughness, straightedge, compare, view, plot and convert read profiles"
        )
    names = ", ".join(plugins().adapters())
    return f"no adapter recognises it; give --adapter, one of {names}"


def find_readers(source: Path) -> list[Adapter]:
    """Return the adapters that recognise ``source``; one that fails at it is reported."""
    return [adapter for adapter in plugins().adapters().values() if _recognise(adapter, source)]


def get_reader(name: str) -> Adapter:
    """Return the adapter called ``name``; InputError if it is unknown."""
    known = plugins().adapters()
    if name not in known:
        raise InputError(f"adapter {name}: unknown; {suggest(name, known)}")
    return known[name]


def is_native(reader: Adapter) -> bool:
    """Return whether ``reader`` lists a file's content, for a channel map."""
    return callable(getattr(reader, "streams", None))


def read_source(reader: Adapter, source: Path) -> Recording:
    """Return the recording; PluginError for any error of the adapter other than InputError."""
    check_source(source)
    with guard(reader.name, source):
        found = cast(RecordingAdapter, reader).read(source)
    return _check(found, reader, source, Recording, "recording")


def native_of(reader: Adapter, source: Path, options: Mapping[str, str]) -> NativeFile:
    """Return the content of ``source``; InputError if ``reader`` does not list files."""
    if not exists(source) and not islink(source):
        raise InputError(f"{source}: not found")
    check_source(source)
    if not is_native(reader) or RecordingDirectory().recognises(source):
        name = RecordingDirectory.name if is_native(reader) else reader.name
        raise InputError(f"{source}: adapter {name} has our channels; it needs no map")
    with guard(reader.name, source):
        found = cast(NativeAdapter, reader).streams(source, options)
    native = _check(found, reader, source, NativeFile, "native file")
    names = [stream.name for stream in native.streams]
    if len(set(names)) < len(names):
        twice = next(name for at, name in enumerate(names) if name in names[:at])
        raise PluginError(f"adapter {reader.name}: {source}: gave two streams called {twice!r}")

    def close() -> None:
        with guard(reader.name, source):
            native.close()

    return replace(native, close=close)


@contextmanager
def guard(name: str, source: Path) -> Iterator[None]:
    """Turn an unexpected exception of adapter ``name`` into a PluginError in one line."""
    try:
        yield
    except (FloatrefError, MemoryError, KeyboardInterrupt, GeneratorExit):
        raise
    except OSError as error:
        place = error.filename or source
        raise InputError(f"{place}: {error.strerror or error}; copy the file again") from error
    except BaseException as error:
        # contextlib treats a RuntimeError caused by a StopIteration as the StopIteration itself.
        cause = None if isinstance(error, StopIteration) else error
        raise PluginError(failure(f"adapter {name}", source, error)) from cause


def _check(found: Any, reader: Adapter, source: Path, kind: type[T], what: str) -> T:
    if not isinstance(found, kind):
        raise PluginError(f"adapter {reader.name}: {source}: gave no {what}")
    return found


def _recognise(adapter: Adapter, source: Path) -> bool:
    try:
        return bool(adapter.recognises(source))
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        plugins().reports.append(failure(f"adapter {adapter.name}", source, error))
        return False
