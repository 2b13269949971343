"""`live-final`: a final point never changes, all of the drive has one, and they are the road."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks import scoring
from floatref_conformance.checks.streams.passing import Passing
from floatref_conformance.checks.streams.stream_check import Runs, bits, measurement
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.streams.transcript import Line, Transcript, lines_of
from floatref_conformance.errors import DeviceError

CHANGE, MISSING, ROUGHNESS = "change of a final point", "drive without final points", "IRI error"
MOST_MISSING_M = 1.0
"""Length in m of the drive that may have no final point, both ends apart."""
MOST_PERCENT = 10.0
"""Error of the IRI in percent that is allowed to the points of a steady drive."""


@dataclass(frozen=True)
class FinalCheck:
    """A final point that is given out again is the same; together they are the drive."""

    id: str = "live-final"
    title: str = "a final point never changes, and the whole drive gets final points"
    clause: str = "Final is final"
    derivation: str = (
        "Of a drive of 4.5 km, at constant speed and with a stop of 45 s, every point that is "
        "given out as final is compared with what was given out as final before at its place: "
        "whoever stored the first one never learns of a second. After finish, every metre but "
        "the first and the last of the encoder's distance has its final point, valid or not."
    )
    floor: str = (
        "At constant speed the IRI of the valid points is that of the road within 10 %, twice "
        "what class nominal allows at constant speed; half of the drive at least is valid."
    )
    limits: Mapping[str, str] = field(
        default_factory=lambda: {
            CHANGE: "0, or what the device declares as tolerance_m",
            MISSING: f"{MOST_MISSING_M:g} m",
            ROUGHNESS: f"{MOST_PERCENT:g} % at constant speed",
        }
    )
    is_long: bool = False

    def judge(self, runs: Runs) -> tuple[Measurement, ...]:
        """Return the largest change, the length without points, and the error of the IRI."""
        lines = lines_of(runs.plain.final)
        absent = [t.name for t in runs.truth.tracks if t.name not in lines]
        if absent:
            raise DeviceError(f"stream: track {absent[0]}: no final point in the whole drive")
        marks_m = Passing.of(runs.recording).marks_m
        return tuple(
            measured
            for name, line in lines.items()
            for measured in (
                _change(name, line, runs.plain),
                measurement(MISSING, name, _missing_m(line, marks_m), "m", MOST_MISSING_M),
                *(_roughness(name, line, runs.truth) if runs.case.steady else ()),
            )
        )


def _change(name: str, line: Line, run: Transcript) -> Measurement:
    return measurement(CHANGE, name, float(np.max(line.changed_m)), "m", bits(run))


def _missing_m(line: Line, marks_m: np.ndarray) -> float:
    """Return how many of the metres ``marks_m`` have no final point."""
    index = np.rint(marks_m / line.interval_m).astype(np.int64) - line.first
    inside = (index >= 0) & (index < line.given_s.size)
    given = ~np.isnan(line.given_s[np.clip(index, 0, line.given_s.size - 1)])
    return float(np.sum(~(inside & given)))


def _roughness(name: str, line: Line, truth: Profile) -> Iterator[Measurement]:
    if name not in {track.name for track in truth.tracks}:
        return
    points = ProfileTrack.of(name, line.elevation, line.valid)
    made = Profile(line.interval_m, (points,), line.first * line.interval_m)
    alone = Profile(truth.interval_m, (truth.track(name),), truth.start_m)
    (compared,) = scoring.compare(alone, made)
    pair = compared.unflagged()
    if pair is None or 2 * np.sum(pair.counted) < pair.counted.size:
        raise DeviceError(f"stream: track {name}: less than half of a steady drive is valid")
    limits = dict.fromkeys(DeviceClass, MOST_PERCENT)
    yield scoring.roughness_percent(pair, name, limits)
