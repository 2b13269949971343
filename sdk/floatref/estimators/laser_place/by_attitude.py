"""The height carried to the accelerometer by the attitude that an inertial unit measures."""

from collections.abc import Mapping

import numpy as np

from floatref.estimators.levelling.attitude import Attitude
from floatref.estimators.levelling.attitude_stage import BLENDED_S, AttitudeStage, Own
from floatref.stages.marks import flags_of
from floatref.stages.signals import HEIGHT
from floatref.values.arrays import FloatArray
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId

Lever = tuple[float, float]


class HeightByAttitude(AttitudeStage):
    """Replaces `height` by what the laser would read in the accelerometer's place.

    The body is rigid, so a laser at (x, y) ahead of and to the left of its accelerometer is higher
    by -x sin θ + y cos θ sin φ at the pitch θ, nose down positive, and the roll φ, left side up
    (6.23). Where the attitude is not known, the height is flagged as the sensors behind it are.
    """

    source = made = HEIGHT

    def __init__(self, levers_m: Mapping[str, Lever], blended_s: float = BLENDED_S) -> None:
        """Carry by ``levers_m`` of each wheel path: its laser's (x, y) from its accelerometer."""
        super().__init__(blended_s)
        self.levers_m = dict(levers_m)

    def open(self, header: Header) -> Header:
        """Ask for the inertial unit of every track, the encoder and the heights, in time."""
        return super().open(header)

    def compute(
        self, track: str, block: Block, attitude: Attitude, turned: FloatArray, at: int
    ) -> Own:
        """Return the height at the accelerometer, in m."""
        (x_m, y_m), channel = self.levers_m[track], ChannelId(HEIGHT, track)
        (pitch, roll), _ = attitude.angles(turned, at)
        raised = y_m * np.cos(pitch) * np.sin(roll) - x_m * np.sin(pitch)
        marks = flags_of(block, *self.channels[track])
        return {channel: block[channel] - raised}, {} if marks is None else {channel: marks}
