"""How each channel of a live run does: samples that came, missing ones, silence, a stuck sensor."""

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from floatref.live.session.messages import Piece
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.needs import HEIGHT, VERTICAL_FORCES

SILENT_S = 2.0
"""Time in s without a sample, by the clock of this machine, after which a channel is silent."""
RECENT_S = 1.0
"""Time in s after which a sample counts e⁻¹ as much in the share of missing ones."""
MOSTLY = 0.5
"""Share of missing samples above which a channel is missing."""
STUCK_S, STUCK = 1.0, 20
"""A sensor of motion is stuck if its samples have been identical for this time in s and this number
while the vehicle moves; every hold of a working laser is shorter."""
MOVES_MPS = 1.0
"""Speed in m/s above which the vehicle moves."""
MEASURE_MOTION = {
    *VERTICAL_FORCES,
    HEIGHT,
    "longitudinal_specific_force",
    "lateral_specific_force",
    "roll_rate",
    "pitch_rate",
    "yaw_rate",
}
"""Channels that change whenever the vehicle moves."""


class Health(StrEnum):
    """State of a channel, the worst one that holds."""

    WAITING = "waiting"
    """No sample has come."""
    SILENT = "silent"
    """No sample has come for `SILENT_S`."""
    MISSING = "missing"
    """Most samples of the last second are missing."""
    STUCK = "stuck"
    """Its samples do not change."""
    OK = "ok"
    """Samples come, and they change."""


@dataclass(frozen=True)
class SensorState:
    """What is known of a channel.

    Attributes:
        name: of the channel.
        health: its state.
        samples: that have come since the command was started, missing ones included.
        missing: of those, how many are missing.
        missing_share: share of them in the last second, 0 to 1.
        dropped: samples that were never sent.
        late: samples that came too late to count.
        silent_s: time in s since the last one came; NaN before the first.
        unchanged_s: time in s for which samples have been identical.
    """

    name: str
    health: Health
    samples: int
    missing: int
    missing_share: float
    dropped: int
    late: int
    silent_s: float
    unchanged_s: float


class SensorHealth:
    """Counts the samples of one channel; its memory does not grow."""

    def __init__(self, name: str, clock: UniformClock | None) -> None:
        """Begin without samples; ``clock`` is None where they have times."""
        self._name = name
        self._rate_hz = None if clock is None else float(clock.rate)
        self._samples = self._missing = self._dropped = 0
        self._recent = self._recent_missing = 0.0
        self._last_s: float | None = None
        self._came_s = math.nan
        self._value = math.nan
        self._alike, self._alike_s = 0, 0.0

    def drop(self, count: int) -> None:
        """Count ``count`` samples that were never sent."""
        self._dropped += count

    def read(self, piece: Piece, now_s: float) -> None:
        """Count the samples of ``piece``, which came at ``now_s`` by the clock of this machine."""
        count = piece.values.size
        if not count:
            return
        lasts_s = self._duration_s(piece)
        known = np.flatnonzero(~np.isnan(piece.values))
        weights = np.exp(np.arange(1 - count, 1) * (lasts_s / count / RECENT_S))
        kept, all_of_it = math.exp(-lasts_s / RECENT_S), float(weights.sum())
        self._recent = kept * self._recent + all_of_it
        missing = all_of_it - float(weights[known].sum()) if known.size < count else 0.0
        self._recent_missing = kept * self._recent_missing + missing
        self._samples += count
        self._missing += count - known.size
        self._came_s = now_s
        if known.size:
            self._compare(piece.values[known], lasts_s)

    def state(self, now_s: float, late: int, speed_mps: float | None) -> SensorState:
        """Return the state at ``now_s``, of a vehicle at this speed; None if it is not known."""
        silent_s = now_s - self._came_s
        share = self._recent_missing / self._recent if self._recent else 0.0
        moves = speed_mps is not None and speed_mps > MOVES_MPS
        return SensorState(
            self._name,
            self._health(silent_s, share, moves),
            self._samples,
            self._missing,
            share,
            self._dropped,
            late,
            silent_s,
            self._alike_s,
        )

    def _health(self, silent_s: float, share: float, moves: bool) -> Health:
        if not self._samples:
            return Health.WAITING
        if silent_s > SILENT_S:
            return Health.SILENT
        if share > MOSTLY:
            return Health.MISSING
        measures = self._name.rpartition(".")[2] in MEASURE_MOTION
        if measures and moves and self._alike >= STUCK and self._alike_s >= STUCK_S:
            return Health.STUCK
        return Health.OK

    def _duration_s(self, piece: Piece) -> float:
        """Return the time in s from the last sample before to the last one of ``piece``."""
        if piece.times_s is None:
            return piece.values.size / self._rate_hz if self._rate_hz else 0.0
        before_s, self._last_s = self._last_s, float(piece.times_s[-1])
        return max(self._last_s - (piece.times_s[0] if before_s is None else before_s), 0.0)

    def _compare(self, known: FloatArray, lasts_s: float) -> None:
        """Count the last samples of ``known`` that are identical, and for how long."""
        changes = np.flatnonzero(known != known[-1])
        alike = known.size - (int(changes[-1]) + 1 if changes.size else 0)
        if alike < known.size or known[-1] != self._value:
            self._alike, self._alike_s = alike, lasts_s * (alike - 1) / known.size
        else:
            self._alike, self._alike_s = self._alike + alike, self._alike_s + lasts_s
        self._value = float(known[-1])
