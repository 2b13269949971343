"""Samples of a height sensor, or one of the suspension's deflection, stuck or out of range."""

from dataclasses import dataclass

import numpy as np

from floatref.screening.damage.damaged_samples import (
    Damage,
    Runs,
    Usual,
    describe_damage,
    merge,
)
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel

SHORTEST = 3
PINNED_S = 0.002
PINNED = 5.0
"""Shortest stay of a laser out of its range, in s, and in usual holds."""
LEAP_M = 0.005
"""Smallest step in m with which it leaves its range or returns."""
STUCK_S = 0.05
STUCK = 20.0
"""Shortest run of identical samples of a stuck laser, in s, and in usual holds."""
LASTING_S = 1.0
"""Every hold of a working laser is shorter than this, in s."""
ALIVE = 0.1
"""Smallest spread of the accelerometer's readings meanwhile, in m/s²."""
TRAVEL_M = 0.5
"""Shortest distance in m that the vehicle travels meanwhile: at a standstill a working laser may
repeat itself, but not while the body heaves."""
HEAVE_M = 0.003
COARSE = 4.0
"""A coarse laser that works changes while the body heaves by the first, in m, and by the second, in
its smallest steps."""
HEAVE_S = 1.0
LOOKS = 8
"""The heave is computed from the acceleration over this time in s, at this number of places of a
long run."""
FEWEST = 8
"""Fewest samples for that."""
OWN = 0.01
"""A run with this share of all samples does not count as usual."""
AWAY = 1.5
"""A step above this number of smallest steps is a change of the reading."""


def find_stuck_height(channel: Channel, force: Channel, distance: Channel) -> Damage:
    """Return the stretches in which a height sensor is stuck or out of its range.

    It is stuck where it repeats itself while ``force`` beside it changes and ``distance`` grows, or
    for long while ``force`` shows that the body heaves. It is out of range where it repeats its
    smallest or largest value after a jump. If most of the run may be either stuck or a flat floor,
    there is only a warning.
    """
    rate = channel.mean_rate_hz
    runs = Runs.of(channel.values, max(SHORTEST, int(PINNED_S * rate)))
    if not runs.first.size:
        return Damage()
    found = _Repeated(channel, runs, Usual.of(channel.values))
    stuck, open_to_doubt = found.find_stuck(force, distance)
    chosen = stuck | found.out_of_range()
    warnings = []
    if chosen.any():
        warnings.append(describe_damage(channel, runs.spans[chosen], "stuck or out of range"))
    if 2 * runs.length[open_to_doubt & ~chosen].sum() > channel.values.size:
        warnings.append(
            f"channel {channel.id}: repeats itself for most of the run; if that was not over a "
            "flat floor, the sensor is stuck and the profile is that of the accelerometers alone"
        )
    return Damage(runs.spans[chosen], warnings=tuple(warnings))


@dataclass(frozen=True, eq=False)
class _Repeated:
    """Runs of identical samples of a height, and its usual runs."""

    channel: Channel
    runs: Runs
    usual: Usual

    def out_of_range(self) -> BoolArray:
        """Return which runs at the smallest or largest value begin or end with a jump."""
        extreme = np.isin(self.runs.value, self.channel.scan.extremes)
        pinned: BoolArray = extreme & (self.runs.length >= PINNED * self._beside())
        return pinned & (self._step() >= LEAP_M)

    def find_stuck(self, force: Channel, distance: Channel) -> tuple[BoolArray, BoolArray]:
        """Return which runs only a stuck sensor gives, and which a coarse one may give."""
        length, rate = self.runs.length, self.channel.mean_rate_hz
        shortest = max(STUCK_S * rate, min(STUCK * self.usual.hold, LASTING_S * rate))
        unusual = length >= STUCK * self._beside()
        quantum = self.usual.quantum if np.isfinite(self.usual.quantum) else 0.0
        doubtful = (self._step() > AWAY * quantum) | (length >= LASTING_S * rate)
        stuck = (length >= shortest) & (unusual | doubtful)
        heave_m, doubt = max(HEAVE_M, COARSE * quantum), np.zeros(length.size, np.bool_)
        for k in np.flatnonzero(stuck):
            begin, end = self.channel.clock.times(2, int(self.runs.first[k]), int(length[k] - 1))
            moves = travel(distance, begin, end) >= TRAVEL_M and _spread(force, begin, end) >= ALIVE
            heaves = _heave(force, begin, end) >= heave_m
            stands = bool(heaves) and length[k] >= LASTING_S * rate
            stuck[k], doubt[k] = (moves and (unusual[k] or heaves)) or stands, moves
        return stuck, doubt

    def _beside(self) -> FloatArray:
        """Return for each run the usual hold of all other samples."""
        usual = np.full(self.runs.length.size, self.usual.beside(0))
        for k in np.flatnonzero(self.runs.length > OWN * self.usual.samples):
            usual[k] = self.usual.beside(int(self.runs.length[k]))
        return usual

    def _step(self) -> FloatArray:
        """Return for each run the larger of the steps into it and out of it, 0 if unknown."""
        values, (first, behind) = self.channel.values, self.runs.spans.T
        last = values.size - 1
        steps = np.abs(
            [
                values[np.maximum(first - 1, 0)] - self.runs.value,
                values[np.minimum(behind, last)] - self.runs.value,
            ]
        )
        larger: FloatArray = np.fmax(np.fmax(*steps), 0.0)
        return larger


