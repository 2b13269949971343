"""The height carried to the accelerometer by the attitude that an inertial unit measures."""

from collections.abc import Mapping, Sequence

from floatref.estimators.levelling.attitude import Attitude
from floatref.estimators.levelling.attitude_stage import (
    BLENDED_S,
    AttitudeStage,
    Lever,
    Own,
    raise_by,
)
from floatref.stages.marks import flags_of
from floatref.stages.signals import HEIGHT
from floatref.values.arrays import FlagArray, FloatArray
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


class HeightByAttitude(AttitudeStage):
    """Replaces `height` by what the laser would read in the accelerometer's place.

    The body is rigid, so a laser on a lever is higher by `raise_by` than its accelerometer. The
    attitude is that by the inertial unit of the first wheel path, whose flags all heights get.
    """

    source = made = HEIGHT

    def __init__(self, levers_m: Mapping[str, Lever], blended_s: float = BLENDED_S) -> None:
        """Carry by ``levers_m`` of each wheel path: its laser's (x, y) from its accelerometer."""
        super().__init__(blended_s)
        self.levers_m = dict(levers_m)

    def tracks_of(self, header: Header) -> Sequence[str]:
        """Return the first wheel path: one body has one attitude."""
        return header.tracks[:1]

    def open(self, header: Header) -> Header:
        """Ask for the inertial unit, the encoder and all heights, in time."""
        header.require(self.name, *(ChannelId(HEIGHT, track) for track in self.levers_m))
        return super().open(header)

    def compute(
        self, track: str, block: Block, attitude: Attitude, turned: FloatArray, at: int
    ) -> Own:
        """Return the heights of all wheel paths at their accelerometers, in m."""
        x, y, _, *rates = self.channels[track]
        angles, _ = attitude.angles(turned, at)
        values: dict[ChannelId, FloatArray] = {}
        flags: dict[ChannelId, FlagArray] = {}
        for name, lever in self.levers_m.items():
            height = ChannelId(HEIGHT, name)
            values[height] = block[height] - raise_by(lever, angles)
            marks = flags_of(block, height, x, y, *rates)
            if marks is not None:
                flags[height] = marks
        return values, flags
