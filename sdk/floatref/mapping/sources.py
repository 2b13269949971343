"""What a command reads: a recording directory or a native file, and what is kept of its origin."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from os.path import relpath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floatref.architectures.adapter import RecordingDirectory
from floatref.architectures.readers import is_native, read_source, reader_of
from floatref.errors import InputError
from floatref.files import fingerprint, fingerprint_native
from floatref.values.recording import Recording

if TYPE_CHECKING:
    from floatref.mapping import Reading


@dataclass(frozen=True, eq=False)
class Source:
    """A recording, where it came from, and one line for each thing to know about its reading.

    ``reading`` is None unless it came through a channel map.
    """

    recording: Recording
    origin: dict[str, Any]
    warnings: tuple[str, ...] = ()
    reading: "Reading | None" = None

    def said(self, line: str) -> str:
        """Return ``line`` with the native name of the channel that it is about."""
        return line if self.reading is None else self.reading.named_natively(line)

    @contextmanager
    def named(self) -> Iterator[None]:
        """Put the native name of a channel into any InputError raised inside."""
        try:
            yield
        except InputError as error:
            raise InputError(self.said(str(error))) from error


def recording_of(
    source: Path,
    adapter: str | None = None,
    channel_map: Path | None = None,
    progress: Callable[[float], None] | None = None,
) -> Source:
    """Return what is in ``source``, read with ``adapter`` and by ``channel_map`` if given.

    Raises InputError for a source that cannot be used, and for a map where none is needed.
    """
    from floatref.mapping.document import read_map

    chart = None if channel_map is None else read_map(channel_map)
    stated = adapter or (chart.source.adapter if chart is not None else None)
    reader = reader_of(source, stated)
    if not is_native(reader):
        if chart is not None:
            raise InputError(f"{source}: adapter {reader.name} has our channels; it needs no map")
        hashes = fingerprint if isinstance(reader, RecordingDirectory) else fingerprint_native
        origin = {"source": source.name, "adapter": reader.name, "sha256": hashes(source)}
        return Source(read_source(reader, source), origin)
    from floatref.mapping.reading import read_native

    reading = read_native(source, chart, reader.name, progress)
    return Source(reading.recording, _origin(source, reading, channel_map), reading.told, reading)


def _origin(source: Path, reading: "Reading", channel_map: Path | None) -> dict[str, Any]:
    """Return names, adapters, clocks and fingerprints of every file that was read."""
    files = [*reading.files.values(), *reading.databases]
    files += [] if channel_map is None else [channel_map]
    origin: dict[str, Any] = {
        "source": source.name,
        "adapter": reading.adapters[""],
        "sha256": _hashes(files, source.resolve().parent),
        "channels": dict(
            zip((str(c.id) for c in reading.recording.channels), reading.origins, strict=True)
        ),
    }
    if channel_map is not None:
        origin["map"] = channel_map.name
    if reading.clocks:
        origin["clocks"] = [dict(clock) for clock in reading.clocks]
    return origin


def _hashes(files: Sequence[Path], folder: Path) -> dict[str, str]:
    """Return the SHA-256 of ``files``: by name, or by path from ``folder`` if it is another's."""
    found: dict[str, str] = {}
    for file in dict.fromkeys(path.resolve() for path in files):
        for name, value in fingerprint_native(file).items():
            path = file / name if file.is_dir() else file
            found[name if name not in found else Path(relpath(path, folder)).as_posix()] = value
    return found
