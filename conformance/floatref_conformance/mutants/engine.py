"""A separate engine for mutants with an internal error: plain arrays, stages from the SDK.

Only the elevations come from it; interval, validity and everything else are those of the sound
pipeline. It takes every laser to be under its accelerometer.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

import floatref
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording

CARRY_EVERY = 4096
"""Length of a block in samples; an integral's carry goes from one block to the next."""


@dataclass(frozen=True, eq=False)
class Signals:
    """One wheel path: acceleration in m/s², height in m from its first, distance in m."""

    rate_hz: float
    acceleration: FloatArray
    height: FloatArray
    distance: FloatArray

    @classmethod
    def of(cls, recording: Recording, track: str) -> "Signals":
        """Return the signals of ``track``, all on the accelerometer's clock, gaps bridged."""
        force = recording.channel("vertical_specific_force", track)
        times = force.times_s
        height = recording.channel("height", track)
        distance = recording.channel("distance")
        h = at_times(times, height.times_s, height.values)
        return cls(
            float(np.round(1.0 / np.median(np.diff(times)), 6)),
            at_times(times, times, force.values) - STANDARD_GRAVITY,
            h - h[0],
            np.maximum.accumulate(at_times(times, distance.times_s, distance.values)),
        )


Elevations = Callable[[Signals, Profile], FloatArray]
"""Computes the elevation of one wheel path at the points of a sound profile."""


def replace_elevations(recording: Recording, sound: Profile, elevations: Elevations) -> Profile:
    """Return ``sound`` with the elevations that ``elevations`` computes from ``recording``."""
    names = {track.name: track for track in sound.tracks}
    tracks = tuple(
        ProfileTrack.of(name, elevations(Signals.of(recording, name), sound), track.valid)
        for name, track in names.items()
    )
    return replace(sound, tracks=tracks)


def in_time(carry: float = 1.0, backward: bool = True) -> Elevations:
    """Return the adaptive high-pass in time, backward over distance.

    ``carry`` is the share of an integral that remains after every `CARRY_EVERY` samples; without
    ``backward`` the pass that removes the delay is missing.
    """

    def elevations(signals: Signals, sound: Profile) -> FloatArray:
        speed = floatref.TravelSpeed(signals.rate_hz).of(signals.distance)
        hpf = floatref.AdaptiveHighPass(signals.rate_hz)
        step = 1.0 / signals.rate_hz
        v = _integral(hpf.acceleration(signals.acceleration, speed), step, carry)
        r = _integral(hpf.velocity(v, speed), step, carry)
        at = np.searchsorted(signals.distance, sound.distance_m - 1e-9)
        at = np.minimum(at, signals.distance.size - 1)
        z = (r - hpf.height(signals.height, speed))[at]
        if not backward:
            return z
        return hpf.reverse_over_distance(z, speed[at], sound.interval_m)

    return elevations


def over_distance(reflection: float = 1.0) -> Elevations:
    """Return timer distortion with height-sensor reflection, multiplied by ``reflection``."""

    def elevations(signals: Signals, sound: Profile) -> FloatArray:
        at = np.searchsorted(signals.distance, sound.distance_m - 1e-9)
        at = np.minimum(at, signals.distance.size - 1)
        dt = np.diff(at, prepend=at[:1]) / signals.rate_hz
        hpf, second = floatref.SpatialHighPass(sound.interval_m), floatref.HeightReflection()
        step = floatref.TimerDistortion(sound.interval_m).time_step(dt)
        v = _integral(hpf.acceleration(signals.acceleration[at]), step)
        v, height = hpf.velocity(v), hpf.height(signals.height[at])
        r = second.reference_height(v, step, dt, reflection * height)
        return hpf.reverse(r - height)

    return elevations


def _integral(x: FloatArray, step: float | FloatArray, carry: float = 1.0) -> FloatArray:
    """Return the trapezoidal integral of ``x``, leaking after every `CARRY_EVERY` samples."""
    areas = 0.5 * step * (x + np.concatenate((x[:1], x[:-1])))
    areas[0] = 0.0
    total, out = 0.0, np.empty_like(areas)
    for first in range(0, areas.size, CARRY_EVERY):
        piece = slice(first, first + CARRY_EVERY)
        out[piece] = total + np.cumsum(areas[piece])
        total = carry * float(out[piece][-1])
    return out


def at_times(times: FloatArray, own: FloatArray, values: FloatArray) -> FloatArray:
    """Return ``values`` of the times ``own`` at ``times``, interpolated across gaps."""
    seen = np.isfinite(values)
    return np.interp(times, own[seen], values[seen])
