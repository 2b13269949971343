"""The vehicle's motion cancels in the observer under any cut-off, in the cascade it does not."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import floatref
from floatref.measures import high_pass

G, TOP, INTERVAL_M = 9.80665, 20.0, 0.025
BUMP_M, BUMP_LENGTH_M, BUMP_AT_M = 0.02, 3.0, 150.0
"""A raised cosine some 360 m ahead of the stop, where no filter remembers it."""
MATCHED = "temporal-matched-hpf"
CASCADES = "temporal-adaptive-hpf", "temporal-adaptive-hpf-spatial-backward"
drives = given(
    bounce_m=st.floats(0.0, 0.05),
    bounce_hz=st.floats(0.8, 3.0),
    dive_m=st.floats(0.02, 0.03),
    braking=st.floats(1.0, 5.0),
    dwell_s=st.floats(2.0, 8.0),
    rate_hz=st.sampled_from([4000.0, 16_000.0]),
)
few = settings(deadline=None, max_examples=8)


def travelled(times, legs):
    """Distance, and the time at which every leg begins, of legs (seconds, from and to in m/s)."""
    distance, begins = np.zeros(times.size), [0.0]
    for seconds, first, last in legs:
        u = np.clip((times - begins[-1]) / seconds, 0.0, 1.0)
        area = u**2 / 2.0 - np.sin(np.pi * u) ** 2 / (2.0 * np.pi**2)
        distance += seconds * (first * u + (last - first) * area)
        begins.append(begins[-1] + seconds)
    return np.maximum.accumulate(distance), begins


def swelling(times, begin, seconds, hertz=0.0):
    """A cosine that swells and ebbs as sin⁴ of half a turn, and its second derivative."""
    u = np.clip(times - begin, 0.0, seconds)
    parts = [
        (weight / 16.0, 2.0 * np.pi * (hertz + k / seconds))
        for k, weight in zip(range(-2, 3), (1.0, -4.0, 6.0, -4.0, 1.0), strict=True)
    ]
    motion = sum(a * np.cos(w * u) for a, w in parts)
    acceleration = -sum(a * w**2 * np.cos(w * u) for a, w in parts)
    outside = (u <= 0.0) | (u >= seconds)
    return np.where(outside, 0.0, motion), np.where(outside, 0.0, acceleration)


class Drive:
    """From rest to 20 m/s, to a stop and on, over a flat road: bounce, and a dive in the brake."""

    def __init__(self, rate_hz, bounce_m, bounce_hz, dive_m, braking, dwell_s):
        brake_s = TOP / braking
        legs = [(1.0, 0.0, 0.0), (8.0, 0.0, TOP), (20.0, TOP, TOP), (brake_s, TOP, 0.0)]
        legs += [(dwell_s, 0.0, 0.0), (8.0, 0.0, TOP), (10.0, TOP, TOP)]
        total = sum(leg[0] for leg in legs)
        self.rate_hz = rate_hz
        times = np.arange(int(total * rate_hz)) / rate_hz
        self.distance, begins = travelled(times, legs)
        bounce = swelling(times, 1.0, total - 2.0, bounce_hz)
        dive = swelling(times, begins[3], brake_s + 0.5)
        self.motion, self.acceleration = (
            bounce_m * b - dive_m * d for b, d in zip(bounce, dive, strict=True)
        )

    def elevations(self, *pipelines, road=0.0):
        clock = floatref.UniformClock.of(self.rate_hz)
        channels = (
            floatref.Channel.of("vertical_specific_force", G + self.acceleration, clock),
            floatref.Channel.of("height", 0.3 + self.motion - road, clock),
            floatref.Channel.of("distance", self.distance, clock),
        )
        recording = floatref.Recording(channels, floatref.Setup(profile_interval_m=INTERVAL_M))
        profiles = [floatref.process(recording, name) for name in pipelines]
        return profiles[0].distance_m, *(x.tracks[0].elevation for x in profiles)


def largest(elevation):
    return np.abs(elevation).max()


def integral(x, rate_hz):
    return np.concatenate(([0.0], np.cumsum(x[1:] + x[:-1]))) / (2.0 * rate_hz)


def bump(distance):
    u = (distance - BUMP_AT_M) / BUMP_LENGTH_M
    return np.where(np.abs(u) < 0.5, BUMP_M * np.cos(np.pi * u) ** 2, 0.0)


@pytest.mark.slow
@few
@drives
def test_the_observer_cancels_motion_where_the_cascade_does_not(**drawn):
    drive = Drive(**drawn)
    speed = np.gradient(drive.distance, 1.0 / drive.rate_hz)
    swept = floatref.AdaptiveCutOff().frequency(speed)
    assert swept.min() < 0.05
    assert swept.max() > 0.44
    _, matched, *cascades = drive.elevations(MATCHED, *CASCADES)
    assert largest(matched) <= 1e-6
    for cascade in cascades:
        assert largest(cascade) >= 1e-3


def test_what_the_observer_leaves_is_the_error_of_the_trapezoidal_rule():
    left = {}
    for rate_hz in (1000.0, 4000.0):
        drive = Drive(rate_hz, 0.05, 2.0, 0.025, 4.0, 4.0)
        left[rate_hz] = largest(drive.elevations(MATCHED)[1])
    assert left[1000.0] / left[4000.0] == pytest.approx(16.0, rel=0.05)


@pytest.mark.slow
@few
@drives
def test_motion_that_the_trapezoidal_rule_makes_cancels_exactly(**drawn):
    drive = Drive(**{**drawn, "rate_hz": 4000.0})
    drive.motion = integral(integral(drive.acceleration, 4000.0), 4000.0)
    _, matched, cascade = drive.elevations(MATCHED, CASCADES[0])
    assert largest(matched) <= 1e-11
    assert largest(cascade) >= 1e-3


@pytest.mark.slow
@few
@drives
def test_a_bump_away_from_the_stop_survives_in_all(**drawn):
    drive = Drive(**drawn)
    distance, *found = drive.elevations(MATCHED, *CASCADES, road=bump(drive.distance))
    expected = high_pass(bump(distance), INTERVAL_M).max()
    assert 0.9 * BUMP_M < expected < BUMP_M
    near = np.abs(distance - BUMP_AT_M) < BUMP_LENGTH_M
    for elevation, tolerance in zip(found, (1e-4, 0.01, 0.01), strict=True):
        assert elevation[near].max() == pytest.approx(expected, rel=tolerance)
