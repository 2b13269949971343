"""Calls that belong together: samples of each signal so far, and missing ones at the end."""

import zlib

import numpy as np

from floatref.errors import InputError, StageError
from floatref.stages.filters.schedule import AdaptiveCutOff
from floatref.values.arrays import FloatArray

MOTION = ("acceleration", "velocity", "height")
"""The signals that must all be filtered for the vehicle's motion to cancel."""


class Calls:
    """The calls of one run: the same samples, and the same speed, of every signal."""

    def __init__(self, owner: str, signals: tuple[str, ...] = MOTION) -> None:
        """Expect ``signals``, in the name of the class ``owner``."""
        self._owner = owner
        self._counts = dict.fromkeys(signals, 0)
        self._speeds = dict.fromkeys(signals, 0)
        self._ended = False

    def add(self, signal: str, length: int, speed: FloatArray | None = None) -> None:
        """Count ``length`` samples of ``signal``; StageError after the end, or out of order."""
        self._require_running(signal)
        count = self._counts[signal] + length
        if signal == "velocity" and count > self._counts["acceleration"]:
            raise StageError(
                f"{self._owner}.velocity: sample {count} before that of the acceleration; filter "
                "the acceleration, integrate it, then filter the velocity"
            )
        self._counts[signal] = count
        if speed is not None:
            self._speeds[signal] = _checksum(speed, self._speeds[signal])

    def end(self, call: str) -> None:
        """End the run at ``call``; StageError unless all signals have equally many samples."""
        self._require_running(call)
        self._require_complete(call)
        self._ended = True

    def end_in_time(self, length: int, speed: FloatArray | None = None) -> None:
        """End the run at a backward pass over ``length`` samples at ``speed``.

        Raises StageError unless these are all samples of the forward calls, and their speed.
        """
        self._require_running("reverse")
        self._require_complete("reverse")
        count = next(iter(self._counts.values()))
        if length != count:
            raise StageError(
                f"{self._owner}.reverse: a profile of {length} samples after {count}; give the "
                "whole run in one call"
            )
        if speed is not None and _checksum(speed, 0) not in self._speeds.values():
            raise StageError(f"{self._owner}.reverse: another speed than before; give the same")
        self._ended = True

    def _require_complete(self, call: str) -> None:
        if len({*self._counts.values()}) > 1 or not any(self._counts.values()):
            found = ", ".join(f"{count} of {name}" for name, count in self._counts.items())
            raise StageError(
                f"{self._owner}.{call}: samples so far are {found}; all must go through, or the "
                "vehicle's motion does not cancel"
            )
        if len({*self._speeds.values()}) > 1:
            raise StageError(
                f"{self._owner}.{call}: {', '.join(self._counts)} were given different speeds; "
                "give all the same, or the vehicle's motion does not cancel"
            )

    def _require_running(self, call: str) -> None:
        if self._ended:
            raise StageError(f"{self._owner}.{call}: the run has ended; make a new one for each")


def _checksum(speed: FloatArray, before: int) -> int:
    return zlib.crc32(np.ascontiguousarray(speed).data, before)


class Band:
    """The speeds at which the cut-off (5.3) is possible for a filter at a given rate."""

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
    """Raise InputError, in the name of ``call``, for a profile of missing samples only."""
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
