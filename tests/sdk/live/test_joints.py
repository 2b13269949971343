"""Joints: nothing is lost, nothing repeated, and no step arises."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.live.joints import Joints, WindowPoints, smooth_step
from floatref.live.points import join_points
from floatref.measures import iri
from floatref.values.profile import ProfileTrack

STEP_M, FADE_M = 0.05, 52.955
FADE = round(FADE_M / STEP_M)


def window(first, elevation, valid=None, sigma=None):
    return WindowPoints(first, (ProfileTrack.of("main", elevation, valid, sigma),))


def joined(windows, joints, fade=FADE, **about):
    """Return what is given out for ``windows``, each with its joint."""
    made = Joints(("main",), STEP_M, fade)
    found = [made.add(w, joint, **about) for w, joint in zip(windows, joints, strict=True)]
    return [points for points in found if points is not None]


@pytest.mark.slow
@given(st.lists(st.integers(1, 4000), min_size=1, max_size=6), st.integers(0, 3000))
def test_windows_that_agree_give_back_what_they_measured(cores, fade):
    total = sum(cores) + 3000
    road = np.random.default_rng(1).standard_normal(total)
    places = np.cumsum([0, *cores])
    windows, joints = [], []
    for n, begin in enumerate(places):
        low = max(0, begin - 500)
        last = n == len(places) - 1
        high = total if last else min(total, places[n + 1] + fade)
        windows.append(window(low, road[low:high]))
        joints.append(None if last else int(places[n + 1]))
    profile = join_points(joined(windows, joints, fade))
    np.testing.assert_array_equal(profile["main"].elevation, road)


@given(
    st.floats(-5e-3, 5e-3),
    st.floats(-1e-4, 1e-4),
    st.integers(3000, 9000),
    st.floats(0.0, 2 * np.pi),
)
def test_a_joint_adds_no_more_roughness_than_what_it_joins_differs_by(step_m, slope, joint, phase):
    # What the windows differ by: a level, a slope and a wave as long as the cut-off wavelength.
    at = STEP_M * (np.arange(14_000) - joint)
    difference = step_m + slope * at + abs(step_m) * np.sin(2 * np.pi * at / 105.91 + phase)
    one, two = np.zeros(at.size), difference
    end = joint + FADE + 2000
    profile = join_points(joined([window(0, one[:end]), window(0, two)], [joint, None]))
    made = profile["main"].elevation
    inside = slice(joint, joint + FADE)
    # By the product rule, from the largest slope and curvature of the weight over the length L.
    most = np.abs(difference[inside]).max()
    slopes = np.abs(np.diff(difference[inside.start - 1 : inside.stop + 1])).max() / STEP_M
    curvature = np.abs(np.diff(difference, 2)).max() / STEP_M**2
    steepest = 1.875 / FADE_M * most + slopes
    assert np.abs(np.diff(made[inside])).max() / STEP_M <= steepest * (1 + 1e-6)
    # No kink, at the ends of the fade either.
    sharpest = 5.7735 / FADE_M**2 * most + 2.0 * 1.875 / FADE_M * slopes + curvature
    assert np.abs(np.diff(made, 2)).max() / STEP_M**2 <= sharpest * (1 + 1e-3) + 1e-12


@pytest.mark.parametrize("sigma_m", [1e-4, 1e-3])
def test_the_roughness_of_a_joint_follows_from_the_sigma(sigma_m):
    # Two windows a whole 1-sigma apart, level: the worst 7.62 m of the fade.
    joint = 6000
    end = joint + FADE + 2000
    flat = np.zeros(end)
    profile = join_points(joined([window(0, flat), window(0, flat + sigma_m)], [joint, None]))
    made = profile["main"].elevation
    piece = round(7.62 / STEP_M)
    own = [
        iri(made[k : k + 2 * piece], STEP_M) for k in range(joint - piece, joint + FADE, piece // 4)
    ]
    # The car answers a slope of such a length with no more than the slope: 1.875 sigma / L.
    assert max(own) <= 1000.0 * 1.875 * sigma_m / FADE_M


def test_points_that_one_window_lacks_come_from_the_other():
    one, two = np.zeros(1000), np.ones(1000)
    two[:350] = np.nan
    made = join_points(joined([window(0, one), window(0, two)], [300, None], fade=100))["main"]
    np.testing.assert_array_equal(made.elevation[:350], 0.0)
    assert (np.diff(made.elevation[350:400]) > 0).all()
    np.testing.assert_array_equal(made.elevation[400:], 1.0)


def test_a_joined_point_is_valid_if_it_is_in_both_windows():
    valid = np.ones(1000, np.bool_)
    valid[320:330] = False
    windows = [window(0, np.zeros(1000), valid, np.ones(1000)), window(0, np.zeros(1000))]
    made = join_points(joined(windows, [300, None], fade=100))["main"]
    assert np.flatnonzero(~made.valid).tolist() == list(range(320, 330))


def test_a_refused_window_leaves_missing_points_up_to_its_joint():
    windows = [window(0, np.zeros(500)), WindowPoints(0, ()), window(600, np.ones(500))]
    made = join_points(joined(windows, [300, 700, None], fade=100))["main"]
    assert np.isnan(made.elevation[400:700]).all()
    assert not made.valid[400:700].any()
    np.testing.assert_array_equal(made.elevation[300:400], 0.0)
    np.testing.assert_array_equal(made.elevation[700:], 1.0)


def test_a_gap_behind_a_standstill_is_missing():
    made = join_points(joined([window(0, np.zeros(10)), window(15, np.ones(10))], [None, None]))
    assert np.flatnonzero(np.isnan(made["main"].elevation)).tolist() == [10, 11, 12, 13, 14]


def test_the_weight_goes_from_zero_to_one_without_a_kink():
    u = np.linspace(-0.5, 1.5, 4001)
    w = smooth_step(u)
    assert (w[u <= 0.0] == 0.0).all()
    assert (w[u >= 1.0] == 1.0).all()
    assert np.abs(np.diff(w)).max() / (u[1] - u[0]) == pytest.approx(1.875, rel=1e-3)
    assert np.abs(np.diff(w, 2)).max() / (u[1] - u[0]) ** 2 == pytest.approx(5.7735, rel=1e-2)
