"""Which adapter reads a source, and what is kept of where a recording came from."""

from pathlib import Path
from typing import Any, cast

from floatref.architectures.adapter import Adapter, RecordingAdapter, RecordingDirectory
from floatref.architectures.plugins import plugins
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.files import fingerprint, fingerprint_native
from floatref.values.recording import Recording


def reader_of(source: Path, name: str | None) -> Adapter:
    """Return the adapter called ``name``, else the one that recognises ``source``.

    Raises InputError if there is no such adapter, none recognises it, or several do.
    """
    known = plugins().adapters()
    names = ", ".join(known)
    if name is not None and name not in known:
        raise InputError(f"adapter {name}: unknown; there are {names}")
    if name is not None:
        return known[name]
    if not source.exists():
        raise InputError(f"{source}: not found")
    found = [adapter for adapter in known.values() if _recognised(adapter, source)]
    if not found:
        raise InputError(f"{source}: no adapter recognises it; give --adapter, one of {names}")
    if len(found) > 1:
        both = " and ".join(adapter.name for adapter in found)
        raise InputError(f"{source}: adapters {both} both recognise it; choose with --adapter")
    return found[0]


def read_source(reader: Adapter, source: Path) -> Recording:
    """Return the recording; PluginError if the adapter fails in a way it should not."""
    try:
        recording = cast(RecordingAdapter, reader).read(source)
    except (FloatrefError, OSError):
        raise
    except Exception as error:
        raise PluginError(_failure(reader, source, error)) from error
    if not isinstance(recording, Recording):
        raise PluginError(f"adapter {reader.name}: {source}: gave no recording")
    return recording


def origin_of(source: Path, reader: Adapter) -> dict[str, Any]:
    """Return name, adapter and fingerprints of ``source``."""
    ours = isinstance(reader, RecordingDirectory)
    hashes = fingerprint(source) if ours else fingerprint_native(source)
    return {"source": source.name, "adapter": reader.name, "sha256": hashes}


def _recognised(adapter: Adapter, source: Path) -> bool:
    try:
        return bool(adapter.recognises(source))
    except Exception as error:
        plugins().reports.append(_failure(adapter, source, error))
        return False


def _failure(adapter: Adapter, source: Path, error: Exception) -> str:
    reason = f"{type(error).__name__}: {' '.join(str(error).split())}"
    return f"adapter {adapter.name}: {source}: {reason}"
