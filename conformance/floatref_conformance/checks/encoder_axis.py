"""The axis of distance that a device can know: the encoder's reading at each true place."""

from dataclasses import dataclass, replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import HEIGHT
from floatref_conformance.proving_ground.staging import drive_of


@dataclass(frozen=True, eq=False)
class EncoderAxis:
    """True distance and encoder reading of every sample of a drive, both shape (n,), in m."""

    true_m: FloatArray
    encoder_m: FloatArray

    @classmethod
    def of(cls, taken: Taken) -> "EncoderAxis":
        """Return the axis of a recording, from the simulated drive.

        Without a height sensor the road is measured at a wheel, ahead of the laser's place. The
        device adds the distance between them by the setup; it cannot know the encoder's error over
        this distance.
        """
        encoder = taken.recording.channel("distance")
        motion = drive_of(taken.scenario).motion(encoder.times_s)
        ahead_m = sensing_ahead_m(taken.recording)
        return cls(motion.distance + ahead_m, encoder.values + ahead_m)

    @classmethod
    def without_error(cls, taken: Taken) -> "EncoderAxis":
        """Return the axis of a device that knows the true distance of ``taken``."""
        axis = cls.of(taken)
        return cls(axis.true_m, axis.true_m)

    def place(self, truth: Profile) -> Profile:
        """Return ``truth``, which lies along the true distance, along this axis."""
        count = int((self.encoder_m[-1] - self.encoder_m[0]) / truth.interval_m) + 1
        points_m = self.encoder_m[0] + truth.interval_m * np.arange(count)
        true_m = self.to_true(points_m)
        tracks = tuple(
            ProfileTrack.of(t.name, np.interp(true_m, truth.distance_m, t.elevation))
            for t in truth.tracks
        )
        return replace(truth, tracks=tracks, start_m=float(self.encoder_m[0]))

    def to_true(self, encoder_m: FloatArray) -> FloatArray:
        """Return the true distance in m where the encoder reads ``encoder_m``."""
        return np.interp(encoder_m, self.encoder_m, self.true_m)

    def to_encoder(self, true_m: FloatArray) -> FloatArray:
        """Return the encoder's reading in m at the true distance ``true_m``."""
        return np.interp(true_m, self.true_m, self.encoder_m)


def sensing_ahead_m(recording: Recording) -> float:
    """Return the distance in m from the laser's place to the sensing place; 0 with a laser."""
    setup = recording.setup
    if setup.vehicle is None or any(c.id.name == HEIGHT for c in recording.channels):
        return 0.0
    place = setup.tracks[recording.tracks[0]]
    return setup.vehicle.x_m - place.reference_point_m[0] - place.laser_offset_m[0]
