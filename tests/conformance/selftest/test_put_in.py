"""Errors that are put in are as large as they are said to be, by plain arithmetic."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import iri_trace
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.selftest import put_in

INTERVAL, START, END = 0.05, 150.0, 310.0
X = INTERVAL * np.arange(round(400.0 / INTERVAL))


@pytest.fixture(scope="module")
def road():
    slopes = np.random.default_rng(0).normal(0.0, 1e-3, X.size)
    return Profile(INTERVAL, (ProfileTrack.of("left", np.cumsum(slopes) * INTERVAL**0.5),))


def elevation(profile):
    return profile.tracks[0].elevation


def counted(profile):
    inside = (X[:-1] >= START) & (X[:-1] <= END)
    return iri_trace(elevation(profile), INTERVAL)[inside]


@settings(deadline=None, max_examples=10)
@given(loss=st.floats(0.005, 0.5))
def test_another_road_takes_just_so_much_of_the_correlation(road, loss):
    true, found = counted(road), counted(put_in.mix_in_road(loss, START, END)(road, None, ""))
    assert np.corrcoef(true, found)[0, 1] == pytest.approx(1.0 - loss, abs=0.02 * loss)
    assert np.std(found) == pytest.approx(np.std(true), rel=1e-3)


def test_another_road_lies_under_the_stretch_alone(road):
    found = put_in.mix_in_road(0.1, START, END)(road, None, "")
    away = (START - put_in.RUN_UP_M - put_in.RAMP_M > X) | (END + put_in.RAMP_M < X)
    assert np.array_equal(elevation(found)[away], elevation(road)[away])


@settings(deadline=None, max_examples=10)
@given(more=st.floats(0.01, 2.0))
def test_a_road_becomes_rougher_by_just_so_much(road, more):
    found = put_in.make_rougher(more, START, END)(road, None, "")
    assert np.abs(counted(found)).mean() - np.abs(counted(road)).mean() == pytest.approx(more)


@pytest.mark.parametrize("more", [0.3, 2.0])
def test_a_local_error_is_as_large_over_its_base_and_small_elsewhere(road, more):
    found = put_in.change_locally(more, 200.0, 7.62)(road, None, "")
    change = np.abs(iri_trace(elevation(found), INTERVAL) - iri_trace(elevation(road), INTERVAL))
    means = np.convolve(change, np.full(152, 1 / 152), mode="valid")
    assert means.max() == pytest.approx(more, rel=1e-6)
    assert change[X[:-1] < 194.7].max() == 0.0


@pytest.mark.parametrize("length", [-0.4, 0.25])
def test_features_are_moved(road, length):
    found = elevation(put_in.move_features(length)(road, None, ""))
    steps = round(length / INTERVAL)
    inner = slice(100, -100)
    assert np.allclose(found[inner], np.roll(elevation(road), steps)[inner], atol=1e-12)


def test_flags_take_nothing_else(road):
    for spoil, length in ((put_in.flag_points(100.0, 130.0), 30.0), (put_in.flag_end(71.0), 71.0)):
        found = spoil(road, None, "").tracks[0]
        assert INTERVAL * np.sum(~found.valid) == pytest.approx(length, abs=INTERVAL)
        assert np.array_equal(found.elevation, elevation(road))


def test_some_recordings_of_a_case_are_spared(road):
    spoil = put_in.limit_to_labels(put_in.make_higher(0.5), "second")
    assert spoil(road, None, "first") is road
    assert np.allclose(elevation(spoil(road, None, "second")), 1.5 * elevation(road))


def test_errors_follow_one_another(road):
    found = put_in.chain(put_in.make_higher(1.0), put_in.add_shape(np.ones_like))(road, None, "")
    assert np.allclose(elevation(found), 2.0 * elevation(road) + 1.0)


def test_a_bump_has_its_height_and_ends():
    x = np.array([-1.6, -1.5, -0.75, 0.0, 0.75, 1.5, 1.6])
    assert np.allclose(put_in.raised_cosine(x, 3.0), [0, 0, 0.5, 1, 0.5, 0, 0], atol=1e-12)
