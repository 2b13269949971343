"""Whether a suspension's deflection agrees with the heights of body and wheel."""

from typing import ClassVar, NamedTuple

import numpy as np

from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.values.arrays import FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

LAG_S = 0.05
"""Half the time in s over which bends are compared: they contain the swings of body and
wheel. The error of a tilt under brakes, integrated twice, is almost straight in that time."""
LEAST_R, LEAST_SLOPE, MOST_SLOPE = 0.7, 0.6, 1.6
"""Least agreement, by correlation and by scale; a warning is given below it."""
LOUD = 3.0
"""Least size of a bend that counts, as a multiple of the deflection's noise."""
FEWEST = 200
"""Least number of bends."""


class Sums(NamedTuple):
    """Sums over bends: x are those expected, y those measured, both in m."""

    bends: int = 0
    xx: float = 0.0
    xy: float = 0.0
    yy: float = 0.0

    def add(self, x: FloatArray, y: FloatArray) -> "Sums":
        """Return the sums with these bends, each of shape (n,)."""
        return Sums(
            self.bends + x.size,
            *(float(s) for s in (self.xx + x @ x, self.xy + x @ y, self.yy + y @ y)),
        )


class CompareTravel(Stage):
    """Passes all channels on, and warns if `suspension_deflection` is not body minus wheel height.

    The heights are ``body`` and ``wheel``, in m, as integrated or measured; second differences of
    both sides over 0.05 s are compared by their correlation and by the slope of the line of least
    squares.
    Wheel and body taken for each other, a wrong sign, a wrong scale and clocks that are not in
    step make them differ.
    """

    declared: ClassVar[Declared] = Declared()

    def __init__(self, deflection: str, body: str, wheel: str, sigma_m: float) -> None:
        """Compare these channels of every wheel path; ``sigma_m`` is a deflection's noise in m."""
        super().__init__()
        self.names, self.sigma_m = (deflection, body, wheel), sigma_m
        self._tracks: tuple[str, ...] = ()
        self._lag = 1

    def open(self, header: Header) -> Header:
        """Ask for the three channels, in time."""
        self._tracks = header.tracks
        for name in self.names:
            header.require(self.name, *(ChannelId(name, track) for track in header.tracks))
        step_s = header.step if header.axis is Axis.TIME else LAG_S
        self._lag = max(1, round(LAG_S / step_s))
        nothing = np.full((2, 2 * self._lag), np.nan)
        self.memory = {track: (nothing, Sums()) for track in self._tracks}
        return header

    def advance(self, block: Block) -> Block:
        """Add the bends within the block to the sums."""
        for track in self._tracks:
            past, sums = self.memory[track]
            wide = np.concatenate([past, self._sides(block, track)], axis=1)
            middle = wide[:, self._lag : -self._lag]
            measured, expected = wide[:, 2 * self._lag :] - 2.0 * middle + wide[:, : -2 * self._lag]
            known = np.isfinite(measured + expected)
            last = wide[:, wide.shape[1] - 2 * self._lag :].copy()
            self.memory[track] = last, sums.add(expected[known], measured[known])
        return block

    def warnings(self) -> tuple[str, ...]:
        """Return a warning for every wheel path whose sensors do not agree."""
        lines = (self._warn(track, sums) for track, (_, sums) in self.memory.items())
        return tuple(line for line in lines if line)

    def _sides(self, block: Block, track: str) -> FloatArray:
        """Return deflection, and body minus wheel, shape (2, n); NaN where one is flagged."""
        deflection, body, wheel = (ChannelId(name, track) for name in self.names)
        sides = np.stack([block[deflection], block[body] - block[wheel]])
        marks = flags_of(block, deflection, body, wheel)
        return sides if marks is None else np.where(marks != 0, np.nan, sides)

    def _warn(self, track: str, sums: Sums) -> str:
        loud = (LOUD * self.sigma_m) ** 2 * sums.bends
        if sums.bends < FEWEST or sums.xx == 0.0 or sums.yy < loud:
            return ""
        r, slope = sums.xy / np.sqrt(sums.xx * sums.yy), sums.xy / sums.xx
        if r >= LEAST_R and LEAST_SLOPE <= slope <= MOST_SLOPE:
            return ""
        return (
            f"track {track}: {self.names[0]} follows the heights of body and wheel by "
            f"{slope:.2g} with a correlation of {r:.2f}, expected 1 and 1; check which sensor is "
            "on the wheel, signs, units and clocks: the profile may be wrong throughout"
        )
