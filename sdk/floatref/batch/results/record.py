"""Result of one file: its rows of the summary, and the data to decide if it must be redone."""

import json
import os
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass, field, fields
from math import nan
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any

from floatref.batch.jobs.job import Job
from floatref.errors import InputError
from floatref.files.atomic import replace_file
from floatref.files.document import plain, read_document, write_document
from floatref.files.gis.lines import Line
from floatref.files.schema import enforce
from floatref.measures.ride.segment_measures import SegmentMeasures

FORMAT = "floatref-batch-record/1"


@dataclass(frozen=True)
class Row:
    """One line of the summary: one segment of one wheel path.

    Attributes:
        track: the wheel path.
        segment: number of the segment, from 0.
        start_m, length_m: on the profile's axis of distance.
        latitude_deg, longitude_deg: where the segment starts; NaN where that is not known.
        iri_m_per_km: NaN where it cannot be calculated.
        mean_roughness_index_m_per_km: of both wheel paths; NaN unless there are two.
        flagged_m: length of the points that are not valid, at most ``length_m``.
        iri_of_valid_m_per_km: over stretches of valid points; NaN without any.
        counted_share: of the segment's length, in these stretches, 0 to 1.
        iri_of_valid_low_m_per_km, iri_of_valid_high_m_per_km: its 95 % interval; NaN where the
            profile has no 1-σ.
        mean_roughness_index_of_valid_m_per_km: mean of both wheel paths; NaN unless both have one.
        mean_roughness_index_counted_share: the smaller share of both; NaN unless there are two.
        lines_deg: the known places along the segment, longitude and latitude, as lines.
        measures: what contracts ask for beside the IRI; None unless they were asked for.
    """

    track: str
    segment: int
    start_m: float
    length_m: float
    latitude_deg: float
    longitude_deg: float
    iri_m_per_km: float
    mean_roughness_index_m_per_km: float
    flagged_m: float
    iri_of_valid_m_per_km: float = nan
    counted_share: float = 0.0
    iri_of_valid_low_m_per_km: float = nan
    iri_of_valid_high_m_per_km: float = nan
    mean_roughness_index_of_valid_m_per_km: float = nan
    mean_roughness_index_counted_share: float = nan
    lines_deg: tuple[Line, ...] = ()
    measures: SegmentMeasures | None = None


@dataclass(frozen=True)
class Effort:
    """Cost of a file: seconds, seconds of processor time, bytes in and out, peak memory."""

    seconds: float = 0.0
    cpu_s: float = 0.0
    bytes_in: int = 0
    bytes_out: int = 0
    peak_bytes: int = 0
    """Largest resident memory of the worker until then."""


@dataclass(frozen=True)
class Record:
    """Result of one file; ``error`` is empty after success.

    Attributes:
        name, source: as in the job.
        error: one line with the reason why there is no profile.
        rows: of the summary; empty after an error.
        warnings: of reading and processing, one line each.
        remarks: measures of the profile that failed, one line each.
        key: ``asked``, what the profile depends on besides its inputs; ``segment_m`` and
            ``measured``, what its rows were asked to have; after success also the ``pipeline``
            that was taken, ``chosen``, why ``auto`` took it or None, the profile's ``settings``,
            the ``adapter`` that read it, and ``located``, whether the recording tells where it was.
        inputs: SHA-256 of every file that was read, by its absolute path.
        outputs: SHA-256 of every file of the profile, by its name.
        effort: its cost.
        skipped: it was done before and is unchanged; never written to disk.
    """

    name: str
    source: str
    error: str = ""
    rows: tuple[Row, ...] = ()
    warnings: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()
    key: Mapping[str, Any] = field(default_factory=dict)
    inputs: Mapping[str, str] = field(default_factory=dict)
    outputs: Mapping[str, str] = field(default_factory=dict)
    length_m: float = 0.0
    effort: Effort = field(default_factory=Effort)
    skipped: bool = False

    @property
    def pipeline(self) -> str:
        """The pipeline that was taken; the one that was asked for where that is not known."""
        return str(self.key.get("pipeline") or self.key.get("asked", {}).get("pipeline", ""))


SCHEMA = "floatref-batch-record-1"
PLAIN = (str, int, float)
MOST_BYTES = 1 << 28
"""Largest record that is read: ten thousand kilometres in segments of 100 m."""


