"""The encoder's distance against the places of a GNSS receiver: scale, lag and lost counts."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import ChannelId
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import chunks

RADIUS_M = 6.371e6
"""Mean radius of the earth: a degree is right to 0.3 %."""
APART_S = 1.0
"""Time in s between the places that are compared: 20 m at 72 km/h, and 14 m of a curve of 5 1/km
are 1 mm longer than their chord."""
GOOD = (2.0, 4.0, 5.0)
"""Values of gnss_quality with places to a metre or better against each other within seconds."""
FEWEST = 5
LEAST_M = 2.0
"""Shortest way in m between two places that gives a ratio."""
SCALE_OFF, UNUSABLE = 0.04, 0.3
"""Deviation of the encoder's scale from 1: rolling radius by speed and warmth (1 % each, 3.3.1.1,
3.3.9) and a worn tread (1.9 %); and one that is a wrong unit."""
LOST, LOST_M = 0.15, 0.3
"""Share of a way that no slip takes: 12 % per g in a brake of 1 g (3.3.9); and the noise in m."""
WITHOUT_FIX = np.nan


@dataclass(frozen=True, eq=False)
class Ways:
    """Ways between places about `APART_S` apart.

    Attributes:
        times: at which they begin and end, shape (n + 1,), in s.
        counted: by the encoder, shape (n,), in m.
        travelled: by the receiver, likewise; NaN where it has no fix.
    """

    times: FloatArray
    counted: FloatArray
    travelled: FloatArray

    @property
    def ratio(self) -> float:
        """Median of counted over travelled, NaN if the vehicle hardly moves.

        Of the whole run and its thirds the one nearest to 1: an encoder that loses counts was
        calibrated before.
        """
        far = np.flatnonzero(self.travelled >= LEAST_M)
        if far.size < FEWEST:
            return np.nan
        parts = [far, *(part for part in np.array_split(far, 3) if part.size >= FEWEST)]
        found = [float(np.median(self.counted[p] / self.travelled[p])) for p in parts]
        return min(found, key=lambda ratio: abs(ratio - 1.0))


def encoder_doubts(recording: Recording) -> Iterator[Doubt]:
    """Yield the faults of the encoder that places of a receiver show; nothing without places."""
    ways = ways_of(recording)
    if ways is None:
        return
    name = recording.channel("distance", recording.tracks[0]).id
    ratio = ways.ratio
    if not np.isfinite(ratio):
        return
    if abs(ratio - 1.0) > SCALE_OFF:
        yield _scaled(name, ratio)
        return
    lost = np.flatnonzero(_off(ways, ratio))
    if lost.size:
        yield _misplaced(name, ways, int(lost[0]), ratio)


def ways_of(recording: Recording) -> Ways | None:
    """Return the ways of a run by encoder and receiver, None without places that are numbers."""
    latitude, longitude = recording.find("gnss_latitude"), recording.find("gnss_longitude")
    if latitude is None or longitude is None or latitude.values.size != longitude.values.size:
        return None
    encoder = recording.channel("distance", recording.tracks[0])
    times = latitude.times_s
    stride = max(1, round(APART_S * latitude.mean_rate_hz))
    chosen = np.arange(0, times.size, stride)
    begin, end = encoder.span_s
    chosen = chosen[(times[chosen] >= begin) & (times[chosen] <= end)]
    if chosen.size <= FEWEST:
        return None
    if not np.isfinite(latitude.values[chosen] + longitude.values[chosen]).any():
        return None
    good = _good(recording.find("gnss_quality"), times)
    north = np.where(good, RADIUS_M * latitude.values, WITHOUT_FIX)[chosen]
    shrunk = np.cos(float(np.nanmedian(latitude.values)))
    east = RADIUS_M * shrunk * longitude.values[chosen]
    counted = _counted(encoder, times[chosen])
    return Ways(times[chosen], np.diff(counted), np.hypot(np.diff(north), np.diff(east)))


def _good(quality: Channel | None, times: FloatArray) -> BoolArray:
    if quality is None:
        return np.ones(times.size, np.bool_)
    nearest = np.clip(np.searchsorted(quality.times_s, times), 0, quality.values.size - 1)
    return np.isin(quality.values[nearest], GOOD)


def _counted(encoder: Channel, times: FloatArray) -> FloatArray:
    """Return the distance in m at ``times``, which ascend, between the known samples around each.

    The encoder of hours is never in memory as a whole.
    """
    counted, done = np.full(times.size, np.nan), 0
    stamps, values = np.empty(0), np.empty(0)
    for first, part in chunks(encoder.values):
        known = ~np.isnan(part)
        stamps = np.append(stamps[-1:], encoder.clock.times(part.size, first)[known])
        values = np.append(values[-1:], part[known])
        if stamps.size:
            end = int(np.searchsorted(times, stamps[-1], "right"))
            counted[done:end] = np.interp(times[done:end], stamps, values)
            done = end
    counted[done:] = values[-1] if values.size else np.nan
    return counted


def _off(ways: Ways, ratio: float) -> BoolArray:
    """Return the ways on which counts are missing or too many."""
    apart = np.abs(ways.counted - ratio * ways.travelled)
    return np.asarray(apart > LOST * ratio * ways.travelled + LOST_M)


def _scaled(name: ChannelId, ratio: float) -> Doubt:
    return Doubt(
        (name,),
        f"channel {name}: {ratio:.3g} times the distance by the places of GNSS; correct its unit, "
        f"or calibrate it and divide by {ratio:.4g}",
        abs(ratio - 1.0) > UNUSABLE,
    )


def _misplaced(name: ChannelId, ways: Ways, first: int, ratio: float) -> Doubt:
    begin = float(ways.times[first])
    off_m = float(ways.counted[first] - ratio * ways.travelled[first])
    return Doubt(
        (name,),
        f"channel {name}: {off_m:+.2f} m against the places of GNSS from {begin:.6g} s to "
        f"{float(ways.times[first + 1]):.6g} s; counts are lost, too many, or late: the place of "
        "everything behind is not known; flagged from there on",
        spans=((begin, float("inf")),),
    )
