"""The axis of distance that a device can know: what the encoder told where the vehicle was."""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.checks.interface import Taken
from floatref_conformance.proving_ground.staging import drive_of


@dataclass(frozen=True, eq=False)
class EncoderAxis:
    """True and told distance of every sample of a drive, both shape (n,), in m."""

    true_m: FloatArray
    told_m: FloatArray

    @classmethod
    def of(cls, taken: Taken) -> "EncoderAxis":
        """Return the axis of a recording, by the drive that was simulated."""
        encoder = taken.recording.channel("distance")
        motion = drive_of(taken.scenario).motion(encoder.times_s)
        return cls(motion.distance, encoder.values)

    def true(self, told_m: FloatArray) -> FloatArray:
        """Return the true distance in m where the encoder told ``told_m``."""
        return np.interp(told_m, self.told_m, self.true_m)

    def told(self, true_m: FloatArray) -> FloatArray:
        """Return what the encoder told, in m, at the true distance ``true_m``."""
        return np.interp(true_m, self.true_m, self.told_m)