def read_record(path: Path) -> Record:
    """Return the record in the JSON file ``path``; InputError unless it is one."""
    document = read_document(path, MOST_BYTES)
    enforce(document, SCHEMA, path)
    return of_document(document)


def of_document(document: Mapping[str, Any]) -> Record:
    """Return the record that ``document`` holds, which obeys the schema."""
    return Record(
        name=document["name"],
        source=document["source"],
        error=document["error"],
        rows=tuple(map(_row, document["rows"])),
        warnings=tuple(document["warnings"]),
        remarks=tuple(document["remarks"]),
        key=document["key"],
        inputs=document["inputs"],
        outputs=document["outputs"],
        length_m=float(document["length_m"]),
        effort=Effort(**_known(document["effort"], Effort)),
    )


def write_record(record: Record, path: Path) -> None:
    """Write ``record`` to ``path`` in place of what is there; folders are made.

    Raises InputError if it cannot be written.
    """
    document = as_document(record)
    make_folder_of(path)
    with replace_file(path, overwrite=True) as beside:
        write_document(document, beside)


def as_document(record: Record) -> dict[str, Any]:
    """Return ``record`` in plain JSON values, NaN as None; InputError if it has an infinity."""
    described = asdict(record)
    del described["skipped"]
    return {**plain({"format": FORMAT, **described}, "record")}


def make_folder_of(path: Path) -> None:
    """Make the folder that ``path`` is to lie in; InputError if that cannot be done."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(
            f"{path.parent}: no such folder can be made ({reason}); choose another --out"
        ) from error


def _row(entry: Mapping[str, Any]) -> Row:
    lines = tuple(
        tuple((float(east), float(north)) for east, north in line)
        for line in entry.get("lines_deg", ())
    )
    found = entry.get("measures")
    measures = None if found is None else SegmentMeasures(**_numbers(found, SegmentMeasures))
    return Row(**_numbers(entry, Row), lines_deg=lines, measures=measures)


def _numbers(entry: Mapping[str, Any], kind: type[Row] | type[SegmentMeasures]) -> dict[str, Any]:
    """Return the fields of ``kind`` in ``entry`` that are not lists or objects, None as NaN."""
    known = _known(entry, kind)
    return {name: nan if value is None else value for name, value in known.items()}


def _known(
    entry: Mapping[str, Any], kind: type[Row] | type[SegmentMeasures] | type[Effort]
) -> dict[str, Any]:
    """Return the fields of ``kind`` in ``entry``, with floats for all numbers but counts."""
    found = {f.name: (entry[f.name], f.type) for f in fields(kind) if f.type in PLAIN}
    return {
        name: float(value) if kind is float and value is not None else value
        for name, (value, kind) in found.items()
    }


class Returned:
    """Records in a temporary file without a name, by the names of their jobs."""

    def __init__(self, stream: IO[bytes], out: Path) -> None:
        """Store them in ``stream``, an empty file to write and read on the disk of ``out``."""
        self._stream, self._out = stream, out
        self._places: dict[str, tuple[int, int]] = {}

    def add(self, record: Record) -> None:
        """Store ``record`` without ``skipped``; InputError if there is no space."""
        content = zlib.compress(json.dumps(as_document(record)).encode("ascii"), level=1)
        with _space(self._out):
            self._places[record.name] = (self._stream.seek(0, os.SEEK_END), len(content))
            self._stream.write(content)
            self._stream.flush()

    def of(self, jobs: Iterable[Job]) -> Iterator[Record]:
        """Yield the record of every one of ``jobs``, all of which were added, in their order."""
        for job in jobs:
            start, size = self._places[job.name]
            self._stream.seek(start)
            yield of_document(json.loads(zlib.decompress(self._stream.read(size))))


@contextmanager
def returned_records(out: Path) -> Iterator[Returned]:
    """Yield a temporary store for records on the disk of the folder ``out``.

    Raises InputError if it cannot be made.
    """
    with _space(out):
        stream = TemporaryFile(prefix=".floatref-", dir=out)  # noqa: SIM115  # Closed by `Returned`.
    try:
        yield Returned(stream, out)
    finally:
        # Writing the rest would fail again for lack of space.
        with suppress(OSError):
            stream.close()


@contextmanager
def _space(out: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(
            f"{out}: cannot be written ({reason}); free space there, and go on with --resume"
        ) from error