def travel(distance: Channel, begin_s: float, end_s: float) -> float:
    """Return the distance in m that the vehicle travels meanwhile; infinite if unknown."""
    low, high = _indices(distance, begin_s, end_s)
    values = distance.values[[max(low - 1, 0), min(high, distance.values.size - 1)]]
    travel = float(values[1] - values[0])
    return travel if np.isfinite(travel) else np.inf


def _spread(force: Channel, begin_s: float, end_s: float) -> float:
    """Return the spread of the accelerometer's samples in m/s²; NaN where one is missing."""
    values = force.values[slice(*_indices(force, begin_s, end_s))]
    return float(np.ptp(values)) if values.size else np.nan


def _heave(force: Channel, begin_s: float, end_s: float) -> float:
    """Return the largest heave of the body within a second, in m; 0 if unknown.

    That is the acceleration integrated twice, minus the parabola of bias and initial motion.
    """
    looks = int(np.clip((end_s - begin_s) / HEAVE_S, 1, LOOKS))
    heave = 0.0
    for middle in begin_s + (np.arange(looks) + 0.5) * (end_s - begin_s) / looks:
        low, high = _indices(force, middle - HEAVE_S / 2, middle + HEAVE_S / 2)
        values = force.values[low:high]
        if values.size < FEWEST or np.isnan(values).any():
            continue
        height = np.cumsum(np.cumsum(values - values.mean())) / force.mean_rate_hz**2
        place = np.linspace(-1.0, 1.0, values.size)
        parabola = np.polynomial.Polynomial.fit(place, height, 2)
        heave = max(heave, float(np.ptp(height - parabola(place))))
    return heave


def _indices(channel: Channel, begin_s: float, end_s: float) -> tuple[int, int]:
    """Return the index of the first sample from ``begin_s`` on, and up to ``end_s``."""
    clock = channel.clock
    if isinstance(clock, StampedClock):
        first, behind = np.searchsorted(clock.times_s, [begin_s, end_s])
    else:
        first, behind = np.ceil((np.array([begin_s, end_s]) - clock.start_s) * float(clock.rate))
    return max(int(first), 0), max(int(behind), 0)


SHORTEST_FORCE = 3
STUCK_FORCE_S = 0.02
"""Shortest run of identical samples in s of a stuck accelerometer on a moving vehicle, unless it is
coarse or slow and repeats samples all the time."""


def find_stuck_force(channel: Channel, distance: Channel) -> Damage:
    """Return the stretches in which an accelerometer repeats itself while ``distance`` grows.

    They last 20 ms, `STUCK` usual holds of its other samples, and 0.5 m. The samples after them are
    disturbed as by a gap, since acceleration is integrated.
    """
    shortest = max(SHORTEST_FORCE, int(STUCK_FORCE_S * channel.mean_rate_hz))
    runs = Runs.of(channel.values, shortest)
    if not runs.first.size:
        return Damage()
    usual = Usual.of(channel.values)
    unusual = [length >= STUCK * usual.beside(length) for length in runs.length.tolist()]
    spans = runs.spans[np.array(unusual, dtype=np.bool_)]
    spans = spans[np.array([_goes_on(channel, distance, *s) for s in spans.tolist()], np.bool_)]
    if not spans.size:
        return Damage()
    return Damage(spans, spans, warnings=(describe_damage(channel, spans, "stuck"),))


def combine_damage(first: Damage, second: Damage) -> Damage:
    """Return the damage of both."""
    return Damage(
        merge(np.concatenate([first.gone, second.gone])),
        merge(np.concatenate([first.lasting, second.lasting])),
        merge(np.concatenate([first.void, second.void])),
        (*first.warnings, *second.warnings),
    )


def _goes_on(channel: Channel, distance: Channel, first: int, behind: int) -> bool:
    begin, end = channel.clock.times(2, first)[0], channel.clock.times(1, behind - 1)[0]
    return travel(distance, float(begin), float(end)) >= TRAVEL_M
