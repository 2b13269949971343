"""What a command reads: a recording directory or a native file, and its recorded origin."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from os.path import relpath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floatref.engine.recordings.readers import is_native, read_source, reader_of
from floatref.errors import InputError
from floatref.files import fingerprint, fingerprint_native
from floatref.files.sources import name_errors, real_path
from floatref.interfaces.adapter import Adapter, RecordingDirectory
from floatref.values.recording import Recording

if TYPE_CHECKING:
    from floatref.mapping import Reading


@dataclass(frozen=True, eq=False)
class Source:
    """A recording, its origin, and the warnings from reading it, one line each.

    ``inputs`` is the SHA-256 of every file that was read, by its path; ``reading`` is None unless
    it came through a channel map.
    """

    path: Path
    recording: Recording
    origin: dict[str, Any]
    inputs: Mapping[Path, str]
    warnings: tuple[str, ...] = ()
    reading: "Reading | None" = None

    def name_natively(self, line: str) -> str:
        """Return ``line`` with the native name of the channel that it is about."""
        return line if self.reading is None else self.reading.name_natively(line)

    @contextmanager
    def name_errors_natively(self) -> Iterator[None]:
        """Add the native name of the channel to any InputError raised inside."""
        try:
            yield
        except InputError as error:
            raise InputError(self.name_natively(str(error))) from error


def recording_of(
    source: Path,
    adapter: str | None = None,
    channel_map: Path | None = None,
    progress: Callable[[float], None] | None = None,
) -> Source:
    """Return what is in ``source``, read with ``adapter`` and by ``channel_map`` if given.

    Raises InputError for a source that cannot be used, and for a map where no map is needed.
    """
    from floatref.mapping.channel_map.map_document import read_map

    chart = None if channel_map is None else read_map(channel_map)
    stated = adapter or (chart.source.adapter if chart is not None else None)
    reader = reader_of(source, stated)
    if not is_native(reader):
        if chart is not None:
            raise InputError(f"{source}: adapter {reader.name} has our channels; it needs no map")
        hashes = _hashes_of(reader, source)
        origin = {"source": source.name, "adapter": reader.name, "sha256": hashes}
        return Source(source, read_source(reader, source), origin, _place(hashes, source))
    from floatref.mapping.reading import read_native

    reading = read_native(source, chart, reader.name, progress)
    inputs = _inputs(reading, channel_map)
    origin = _origin(source, reading, channel_map, inputs)
    return Source(source, reading.recording, origin, inputs, reading.warnings, reading)


def _hashes_of(reader: Adapter, source: Path) -> dict[str, str]:
    ours = isinstance(reader, RecordingDirectory)
    return fingerprint(source) if ours else fingerprint_native(source)


def _place(hashes: Mapping[str, str], source: Path) -> dict[Path, str]:
    """Return ``hashes`` of files in the folder ``source``, or beside the file, by their paths."""
    folder = source if source.is_dir() else source.parent
    return {real_path(folder) / name: value for name, value in hashes.items()}


def _inputs(reading: "Reading", channel_map: Path | None) -> dict[Path, str]:
    """Return the SHA-256 of every file behind ``reading``, the map included, by its path."""
    files = [*reading.files.values(), *reading.databases]
    files += [] if channel_map is None else [channel_map]
    found: dict[Path, str] = {}
    for file in dict.fromkeys(real_path(path) for path in files):
        found |= _place(fingerprint_native(file), file)
    return found


def _origin(
    source: Path, reading: "Reading", channel_map: Path | None, inputs: Mapping[Path, str]
) -> dict[str, Any]:
    """Return names, adapters, clocks and fingerprints of every file that was read."""
    origin: dict[str, Any] = {
        "source": source.name,
        "adapter": reading.adapters[""],
        "sha256": _name_hashes(inputs, real_path(source).parent),
        "channels": dict(
            zip((str(c.id) for c in reading.recording.channels), reading.origins, strict=True)
        ),
    }
    if channel_map is not None:
        origin["map"] = channel_map.name
    if reading.clocks:
        origin["clocks"] = [dict(clock) for clock in reading.clocks]
    return origin


def _name_hashes(hashes: Mapping[Path, str], folder: Path) -> dict[str, str]:
    """Return ``hashes`` by file name, or by path from ``folder`` if the name is another's."""
    found: dict[str, str] = {}
    for path, value in hashes.items():
        name = path.name if path.name not in found else Path(relpath(path, folder)).as_posix()
        found[name] = value
    return found


if TYPE_CHECKING:
    from floatref.engine.run import Result


def make_profile(
    read: Source,
    pipeline: str,
    settings: Mapping[str, Any],
    progress: Callable[[float], None] | None = None,
    diagnostics: bool = False,
    as_live: bool = False,
) -> "Result":
    """Return the profile of ``read`` by ``pipeline``, and warnings, one line each.

    Warnings and errors have the native names of channels. ``progress`` is called with the part of
    the recording that has been processed; ``diagnostics`` is as in `run`, ``as_live`` as in
    `floatref.process`, and not both are given. Raises InputError with one line naming the source
    for a recording, pipeline or setting that cannot be used.
    """
    from floatref.live.as_live import way_of

    make = way_of(as_live, diagnostics)
    with name_errors(read.path), read.name_errors_natively():
        result = make(read.recording, pipeline, settings, progress)
    provenance = {**result.profile.provenance, **read.origin}
    warnings = (*read.warnings, *map(read.name_natively, result.warnings))
    profile = replace(result.profile, provenance=provenance)
    return replace(result, profile=profile, warnings=warnings)
