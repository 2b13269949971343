"""Whether laser and accelerometer of each wheel path are on time with each other."""

from collections.abc import Iterator, Mapping
from typing import Any

from floatref.measures.sensor_skew import Skew, sensor_skew, skew_warning
from floatref.values.recording import Channel, Recording

FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"


def skews_of(recording: Recording) -> tuple[tuple[Mapping[str, Any], ...], tuple[str, ...]]:
    """Return the skew of every wheel path that has both sensors, and warnings about it."""
    reports, warnings = [], []
    for track, force, height in _pairs(recording):
        skew = sensor_skew(force, height, recording.find(DISTANCE, track))
        reports.append(_report(track, skew))
        warning = skew_warning(skew, force, height)
        if warning is not None:
            warnings.append(warning)
    return tuple(reports), tuple(warnings)


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
