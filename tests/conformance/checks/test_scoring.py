"""A profile compared with the truth: laws of what is measured."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import high_pass, iri_trace
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks import scoring
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import DeviceError, SuiteError
from floatref_conformance.judge import oracle

INTERVAL, LENGTH = 0.05, 400.0
NOMINAL, ADEQUATE, REFERENCE = DeviceClass
ONE = dict.fromkeys(DeviceClass, 1.0)
QUICK = settings(deadline=None, max_examples=15)


def road(seed=1, scale=1.0):
    """A random walk: white slope, as (2.4) has it for most roads."""
    points = round(LENGTH / INTERVAL) + 1
    return scale * np.cumsum(np.random.default_rng(seed).normal(0.0, 4e-4, points))


def compared(change=lambda z: z, valid=None, scale=1.0):
    """Return the comparison of a filtered road, changed, with the unfiltered one."""
    z = road(scale=scale)
    found = change(high_pass(z, INTERVAL))
    truth = Profile(INTERVAL, (ProfileTrack.of("left", z),))
    return scoring.compare(truth, Profile(INTERVAL, (ProfileTrack.of("left", found, valid),)))[0]


def both(one):
    pair = one.whole(150.0, 300.0)
    return (
        scoring.correlation(pair, "left", ONE).value,
        scoring.roughness_percent(pair, "left", ONE).value,
    )


def test_the_truth_filtered_alike_has_no_error():
    assert both(compared()) == pytest.approx((0.0, 0.0), abs=1e-9)


@QUICK
@given(st.floats(0.5, 2.0))
def test_a_gain_is_the_error_of_the_iri_and_lowers_the_correlation_by_its_share(gain):
    loss, error = both(compared(lambda z: gain * z))
    assert error == pytest.approx(100 * abs(gain - 1), abs=1e-6)
    assert loss == pytest.approx(1 - min(gain, 1 / gain), abs=1e-6)


@QUICK
@given(st.integers(-20, 20))
def test_a_displacement_of_up_to_a_metre_hardly_costs_correlation(points):
    loss, _ = both(compared(lambda z: np.roll(z, points)))
    assert loss < 0.01


def test_a_displacement_of_two_metres_does():
    assert both(compared(lambda z: np.roll(z, 40)))[0] > 0.1


@pytest.mark.parametrize("place", [150.0, 200.0, 300.0])
def test_a_point_without_elevation_where_every_point_counts_is_the_devices_fault(place):
    def holed(z):
        return np.where(np.arange(z.size) == round(place / INTERVAL), np.nan, z)

    with pytest.raises(DeviceError, match="without elevation"):
        compared(holed).whole(150.0, 300.0)


def test_points_ahead_of_the_stretch_may_be_missing():
    def holed(z):
        return np.where(np.arange(z.size) * INTERVAL < 60.0, np.nan, z)

    assert both(compared(holed)) == pytest.approx((0.0, 0.0), abs=1e-6)


@QUICK
@given(st.floats(50.0, 300.0), st.floats(1.0, 60.0), st.floats(-3.0, 3.0))
def test_what_is_flagged_missing_and_wrong_leaves_the_unflagged_part_alone(start, length, gain):
    x = np.arange(road().size) * INTERVAL
    lost = (x >= start) & (x <= start + length)

    def spoilt(z):
        return np.where(lost, np.nan, z)

    part = compared(spoilt, ~lost).unflagged()
    assert scoring.roughness_percent(part, "left", ONE).value == pytest.approx(0.0, abs=1e-6)
    wrong = compared(lambda z: np.where(lost, gain * z, z), ~lost).unflagged()
    assert int(wrong.counted.sum()) == int((~lost[:-1] & ~lost[1:]).sum())


def test_without_a_point_that_is_vouched_for_there_is_no_unflagged_part():
    assert compared(valid=np.zeros(road().size, dtype=bool)).unflagged() is None


@pytest.mark.parametrize(("scale", "limit"), [(0.2, 0.1), (3.0, None)])
def test_the_larger_of_percent_and_metres_per_km_is_the_limit(scale, limit):
    one = compared(lambda z: 1.04 * z, scale=scale)
    pair = one.whole(150.0, 300.0)
    found = scoring.roughness_within(pair, "left", "error", {NOMINAL: (5.0, 0.1)})
    iri = found.value / 0.04
    assert found.limits[NOMINAL] == pytest.approx(0.1 if limit else 0.05 * iri, rel=1e-6)
    assert (0.05 * iri < 0.1) is (limit is not None)


@pytest.mark.parametrize(("gain", "better"), [(1.03, "IRI error"), (0.5, "correlation loss")])
def test_the_better_of_two_is_limited_in_one_class_alone(gain, better):
    pair = compared(lambda z: gain * z).whole(150.0, 300.0)
    loss = scoring.correlation(pair, "left", {NOMINAL: 0.08 if gain > 1 else 10.0})
    error = scoring.roughness_percent(pair, "left", {NOMINAL: 10.0})
    chosen = scoring.better(loss, error, NOMINAL)
    assert chosen.quantity == better
    assert set(chosen.limits) == {NOMINAL}
    assert chosen.ratio(NOMINAL) == min(loss.ratio(NOMINAL), error.ratio(NOMINAL))


@pytest.mark.slow
def test_the_reference_implementation_finds_the_same_and_a_wrong_value_is_the_suites_fault():
    noise = np.random.default_rng(2).normal(0.0, 2e-3, road().size)
    pair = compared(lambda z: z + np.convolve(noise, np.full(20, 0.05), "same")).whole(150.0, 300.0)
    for found in (
        scoring.correlation(pair, "left", ONE),
        scoring.roughness_percent(pair, "left", ONE),
        scoring.roughness_within(pair, "left", "error", {NOMINAL: (5.0, 0.1)}),
    ):
        assert found.value > 0.01
        oracle.confirm("toy", found)
        object.__setattr__(found, "value", 1.05 * found.value)
        with pytest.raises(SuiteError, match="by the reference"):
            oracle.confirm("toy", found)


@QUICK
@given(st.floats(0.01, 0.1))
def test_the_car_of_the_iri_still_swings_from_what_lies_before_the_stretch(height):
    """A bump 22 to 30 m ahead of it counts as for a car that has been running since the start."""
    x = INTERVAL * np.arange(round(LENGTH / INTERVAL) + 1)
    inside = np.clip((x - 120.0) / 8.0, 0.0, 1.0)
    bump = height * (1.0 - np.cos(2 * np.pi * inside)) / 2
    plain = high_pass(road(), INTERVAL)
    counted = (x >= 150.0)[:-1] & (x <= 300.0)[:-1]
    present, wrong = (
        np.mean(np.abs(iri_trace(z, INTERVAL)[: counted.size][counted]))
        for z in (plain, plain + bump)
    )
    pair = compared(lambda z: z + bump).whole(150.0, 300.0)
    found = scoring.roughness_percent(pair, "left", ONE).value
    assert found == pytest.approx(100 * abs(wrong / present - 1), abs=0.05)
