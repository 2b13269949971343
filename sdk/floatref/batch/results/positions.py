"""Where on the earth a distance of the encoder is, from the fixes of a receiver."""

from dataclasses import dataclass

import numpy as np

from floatref.screening.damage.encoder_path import EncoderPath, times_at
from floatref.stages.signals import DISTANCE
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import chunks

LATITUDE, LONGITUDE, QUALITY = "gnss_latitude", "gnss_longitude", "gnss_quality"
LONGEST_GAP_S = 5.0
"""Longest time in s between fixes over which the position is interpolated."""
NEAR_M = 0.5
"""Distance in m from a fix within which the fix itself is used."""
OFTEN_S = 0.05
"""Least time in s between fixes; more frequent ones are skipped."""


def is_located(recording: Recording) -> bool:
    """Return whether ``recording`` has fixes of latitude and longitude."""
    names = {channel.id.name for channel in recording.channels}
    return {LATITUDE, LONGITUDE} <= names


def places(
    recording: Recording, track: str, distance_m: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return latitudes and longitudes in degrees, shape (n,), where the encoder has ``distance_m``.

    It is the place where that distance is first reached. Between fixes position goes with the
    distance, so that braking or a stop causes no error; before the first and after the last fix it
    is extrapolated over one interval between fixes. NaN where fixes are more than 5 s apart, or
    missing.
    """
    encoder, quality = (recording.find(name, track) for name in (DISTANCE, QUALITY))
    unknown = np.full(distance_m.size, np.nan)
    found = [recording.find(name, track) for name in (LATITUDE, LONGITUDE)]
    if encoder is None or None in found:
        return unknown, unknown
    way = _Way.of(encoder)
    latitude, longitude = (
        _angles(_Fixes.of(channel, way, quality), distance_m) for channel in found if channel
    )
    known = ~np.isnan(latitude + longitude)
    return (
        np.where(known, np.degrees(latitude), np.nan),
        np.where(known, np.degrees(_wrap(longitude)), np.nan),
    )


@dataclass(frozen=True, eq=False)
class _Way:
    """The largest distance of the encoder until each time in s, in m."""

    times_s: FloatArray
    far_m: FloatArray

    @classmethod
    def of(cls, encoder: Channel) -> "_Way":
        path = EncoderPath.of(encoder)
        return cls(times_at(encoder, path.knots["at"]), path.distance)

    def covers(self, times_s: FloatArray) -> BoolArray:
        if not self.times_s.size:
            return np.zeros(times_s.size, np.bool_)
        first_s, last_s = self.times_s[[0, -1]].tolist()
        return np.asarray((times_s >= first_s) & (times_s <= last_s))


@dataclass(frozen=True, eq=False)
class _Fixes:
    """The known samples of an angle in rad, and the encoder's distance at each, in m.

    Of several at one distance the first is kept; ``gap_s`` is the time in s since the fix before
    it, kept or not.
    """

    angle: FloatArray
    far_m: FloatArray
    gap_s: FloatArray

    @classmethod
    def of(cls, channel: Channel, way: _Way, quality: Channel | None) -> "_Fixes":
        index = _known(channel)
        times = times_at(channel, index)
        within = way.covers(times) & _is_good(quality, times)
        index, times = index[within], times[within]
        if not times.size:
            return cls(times, times, times)
        far = np.interp(times, way.times_s, way.far_m)
        first = np.flatnonzero(np.diff(far, prepend=-np.inf) > 0)
        gaps = np.diff(times, prepend=times[0])
        return cls(np.unwrap(channel.values[index])[first], far[first], gaps[first])


def _known(channel: Channel) -> IndexArray:
    """Return the samples of ``channel`` that are known, at most one each 0.05 s."""
    found = [np.empty(0, np.int64)]
    for first, chunk in chunks(channel.values):
        index = first + np.flatnonzero(~np.isnan(chunk))
        turns = np.floor(times_at(channel, index) / OFTEN_S)
        found.append(index[np.diff(turns, prepend=-np.inf) > 0])
    return np.concatenate(found)


def _is_good(quality: Channel | None, times: FloatArray) -> BoolArray:
    """Return at which ``times`` the receiver did not report a missing fix."""
    if quality is None:
        return np.ones(times.size, np.bool_)
    at = np.searchsorted(quality.times_s, times, side="right") - 1
    return np.asarray((at < 0) | (quality.values[np.maximum(at, 0)] != 0.0))


def _angles(fixes: _Fixes, wanted: FloatArray) -> FloatArray:
    """Return the angle in rad at the distances ``wanted``, NaN where it is unknown."""
    angles, far = fixes.angle, fixes.far_m
    if far.size < 2:
        return np.full(wanted.size, np.nan)
    after = np.clip(np.searchsorted(far, wanted), 1, far.size - 1)
    before = after - 1
    part = (wanted - far[before]) / (far[after] - far[before])
    apart = fixes.gap_s[after] > LONGEST_GAP_S
    part = np.where(apart, np.rint(np.clip(part, 0.0, 1.0)), np.clip(part, -1.0, 2.0))
    reached = far[before] + part * (far[after] - far[before])
    angle = angles[before] + part * (angles[after] - angles[before])
    return np.where(np.abs(wanted - reached) <= NEAR_M, angle, np.nan)


def _wrap(longitude: FloatArray) -> FloatArray:
    """Return ``longitude`` in rad within -pi to pi."""
    return np.mod(longitude + np.pi, 2.0 * np.pi) - np.pi
