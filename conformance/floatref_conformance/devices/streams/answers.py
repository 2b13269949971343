"""What a device that streams answers, read and verified: `started`, `points`, `synced`, ….

DeviceError names the field of an answer that cannot be used.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray
from floatref_conformance.devices.process import readable
from floatref_conformance.devices.streams.questions import FORMAT
from floatref_conformance.errors import DeviceError

KINDS = ("started", "points", "event", "synced", "refused", "finished")
"""Kinds of answers that the judge knows."""
FINAL, PROVISIONAL = "final", "provisional"
LARGEST = 10**12
"""Largest number of a point, and of a sync."""
MAX_INTERVAL_M, MIN_INTERVAL_M = 0.25, 0.001
"""Of points, in m, as for a profile."""


@dataclass(frozen=True)
class Latency:
    """When a device says that points are there, counted from when the vehicle passed them.

    Attributes:
        travelled_m, then_s: a point is final when the vehicle has gone so many metres beyond it,
            and then so many seconds have passed.
        longest_s: so many seconds have passed, whatever the vehicle does.
        standing_s: the vehicle has been stationary for so many seconds; None if that ends nothing.
        provisional_s: a provisional point is there; None without provisional points.
    """

    travelled_m: float
    then_s: float
    longest_s: float
    standing_s: float | None = None
    provisional_s: float | None = None


@dataclass(frozen=True)
class Started:
    """A stream has begun: its latency, and the rounding of its numbers in m, 0 for every bit."""

    latency: Latency
    tolerance_m: float


@dataclass(frozen=True, eq=False)
class Path:
    """Points of one wheel path: elevation in m, NaN if missing, and validity; shape (N,)."""

    elevation: FloatArray
    valid: BoolArray


@dataclass(frozen=True, eq=False)
class Points:
    """Successive points: number ``first`` + k lies at its number times ``interval_m``."""

    state: str
    first: int
    interval_m: float
    paths: Mapping[str, Path]

    @property
    def count(self) -> int:
        """The number of points."""
        return next(iter(self.paths.values())).elevation.size

    @property
    def distance_m(self) -> FloatArray:
        """Distance of every point in m, shape (N,)."""
        return (self.first + np.arange(self.count, dtype=np.float64)) * self.interval_m


def kind_of(answer: Mapping[str, Any]) -> str:
    """Return the kind of ``answer``."""
    kind = answer.get("kind")
    if kind not in KINDS:
        raise DeviceError(f"answered kind {readable(repr(kind), 40)}; known: {', '.join(KINDS)}")
    return str(kind)


def read_started(answer: Mapping[str, Any]) -> Started:
    """Return what ``answer`` declares of a stream that begins."""
    if answer.get("format") != FORMAT:
        given = readable(repr(answer.get("format")), 40)
        raise DeviceError(f"started with format {given}, expected {FORMAT!r}")
    declared = answer.get("latency")
    if not isinstance(declared, Mapping):
        raise DeviceError("started without a latency; state travelled_m, then_s and longest_s")
    latency = Latency(
        _amount(declared, "travelled_m"),
        _amount(declared, "then_s"),
        _amount(declared, "longest_s"),
        standing_s=_amount_or_none(declared, "standing_s"),
        provisional_s=_amount_or_none(declared, "provisional_s"),
    )
    return Started(latency, _amount_or_none(answer, "tolerance_m") or 0.0)


def read_number(answer: Mapping[str, Any]) -> int:
    """Return the number of the sync that ``answer`` answers."""
    return _whole(answer, "number")


def read_points(answer: Mapping[str, Any]) -> Points:
    """Return the points in ``answer``."""
    state = answer.get("state")
    if state not in (FINAL, PROVISIONAL):
        raise DeviceError(
            f"points with state {readable(repr(state), 40)}; give final or provisional"
        )
    interval_m = _amount(answer, "interval_m")
    if not MIN_INTERVAL_M <= interval_m <= MAX_INTERVAL_M:
        raise DeviceError(
            f"points with interval_m {interval_m:g}; give {MIN_INTERVAL_M} to {MAX_INTERVAL_M}"
        )
    tracks = answer.get("tracks")
    if not isinstance(tracks, Mapping) or not tracks:
        raise DeviceError("points without tracks")
    paths = {str(name): _path(str(name), path) for name, path in tracks.items()}
    if len({path.elevation.size for path in paths.values()}) > 1:
        raise DeviceError("points whose tracks differ in length")
    return Points(str(state), _whole(answer, "first"), interval_m, paths)


def _path(name: str, answer: object) -> Path:
    if not isinstance(answer, Mapping):
        raise DeviceError(f"points of track {readable(name, 40)} that are no object")
    given, valid = answer.get("elevation"), answer.get("valid")
    if not isinstance(given, list) or not isinstance(valid, list) or len(given) != len(valid):
        raise DeviceError(
            f"points of track {readable(name, 40)} without elevation and valid of one length"
        )
    if not given or not all(isinstance(flag, bool) for flag in valid):
        raise DeviceError(
            f"points of track {readable(name, 40)}: empty, or valid is not all true or false"
        )
    if any(
        v is not None and (isinstance(v, bool) or not isinstance(v, (int, float))) for v in given
    ):
        raise DeviceError(f"points of track {readable(name, 40)}: an elevation is no number")
    elevation = np.array(given, dtype=np.float64)
    return Path(elevation, np.array(valid) & np.isfinite(elevation))


def _whole(answer: Mapping[str, Any], key: str) -> int:
    value = answer.get(key)
    if isinstance(value, bool) or not isinstance(value, int) or abs(value) > LARGEST:
        raise DeviceError(f"{key} is {readable(repr(value), 40)}; give a whole number")
    return value


def _amount(answer: Mapping[str, Any], key: str) -> float:
    value = answer.get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not isfinite(value):
        raise DeviceError(f"{key} is {readable(repr(value), 40)}; give a number")
    if value < 0:
        raise DeviceError(f"{key} is {value:g}; give a number from 0 on")
    return float(value)


def _amount_or_none(answer: Mapping[str, Any], key: str) -> float | None:
    return None if answer.get(key) is None else _amount(answer, key)
