"""`live-latency`: points are there when the device says, counted in samples and not by a clock."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.checks.streams.passing import Passing
from floatref_conformance.checks.streams.stream_check import Runs, measurement
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.devices.streams.answers import Latency
from floatref_conformance.devices.streams.pieces import PIECE_S
from floatref_conformance.devices.streams.transcript import Given, Line, Transcript, lines_of
from floatref_conformance.errors import DeviceError

LATE_FINAL, LATE_PROVISIONAL = "lateness of final points", "lateness of provisional points"
MOST_LATE_S = 2.0 * PIECE_S
"""Lateness in s beyond what is declared: a piece in which a point falls due, and its sync."""
MOST_TRAVEL_M = 4000.0
"""Largest latency in m of which the drive can show anything."""


@dataclass(frozen=True)
class LatencyCheck:
    """Final and provisional points are there within the declared metres and seconds."""

    id: str = "live-latency"
    title: str = "points are there within the latency that the device declares"
    clause: str = "The device's own declaration"
    derivation: str = (
        "The device declares when a point is final: when the vehicle has gone travelled_m beyond "
        "it and then_s more have passed, when it has stood for standing_s, or after longest_s; "
        "and that a provisional one is there after provisional_s. For every metre of the drive "
        "the encoder says when that is, in recorded time. A point has come with the samples that "
        "were pushed before the sync that the device answers next. So neither the speed of the "
        f"machine nor that of the judge counts. Pieces of {PIECE_S:g} s, and rounding of places, "
        f"make {MOST_LATE_S:g} s."
    )
    floor: str = (
        f"A declared travelled_m is {MOST_TRAVEL_M:g} m at most, so that points fall due while "
        "the vehicle drives."
    )
    limits: Mapping[str, str] = field(
        default_factory=lambda: dict.fromkeys((LATE_FINAL, LATE_PROVISIONAL), f"{MOST_LATE_S:g} s")
    )
    is_long: bool = False

    def judge(self, runs: Runs) -> tuple[Measurement, ...]:
        """Return by how many seconds the latest point is late, of either state."""
        latency, passing = runs.plain.started.latency, Passing.of(runs.recording)
        if latency.travelled_m > MOST_TRAVEL_M:
            raise DeviceError(
                f"stream: declares travelled_m {latency.travelled_m:g}; a stream gives out final "
                f"points within {MOST_TRAVEL_M:g} m"
            )
        names = [track.name for track in runs.truth.tracks]
        return tuple(
            measurement(LATE_FINAL, name, late_s, "s", MOST_LATE_S)
            for name in names
            for late_s in (_late_s(runs.plain.final, name, passing, _final(passing, latency)),)
        ) + _of_provisional(runs.plain, names, passing)


def _final(passing: Passing, latency: Latency) -> FloatArray:
    return passing.due_final(passing.marks_m, latency)


def _of_provisional(run: Transcript, names: list[str], passing: Passing) -> tuple[Measurement, ...]:
    latency = run.started.latency
    if latency.provisional_s is None:
        return ()
    due_s = passing.due_provisional(passing.marks_m, latency)
    # A place that is final has no need of a provisional point.
    return tuple(
        measurement(LATE_PROVISIONAL, n, _late_s(run.given, n, passing, due_s), "s", MOST_LATE_S)
        for n in names
    )


def _late_s(
    given: list[Given] | tuple[Given, ...], name: str, passing: Passing, due_s: FloatArray
) -> float:
    """Return by how much the latest point that fell due in the drive is late, in s."""
    falls_due = due_s < passing.end_s - MOST_LATE_S
    if not falls_due.any():
        return 0.0
    line = lines_of(_as_one(given)).get(name)
    if line is None:
        return np.inf
    came_s = _came_s(line, passing.marks_m[falls_due])
    return max(0.0, float(np.max(came_s - due_s[falls_due])))


def _as_one(given: list[Given] | tuple[Given, ...]) -> list[Given]:
    """Return what has the interval of the first: provisional points may be farther apart."""
    interval_m = given[0].points.interval_m if given else 0.0
    return [each for each in given if each.points.interval_m == interval_m]


def _came_s(line: Line, marks_m: FloatArray) -> FloatArray:
    """Return when the point at each place came, in s; infinite if it never did."""
    index = np.rint(marks_m / line.interval_m).astype(np.int64) - line.first
    inside = np.clip(index, 0, line.given_s.size - 1)
    came_s = np.where(index == inside, line.given_s[inside], np.inf)
    return np.where(np.isnan(came_s), np.inf, came_s)
