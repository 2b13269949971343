"""What would stop a filter in the middle of a call, looked for before anything is counted."""

import numpy as np

from floatref.errors import InputError
from floatref.stages.schedule import AdaptiveCutOff
from floatref.values.arrays import FloatArray


class Band:
    """The speeds at which the cut-off (5.3) is one that a filter at a given rate can have."""

    def __init__(self, schedule: AdaptiveCutOff, step_s: float) -> None:
        """Check the cut-offs of ``schedule`` for a filter that samples every ``step_s``."""
        self._schedule, self._step_s = schedule, step_s

    def require(self, call: str, speed: FloatArray) -> None:
        """Raise InputError, in the name of ``call``, for the first of ``speed`` beyond the band."""
        cutoff = self._schedule.frequency(speed)
        _require(call, speed, cutoff, "Hz", self._step_s)

    def require_over_distance(self, call: str, speed: FloatArray, interval_m: float) -> None:
        """Raise InputError as `require`, for the cut-off over distance, every ``interval_m``."""
        cutoff = self._schedule.wave_number(speed, interval_m)
        _require(call, speed, cutoff, "cycles/m", interval_m)


def require_profile(call: str, profile: FloatArray) -> None:
    """Raise InputError, in the name of ``call``, for a profile without any sample that is there."""
    if profile.size and np.isnan(profile).all():
        raise InputError(
            f"{call}: all {profile.size} samples of profile are missing (NaN); there is nothing "
            "to filter, so look for the gap in what made it"
        )


def _require(call: str, speed: FloatArray, cutoff: FloatArray, unit: str, step: float) -> None:
    wrong = (cutoff < 0.0) | (cutoff * step >= 0.5)
    if wrong.any():
        where = int(wrong.argmax())
        raise InputError(
            f"{call}: speed sample {where} is {speed[where]:g} m/s: its cut-off is "
            f"{cutoff[where]:g} {unit}, outside 0 to {0.5 / step:g}, half the sampling rate; give "
            "the speed in m/s"
        )
