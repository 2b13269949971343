"""The axis of distance that a device can know: what the encoder told where the vehicle was."""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.recording import Recording
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import HEIGHT
from floatref_conformance.proving_ground.staging import drive_of


@dataclass(frozen=True, eq=False)
class EncoderAxis:
    """True and told distance of every sample of a drive, both shape (n,), in m."""

    true_m: FloatArray
    encoder_m: FloatArray

    @classmethod
    def of(cls, taken: Taken) -> "EncoderAxis":
        """Return the axis of a recording, by the drive that was simulated.

        Without a height sensor a wheel finds the road, ahead of the laser's place: it takes the
        way between them by the setup, and no device knows what the encoder will make of it.
        """
        encoder = taken.recording.channel("distance")
        motion = drive_of(taken.scenario).motion(encoder.times_s)
        ahead_m = sensing_ahead_m(taken.recording)
        return cls(motion.distance + ahead_m, encoder.values + ahead_m)

    def to_true(self, told_m: FloatArray) -> FloatArray:
        """Return the true distance in m where the encoder told ``told_m``."""
        return np.interp(told_m, self.encoder_m, self.true_m)

    def to_encoder(self, true_m: FloatArray) -> FloatArray:
        """Return what the encoder told, in m, at the true distance ``true_m``."""
        return np.interp(true_m, self.true_m, self.encoder_m)


def sensing_ahead_m(recording: Recording) -> float:
    """Return how far ahead of the laser's place the road is seen, in m; 0 by a height sensor."""
    setup = recording.setup
    if setup.vehicle is None or any(c.id.name == HEIGHT for c in recording.channels):
        return 0.0
    place = setup.tracks[recording.tracks[0]]
    return setup.vehicle.x_m - place.reference_point_m[0] - place.laser_offset_m[0]
