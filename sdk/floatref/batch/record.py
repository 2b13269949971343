"""How one file went: its rows of the summary, and what tells whether it has to be done again."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

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
        flagged_m: length of the points that are not valid.
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


@dataclass(frozen=True)
class Effort:
    """What a file has cost: seconds, seconds of processor time, bytes in and out, peak memory."""

    seconds: float = 0.0
    cpu_s: float = 0.0
    bytes_in: int = 0
    bytes_out: int = 0
    peak_bytes: int = 0
    """Largest resident memory of the worker until then."""


@dataclass(frozen=True)
class Record:
    """How one file went; ``error`` is empty if it went well.

    Attributes:
        name, source: as in the job.
        error: one line that says why there is no profile.
        rows: of the summary; empty after an error.
        warnings: of reading and processing, one line each.
        remarks: what could not be measured of the profile, one line each.
        key: ``asked``, what the profile depends on beside its inputs; ``segment_m``; after success
            also the ``settings`` of the profile, the ``adapter`` that read it, and ``located``,
            whether the recording tells where it was.
        inputs: SHA-256 of every file that was read, by its absolute path.
        outputs: SHA-256 of every file of the profile, by its name.
        effort: what it has cost.
        skipped: it was done before, and is as it was; never written to disk.
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
