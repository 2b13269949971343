"""The exactly matched high-pass filter: an observer in place of both integrations."""

from numpy.typing import ArrayLike

from floatref.retrofit.adaptive import FollowingHighPass
from floatref.retrofit.alone import Alone
from floatref.stages.filters.matched_high_pass import MatchedHighPass as Observer
from floatref.stages.filters.schedule import ScheduleCutOff
from floatref.stages.filters.varying import StateHighPassB3S1R, StateHighPassB3S2R
from floatref.stages.signals import ACCELERATION, HEIGHT, REFERENCE_HEIGHT, TRAVEL_SPEED
from floatref.values.arrays import FloatArray
from floatref.values.block import Header


class MatchedHighPass(FollowingHighPass):
    """The floating reference height, which follows the height below the cut-off (5.3) of the speed.

    It replaces both integrations and the filters around them: subtract the measured height. The
    vehicle's motion cancels at any variation of the cut-off. At a constant one the difference is
    (A.1) of the profile; content below the cut-off is removed.

    The stages of the backward passes are in state-variable form, which is valid at a stop.
    """

    _signals = ("reference_height",)
    _back = (StateHighPassB3S2R, StateHighPassB3S1R)

    def reference_height(self, a: ArrayLike, h: ArrayLike, speed: ArrayLike) -> FloatArray:
        """Return the floating reference height in m, shape (N,); minus ``h`` it is the elevation.

        Args:
            a: next samples of the acceleration with 1 g removed in m/s², shape (N,).
            h: height as it was measured in m, shape (N,).
            speed: travel speed there in m/s, shape (N,).

        Raises:
            InputError: for arrays of other shapes or infinite samples; for a speed whose cut-off
                is not below half the rate.
            StageError: after the end of the run.
        """
        return self._pass("reference_height", a=a, h=h, speed=speed)

    def _make_forward(self, axis: Header) -> dict[str, Alone]:
        signals = ACCELERATION, HEIGHT, TRAVEL_SPEED
        stages = ScheduleCutOff(self.schedule), Observer()
        return {"reference_height": Alone(axis, signals, REFERENCE_HEIGHT, stages)}
