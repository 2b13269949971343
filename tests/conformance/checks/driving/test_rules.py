"""The limits of the driving checks are those of the table, and decide at them."""

import numpy as np
import pytest

from floatref.measures import high_pass
from floatref_conformance.checks.driving.layout import Layout
from floatref_conformance.checks.driving.rules import rule_of, rules_of
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.classes import DeviceClass
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.scenario import Scenario

INTERVAL = 0.05
X = np.arange(round(500 / INTERVAL) + 1) * INTERVAL
NOMINAL, ADEQUATE, REFERENCE = DeviceClass
STEADY, SLOWLY = Scenario(bump_mm=20.0, bump_at_m=115.0), Scenario(speed_kmh=10.0)
AROUND = Layout((316.0,), ((220.0, 380.9),))
CONSTANT, LIGHT, HARD, START, SLOW = "constant", "light", "hard", "start", "slow"
EDITIONS = tuple(find_edition(name) for name in ("2026.1", "2026.2"))


@pytest.fixture(params=EDITIONS, ids=lambda edition: edition.name)
def rules(request):
    return rules_of(request.param)


def road(scale=1.0):
    """About 1.5 m/km, and a bump of 20 mm at 115 m."""
    walk = np.cumsum(np.random.default_rng(3).normal(0.0, 3e-4, X.size))
    bump = np.where(np.abs(X - 115.0) < 1.5, 0.02 * np.cos(np.pi * (X - 115.0) / 3.0) ** 2, 0.0)
    return high_pass(scale * walk + bump, INTERVAL)


def failing(rule, change, device_class=NOMINAL, valid=None, scenario=STEADY, scale=1.0):
    """Return the quantities of a changed profile that the class does not pass."""
    truth = road(scale)
    valid = np.ones(X.size, dtype=bool) if valid is None else valid
    compared = Compared("left", X, truth, change(truth), valid, INTERVAL)
    measured = rule.measure(compared, scenario, AROUND)
    return {m.quantity for m in measured if not m.within(device_class)}


def off_by(percent):
    """Return what gets the IRI wrong by a gain, but leaves the bump."""
    return lambda z: np.where(np.abs(X - 115.0) < 10.0, z, (1 + percent / 100) * z)


@pytest.mark.parametrize(
    ("drive", "rule"),
    [
        ({"manoeuvre": "constant", "speed_kmh": 16.1}, CONSTANT),
        ({"manoeuvre": "constant", "speed_kmh": 15.9}, SLOW),
        ({"manoeuvre": "creeping", "speed_kmh": 4.0}, SLOW),
        ({"manoeuvre": "coasting"}, LIGHT),
        ({"manoeuvre": "throttle"}, LIGHT),
        ({"manoeuvre": "braking", "deceleration_g": 0.16}, LIGHT),
        ({"manoeuvre": "braking", "deceleration_g": 0.17}, HARD),
        ({"manoeuvre": "near-stop", "deceleration_g": 0.1}, HARD),
        ({"manoeuvre": "stop", "deceleration_g": 0.1}, HARD),
        ({"manoeuvre": "dead-start"}, START),
    ],
)
def test_what_the_drive_does_decides_on_the_rule(drive, rule):
    for edition in EDITIONS:
        assert rule_of(Scenario(**drive), edition) is rules_of(edition)[rule]


@pytest.mark.parametrize("rule", [CONSTANT, LIGHT, HARD, START, SLOW])
@pytest.mark.parametrize("device_class", DeviceClass)
def test_the_truth_passes_every_class(rules, rule, device_class):
    assert failing(rules[rule], lambda z: z, device_class) == set()


PERCENT = [
    (CONSTANT, NOMINAL, 5.0),
    (CONSTANT, ADEQUATE, 3.0),
    (CONSTANT, REFERENCE, 2.0),
    (LIGHT, ADEQUATE, 5.0),
    (LIGHT, REFERENCE, 2.0),
    (HARD, ADEQUATE, 5.0),
    (HARD, REFERENCE, 2.0),
    (START, ADEQUATE, 5.0),
    (START, REFERENCE, 2.0),
    (SLOW, ADEQUATE, 5.0),
    (SLOW, REFERENCE, 3.0),
]


@pytest.mark.parametrize(("rule", "device_class", "limit"), PERCENT)
def test_an_iri_half_as_far_off_again_as_the_limit_fails_and_two_thirds_pass(
    rules, rule, device_class, limit
):
    assert "IRI error" in failing(rules[rule], off_by(1.5 * limit), device_class)
    assert "IRI error" not in failing(rules[rule], off_by(0.67 * limit), device_class)


LOSS = [
    (CONSTANT, NOMINAL, 0.08),
    (CONSTANT, ADEQUATE, 0.05),
    (CONSTANT, REFERENCE, 0.02),
    (LIGHT, ADEQUATE, 0.08),
    (LIGHT, REFERENCE, 0.02),
    (HARD, ADEQUATE, 0.08),
    (HARD, REFERENCE, 0.02),
    (SLOW, ADEQUATE, 0.08),
    (SLOW, REFERENCE, 0.05),
]


