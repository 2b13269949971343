"""The sensors of the vehicle's response: at a wheel, in its suspension, and on a test rig.

The engine's shake is left out: its mounts and the springs keep it from these places.
"""

from collections.abc import Iterator

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import ONLY_TRACK, Channel, Setup
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.proving_ground.sensors.noise import (
    draw_value,
    quantize,
    random_walk,
    stream,
    white,
)
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.vehicles.suspended import Gauges
from floatref_conformance.proving_ground.vehicles.suspension import SuspensionMotion


def response_channels(
    suite: SensorSuite, seed: int, motion: SuspensionMotion, setup: Setup
) -> Iterator[Channel]:
    """Yield the response channels of every wheel path of ``setup``, then those of all."""
    sensors = ResponseSensors(suite, seed, motion)
    for track, place in setup.tracks.items():
        yield from sensors.channels(motion.vehicle.gauges(place.reference_point_m[1]), track)
    yield from sensors.channels(motion.vehicle.shared_gauges(), None)


def as_installed(known: VehicleSetup, error: float, seed: int) -> VehicleSetup:
    """Return the vehicle as an installer knows it: each parameter wrong by up to ``error``.

    A parameter is multiplied or divided by up to 1 + ``error``, so that its sign stays.
    """
    rng = stream(seed, "setup.vehicle")
    parameters = {
        name: value * (1.0 + error) ** rng.uniform(-1.0, 1.0)
        for name, value in known.parameters.items()
    }
    return VehicleSetup(known.model, parameters, known.x_m)


class ResponseSensors:
    """The response sensors of one run: a suite, a seed, and the true motion they see."""

    def __init__(self, suite: SensorSuite, seed: int, motion: SuspensionMotion) -> None:
        """Keep what every channel is made from."""
        self.suite = suite
        self.seed = seed
        self.motion = motion
        self.rate_hz = float(motion.clock.rate)
        self.count = motion.lane.shape[1]
        self.tilt = motion.tilt()

    def channels(self, gauges: Gauges, track: str | None) -> Iterator[Channel]:
        """Yield the channels of ``gauges``; the only track has no name."""
        for name, row in gauges.forces.items():
            yield self._channel(name, self._force(name, row, self._stream(name, track)), track)
        for name, row in gauges.deflections.items():
            values = self._deflection(row, self._stream(name, track))
            yield self._channel(name, values, track)
        for name, row in gauges.test_rig.items():
            values = self._on_the_rig(name, row, self._stream(name, track))
            yield self._channel(name, values, track)

    def _stream(self, name: str, track: str | None) -> np.random.Generator:
        return stream(self.seed, name if track is None else f"{track}.{name}")

    def _channel(self, name: str, values: FloatArray, track: str | None) -> Channel:
        return Channel.of(name, values, self.motion.clock, None if track == ONLY_TRACK else track)

    def _force(self, name: str, row: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Return what an accelerometer reads that moves by ``row`` of the freedoms, (2.17).

        One on the body tilts with it; a wheel carrier stays normal to the road's alignment but
        for its brake, which winds it up.
        """
        along, across, normal = self.motion.lane
        on_carrier = "unsprung" in name
        if on_carrier:
            slope = np.arctan(self.motion.grade)
            braking = along / STANDARD_GRAVITY + np.sin(slope)
            pitch = -self.suite.carrier_windup * braking - slope
            roll = np.zeros(1)
        else:
            pitch, roll = self.tilt
        pitch = pitch + draw_value(rng, self.suite.misalignment_rad)
        roll = roll + draw_value(rng, self.suite.misalignment_rad)
        seen = normal + row @ self.motion.acceleration
        seen *= np.cos(pitch)
        seen += np.sin(pitch) * along
        seen *= np.cos(roll)
        seen -= np.sin(roll) * across
        return self._with_errors(seen, rng, on_carrier)

    def _with_errors(
        self, force: FloatArray, rng: np.random.Generator, on_carrier: bool
    ) -> FloatArray:
        """Return ``force`` with scale error, bias, walk, noise and resolution; it is given up."""
        s = self.suite
        noise, bias, walk, step = (
            (s.carrier_noise, s.carrier_bias, s.carrier_walk, s.carrier_resolution)
            if on_carrier
            else (s.force_noise, s.force_bias, s.force_walk, s.force_resolution)
        )
        force *= 1.0 + s.force_scale * rng.uniform(-1.0, 1.0)
        force += draw_value(rng, bias)
        force += random_walk(rng, walk, self.rate_hz, self.count)
        force += white(rng, noise, self.rate_hz, self.count)
        return quantize(force, step)

    def _deflection(self, row: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Return the travel of a suspension against rest on a level road, in m."""
        travel = row @ self.motion.position
        travel *= 1.0 + self.suite.deflection_scale * rng.uniform(-1.0, 1.0)
        if self.suite.deflection_noise_m > 0:
            travel += self.suite.deflection_noise_m * rng.standard_normal(self.count)
        return quantize(travel, self.suite.deflection_resolution_m)

    def _on_the_rig(self, name: str, row: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Return what a test rig reads: the truth and white noise."""
        suite, motion = self.suite, self.motion
        rows, noise = {
            "displacement": (motion.position, suite.rig_height_noise_m),
            "velocity": (motion.velocity, suite.rig_velocity_noise),
            "angle": (motion.position, suite.rig_angle_noise),
            "acceleration": (motion.acceleration, suite.rig_turn_noise),
        }[name.rpartition("_")[2]]
        return np.asarray(row @ rows + noise * rng.standard_normal(self.count))
