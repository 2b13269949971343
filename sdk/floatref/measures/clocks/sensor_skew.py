"""The skew of a height sensor against its accelerometer, from stretches where the body alone moves.

During the swing of a stationary vehicle and in a bounce test both sensors measure the same motion.
On a moving vehicle the road drives both, and the phase between them is the suspension's: such
stretches are not used, however coherent they are.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from floatref.measures.clocks.skew_series import RATE_HZ, STEP_S, find_standing, on_grid, stretches
from floatref.measures.clocks.skew_windows import LARGEST, SkewWindow, skew_window
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.recording import Channel

WINDOW_S = 1.5
"""Length of a window in s; a longer one has integrated noise, a shorter one no whole swing."""
STANDS_M, STANDS_S = 0.002, 0.75
"""Travel in m and time in s below which a vehicle is stationary; the least window in s."""
LEAST_COHERENCE, GAIN_OFF = 0.95, 0.05
"""Requirements on a window of a stationary vehicle."""
BOUNCE_COHERENCE, BOUNCE_OFF = 0.9999, 0.03
"""Requirements on a window where the vehicle moves by its distance, or has no distance."""
FEWEST_BOUNCES = 2
"""Least number of such windows in a row."""
LEAST_MOTION_M = 2e-5
AROUND = 2 * LARGEST
"""Points on either side of a stop that its windows may be moved by."""
SWINGS_S = 4.5
"""Length in s of three windows, after which hardly a body swings any more at a stop."""
SLOWEST_HZ, SHORTEST_S = 100.0, 2.0
LARGEST_SIGMA_S = 5e-4
"""Largest standard deviation of a skew that is reported, in s."""
WORTH_S, CERTAIN = 5e-4, 3.0
"""Skew in s, and in standard deviations, above which a warning is given."""


@dataclass(frozen=True)
class Skew:
    """By how much the height's samples are later than the accelerometer's, or why that is unknown.

    Attributes:
        skew_s: in s; NaN if it is unknown.
        sigma_s: its standard deviation in s; NaN if nothing was found.
        seconds: length of the stretches that it is estimated from, in s.
        coherence: of height and twice integrated acceleration in them.
        reason: one line that says why the skew is unknown; "" if it is known.
    """

    skew_s: float
    sigma_s: float = np.nan
    seconds: float = 0.0
    coherence: float = np.nan
    reason: str = ""

    @classmethod
    def none(cls, reason: str, sigma_s: float = np.nan) -> "Skew":
        """Return an unknown skew."""
        return cls(np.nan, sigma_s, reason=reason)

    @property
    def known(self) -> bool:
        """Whether there is an estimate."""
        return not self.reason


def sensor_skew(force: Channel, height: Channel, distance: Channel | None = None) -> Skew:
    """Return by how much ``height`` is later than the vertical ``force``, if it can be estimated.

    Windows of 1.5 s count where the vehicle is stationary by its ``distance``, or where height and
    acceleration agree as they do only in a bounce test. Channels may have any clocks above 100 Hz,
    and gaps; memory grows by 10 kB for each second.
    """
    slow = next((c for c in (force, height) if c.mean_rate_hz < SLOWEST_HZ), None)
    if slow is not None:
        return Skew.none(
            f"channel {slow.id} has {slow.mean_rate_hz:.4g} Hz; it takes {SLOWEST_HZ:g} Hz"
        )
    begin = max(force.span_s[0], height.span_s[0])
    end = min(force.span_s[1], height.span_s[1])
    if end - begin < SHORTEST_S:
        return Skew.none(f"channels {force.id} and {height.id} share less than {SHORTEST_S:g} s")
    grid: FloatArray = begin + STEP_S * np.arange(int((end - begin) * RATE_HZ) + 1.0)
    series = on_grid(force, grid), on_grid(height, grid)
    stands = np.zeros(grid.size, dtype=np.bool_)
    if distance is not None:
        stands = find_standing(distance, grid, STANDS_M, STANDS_S)
    return combine_stretches([*_at_stops(*series, stands), *_in_bounces(*series, stands)])


def skew_at_stops(force: Channel, height: Channel, distance: Channel) -> Skew:
    """Return `sensor_skew` from stops alone, of which the first `SWINGS_S` are read.

    It costs little where a drive has few stops. A bounce test is not looked for.
    """
    if min(force.mean_rate_hz, height.mean_rate_hz) < SLOWEST_HZ:
        return Skew.none(f"a sensor has less than {SLOWEST_HZ:g} Hz")
    start_s = max(force.span_s[0], height.span_s[0])
    seconds = min(force.span_s[1], height.span_s[1]) - start_s
    points_s = STEP_S * np.arange(max(0.0, int(seconds * RATE_HZ) + 1.0))
    grid: FloatArray = start_s + points_s
    found: list[Stretch] = []
    for first, last in stretches(find_standing(distance, grid, STANDS_M, STANDS_S)):
        last = min(last, first + round(SWINGS_S * RATE_HZ))
        begin, end = max(0, first - AROUND), min(grid.size, last + AROUND)
        stands = np.zeros(end - begin, dtype=np.bool_)
        stands[first - begin : last - begin] = True
        points = grid[begin:end]
        found += _at_stops(on_grid(force, points), on_grid(height, points), stands)
    return combine_stretches(found)


def is_certain(skew: Skew) -> bool:
    """Return whether a skew is known, above 0.5 ms and above three standard deviations."""
    size = abs(skew.skew_s)
    return skew.known and size > WORTH_S and size > CERTAIN * skew.sigma_s


def skew_warning(skew: Skew, force: Channel, height: Channel) -> str | None:
    """Return a warning with the remedy for a significant skew above 0.5 ms, else None."""
    if not is_certain(skew):
        return None
    size = abs(skew.skew_s)
    late, other = (height, force) if skew.skew_s > 0 else (force, height)
    return (
        f"channel {late.id}: {1e3 * size:.2f} ± {1e3 * skew.sigma_s:.2f} ms later than {other.id}, "
        f"by {skew.seconds:.3g} s in which the body alone moved; add {size:.5f} to its delay_s"
    )


@dataclass(frozen=True)
class Stretch:
    """Windows that follow one another, and the gain of the sensors in them."""

    windows: Sequence[SkewWindow]
    gain: float

    def skew(self) -> tuple[float, float]:
        """Return the skew of the stretch and its standard deviation, in s.

        Errors of successive windows are equal: averaging does not reduce them.
        """
        sigmas = np.array([w.sigma_s(self.gain) for w in self.windows])
        weights = 1.0 / np.square(sigmas)
        skews = np.array([w.skew_s for w in self.windows])
        skew = float(weights @ skews / weights.sum())
        spread = float(weights @ np.square(skews - skew) / weights.sum())
        return skew, float(np.hypot(weights @ sigmas / weights.sum(), spread**0.5))


def _at_stops(force: FloatArray, height: FloatArray, stands: BoolArray) -> list[Stretch]:
    """Return the usable stretches of a stationary vehicle."""
    found = []
    for first, end in stretches(stands):
        windows = _windows(force, height, first, end)
        kept = [w for w in windows if w is not None and _is_one(w, LEAST_COHERENCE, GAIN_OFF)]
        if kept:
            found.append(Stretch(kept, 1.0))
    return found


def _in_bounces(force: FloatArray, height: FloatArray, stands: BoolArray) -> list[Stretch]:
    """Return the stretches that agree as well as a bounce test alone does, wherever they are."""
    found = []
    for first, end in stretches(~stands):
        run: list[SkewWindow] = []
        for window in [*_windows(force, height, first, end), None]:
            if window is not None and _is_one(window, BOUNCE_COHERENCE, BOUNCE_OFF):
                run.append(window)
                continue
            if len(run) >= FEWEST_BOUNCES:
                found.append(Stretch(run, float(np.median([w.gain for w in run]))))
            run = []
    return found


def _windows(
    force: FloatArray, height: FloatArray, first: int, end: int
) -> Iterable[SkewWindow | None]:
    """Yield the results of equal windows of about `WINDOW_S` from ``first`` to ``end``."""
    many = max(1, round((end - first) * STEP_S / WINDOW_S))
    edges = np.linspace(first, end, many + 1).astype(int).tolist()
    for a, b in pairwise(edges):
        yield skew_window(force, height, a, b - a) if b - a >= STANDS_S * RATE_HZ else None


def _is_one(window: SkewWindow, coherence: float, off: float) -> bool:
    """Return whether both sensors measured one motion, and enough of it."""
    agrees = 1.0 - window.rest**2 >= coherence and abs(window.gain - 1.0) <= off
    return agrees and window.motion_m >= LEAST_MOTION_M


def combine_stretches(found: list[Stretch]) -> Skew:
    """Return the skew estimated from all stretches together, or the reason why it is open."""
    if not found:
        return Skew.none(
            "no moment in which the body alone moves: neither a stop after which it still swings "
            "nor a bounce test"
        )
    skews, sigmas = np.array([s.skew() for s in found]).T
    weights = 1.0 / np.square(sigmas)
    skew = float(weights @ skews / weights.sum())
    # Stretches that disagree are less certain than each alone suggests.
    excess = float(weights @ np.square(skews - skew)) / max(skews.size - 1, 1)
    sigma = float((max(1.0, excess) / weights.sum()) ** 0.5)
    windows = [w for s in found for w in s.windows]
    if sigma > LARGEST_SIGMA_S:
        return Skew.none(
            f"{WINDOW_S * len(windows):.3g} s in which the body alone moves give it to "
            f"{1e3 * sigma:.2g} ms only; a bounce test gives it to 0.05 ms",
            sigma,
        )
    power = np.array([w.motion_m**2 for w in windows])
    missed = float(power @ np.array([w.rest**2 for w in windows]) / power.sum())
    return Skew(skew, sigma, WINDOW_S * len(windows), 1.0 - missed)
