"""The Kalman smoother in place of both integrations."""

from dataclasses import replace
from typing import ClassVar

from floatref.estimators.kalman.filter import KalmanStage
from floatref.estimators.kalman.inputs import IMU
from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.references import Plan
from floatref.estimators.smoothing.backlog import ALL, TOLERANCE_M, WAITING_S, Backlog
from floatref.estimators.smoothing.line import Closing
from floatref.stages.protocol import Declared
from floatref.stages.signals import ACCELERATION, SIGMA
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId


class KalmanSmoother(KalmanStage):
    """Filter and smoother (section 6.6.2 and its variants).

    Adds `floating_reference_height`, and `elevation_sigma`: 1-σ of the elevation after HPF_B3x2 at
    ``wavelength_m``. Segments of four seconds are smoothed once the readings behind them no longer
    matter, and a block comes out with each that is pushed from then on. What is stored until then
    depends on the drive, not on its length (section 7.3.4).
    """

    declared: ClassVar[Declared] = replace(KalmanStage.declared, delay=ALL)

    def __init__(
        self,
        plan: Plan,
        noise: Noise,
        wavelength_m: float = 105.91,
        tolerance_m: float = TOLERANCE_M,
        waiting_s: float = WAITING_S,
    ) -> None:
        """Observe what ``plan`` lists, with ``noise``.

        Segments are closed within ``tolerance_m``, after ``waiting_s`` at the earliest.
        """
        super().__init__(plan, noise, wavelength_m)
        self.tolerance_m, self.waiting_s = tolerance_m, waiting_s

    def open(self, header: Header) -> Header:
        """Begin with empty memory."""
        out = super().open(header)
        rule = Closing(header.step, self.tolerance_m, self.wavelength_m, self.noise.height_m)
        self.memory["backlog"] = Backlog.of(header.tracks, rule, self.waiting_s)
        out = out.adding(*(ChannelId(SIGMA, track) for track in header.tracks))
        self._made = out.channels
        return out

    def advance(self, block: Block) -> Block:
        """Filter the block; return the block that is ready by now, if one is."""
        backlog: Backlog = self.memory["backlog"]
        if len(block):
            backlog.add(block.without(ACCELERATION, *IMU), self.forward(block))
            done = next(backlog.come_out(), None)
            if done is not None:
                return done
        return self.empty(backlog.next_sample(block))

    def close(self) -> tuple[Block, ...]:
        """Return all that remains."""
        backlog: Backlog = self.memory["backlog"]
        backlog.finish(self.ending())
        return tuple(backlog.come_out())
