"""Counts while files are processed: files, bytes, kilometres, remaining time, the roughest."""

import heapq
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from math import isnan, nan

from floatref.batch.jobs.job import Job
from floatref.batch.jobs.natural_order import NaturalKey, natural_key
from floatref.batch.results.record import Effort, Record, Row

ROUGHEST = 5
"""Number of rows with the largest IRI that are stored."""
RANKED_SHARE = 0.5
"""Share of the file's longest segment that a row must count over to be among the roughest."""
FIRST_WARNINGS = 5
"""Number of warnings whose lines are stored."""
OPENING = 16 << 20
"""Bytes of a recording that take about as long to read as opening a file takes."""


@dataclass
class Tally:
    """Counts of one command; ``began_s`` and every ``now_s`` are on one clock, in seconds.

    Attributes:
        files: how many there are in all.
        size_bytes: of all of them.
        done: files with a profile, including those that were done before.
        skipped: files that were done before and are unchanged.
        failed: name and reason of every file without a profile.
        warnings: lines of warnings of all files.
        first_warnings: names and lines of the first of them.
        pipelines: files with a profile by the pipeline that made it.
        length_m: of all profiles; ``new_m`` of those that this command has made.
        effort: of all profiles, whenever they were made: sums, and the largest peak of memory.
        roughest: IRI of valid points in m/km, name and row, the largest first; equal ones by name.
        not_ranked: rows whose valid points are too few to be among the roughest.
    """

    files: int = 0
    size_bytes: int = 0
    began_s: float = 0.0
    done: int = 0
    skipped: int = 0
    failed: dict[str, str] = field(default_factory=dict)
    warnings: int = 0
    first_warnings: list[tuple[str, str]] = field(default_factory=list)
    pipelines: Counter[str] = field(default_factory=Counter)
    length_m: float = 0.0
    new_m: float = 0.0
    effort: Effort = field(default_factory=Effort)
    roughest: list[tuple[float, str, Row]] = field(default_factory=list)
    not_ranked: int = 0
    _weight_done: int = 0
    _weight_skipped: int = 0

    def begin(self, jobs: Sequence[Job], now_s: float) -> None:
        """Begin to count ``jobs``."""
        self.files, self.began_s = len(jobs), now_s
        self.size_bytes = sum(job.size_bytes for job in jobs)

    def add(self, job: Job, record: Record) -> None:
        """Count ``record`` of ``job``."""
        self._weight_done += _weight(job.size_bytes)
        self.warnings += len(record.warnings)
        room = FIRST_WARNINGS - len(self.first_warnings)
        self.first_warnings += [(record.name, line) for line in record.warnings[:room]]
        if record.error:
            self.failed[record.name] = record.error
            return
        self.done += 1
        self.pipelines[record.pipeline] += 1
        self.length_m += record.length_m
        self.effort = total(self.effort, record.effort)
        self._keep_roughest(record)
        if record.skipped:
            self.skipped += 1
            self._weight_skipped += _weight(job.size_bytes)
        else:
            self.new_m += record.length_m

    @property
    def seen(self) -> int:
        """Files whose record was counted."""
        return self.done + len(self.failed)

    @property
    def processed(self) -> int:
        """Files that this command has processed, with or without success."""
        return self.seen - self.skipped

    @property
    def part(self) -> float:
        """Part of the work that is done, from 0 to 1."""
        return self._weight_done / max(self._weight_of_all, 1)

    def files_per_minute(self, now_s: float) -> float:
        """Return the rate of this command; files that were done before do not count."""
        return _ratio(60.0 * self.processed, now_s - self.began_s)

    def km_per_hour(self, now_s: float) -> float:
        """Return kilometres of profile per hour of this command."""
        return _ratio(3.6 * self.new_m, now_s - self.began_s)

    def left_s(self, now_s: float) -> float:
        """Return the remaining time in s at the rate until now; NaN if unknown."""
        worked = self._weight_done - self._weight_skipped
        return _ratio((now_s - self.began_s) * (self._weight_of_all - self._weight_done), worked)

    @property
    def _weight_of_all(self) -> int:
        return self.size_bytes + OPENING * self.files

    def _keep_roughest(self, record: Record) -> None:
        """Keep the rows of largest IRI of valid points; a rest and an invalid row do not count."""
        needed_m = RANKED_SHARE * max((row.length_m for row in record.rows), default=0.0)
        rows = [
            (row.iri_of_valid_m_per_km, record.name, row)
            for row in record.rows
            if not isnan(row.iri_of_valid_m_per_km) and row.counted_share * row.length_m >= needed_m
        ]
        self.not_ranked += len(record.rows) - len(rows)
        self.roughest = heapq.nsmallest(ROUGHEST, self.roughest + rows, key=_rank)


def total(one: Effort, other: Effort) -> Effort:
    """Return the sum of both, and the larger peak."""
    return Effort(
        one.seconds + other.seconds,
        one.cpu_s + other.cpu_s,
        one.bytes_in + other.bytes_in,
        one.bytes_out + other.bytes_out,
        max(one.peak_bytes, other.peak_bytes),
    )


def _rank(item: tuple[float, str, Row]) -> tuple[float, NaturalKey, float, str]:
    """Return what orders a row: files end in any order, and equal ones are in that of the table."""
    iri, name, row = item
    return -iri, natural_key(name), row.start_m, row.track


def _weight(size_bytes: int) -> int:
    """Return the weight of a file: its bytes, plus the constant effort per file."""
    return size_bytes + OPENING


def _ratio(part: float, whole: float) -> float:
    return part / whole if whole > 0.0 else nan
