"""The native files of a run, each opened when it is first asked for."""

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

from floatref.engine.recordings.readers import native_of, reader_of
from floatref.errors import InputError
from floatref.files.sources import name_errors
from floatref.mapping.channel_map.clock_entries import name_stream
from floatref.mapping.channel_map.column_names import similar
from floatref.mapping.channel_map.entries import SOURCE, ChannelMap, ClockEntry, FileEntry
from floatref.values.native import NativeFile


class Opened:
    """The files of one run by their labels; they are closed with ``stack``.

    ``paths``, ``adapters`` and ``databases`` have the files that were opened, their adapters, and
    the files that their options name.
    """

    def __init__(
        self, source: Path, adapter: str | None, chart: ChannelMap | None, stack: ExitStack
    ) -> None:
        """Read ``source`` with ``adapter`` if it is given, else with that of the map."""
        self.paths: dict[str, Path] = {SOURCE: source}
        self.adapters: dict[str, str] = {}
        self.databases: list[Path] = []
        self._stack, self._chart, self._adapter = stack, chart, adapter
        self._files: dict[str, NativeFile] = {}

    def file(self, label: str) -> NativeFile:
        """Return the file called ``label``; InputError if it cannot be read."""
        if label not in self._files:
            self._files[label] = self._open(label)
        return self._files[label]

    def check_clock(self, entry: ClockEntry) -> None:
        """Raise InputError if ``entry`` is of a stream that its file does not have."""
        names = [stream.name for stream in self.file(entry.file).streams]
        if entry.stream is not None and entry.stream not in names:
            with (
                name_errors(self.paths[entry.file]),
                name_errors(f"clock of {name_stream(entry.file, None)}"),
            ):
                hint = similar(entry.stream, names) or "the file has no streams"
                raise InputError(f"no stream is called {entry.stream[:80]!r}; {hint}")

    def warnings(self) -> Iterator[str]:
        """Yield the warnings of the adapters about their files."""
        for label, native in self._files.items():
            for line in native.warnings:
                yield f"{self.paths[label].name}: {line}"

    def _open(self, label: str) -> NativeFile:
        entry = self._entry(label)
        if label != SOURCE:
            self.paths[label] = entry.path
        path = self.paths[label]
        adapter = (label == SOURCE and self._adapter) or entry.adapter
        reader = reader_of(path, adapter or None)
        native = self._stack.enter_context(native_of(reader, path, dict(entry.options)))
        self.adapters[label] = reader.name
        if "dbc" in entry.options:
            self.databases.append(Path(entry.options["dbc"]))
        return native

    def _entry(self, label: str) -> FileEntry:
        if self._chart is None:
            return FileEntry(Path())
        return self._chart.source if label == SOURCE else self._chart.files[label]