@pytest.mark.parametrize(("rule", "device_class", "limit"), LOSS)
def test_a_correlation_half_as_far_off_again_as_the_limit_fails_and_two_thirds_pass(
    rules, rule, device_class, limit
):
    def with_loss(loss):
        return lambda z: (1 - loss) * z

    assert "correlation loss" in failing(rules[rule], with_loss(1.5 * limit), device_class)
    assert "correlation loss" not in failing(rules[rule], with_loss(0.67 * limit), device_class)


@pytest.mark.parametrize(("percent", "passes"), [(6.7, True), (15.0, False)])
def test_a_light_event_fails_class_nominal_only_if_shape_and_roughness_both_fail(
    rules, percent, passes
):
    assert (failing(rules[LIGHT], off_by(percent)) == set()) is passes
    shifted = failing(rules[LIGHT], lambda z: np.where(X > 150.0, np.roll(z, 40), z))
    assert shifted == set(), "a wrong shape of the right roughness"


def flagged(start, end):
    return ~((start <= X) & (end >= X))


@pytest.mark.parametrize(("scale", "percent"), [(1.0, 5.0), (0.1, None)])
def test_where_a_hard_event_is_unflagged_the_iri_is_within_5_percent_or_a_tenth(
    rules, scale, percent
):
    unflagged = {"IRI error, unflagged part"}
    truth_iri = 1.5 * scale
    limit = percent or 100 * 0.1 / truth_iri
    far = failing(rules[HARD], off_by(2.0 * limit), scale=scale)
    assert unflagged <= far
    assert not unflagged & failing(rules[HARD], off_by(0.5 * limit), scale=scale)


def test_what_a_hard_event_has_flagged_counts_in_the_whole_alone():
    rules = rules_of(EDITIONS[0])

    def spoilt(z):
        return np.where(flagged(290.0, 380.0), z, 0.5 * z)

    assert failing(rules[HARD], spoilt, valid=flagged(285.0, 385.0)) == set()
    assert failing(rules[HARD], spoilt) == {"IRI error, unflagged part"}

    def ruined(z):
        return np.where(flagged(290.0, 380.0), z, 6.0 * z)

    assert failing(rules[HARD], ruined, valid=flagged(285.0, 385.0)) == {"IRI error, 160.9 m"}


@pytest.mark.parametrize(
    ("rule", "lengths"), [(HARD, (125.0, 10.0, 5.0)), (CONSTANT, (10.0, 10.0, 5.0))]
)
def test_no_more_may_be_flagged_away_from_the_ends_than_the_class_allows(rules, rule, lengths):
    for device_class, limit in zip(DeviceClass, lengths, strict=True):
        for share, fails in ((1.5, True), (0.67, False)):
            half = share * limit / 2
            valid = flagged(316.0 - half, 316.0 + half)
            found = failing(rules[rule], lambda z: z, device_class, valid)
            assert ("flagged elsewhere" in found) is fails, (device_class, share)


@pytest.mark.parametrize("rule", [CONSTANT, LIGHT, HARD, START])
def test_a_point_without_elevation_where_all_count_is_the_devices_fault(rules, rule):
    with pytest.raises(DeviceError, match="without elevation"):
        failing(rules[rule], lambda z: np.where(np.abs(X - 300.0) < 1.0, np.nan, z))


def nothing(z):
    return np.full(z.size, np.nan)


def test_below_16_km_per_h_class_nominal_answers_for_what_it_vouches_for(rules):
    none = np.zeros(X.size, dtype=bool)
    slow = Scenario(speed_kmh=10.0, bump_mm=20.0, bump_at_m=115.0)
    for change in (nothing, lambda z: 0.0 * z):
        assert failing(rules[SLOW], change, valid=none, scenario=slow) == set()
        for device_class in (ADEQUATE, REFERENCE):
            found = failing(rules[SLOW], change, device_class, none, slow)
            assert found == {"correlation loss", "IRI error", "bump error"}
    assert failing(rules[SLOW], lambda z: 0.0 * z, scenario=slow) == {
        "IRI error, unflagged part",
        "bump error",
    }
    assert failing(rules[SLOW], off_by(7.5), scenario=SLOWLY) == {"IRI error, unflagged part"}
    assert failing(rules[SLOW], off_by(3.3), scenario=SLOWLY) == set()


def test_every_rule_says_what_it_measures(rules):
    for rule in rules.values():
        truth = road()
        compared = Compared("left", X, truth, truth, np.ones(X.size, dtype=bool), INTERVAL)
        measured = rule.measure(compared, STEADY, AROUND)
        assert {m.quantity for m in measured} <= set(rule.limits)
        for found in measured:
            if found.quantity != "IRI error" or rule is not rules[LIGHT]:
                words = rule.limits[found.quantity]
                limited = {c for c in DeviceClass if words[c] != "not limited"}
                assert set(found.limits) <= limited
