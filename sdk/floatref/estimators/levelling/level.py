"""The vertical acceleration by the measured attitude, in place of one less 1 g."""

import numpy as np

from floatref.estimators.kalman.inputs import IMU
from floatref.estimators.levelling.attitude import Attitude
from floatref.estimators.levelling.attitude_stage import BLENDED_S as BLENDED_S
from floatref.estimators.levelling.attitude_stage import AttitudeStage, Own
from floatref.stages.conditioning import SPECIFIC_FORCE
from floatref.stages.marks import flags_of
from floatref.stages.signals import ACCELERATION
from floatref.values.arrays import Flag, FloatArray
from floatref.values.block import Block
from floatref.values.channels import ChannelId


class Level(AttitudeStage):
    """Levels the accelerometers: `vertical_acceleration` in place of `vertical_specific_force`.

    The result is (2.20) with the attitude of `AttitudeStage`. All channels of the inertial unit are
    dropped.
    """

    source, made = SPECIFIC_FORCE, ACCELERATION
    dropped = (SPECIFIC_FORCE, *IMU)

    def compute(
        self, track: str, block: Block, attitude: Attitude, turned: FloatArray, at: int
    ) -> Own:
        """Return the levelled acceleration in m/s²."""
        names, target = self.channels[track], ChannelId(ACCELERATION, track)
        force = np.stack([block[name] for name in names[:3]])
        found, unknown = attitude.level(force, turned, at)
        marks = flags_of(block, *names)
        if unknown.any():
            lost = np.where(unknown, np.uint8(Flag.MISSING | Flag.DRIFT), np.uint8(0))
            marks = lost if marks is None else marks | lost
        return {target: found}, {} if marks is None else {target: marks}
