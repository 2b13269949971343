"""What is to be processed: folders, files, patterns and manifests as jobs, each source once."""

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from floatref.batch.jobs.defaults import Defaults, files_of, read_given_map
from floatref.batch.jobs.job import Job
from floatref.batch.jobs.manifest import is_manifest, read_manifest
from floatref.batch.jobs.natural_order import natural_path_key
from floatref.batch.jobs.recognition import (
    Kind,
    is_inside,
    is_recording,
    kind_of_folder,
    size_of,
    walk,
)
from floatref.batch.jobs.source_names import name_below, unique_names
from floatref.engine.recordings.readers import find_readers
from floatref.errors import InputError
from floatref.files.recording_directory import DOCUMENT as RECORDING
from floatref.files.search.counted_listing import CountedListing
from floatref.files.search.path_patterns import find_matches, is_pattern, split_pattern
from floatref.files.sources import name_errors
from floatref.mapping.channel_map.entries import ChannelMap

__all__ = ["Defaults", "Found", "find_jobs"]


@dataclass(frozen=True)
class Found:
    """The jobs in the order in which they were found, and the skipped files of folders."""

    jobs: tuple[Job, ...]
    passed_over: tuple[Path, ...]


def find_jobs(given: Sequence[str], out: Path, defaults: Defaults) -> Found:
    """Return a job for each source in ``given``: recordings, folders, patterns and manifests.

    A named file is a source even if it cannot be read; a folder is searched for recordings and
    native files. The map of ``defaults`` is for native files: recording directories need no map.
    Raises InputError for a name in ``given`` that does not exist, if nothing is found, and for
    options that no file can be processed with.
    """
    search = _Search(Path(out).absolute(), defaults)
    for text in given:
        search.take(text)
    return search.list_found()


@dataclass(frozen=True)
class _Source:
    path: Path
    name: str
    options: Defaults


class _Search:
    """The sources found so far, by their resolved paths."""

    def __init__(self, out: Path, defaults: Defaults) -> None:
        self._out, self._defaults = out, defaults
        self._real_out = os.path.realpath(out)
        self._charts = {defaults.channel_map: read_given_map(defaults)}
        self._sources: dict[str, _Source] = {}
        self._passed_over: dict[Path, None] = {}

    def take(self, text: str) -> None:
        """Take what one argument of the command names."""
        path = Path(text).absolute()
        if text and os.path.exists(path):
            self._take_path(path)
        elif is_pattern(text):
            self._take_pattern(text)
        else:
            raise InputError(f"{text or repr(text)}: not found; check the name")

    def list_found(self) -> Found:
        sources = self._sources.values()
        if not sources:
            raise InputError("no recording was found; name recordings, native files or folders")
        names = unique_names([s.name for s in sources], [s.path for s in sources])
        jobs = (self._job(s, name) for s, name in zip(sources, names, strict=True))
        named = {s.path for s in sources}
        return Found(tuple(jobs), tuple(p for p in self._passed_over if p not in named))

    def _take_path(self, path: Path) -> None:
        _check_kind(path)
        if self._is_ours(path):
            raise InputError(f"{path}: is, or lies in, the folder of --out; choose another for one")
        if path.is_dir():
            if not self._take_folder(path, path, self._defaults):
                raise InputError(f"{path}: no recording in it; name its files, or another folder")
        elif is_recording(path) or not is_manifest(path):
            self._add(path, path.parent, self._defaults)
        else:
            self._take_manifest(path)

    def _take_manifest(self, path: Path) -> None:
        with name_errors(path):
            for entry in read_manifest(path, self._defaults):
                _check_kind(entry.path)
                folder = entry.path.is_dir()
                if not (folder and self._take_folder(entry.path, path.parent, entry.options)):
                    self._add(entry.path, path.parent, entry.options)

    def _take_pattern(self, text: str) -> None:
        start, names = split_pattern(text)
        base, listing = start.absolute(), CountedListing(text)
        matches = sorted(find_matches(base, names, listing), key=natural_path_key)
        beside, count = self._beside(self._defaults), 0
        entered: set[Path] = set()
        for path in matches:
            if entered.isdisjoint(path.parents) and not self._is_ours(path):
                if path.is_dir():
                    entered.add(path)
                    listing.check_below(path)
                    count += self._take_folder(path, base, self._defaults)
                elif is_inside(path) or not path.is_file():
                    self._passed_over[path] = None
                elif os.path.realpath(path) not in beside:
                    self._add(path, base, self._defaults)
                    count += 1
        if not count:
            raise InputError(f"{text}: matches no recording; check the pattern")

    def _take_folder(self, folder: Path, base: Path, options: Defaults) -> int:
        """Take the recording ``folder``, or those in it; return how many there are."""
        if find_readers(folder):
            self._add(folder, base, options)
            return 1
        if self._is_ours(folder) or kind_of_folder(folder, None) is not Kind.FOLDER:
            self._passed_over[folder] = None
            return 0
        chart, beside, count = self._chart(options), self._beside(options), 0
        file_adapter = options.adapter or (chart.source.adapter if chart else None)
        for path, kind in walk(folder, self._real_out, options.adapter, file_adapter):
            if os.path.realpath(path) in beside:
                continue
            if kind is Kind.SOURCE:
                self._add(path, base, options)
                count += 1
            else:
                self._passed_over[path] = None
        return count

    def _add(self, path: Path, base: Path, options: Defaults) -> None:
        """Add the source ``path`` unless it is there; InputError if it is, with other options."""
        place = path.parent if path.name == RECORDING else path
        if is_recording(path) and options.channel_map == self._defaults.channel_map:
            options = replace(options, channel_map=None)
        source = _Source(path, name_below(place, base), options)
        before = self._sources.setdefault(os.path.realpath(place), source)
        if before.options != options:
            raise InputError(f"{path}: given twice, with different options; name it once")

    def _chart(self, options: Defaults) -> ChannelMap | None:
        if options.channel_map not in self._charts:
            self._charts[options.channel_map] = read_given_map(options)
        return self._charts[options.channel_map]

    def _beside(self, options: Defaults) -> frozenset[str]:
        return files_of(self._chart(options))

    def _is_ours(self, path: Path) -> bool:
        """Tell whether ``path`` is the output of this command, or in it."""
        return Path(os.path.realpath(path)).is_relative_to(self._real_out)

    def _job(self, source: _Source, name: str) -> Job:
        options, recording = source.options, source.path.name == RECORDING
        return Job(
            source=source.path,
            name=name,
            out=self._out,
            adapter=options.adapter,
            channel_map=options.channel_map and options.channel_map.absolute(),
            pipeline=options.pipeline,
            settings=options.settings,
            segment_m=options.segment_m,
            measures=options.measures,
            size_bytes=size_of(source.path.parent if recording else source.path),
        )


def _check_kind(path: Path) -> None:
    """Refuse a pipe or a device, which may block, or have no end."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise InputError(f"{path}: is a device or pipe; name files and folders")
