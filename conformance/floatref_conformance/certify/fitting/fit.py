"""Scale of distance and of heights of a run against the reference, from the section alone."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from floatref.measures.locating.finding import find_forward, pieces_of
from floatref.measures.locating.lags import Line, follow_line
from floatref.measures.locating.slopes import slope_of
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.certify.fitting.estimates import Estimate, estimate
from floatref_conformance.certify.fitting.long_waves import LongWaves, examine_long_waves
from floatref_conformance.certify.fitting.spectra import Surface, Windows, windows_of
from floatref_conformance.certify.fitting.symmetric import Bands, bands_of

WINDOW_M, LONG_WINDOW_M = 12.8, 38.4
LONGEST_M, SHORTEST_M = 6.5, 0.4
"""Waves by which gain and lag are estimated: above, the filters of profilers; below, footprints."""
LONG_WAVES_M, BODY_WAVES_M = (25.0, 8.0), (25.0, 4.0)
"""Waves that two lines on a road share, and those in which the body moves."""
POINTS_PER_WAVE = 5
"""Of the coarser profile in the shortest wave that counts."""
LEAST_WINDOWS, LEAST_LONG_WINDOWS, LEAST_WAVES = 6, 4, 4
ROUGHLY_M, ROUNDS = 1.6, 4
"""Shortest wave of the first round, and how many there are."""
STEEPEST = 0.4
"""Waves in which a footprint takes away more, as a logarithm, are left out."""
FARTHEST = 0.07
"""A run that lies farther off than this share of the section, and 2 m, does not lie on it."""


@dataclass(frozen=True, eq=False)
class Fit:
    """How a wheel path of a run lies on the reference; NaN where that is unknown.

    Attributes:
        distance_percent, distance_sigma: how much longer the run takes the section, and 1-sigma.
        height_percent, height_sigma: how much higher it takes the road, and 1-sigma.
        offset_m: how much farther along the beginning of the section lies.
        correlation: of slope in waves of 0.4 to 6.5 m once distance, offset and direction of
            heights are undone.
        inverted: whether heights are upside down.
        smoothing_m2, smoothing_sigma: c of a gain of about exp(c·k²) at wave number k in
            cycles per m, apart from the scale of heights, and 1-sigma.
        division, division_sigma: where what is not common lies: 1 in the run, -1 in the reference.
        long_percent, long_sigma: gain of waves of 8 to 25 m beyond the scale of heights.
        long_waves: how far waves of 4 to 25 m are off in height and place; None if unknown.
        at_m, lag_m: middles of the windows on the reference's axis, and how much farther along
            the run lies there; shape (windows,).
        line: the straight line of that lag; None if the run was not found.
    """

    distance_percent: float = math.nan
    distance_sigma: float = math.nan
    height_percent: float = math.nan
    height_sigma: float = math.nan
    offset_m: float = math.nan
    correlation: float = math.nan
    inverted: bool = False
    smoothing_m2: float = math.nan
    smoothing_sigma: float = math.nan
    division: float = math.nan
    division_sigma: float = math.nan
    long_percent: float = math.nan
    long_sigma: float = math.nan
    long_waves: LongWaves | None = None
    at_m: FloatArray = field(default_factory=lambda: np.zeros(0))
    lag_m: FloatArray = field(default_factory=lambda: np.zeros(0))
    line: Line | None = None

    @property
    def found(self) -> bool:
        """Whether the run could be laid on the reference."""
        return self.line is not None


def fit(reference: Profile, run: Profile, track: str) -> Fit:
    """Return how the wheel path ``track`` of ``run`` lies on ``reference``, both in m.

    Lag and gain come from windows of 12.8 m in waves of 0.4 to 6.5 m. A gain that is less for the
    shorter waves is that of a footprint or a filter; the scale of heights is what remains of it at
    the longest. 1-sigma is estimated by leaving out stretches of the section. Raises InputError
    where one of the two has no such track.
    """
    p = replace(reference, tracks=(reference.track(track),))
    q = replace(run, tracks=(run.track(track),))
    first = _first_line(p, q)
    if first is None:
        return Fit()
    line, sign = first
    pair = _Pair(
        Surface(p.tracks[0], p.start_m, p.interval_m),
        Surface(q.tracks[0], q.start_m, q.interval_m),
        (p.start_m, p.start_m + p.length_m),
        sign,
        max(SHORTEST_M, POINTS_PER_WAVE * max(p.interval_m, q.interval_m)),
    )
    return _fit_windows(pair, line)


@dataclass(frozen=True, eq=False)
class _Pair:
    """A wheel path of the reference and of the run, and the shortest wave that both contain."""

    reference: Surface
    run: Surface
    stretch_m: tuple[float, float]
    sign: float
    shortest_m: float

    def windows(self, line: Line, length_m: float, longest_m: float, shortest_m: float) -> Windows:
        """Return the windows of the run laid by ``line``, upright."""
        all_waves = windows_of(self.reference, self.run, line, self.stretch_m, length_m)
        chosen = all_waves.within(longest_m, shortest_m)
        return replace(chosen, run=self.sign * chosen.run)


def _first_line(reference: Profile, run: Profile) -> tuple[Line, float] | None:
    """Return where the run lies, to a few centimetres, and -1 for heights upside down."""
    pieces = pieces_of(reference)
    p = slope_of(reference.tracks[0], reference.start_m, reference.interval_m)
    q = slope_of(run.tracks[0], run.start_m, run.interval_m)
    if not pieces or p is None or q is None or q.energy() <= 0:
        return None
    found = find_forward(pieces, [q])
    if found is None or abs(found.run_m - found.at_m) > 2.0 + FARTHEST * reference.length_m:
        return None
    sign = math.copysign(1.0, found.score)
    return follow_line(p, q, Line(found.at_m, found.run_m, found.scale), sign), sign


def _fit_windows(pair: _Pair, line: Line) -> Fit:
    """Return the estimates from the windows, which correct ``line`` until it is stable."""
    last: tuple[Windows, Estimate] | None = None
    shortest = max(ROUGHLY_M, pair.shortest_m)
    for _ in range(ROUNDS):
        windows = pair.windows(line, WINDOW_M, LONGEST_M, shortest)
        if windows.at_m.size < LEAST_WINDOWS or windows.wave_number.size < LEAST_WAVES:
            return Fit(line=line, inverted=pair.sign < 0)
        fitted = estimate(windows)
        line = _correct_lag(line, fitted)
        last = windows, fitted
        footprint = abs(fitted.gain.smoothing_m2)
        shortest = max(pair.shortest_m, math.sqrt(footprint / STEEPEST))
    assert last is not None
    windows, fitted = last
    return _summarise(pair, line, windows, fitted)


def _summarise(pair: _Pair, line: Line, windows: Windows, fitted: Estimate) -> Fit:
    """Return the fit of the last round, and what the long waves add to it."""
    long, body = _long_waves(pair, line)
    gain = fitted.gain if long is None else fitted.gain.with_noise(long, fitted.incoherent)
    height = math.exp(gain.log_height)
    beyond = None if long is None else examine_long_waves(long, gain)
    return Fit(
        distance_percent=100.0 * (line.scale - 1.0),
        distance_sigma=100.0 * fitted.slope_sigma,
        height_percent=100.0 * (height - 1.0),
        height_sigma=100.0 * height * gain.log_sigma,
        offset_m=line.lag_at(pair.stretch_m[0]),
        correlation=fitted.correlation,
        inverted=pair.sign < 0,
        smoothing_m2=gain.smoothing_m2,
        smoothing_sigma=gain.smoothing_sigma,
        division=fitted.division,
        division_sigma=fitted.division_sigma,
        long_percent=math.nan if beyond is None else beyond.gain_percent,
        long_sigma=math.nan if beyond is None else beyond.gain_sigma,
        long_waves=None if body is None else examine_long_waves(body, gain),
        at_m=windows.at_m,
        lag_m=line.run_at(windows.at_m) - windows.at_m + fitted.lags_m,
        line=line,
    )


def _correct_lag(line: Line, fitted: Estimate) -> Line:
    """Return ``line`` plus the straight line of the remaining lag."""
    shift = fitted.shift_m + fitted.slope * (line.at_m - fitted.middle_m)
    return Line(line.at_m, line.run_m + shift, line.scale + fitted.slope)


def _long_waves(pair: _Pair, line: Line) -> tuple[Bands | None, Bands | None]:
    """Return the bands of `LONG_WAVES_M` and of `BODY_WAVES_M`; None on a short section."""
    windows = pair.windows(line, LONG_WINDOW_M, *BODY_WAVES_M)
    if windows.at_m.size < LEAST_LONG_WINDOWS:
        return None, None
    equal = np.ones(windows.at_m.size)
    return bands_of(windows.within(*LONG_WAVES_M), equal), bands_of(windows, equal)
