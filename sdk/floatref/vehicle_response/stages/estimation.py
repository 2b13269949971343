"""An estimator of unknown inputs in place of a height sensor."""

from collections.abc import Sequence
from math import pi, sqrt
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import CUTOFF
from floatref.values.arrays import Flag, FlagArray, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.vehicle_response.estimators.estimate import Estimate
from floatref.vehicle_response.stages.estimators import Group
from floatref.vehicle_response.stages.joining import elevation_under, sigma_under

LOCAL_S = 0.5
"""Time constant in s of the mean square of the tyre's deflection: some periods of the wheel."""


def drift_sigma(density: float, cutoff_hz: ArrayLike) -> FloatArray:
    """Return the 1-σ in m of a height integrated twice from an accelerometer, any shape.

    White noise of the two-sided ``density`` N in m/s²/√Hz, integrated twice, has the spectrum
    N²/(2πf)⁴. HPF_B3 at the cut-off c passes f⁶/(f⁶ + c⁶) of it forward and as much backward, so
    that σ² = 2N²/(2π)⁴ · ∫ f⁸/(f⁶ + c⁶)² df = 2N²/((2π)⁴c³) · π/12 from 0 to ∞.
    """
    c = np.asarray(cutoff_hz, dtype=np.float64)
    return np.asarray(density * sqrt(pi / 6.0) / (2.0 * pi) ** 2 / c**1.5, dtype=np.float64)


class LocalSquare:
    """The mean square of a signal over about `LOCAL_S` before each sample, at least its own square.

    It is an exponential mean of the past alone, so that a bump counts as it begins.
    """

    def __init__(self, step_s: float) -> None:
        """Take samples ``step_s`` apart."""
        self._keep = float(np.exp(-step_s / LOCAL_S))

    def begin(self) -> FloatArray:
        """Return the memory of a run."""
        return np.zeros(1)

    def advance(self, memory: FloatArray, signal: FloatArray) -> FloatArray:
        """Return it for the next samples, shape (N,), and change ``memory``; NaN counts as 0."""
        from scipy.signal import lfilter

        squares = np.nan_to_num(signal) ** 2
        if squares.size == 0:
            return squares
        mean, memory[:] = lfilter([1.0 - self._keep], [1.0, -self._keep], squares, zi=memory)
        return np.maximum(mean, squares)


class EstimateRoad(Stage):
    """Adds the road under every tyre of each group, and its 1-σ; the readings are dropped.

    The 1-σ puts together as independent: the estimator's own; the drift of a wheel's height that
    was integrated from its accelerometer (`drift_sigma`), at the cut-off of the sample; and
    ``parameter_sigma`` times the root mean square of the tyre's deflection (`LocalSquare`), since
    the road is the wheel's height, which needs no parameter, plus that deflection, the force on
    the tyre over its stiffness. Where too few readings are there both are NaN. An estimate is
    flagged as its readings are, and the error of a missing one decays in the estimator.
    """

    declared: ClassVar[Declared] = Declared(linear=False, zero_in_zero_out=False)

    def __init__(self, groups: Sequence[Group], parameter_sigma: float = 0.03) -> None:
        """Estimate the road of ``groups``; parameters are off by ``parameter_sigma``, relative."""
        super().__init__()
        self.groups, self.parameter_sigma = tuple(groups), parameter_sigma
        self._square = LocalSquare(1.0)

    def open(self, header: Header) -> Header:
        """Ask for the readings and the cut-off, in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        read = [channel for group in self.groups for channel in group.channels]
        header.require(self.name, ChannelId(CUTOFF), *read)
        self._square = LocalSquare(header.step)
        self.memory = {
            "estimators": [group.estimator.begin() for group in self.groups],
            "squares": [[self._square.begin() for _ in group.tracks] for group in self.groups],
        }
        made = [
            ChannelId(name(k), track)
            for group in self.groups
            for k, track in zip(group.numbers, group.tracks, strict=True)
            for name in (elevation_under, sigma_under)
        ]
        return header.without(*{channel.name for channel in read}).adding(*made)

    def advance(self, block: Block) -> Block:
        """Estimate the road of every group."""
        values: dict[ChannelId, FloatArray] = {}
        flags: dict[ChannelId, FlagArray] = {}
        for number, group in enumerate(self.groups):
            memory, squares = self.memory["estimators"][number], self.memory["squares"][number]
            samples = group.samples([block[channel] for channel in group.channels])
            estimate = group.estimator.advance(memory, samples)
            marks = flags_of(block, *group.channels, ChannelId(CUTOFF))
            for k, track in enumerate(group.tracks):
                sigma = self._sigma(group, k, estimate, block[ChannelId(CUTOFF)], squares)
                own_number = group.numbers[k]
                found = {
                    elevation_under(own_number): estimate.road[:, k].copy(),
                    sigma_under(own_number): sigma,
                }
                own = _mark_unknown(marks, sigma)
                for name, x in found.items():
                    values[ChannelId(name, track)] = x
                    if own is not None:
                        flags[ChannelId(name, track)] = own
        read = {channel.name for group in self.groups for channel in group.channels}
        return block.without(*read).setting(values, flags)

    def _sigma(
        self,
        group: Group,
        number: int,
        estimate: Estimate,
        cutoff: FloatArray,
        squares: Sequence[FloatArray],
    ) -> FloatArray:
        """Return the 1-σ of the road under tyre ``number`` in m, shape (N,)."""
        road = estimate.road[:, number]
        deflection = road - estimate.states[:, group.wheels[number]]
        square = self._square.advance(squares[number], deflection)
        drift = drift_sigma(group.densities[number], cutoff)
        own = estimate.road_sigma[:, number] ** 2 + drift**2 + self.parameter_sigma**2 * square
        return np.where(np.isnan(road), np.nan, np.sqrt(own))


def _mark_unknown(marks: FlagArray | None, sigma: FloatArray) -> FlagArray | None:
    """Return ``marks`` with unknown samples as missing, None without any flag."""
    unknown = np.isnan(sigma)
    if not unknown.any():
        return marks
    missing = np.where(unknown, np.uint8(Flag.MISSING), np.uint8(0))
    return missing if marks is None else marks | missing
