"""Slip and rolling radius of the encoder's wheel, from a second source that does not slip."""

from dataclasses import dataclass

import numpy as np

from floatref.measures.slip.encoder_motion import STEP_S, Motion, derivatives
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Channel, Recording

SOURCES = "optical_distance", "gnss_speed"
"""Channels that do not slip, the better one first."""
MOVING_MPS = 0.5
"""Below it the noise of a horizontal speed is no longer without bias."""
CERTAIN = 3.0
"""Standard deviations of a slip that is believed."""
FEWEST = 100
CORRELATED = 2.0 * 0.15 / STEP_S
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

    By least squares, v_encoder - v is what `Wheel` says and τ·a, τ the source's lateness. The
    ``motion`` is the encoder's own; slip and growth act on that of the vehicle, which is found in
    `PASSES`.
    """
    for name in SOURCES:
        source = recording.find(name, distance.id.track)
        if source is not None and motion.speed.size:
            wheel = _compare(name, source, motion, motion)
            for _ in range(PASSES if wheel is not None else 0):
                wheel = wheel and _compare(name, source, motion, wheel.on_road(motion))
            if wheel is not None:
                return wheel
    return None


def _compare(name: str, source: Channel, motion: Motion, road: Motion) -> Wheel | None:
    speed = _speed_of(name, source, motion.times_s)
    used = np.isfinite(speed) & (road.speed > MOVING_MPS)
    if used.sum() < FEWEST:
        return None
    v, a = road.speed[used], road.acceleration[used]
    columns = np.stack([v, v * a / STANDARD_GRAVITY, v * ((v / FAST_MPS) ** 2 - 1.0), a])
    own = columns if np.ptp(v) > 0.2 * v.mean() else columns[[0, 1, 3]]
    off = motion.speed[used] - speed[used]
    found, sigmas = _least_squares(own, off)
    slip, sigma = float(found[1]), float(sigmas[1])
    growth, unsure = (float(x[2]) if own.size == columns.size else 0.0 for x in (found, sigmas))
    if abs(slip) <= CERTAIN * sigma and abs(growth) <= CERTAIN * unsure:
        return None
    scale = float(found[0]) if name == "gnss_speed" else 0.0
    return Wheel(name, slip, sigma, growth, scale)


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


def _speed_of(name: str, source: Channel, times_s: FloatArray) -> FloatArray:
    """Return the source's speed at ``times_s``, smoothed as the encoder's, NaN where unknown."""
    known = ~np.isnan(source.values)
    if known.sum() < 2:
        return np.full(times_s.size, np.nan)
    times, values = source.times_s[known], source.values[known]
    if name == "gnss_speed":
        steps = np.diff(times, prepend=times[0])
        values = np.cumsum(np.append(0.0, 0.5 * (values[1:] + values[:-1])) * steps)
    there = np.interp(times_s, times, values)
    slope, _ = derivatives(there)
    gap = np.diff(times)
    far = np.interp(times_s, 0.5 * (times[1:] + times[:-1]), gap) > 1.0
    outside = (times_s < times[0]) | (times_s > times[-1])
    return np.where(far | outside, np.nan, slope)
