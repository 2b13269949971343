"""Skew and gain between laser and accelerometer of each wheel path."""

from collections.abc import Iterator, Mapping
from math import isnan
from typing import Any

from floatref.measures.clocks.sensor_gain import gain_warning, sensor_gain
from floatref.measures.clocks.sensor_skew import Skew, sensor_skew, skew_warning
from floatref.values.recording import Channel, Recording

FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"


def skews_of(recording: Recording) -> tuple[tuple[Mapping[str, Any], ...], tuple[str, ...]]:
    """Return the skew of every wheel path that has both sensors, and warnings about both."""
    reports, warnings = [], []
    for track, force, height in _pairs(recording):
        distance = recording.find(DISTANCE, track)
        skew = sensor_skew(force, height, distance)
        reports.append(_report(track, skew))
        warnings.append(skew_warning(skew, force, height))
        # A skew is reported only for sensors that measure the same motion.
        if distance is not None and isnan(skew.sigma_s):
            warnings.append(gain_warning(sensor_gain(force, height, distance), height))
    return tuple(reports), tuple(line for line in warnings if line is not None)


def _pairs(recording: Recording) -> Iterator[tuple[str, Channel, Channel]]:
    for track in recording.tracks:
        force, height = (recording.find(name, track) for name in (FORCE, HEIGHT))
        if force is not None and height is not None:
            yield track, force, height


def _report(track: str, skew: Skew) -> Mapping[str, Any]:
    return {
        "track": track,
        "skew_s": skew.skew_s,
        "sigma_s": skew.sigma_s,
        "seconds": skew.seconds,
        "coherence": skew.coherence,
        "reason": skew.reason,
    }
