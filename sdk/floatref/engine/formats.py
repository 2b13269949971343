"""Choosing adapters and profile formats and calling them; their own failures as one line."""

import shlex
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from os.path import exists
from pathlib import Path
from typing import Any, TypeVar, cast

from floatref.engine.plugins import plugins
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.files import read_profile, write_profile
from floatref.files.atomic import replace_file
from floatref.files.sources import name_errors
from floatref.files.withheld_formats import refuse_to_read, refuse_to_write
from floatref.interfaces.adapter import (
    Adapter,
    NativeAdapter,
    RecordingAdapter,
    RecordingDirectory,
)
from floatref.interfaces.profile_format import ProfileDirectory, ProfileFormat
from floatref.values.display.similar_names import hint_at, suggest
from floatref.values.native import NativeFile
from floatref.values.profile import Profile
from floatref.values.recording import Recording

T = TypeVar("T")


def reader_of(source: Path, name: str | None) -> Adapter:
    """Return the adapter called ``name``, else the one that recognises ``source``.

    Raises InputError if there is no such adapter, or not exactly one recognises it.
    """
    if name is not None:
        return get_reader(name)
    if not exists(source):
        raise InputError(f"{source}: not found")
    found = find_readers(source)
    if not found:
        names = ", ".join(plugins().adapters())
        raise InputError(f"{source}: no adapter recognises it; give --adapter, one of {names}")
    if len(found) > 1:
        both = " and ".join(adapter.name for adapter in found)
        raise InputError(f"{source}: adapters {both} both recognise it; choose with --adapter")
    return found[0]


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
    with guard(reader.name, source):
        found = cast(RecordingAdapter, reader).read(source)
    return _check(found, reader, source, Recording, "recording")


def native_of(reader: Adapter, source: Path, options: Mapping[str, str]) -> NativeFile:
    """Return the content of ``source``; InputError if ``reader`` does not list files."""
    if not exists(source):
        raise InputError(f"{source}: not found")
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
    except (FloatrefError, MemoryError):
        raise
    except OSError as error:
        place = error.filename or source
        raise InputError(f"{place}: {error.strerror or error}; copy the file again") from error
    except (Exception, SystemExit) as error:
        # contextlib treats a RuntimeError caused by a StopIteration as the StopIteration itself.
        cause = None if isinstance(error, StopIteration) else error
        raise PluginError(_failure(f"adapter {name}", source, error)) from cause


def _check(found: Any, reader: Adapter, source: Path, kind: type[T], what: str) -> T:
    if not isinstance(found, kind):
        raise PluginError(f"adapter {reader.name}: {source}: gave no {what}")
    return found


def _recognise(adapter: Adapter, source: Path) -> bool:
    try:
        return bool(adapter.recognises(source))
    except Exception as error:
        plugins().reports.append(_failure(f"adapter {adapter.name}", source, error))
        return False


def _failure(reader: str, path: Path, error: BaseException) -> str:
    """Return one line on an ``error`` that ``reader``, an adapter or a format, raised."""
    return f"{reader}: {path}: {type(error).__name__}: {' '.join(str(error).split())}"


def profile_of(path: Path) -> Profile:
    """Return the profile at ``path``: our directory, its profile.json, or a file of any format.

    A file that no format recognises is read as our CSV, whose errors say what is expected. Raises
    InputError if ``path`` cannot be used or two formats recognise it, and PluginError for any other
    error of a format.
    """
    path = Path(path)
    found = [
        form for form in plugins().profile_formats().values() if _recognise_profile(form, path)
    ]
    if not found or RecordingDirectory().recognises(path):
        _refuse_recording(path)
    if not found:
        refuse_to_read(path)
        return read_profile(path)
    if len(found) > 1:
        both = " and ".join(form.name for form in found)
        raise InputError(f"{path}: formats {both} both recognise it; remove one plug-in")
    return _read(found[0], path)


def _refuse_recording(path: Path) -> None:
    """Raise InputError for a recording: what to do is better known than what is wrong with it.

    Any table of text may be a CSV profile, whose own errors say what is missing in it.
    """
    if not exists(path):
        return
    readers = [adapter.name for adapter in find_readers(path) if adapter.name != "csv"]
    if readers:
        raise InputError(
            f"{path}: is a recording for adapter {' or '.join(readers)}, no profile; process it "
            f"first: floatref process {shlex.quote(str(path))} --out PROFILE"
        )


def _recognise_profile(form: ProfileFormat, path: Path) -> bool:
    try:
        return bool(form.recognises(path))
    except (OSError, ValueError):
        # A name that cannot be opened: reading it raises the error.
        return False
    except Exception as error:
        plugins().reports.append(_failure(f"format {form.name}", path, error))
        return False


def _read(form: ProfileFormat, path: Path) -> Profile:
    try:
        profile = form.read(path)
    except (FloatrefError, OSError):
        raise
    except Exception as error:
        raise PluginError(_failure(f"format {form.name}", path, error)) from error
    if not isinstance(profile, Profile):
        raise PluginError(f"format {form.name}: {path}: gave no profile")
    return profile


def format_of(out: Path, name: str | None = None) -> ProfileFormat:
    """Return the format called ``name``, else the one of the suffix of ``out``.

    Raises InputError, which lists the formats, if no format or more than one fits, or if it needs a
    library that is missing.
    """
    form = _choose(out, name)
    check = getattr(form, "check_installed", None)
    if callable(check):
        with name_errors(out):
            check()
    return form


def _choose(out: Path, name: str | None) -> ProfileFormat:
    known = plugins().profile_formats()
    if name is not None and name not in known:
        raise InputError(f"format {name}: unknown; {suggest(name, known)}")
    if name is not None:
        return known[name]
    # A suffix has letters only: names of runs hold numbers, as in stop_0.20g.
    suffix = out.suffix.lower() if out.suffix[1:].isalpha() else ""
    found = [form for form in known.values() if form.suffix == suffix]
    if len(found) > 1:
        both = " and ".join(form.name for form in found)
        raise InputError(f"{out}: suffix {suffix} is that of {both}; choose with --format")
    if not found:
        refuse_to_write(out)
        suffixes = [form.suffix for form in known.values() if form.suffix]
        raise InputError(
            f"{out}: suffix {out.suffix} is no format; use {', '.join(suffixes)}, no suffix, or "
            f"--format with one of {', '.join(known)}{hint_at(suffix, suffixes)}"
        )
    return found[0]


def write_as(form: ProfileFormat, profile: Profile, out: Path, overwrite: bool = False) -> None:
    """Write ``profile`` to ``out`` in the format ``form``, complete or not at all.

    Raises InputError if ``out`` exists and ``overwrite`` is false, cannot be written, or if the
    format cannot hold the profile; PluginError for any other error of the format.
    """
    if isinstance(form, ProfileDirectory):
        write_profile(profile, out, overwrite)
        return
    write_file(form.name, out, lambda beside: form.write(profile, beside), overwrite)


def write_file(
    name: str, out: Path, write: Callable[[Path], None], overwrite: bool = False
) -> None:
    """Let ``write``, of the format called ``name``, make a file beside ``out``, then rename it.

    Raises InputError as ``write`` does, with the name of ``out``, and PluginError for its others.
    """
    with replace_file(out, overwrite) as beside:
        try:
            write(beside)
        except InputError as error:
            raise InputError(str(error).replace(str(beside), str(out))) from error
        except (FloatrefError, OSError):
            raise
        except Exception as error:
            raise PluginError(_failure(f"format {name}", out, error)) from error
        if not beside.is_file():
            raise PluginError(f"format {name}: {out}: wrote no file")
