"""What a device flags: the road's shape in its place, and what class nominal need not answer for.

In edition 2026.2; the first edition asks for every point.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import high_pass
from floatref_conformance.checks.driving.layout import Layout
from floatref_conformance.checks.driving.rules import BESIDE, UNFLAGGED, VALID_PART, WHOLE, rules_of
from floatref_conformance.checks.flags import SLOW_MPS, speed_at
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.classes import DeviceClass
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.scenario import Scenario

INTERVAL = 0.05
X = np.arange(round(500 / INTERVAL) + 1) * INTERVAL
NOMINAL, ADEQUATE, REFERENCE = DeviceClass
FIRST, SECOND = (rules_of(find_edition(name)) for name in ("2026.1", "2026.2"))
HARD = SECOND["hard"]
LAYOUT = Layout((316.0,), ((220.0, 380.9),))
FAST = Scenario()
ROLLS_ON = Scenario(manoeuvre="braking", event_speed_kmh=15.0, deceleration_g=0.3, event_at_m=316.0)
"""Brakes to 15 km/h at 316 m and rolls on, so that all behind is slow."""
EVERYWHERE = np.ones(X.size, dtype=bool)


def road(scale=1.0, bump_at=None):
    """About 1.5 m/km; with a bump of 20 mm if its place is given."""
    walk = scale * np.cumsum(np.random.default_rng(3).normal(0.0, 3e-4, X.size))
    if bump_at is not None:
        away = X - bump_at
        walk += np.where(np.abs(away) < 1.5, 0.02 * np.cos(np.pi * away / 3.0) ** 2, 0.0)
    return high_pass(walk, INTERVAL)


def measure(result, valid=EVERYWHERE, scenario=FAST, truth=None, beside=None, rule=HARD):
    truth = road() if truth is None else truth
    compared = Compared("left", X, truth, result, valid, INTERVAL)
    if beside is not None:
        beside = Compared("left", X, beside, result, valid, INTERVAL)
    return rule.measure(compared, scenario, LAYOUT, beside)


def failing(measured, device_class=NOMINAL):
    return {m.quantity for m in measured if not m.within(device_class)}


def wrong(factor, start, end):
    """Return the road with heights wrong by ``factor`` from ``start`` to ``end``."""
    return np.where((start <= X) & (end >= X), factor * road(), road())


def flagged(start, end):
    return ~((start <= X) & (end >= X))


def value_of(measured, quantity):
    (found,) = (m for m in measured if m.quantity == quantity)
    return found.value


@pytest.mark.parametrize(
    ("rules", "percent", "m_per_km"), [(FIRST, 50.0, 1.0), (SECOND, 13.8, 0.22)]
)
@pytest.mark.parametrize("name", ["hard", "start"])
@pytest.mark.parametrize("scale", [0.2, 4.0])
def test_the_whole_may_be_off_by_what_the_edition_says(rules, percent, m_per_km, name, scale):
    # Twice as high a road is off by its own IRI.
    truth = road(scale)
    (whole,) = (m for m in measure(2 * truth, truth=truth, rule=rules[name]) if m.quantity == WHOLE)
    assert whole.limits == {NOMINAL: pytest.approx(max(percent * whole.value / 100, m_per_km))}


def test_flagged_points_get_the_roads_shape_where_only_valid_ones_are_asked_for():
    broken, none = wrong(6.0, 290.0, 380.0), np.full(X.size, np.nan)
    all_flagged, half_flagged = (
        measure(broken, valid) for valid in (flagged(285.0, 385.0), flagged(330.0, 385.0))
    )
    assert failing(all_flagged) == {WHOLE}
    assert value_of(all_flagged, VALID_PART) < 0.02
    assert failing(half_flagged) == {WHOLE, VALID_PART, UNFLAGGED}
    missing = np.where(flagged(285.0, 385.0), road(), none)
    with pytest.raises(DeviceError, match="without elevation"):
        measure(missing, flagged(285.0, 385.0))
    assert VALID_PART not in {m.quantity for m in measure(broken, rule=FIRST["hard"])}


def test_a_scored_stretch_is_right_where_it_is_valid_even_if_all_the_rest_outweighs_it():
    assert failing(measure(wrong(1.1, 225.0, 380.0))) == {VALID_PART}
    assert failing(measure(wrong(1.03, 225.0, 380.0))) == set()


@settings(deadline=None, max_examples=15)
@given(
    factor=st.one_of(st.just(np.nan), st.floats(-8.0, 8.0)),
    margin_m=st.floats(0.0, 4.0),
)
def test_what_is_flagged_below_16_km_per_h_does_not_count_in_class_nominal(factor, margin_m):
    slow = speed_at(ROLLS_ON, X) < SLOW_MPS
    first_m = X[np.argmax(slow)]
    assert slow[X > 316.0].all()
    valid = first_m - margin_m > X
    result = np.where(valid, road(), factor * road())
    measured = measure(result, valid, ROLLS_ON)
    assert failing(measured) == set()
    assert value_of(measured, VALID_PART) < 1e-9
    if np.isnan(factor) or abs(factor - 1) > 0.2:
        for device_class in (ADEQUATE, REFERENCE):
            assert failing(measured, device_class) >= {"correlation loss"}


def test_the_first_edition_asks_for_slow_points_too():
    valid = X < 316.0
    with pytest.raises(DeviceError, match="without elevation"):
        measure(np.where(valid, road(), np.nan), valid, ROLLS_ON, rule=FIRST["hard"])
    measured = measure(np.where(valid, road(), 8 * road()), valid, ROLLS_ON, rule=FIRST["hard"])
    assert failing(measured) == {WHOLE}


def test_slow_points_that_are_not_flagged_count():
    measured = measure(wrong(8.0, 316.0, 500.0), scenario=ROLLS_ON)
    assert failing(measured) == {WHOLE, VALID_PART, UNFLAGGED}
    for valid in (EVERYWHERE, flagged(400.0, 500.0)):
        measured = measure(wrong(8.0, 316.0, 400.0), valid, ROLLS_ON)
        assert failing(measured) == {WHOLE, VALID_PART, UNFLAGGED}


def test_points_that_are_given_up_well_before_16_km_per_h_count():
    valid = X < 316.0 - 15.0
    with pytest.raises(DeviceError, match="without elevation"):
        measure(np.where(valid, road(), np.nan), valid, ROLLS_ON)


def test_the_loss_along_the_encoder_is_measured_and_not_limited():
    off_m = 5.0
    along = np.interp(X + off_m, X, road())
    measured = measure(road(), beside=along)
    (found,) = (m for m in measured if m.quantity == BESIDE)
    assert found.limits == {}
    assert found.value > 0.5
    assert failing(measured, REFERENCE) == set()
    assert value_of(measure(road(), beside=road()), BESIDE) < 1e-9
    assert BESIDE not in {m.quantity for m in measure(road())}
    missing = np.where(X > 316.0, np.nan, road())
    assert BESIDE not in {m.quantity for m in measure(missing, X < 316.0, ROLLS_ON, beside=along)}


def test_the_bump_is_found_on_either_axis():
    lost_m, at_m = 2.4, 316.0
    scenario = Scenario(bump_mm=20.0, bump_at_m=at_m)
    true, along = road(bump_at=at_m), road(bump_at=at_m - lost_m)
    for delivered, right in ((true, True), (along, True), (road(), False)):
        for device_class in DeviceClass:
            measured = measure(delivered, scenario=scenario, truth=true, beside=along)
            found = failing(measured, device_class)
            assert ("bump error" in found) is not right, device_class
    assert "bump error" in failing(measure(along, scenario=scenario, truth=true))


def test_a_bump_that_is_given_up_below_16_km_per_h_is_one_that_stricter_classes_lack():
    scenario = Scenario(**{**vars_of(ROLLS_ON), "bump_mm": 20.0, "bump_at_m": 316.0})
    truth, valid = road(bump_at=316.0), X < 313.0
    measured = measure(np.where(valid, truth, np.nan), valid, scenario, truth=truth)
    assert failing(measured) == set()
    assert failing(measured, ADEQUATE) >= {"bump error"}


def vars_of(scenario):
    return {
        name: getattr(scenario, name) for name in ("manoeuvre", "event_speed_kmh", "event_at_m")
    }
