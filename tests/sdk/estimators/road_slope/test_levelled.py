"""What is found of stretches is blended where they share their ends, and is held between."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.short_runs import at_speed

from floatref.estimators.laser_place import bins
from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.gauss_newton import Fit, fit
from floatref.estimators.road_slope.layout import GLOBALS
from floatref.estimators.road_slope.levelled import (
    LOST_REACH_M,
    RAMP_S,
    UNKNOWN_M,
    UNLIKELY,
    Levelled,
    _sigma,
    is_believed,
    known_gains,
)
from floatref.estimators.road_slope.readings import Drive
from floatref.estimators.road_slope.rows import Stretch
from floatref.estimators.road_slope.stretches import find_stretches

STEP, PLACES = 0.01, Places(4.0, 0.6, 0.0)


def drive_over_bumps(stops: int, seed: int = 0) -> Drive:
    """Return some brakes to a standstill from 8 m/s on a rough road; its body does not pitch."""
    fast, rng = 8.0, np.random.default_rng(seed)
    one = ((3.0, 0.0), (2.0, 0.0), (3.0, fast), (40.0, fast))
    corners = [(20.0, fast), *one * stops]
    times = np.cumsum([0.0, *(duration for duration, _ in corners)])
    t = np.arange(0.0, times[-1], STEP)
    speed = np.interp(t, times, [fast, *(v for _, v in corners)])
    noise = 1e-3 * rng.normal(size=(t.size, 2)).T
    distance, along = np.cumsum(speed) * STEP, np.gradient(speed, STEP)
    return Drive(noise[0], t < 0, 0.3 + 0.1 * noise[1], distance, speed, along, t < 0, STEP)


@pytest.mark.slow
def test_each_stop_is_levelled_for_itself() -> None:
    model = SlopeModel()
    both, alone = (drive_over_bumps(count) for count in (2, 1))
    two, one = (Levelled.of(drive, PLACES, model, 30.0) for drive in (both, alone))
    assert len(two.gains) == 2
    end = alone.force.size
    np.testing.assert_allclose(two.pitch[: end - 3000], one.pitch[: end - 3000], atol=1e-12)
    assert np.abs(two.pitch).max() < 1e-2
    assert set(np.unique(two.share > 0)) == {False, True}
    assert (two.sigma_m[two.share >= 1.0] > 0.0).all()
    assert not two.sigma_m[two.share == 0.0].any()


def test_its_share_comes_and_goes_within_a_second() -> None:
    found = Levelled.of(drive_over_bumps(1), PLACES, SlopeModel(), 30.0)
    rising = np.diff(found.share)
    assert np.abs(rising).max() <= 1.01 * STEP / RAMP_S
    assert found.share.max() == 1.0


@pytest.mark.slow
@given(begin=st.integers(0, 3000), count=st.integers(1, 40))
@settings(deadline=None, max_examples=5)
def test_a_stretch_without_the_encoder_is_left_and_unsure(begin: int, count: int) -> None:
    """Anywhere in it; elsewhere it changes nothing."""
    drive = drive_over_bumps(1)
    ((pieces),) = find_stretches(drive)
    inside = slice(pieces[0].start, pieces[-1].stop)
    lost = np.zeros(drive.force.size, np.bool_)
    lost[begin : begin + count] = True
    found = Levelled.of(drive._replace(lost=lost), PLACES, SlopeModel(), 30.0)
    if lost[inside].any():
        assert not found.share.any()
        place, sigma_m = drive.distance[inside][100:-100], found.sigma_m[inside][100:-100]
        near = np.abs(place - drive.distance[np.argmin(drive.speed)]) < LOST_REACH_M
        np.testing.assert_array_equal(sigma_m, np.where(near, UNKNOWN_M, 0.0))
    else:
        assert found.share.any()


@given(outside=st.floats(-1, 1), inside=st.floats(-1, 1))
def test_between_stretches_values_are_bent_to_meet_what_is_known(
    outside: float, inside: float
) -> None:
    share = np.array([0, 0, 1, 1, 0, 0, 1, 0.0])
    found = Levelled(share, *np.zeros((4, 8)), [])
    values = np.where(share > 0, inside, 99.0)
    held = found.hold(values, np.full(8, outside))
    np.testing.assert_allclose(held, np.full(8, inside), atol=1e-12)
    nothing = Levelled(np.zeros(8), *np.zeros((4, 8)), [])
    np.testing.assert_array_equal(nothing.hold(values, np.full(8, outside)), np.full(8, outside))


@given(
    share=st.lists(st.sampled_from([0.0, 0.0, 0.5, 1.0]), min_size=1, max_size=60),
    part=st.integers(1, 20),
    seed=st.integers(0, 2**32),
)
@settings(deadline=None)
def test_the_parts_of_a_run_change_no_bit_of_what_is_held(share, part, seed) -> None:
    values, outside = np.random.default_rng(seed).normal(size=(2, len(share)))
    known = np.flatnonzero(share)
    expected = outside
    if known.size:
        off = np.interp(np.arange(len(share)), known, values[known] - outside[known])
        expected = outside + off
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bins, "PART", part)
        held = Levelled(np.array(share), *np.zeros((4, len(share))), []).hold(values, outside)
    np.testing.assert_array_equal(held, expected)


@pytest.mark.parametrize("part", [1999, 64])
def test_the_parts_of_a_run_change_no_bit_of_what_is_found(part, monkeypatch) -> None:
    drive = drive_over_bumps(1)
    whole = Levelled.of(drive, PLACES, SlopeModel(), 30.0)
    monkeypatch.setattr(bins, "PART", part)
    found = Levelled.of(drive, PLACES, SlopeModel(), 30.0)
    for name in ("share", "pitch", "lean", "grade", "sigma_m"):
        np.testing.assert_array_equal(getattr(found, name), getattr(whole, name))


@pytest.mark.slow
def test_gains_have_the_sign_of_the_smoother_and_their_covariance() -> None:
    model = SlopeModel(gain=0.001, gain_sigma=1e-7, lean_rad=-0.0001, lean_sigma_rad=1e-7)
    found = Levelled.of(drive_over_bumps(1), PLACES, model, 30.0)
    ((estimate, covariance),) = found.gains
    assert estimate == pytest.approx([0.0001, -0.001], abs=1e-6)
    assert np.sqrt(np.diag(covariance)) == pytest.approx([1e-7, 1e-7], rel=1e-2)


def over(stretch: Stretch) -> Fit:
    return Fit(stretch, stretch.start(), np.full(stretch.layout.points - 1, 1e-5), 7, 0.0)


@pytest.mark.slow
@given(many=st.floats(0.0, 12.0), name=st.sampled_from(GLOBALS))
def test_constants_that_no_vehicle_has_are_not_believed(many: float, name: str) -> None:
    """Sigmas by which one is off, squared."""
    found = over(at_speed(np.full(40, 10.0)))
    assert found.prior_misfit == pytest.approx(0.0, abs=1e-20)
    y, model = found.unknowns.copy(), found.stretch.model
    y[found.stretch.layout.place(name)] += many * model.sigmas[name]
    off = found._replace(unknowns=y)
    assert off.prior_misfit == pytest.approx(many**2, rel=1e-9, abs=1e-15)
    assert is_believed(off) == (off.prior_misfit < UNLIKELY)


def test_a_stretch_without_a_positive_matrix_is_not_settled() -> None:
    """A force that is no number crept in: nothing is known, and nothing breaks."""
    found = fit(at_speed(np.full(40, 10.0), force=np.full(40, np.nan)))
    assert found.passes == 0
    assert not is_believed(found)
    assert known_gains([found]) == []
    sigma_m = _sigma(found, np.linspace(0.0, 20.0, 9), 30.0)
    np.testing.assert_array_equal(sigma_m, UNKNOWN_M)


def test_a_fit_whose_covariance_is_lost_has_neither_gains_nor_a_sigma() -> None:
    stretch = at_speed(np.full(40, 10.0), force=np.full(40, np.nan))
    found = over(stretch)
    assert is_believed(found)
    assert known_gains([found, over(at_speed(np.full(40, 10.0)))])[0][1].shape == (2, 2)
    assert len(known_gains([found])) == 0
    sigma_m = _sigma(found, np.linspace(0.0, 20.0, 9), 30.0)
    np.testing.assert_array_equal(sigma_m, UNKNOWN_M)
