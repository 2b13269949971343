"""Noise is told as densities: what comes of it does not depend on the rate of the samples."""

from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanSmoother, Noise, Plan
from floatref.estimators.kalman.references import Stretch
from floatref.estimators.kalman.track import TrackFilter
from floatref.estimators.models.kalman_values import Inputs
from floatref.values.channels import ChannelId

laws = settings(deadline=None, max_examples=20)
SIGMA, REFERENCE = (ChannelId(n, "left") for n in ("elevation_sigma", "floating_reference_height"))
STILL = Noise(**{field.name: 0.0 for field in fields(Noise)})
NONE = np.empty(0, np.int64), np.empty((0, 5)), np.empty(0, np.int64)
DENSITY = st.floats(1e-3, 10.0)


def spread(noise, rate, seconds=0.4):
    """Return the covariance of a vehicle at rest on level ground before anything is observed."""
    count = round(seconds * rate) + 1
    track = TrackFilter.of(Plan(), noise, 1.0 / rate, (0.0, 0.0, 0.0), 0.0)
    track.state.p[:] = 0.0
    moving, there = np.zeros(count, np.bool_), np.ones(count, np.bool_)
    zero = np.zeros(count)
    zero.flags.writeable = False
    track.advance(Inputs(0, *[zero] * 6), Stretch(0, moving, np.zeros(count), there, *NONE))
    return track.state.p


@laws
@given(
    rate=st.sampled_from([500, 1000, 4000, 16_000]),
    white=st.tuples(DENSITY, DENSITY, DENSITY),
    walk=st.tuples(DENSITY, DENSITY, DENSITY),
)
def test_variances_grow_as_those_of_continuous_noise(rate, white, walk):
    """White noise of density S integrates to S² t, to S² t³ / 3; a walk adds its own integrals.

    The sums of n steps differ from integrals by 5 / 2n at most.
    """
    names = ("acceleration", "roll_rate", "pitch_rate")
    densities = dict(zip(names, white, strict=True)) | {
        f"{name}_walk": size for name, size in zip(names, walk, strict=True)
    }
    t, near = 0.4, 3.0 / (0.4 * rate)
    p = spread(replace(STILL, **densities), rate, t)
    (a, roll, pitch), (a_walk, roll_walk, pitch_walk) = np.square(white), np.square(walk)
    expected = [
        a * t + a_walk * t**3 / 3,
        pitch * t + pitch_walk * t**3 / 3,
        roll * t + roll_walk * t**3 / 3,
        *(a_walk * t, roll_walk * t, pitch_walk * t),
    ]
    np.testing.assert_allclose(np.diag(p)[1:7], expected, rtol=near)
    assert p[0, 0] == pytest.approx(a * t**3 / 3 + a_walk * t**5 / 20, rel=near)
    shared = np.array([a_walk, roll_walk, pitch_walk]) * t**2 / 2
    np.testing.assert_allclose([p[1, 4], p[3, 5], p[2, 6]], shared, rtol=near)


def coarser(drive, times):
    """Return what the same drive is at a rate ``times`` lower: inputs are means over a step."""
    weights = np.concatenate(([0.5], np.ones(times - 1), [0.5])) / times
    around = np.pad(drive.u, ((times // 2, times // 2), (0, 0)), mode="edge")
    means = np.array([np.convolve(column, weights, "valid") for column in around.T]).T
    return replace(
        drive,
        rate=drive.rate // times,
        u=means[::times],
        x=drive.x[::times],
        speed=drive.speed[::times],
        height=drive.height[::times],
        at=drive.at // times,
    )


@pytest.mark.parametrize(
    "plan", [Plan(), Plan(attitude=False), Plan(gnss=False, attitude=False)], ids=str
)
def test_a_drive_at_two_and_eight_kilohertz_has_one_result(drive, through, plan):
    """Braking, a stop and an outage of GNSS are in it; so are all errors of the sensors."""
    fine = drive(4, 10.0, 8000, (5.0, 7.0)).without(slice(120, 140))
    fine = replace(fine, at=fine.at // 4 * 4)
    results = [through(KalmanSmoother(plan, Noise()), d) for d in (fine, coarser(fine, 4))]
    moved = results[0][REFERENCE][::4] - results[1][REFERENCE]
    assert np.abs(moved).max() < 1e-4
    np.testing.assert_allclose(results[0][SIGMA][::4], results[1][SIGMA], rtol=0.002)


def test_variances_are_squares_and_those_of_constants_are_of_their_interval():
    noise = Noise(
        acceleration=1.0, roll_rate=2.0, pitch_rate=3.0, yaw_rate=4.0, acceleration_walk=5.0,
        roll_rate_walk=6.0, pitch_rate_walk=7.0, gnss_height_m=1.0, gnss_velocity_mps=2.0,
        gnss_pitch_rad=3.0, gnss_roll_rad=4.0, constant_height=1.0, constant_velocity=2.0,
        constant_pitch=3.0, constant_roll=4.0,
    )  # fmt: skip
    np.testing.assert_array_equal(noise.process(), [1.0, 4.0, 9.0, 16.0, 25.0, 36.0, 49.0])
    np.testing.assert_array_equal(noise.readings(), [1.0, 4.0, 9.0, 16.0])
    np.testing.assert_array_equal(noise.constants(0.25), [4.0, 16.0, 36.0, 64.0])
