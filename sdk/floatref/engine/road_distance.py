"""The encoder's distance without the slip of its wheel, and how far the axis may be off."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from floatref.measures.slip.encoder_motion import Motion
from floatref.measures.slip.knots import knots_of
from floatref.measures.slip.second_source import Wheel, find_wheel
from floatref.stages.signals import DISTANCE
from floatref.values.channels import ChannelId
from floatref.values.recording import Channel, Recording

UNKNOWN_PER_G = 0.06
"""1-σ of a slip of which nothing is known: the middle of 3 to 12 % per g (3.3.1.3, 3.3.9)."""


@dataclass(frozen=True)
class RoadDistance:
    """A recording whose distance is that along the road, as far as it is known.

    Attributes:
        recording: with other samples of distance, if there was something to take off.
        record: what was done, for the profile's record.
    """

    recording: Recording
    record: Mapping[str, Any] = field(default_factory=dict)


def correct_distance(recording: Recording, slip_per_g: float | None = None) -> RoadDistance:
    """Return ``recording`` without slip: the given one, else that which a second source shows.

    Every channel `distance` is corrected, and never decreases for that.
    """
    corrected: dict[ChannelId, Channel] = {}
    record: dict[str, Any] = {}
    for distance in (c for c in recording.channels if c.id.name == DISTANCE):
        motion = Motion.of(distance)
        wheel = _wheel(recording, distance, motion, slip_per_g)
        if motion.speed.size and (wheel.slip_per_g or wheel.growth or wheel.scale):
            corrected[distance.id] = _take_off(distance, motion, wheel)
        record = record or _record(wheel, wheel.on_road(motion))
    return RoadDistance(_with(recording, corrected), record)


def _wheel(
    recording: Recording, distance: Channel, motion: Motion, slip_per_g: float | None
) -> Wheel:
    if slip_per_g is not None:
        return Wheel("setting", slip_per_g, abs(slip_per_g) / 4.0)
    return find_wheel(recording, distance, motion) or Wheel("encoder", 0.0, UNKNOWN_PER_G)


def _take_off(distance: Channel, motion: Motion, wheel: Wheel) -> Channel:
    too_much = wheel.counted_too_much(wheel.on_road(motion))
    values = distance.values - np.interp(distance.times_s, motion.times_s, too_much)
    known = ~np.isnan(values)
    back = np.diff(distance.values[known], prepend=-np.inf) < 0.0
    if not back.any():
        values[known] = np.maximum.accumulate(values[known])
    return Channel(distance.id, values, distance.clock)


def _with(recording: Recording, changed: Mapping[ChannelId, Channel]) -> Recording:
    if not changed:
        return recording
    channels = tuple(changed.get(channel.id, channel) for channel in recording.channels)
    return replace(recording, channels=channels)


def _record(wheel: Wheel, motion: Motion) -> dict[str, Any]:
    record: dict[str, Any] = {"source": wheel.source, "slip_per_g": wheel.slip_per_g}
    if wheel.growth:
        record["radius_growth"] = wheel.growth
    if wheel.scale:
        record["scale"] = wheel.scale
    if not motion.speed.size:
        return record
    along = motion.distance_m
    knots = knots_of(along, motion.speed**2)
    off = wheel.slip_sigma_per_g * np.abs(motion.gain_m()[knots])
    return record | {
        "slip_sigma_per_g": wheel.slip_sigma_per_g,
        "along_m": [round(float(x), 2) for x in along[knots]],
        "speed_mps": [round(float(v), 3) for v in motion.speed[knots]],
        "sigma_m": [round(float(x), 4) for x in off],
    }
