"""Which pipeline for which sensors: what `auto` takes, and what it measures at stops.

The answer is that of `choosing`, asked about recordings that have the channels of these sensors
and nothing else.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from floatref.engine.choosing import has_channels, usable
from floatref.estimators.kalman.inputs import GNSS, IMU
from floatref.interfaces.pipeline import Pipeline
from floatref.values.clock import UniformClock
from floatref.values.needs import DISTANCE, FORCE, HEIGHT
from floatref.values.recording import Channel, Recording, Setup, VehicleSetup

NOMINAL = (FORCE, HEIGHT, DISTANCE)
GNSS_READINGS = tuple(channel.name for channel in GNSS)
RESPONSE = (
    *("unsprung_specific_force", "rear_unsprung_specific_force", "sprung_specific_force"),
    DISTANCE,
)
"""Channels of a half car, whose parameters need not be given."""
SENSORS: Mapping[str, tuple[str, ...]] = {
    "accelerometer, height sensor, encoder": NOMINAL,
    "the same, inertial unit": (*NOMINAL, *IMU),
    "the same, inertial unit, GNSS without attitude": (*NOMINAL, *IMU, *GNSS_READINGS[:2]),
    "the same, inertial unit, GNSS with attitude": (*NOMINAL, *IMU, *GNSS_READINGS),
    "no height sensor: accelerometers on wheels and body, the vehicle's parameters": RESPONSE,
    "no height sensor, nothing of the vehicle's response": (FORCE, DISTANCE),
    "no encoder": (FORCE, HEIGHT),
}
"""Channels of usual sets of sensors."""


@dataclass(frozen=True)
class ForSensors:
    """What there is for a set of sensors.

    Attributes:
        sensors: what is recorded.
        taken: what `auto` takes; None if it refuses the recording.
        through_stops: whether that one measures where the vehicle stops.
        others: pipelines that measure there, too, with no sensor more.
    """

    sensors: str
    taken: str | None
    through_stops: bool
    others: tuple[str, ...]


def pipelines_by_sensors(known: Mapping[str, Pipeline]) -> Iterator[ForSensors]:
    """Yield the answer for each of `SENSORS`, of the pipelines ``known`` by name."""
    for sensors, names in SENSORS.items():
        recording = _recording(names)
        taken = next((choice.pipeline for choice in usable(recording, known)), None)
        others = tuple(measuring_stops(recording, known, taken))
        yield ForSensors(sensors, taken, bool(taken and known[taken].through_stops), others)


def measuring_stops(
    recording: Recording, known: Mapping[str, Pipeline], taken: str | None
) -> Iterator[str]:
    """Yield the pipelines but ``taken`` that measure at stops and have all channels."""
    for name, pipeline in known.items():
        if name != taken and pipeline.through_stops and has_channels(recording, pipeline):
            yield name


def _recording(names: tuple[str, ...]) -> Recording:
    clock, values = UniformClock.of(1000.0), np.ones(2)
    channels = tuple(Channel.of(name, values, clock) for name in names)
    vehicle = VehicleSetup("half-car-with-equipment", {}) if set(RESPONSE) <= set(names) else None
    return Recording(channels, Setup(vehicle=vehicle))
