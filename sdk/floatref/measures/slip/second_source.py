"""Slip and rolling radius of the encoder's wheel, from a second source that does not slip."""

from dataclasses import dataclass

import numpy as np

from floatref.measures.slip.encoder_motion import SMOOTHED_S, STEP_S, Motion, derivatives
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.encoder.plausible_distance import FASTEST_MPS
from floatref.values.recording import Channel, Recording

SOURCES = "optical_distance", "gnss_speed"
"""Channels that do not slip, the better one first."""
MOVING_MPS = 0.5
"""Below it the noise of a horizontal speed is no longer without bias."""
CERTAIN = 3.0
"""Standard deviations of a slip that is believed."""
FEWEST = 100
CORRELATED = 2.0 * SMOOTHED_S / STEP_S
"""Neighbours that smoothing makes alike, by which there are fewer readings than samples."""
PASSES = 3
"""A slip changes the speed that it acts on by some percent, so an error falls so fast by a pass."""
FAST_MPS = 20.0
"""Speed in m/s at which encoders are calibrated, 72 km/h."""


@dataclass(frozen=True)
class Wheel:
    """How the encoder's wheel differs from the road.

    It counts ẋ (1 + scale + slip·a/g + growth·((v/20)² - 1)).

    Attributes:
        source: what showed it.
        slip_per_g: relative, per g of longitudinal acceleration.
        slip_sigma_per_g: its standard deviation.
        growth: relative, from rest to 20 m/s, the usual speed of a calibration.
        scale: relative; 0 where the source has a scale error of its own.
    """

    source: str
    slip_per_g: float
    slip_sigma_per_g: float
    growth: float = 0.0
    scale: float = 0.0

    def on_road(self, motion: Motion) -> Motion:
        """Return the vehicle's motion from that of the encoder."""
        found = motion
        for _ in range(PASSES):
            found = motion.less(self.counted_too_much(found))
        return found

    def counted_too_much(self, motion: Motion) -> FloatArray:
        """Return by how much the encoder is ahead of the road since its start, in m, shape (n,).

        ``motion`` is that of the vehicle.
        """
        v = motion.speed
        if not v.size:
            return v
        rate = (self.scale + self.growth * ((v / FAST_MPS) ** 2 - 1.0)) * v
        grown = STEP_S * (np.cumsum(rate) - 0.5 * (rate + rate[0]))
        return np.asarray(self.slip_per_g * motion.gain_m() + grown)


def find_wheel(recording: Recording, distance: Channel, motion: Motion) -> Wheel | None:
    """Return what the best second source of ``recording`` shows; None if there is nothing certain.

    By least squares, v_encoder - v is what `Wheel` says and τ·a, τ the source's lateness. v and a
    are those of an optical wheel itself, which has no slip in it; a speed by GNSS is too noisy for
    that, and the encoder's motion without the slip found before takes their place, in `PASSES`.
    """
    for name in SOURCES:
        source = recording.find(name, distance.id.track)
        if source is not None and motion.speed.size:
            road = _road_by(name, source, motion.times_s)
            optical = name == "optical_distance"
            wheel = _compare(name, motion, road, road) if optical else _settle(name, motion, road)
            if wheel is not None:
                return wheel
    return None


def _settle(name: str, motion: Motion, source: Motion) -> Wheel | None:
    """Return what ``source`` shows after `PASSES`; None if it is not certain or does not settle.

    In one short brake v a and a are alike, so that slip and lateness can hardly be separated: what
    one has too little the other takes, and each pass goes farther from the truth.
    """
    found = [_compare(name, motion, source, motion)]
    for _ in range(PASSES):
        last = found[-1]
        found.append(last and _compare(name, motion, source, last.on_road(motion)))
    before, wheel = found[-2:]
    if wheel is None or before is None:
        return None
    is_steady = abs(wheel.slip_per_g - before.slip_per_g) <= wheel.slip_sigma_per_g
    return wheel if is_steady else None


def _compare(name: str, motion: Motion, source: Motion, road: Motion) -> Wheel | None:
    """Return how the encoder's ``motion`` differs from ``source``; ``road`` has v and a."""
    slips = _gain_rate(road)
    used = np.isfinite(slips) & np.isfinite(source.speed) & (motion.speed > MOVING_MPS)
    if used.sum() < FEWEST:
        return None
    v, a = road.speed[used], road.acceleration[used]
    columns = np.stack([v, slips[used], v * ((v / FAST_MPS) ** 2 - 1.0), a])
    own = columns if np.ptp(v) > 0.2 * v.mean() else columns[[0, 1, 3]]
    off = motion.speed[used] - source.speed[used]
    found, sigmas = _least_squares(own, off)
    slip, sigma = float(found[1]), float(sigmas[1])
    growth, unsure = (float(x[2]) if own.size == columns.size else 0.0 for x in (found, sigmas))
    if abs(slip) <= CERTAIN * sigma and abs(growth) <= CERTAIN * unsure:
        return None
    scale = float(found[0]) if name == "gnss_speed" else 0.0
    return Wheel(name, slip, sigma, growth, scale)


def _gain_rate(road: Motion) -> FloatArray:
    """Return v a / g in m/s, shape (n,), smoothed as a whole, as a speed of the encoder is.

    The mean of v² in a bell of σ is the square of the mean and σ² a².
    """
    squares = road.speed**2 + (SMOOTHED_S * road.acceleration) ** 2
    return np.gradient(0.5 * squares / STANDARD_GRAVITY, STEP_S)


def _least_squares(columns: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the coefficients of ``columns``, shape (m, n), in ``y``, and their 1-σ."""
    scale = np.sqrt((columns**2).sum(axis=1))
    scale = np.where(scale > 0.0, scale, 1.0)
    q = columns / scale[:, np.newaxis]
    inverse = np.linalg.pinv(q @ q.T)
    found = inverse @ (q @ y)
    rest = y - found @ q
    freedom = max(y.size / CORRELATED - columns.shape[0], 1.0)
    variance = float(rest @ rest) / freedom
    sigmas = np.sqrt(variance * np.diag(inverse))
    return np.asarray(found / scale), np.asarray(sigmas / scale)


def _road_by(name: str, source: Channel, times_s: FloatArray) -> Motion:
    """Return the motion by ``source`` at ``times_s``, smoothed as the encoder's, NaN if unknown."""
    # NaN is not less either; `check_origins` has refused a distance beyond.
    known = np.abs(source.values) <= (FASTEST_MPS if name == "gnss_speed" else np.inf)
    if known.sum() < 2:
        return Motion(times_s, *np.full((3, times_s.size), np.nan))
    times, values = source.times_s[known], source.values[known]
    if name == "gnss_speed":
        steps = np.diff(times, prepend=times[0])
        values = np.cumsum(np.append(0.0, 0.5 * (values[1:] + values[:-1])) * steps)
    there = np.interp(times_s, times, values)
    far = np.interp(times_s, 0.5 * (times[1:] + times[:-1]), np.diff(times)) > 1.0
    unknown = far | (times_s < times[0]) | (times_s > times[-1])
    slope, bend = (np.where(unknown, np.nan, each) for each in derivatives(there))
    return Motion(times_s, there, slope, bend)
