"""The cut-off that follows the travel speed (5.3), in time and over distance."""

from abc import abstractmethod
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import CUTOFF, TRAVEL_SPEED
from floatref.values.arrays import FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.plain import above_zero, numbers

SHORTEST = 4.0
"""Shortest cut-off wavelength over distance, in intervals of the profile."""


@dataclass(frozen=True)
class AdaptiveCutOff:
    """The cut-off of (5.3): a frequency at low speed, a wavelength at high speed.

    ``low_speed_hz`` is f_ls, ``wavelength_m`` λ_c; the transition is at ``transition_speed``
    (v_0, m/s) with ``steepness`` α in s/m. Raises InputError unless all are above zero.
    """

    low_speed_hz: float = 0.45
    wavelength_m: float = 105.91
    transition_speed: float = 2.778
    steepness: float = 2.5

    def __post_init__(self) -> None:
        """Refuse numbers that are no cut-off."""
        for field in fields(self):
            above_zero(f"cut-off schedule: {field.name}", getattr(self, field.name))

    def frequency(self, speed: ArrayLike) -> FloatArray:
        """Return f_c in Hz at ``speed`` in m/s: (5.3).

        Args:
            speed: travel speed in m/s, any shape; NaN where it is missing.

        Returns:
            An array of the shape of ``speed``, so () for a number; NaN where the speed is.

        Raises:
            InputError: for what holds no real numbers, or an infinite one.
        """
        values = numbers("AdaptiveCutOff.frequency: speed", speed)
        return self._frequency(values.reshape(-1)).reshape(values.shape)

    def wave_number(self, speed: ArrayLike, interval_m: float) -> FloatArray:
        """Return f_c / v in cycles/m, at most one cycle in four of ``interval_m``.

        Args:
            speed: travel speed in m/s, any shape; NaN where it is missing.
            interval_m: distance between points in m.

        Returns:
            An array of the shape of ``speed``, so () for a number; NaN where the speed is.

        Raises:
            InputError: for what holds no real numbers, or an infinite one; an interval not above
                zero.
        """
        values = numbers("AdaptiveCutOff.wave_number: speed", speed)
        interval_m = above_zero("AdaptiveCutOff.wave_number: interval_m", interval_m)
        return self._wave_number(values.reshape(-1), interval_m).reshape(values.shape)

    def _frequency(self, speed: FloatArray) -> FloatArray:
        from floatref.kernels import schedule

        frequency = np.empty(speed.size)
        schedule.frequencies(
            speed,
            frequency,
            self.low_speed_hz,
            self.wavelength_m,
            self.transition_speed,
            self.steepness,
        )
        return frequency

    def _wave_number(self, speed: FloatArray, interval_m: float) -> FloatArray:
        from floatref.kernels import schedule

        values = self._frequency(speed)
        schedule.wave_numbers(speed, values, 1.0 / (SHORTEST * interval_m))
        return values


class Schedule(Stage):
    """Adds the shared channel `high_pass_cutoff` from `travel_speed`.

    No point of the profile is changed by this stage itself.
    """

    declared = Declared(linear=False, zero_in_zero_out=False)
    axis: Axis

    def __init__(self, schedule: AdaptiveCutOff | None = None) -> None:
        """Follow ``schedule``, by default that of section 5.7."""
        super().__init__()
        self.schedule = schedule or AdaptiveCutOff()
        self._step = 1.0

    def open(self, header: Header) -> Header:
        """Ask for the speed on the right axis."""
        if header.axis is not self.axis:
            raise InputError(f"stage {self.name}: the stream is not on the {self.axis.value} axis")
        header.require(self.name, ChannelId(TRAVEL_SPEED))
        self._step = header.step
        return header.adding(ChannelId(CUTOFF))

    def advance(self, block: Block) -> Block:
        """Look up every sample."""
        source, target = ChannelId(TRAVEL_SPEED), ChannelId(CUTOFF)
        flags = flags_of(block, source)
        marks = {} if flags is None else {target: flags}
        return block.setting({target: self._cutoff(block[source])}, marks)

    @abstractmethod
    def _cutoff(self, speed: FloatArray) -> FloatArray:
        """Return the cut-off in cycles per unit of the axis."""


class ScheduleCutOff(Schedule):
    """Adds `high_pass_cutoff` in Hz, (5.3), on the time axis.

    No point of the profile is changed by this stage itself.
    """

    axis = Axis.TIME

    def _cutoff(self, speed: FloatArray) -> FloatArray:
        return self.schedule.frequency(speed)


class ScheduleWaveNumber(Schedule):
    """Adds `high_pass_cutoff` in cycles/m, (5.3) over the speed, on the distance axis.

    The cut-off wavelength is no shorter than four intervals, and so it is where the stored
    speed is zero. No point of the profile is changed by this stage itself.
    """

    axis = Axis.DISTANCE

    def _cutoff(self, speed: FloatArray) -> FloatArray:
        return self.schedule.wave_number(speed, self._step)
