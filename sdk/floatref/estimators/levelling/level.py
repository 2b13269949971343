"""The vertical acceleration by the measured attitude, in place of one less 1 g."""

from collections.abc import Mapping

import numpy as np

from floatref.estimators.kalman.inputs import IMU
from floatref.estimators.levelling.attitude import Attitude
from floatref.estimators.levelling.attitude_stage import BLENDED_S as BLENDED_S
from floatref.estimators.levelling.attitude_stage import AttitudeStage, Lever, Own, raise_by
from floatref.stages.conditioning import SPECIFIC_FORCE
from floatref.stages.marks import flags_of
from floatref.stages.signals import ACCELERATION, HEIGHT
from floatref.values.arrays import Flag, FloatArray
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


class Level(AttitudeStage):
    """Levels the accelerometers: `vertical_acceleration` in place of `vertical_specific_force`.

    The result is (2.20) with the attitude of `AttitudeStage`. All channels of the inertial unit are
    dropped. Given the levers of lasers, `height` is carried to the accelerometer by the same
    attitude, as `HeightByAttitude` does.
    """

    source, made = SPECIFIC_FORCE, ACCELERATION
    dropped = (SPECIFIC_FORCE, *IMU)

    def __init__(
        self, blended_s: float = BLENDED_S, levers_m: Mapping[str, Lever] | None = None
    ) -> None:
        """Blend as `AttitudeStage`; ``levers_m`` are by wheel path, nothing if all are zero."""
        super().__init__(blended_s)
        self.levers_m = {t: lever for t, lever in (levers_m or {}).items() if any(lever)}

    def open(self, header: Header) -> Header:
        """Ask for the inertial unit, the encoder, and the heights that are to be carried."""
        header.require(self.name, *(ChannelId(HEIGHT, track) for track in self.levers_m))
        return super().open(header)

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
        values, flags = {target: found}, {} if marks is None else {target: marks}
        if track in self.levers_m:
            height = ChannelId(HEIGHT, track)
            angles, _ = attitude.angles(turned, at)
            values[height] = block[height] - raise_by(self.levers_m[track], angles)
            own = flags_of(block, height)
            both = [each for each in (own, marks) if each is not None]
            if both:
                flags[height] = np.bitwise_or.reduce(both)
        return values, flags
