"""The data of the editions: complete, consistent, and of scenarios that exist."""

from copy import deepcopy
from dataclasses import fields, replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance import EDITION, EDITIONS
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.driving.check import driving_checks
from floatref_conformance.checks.driving.rules import rule_of, rules_of
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import SuiteError
from floatref_conformance.plugins import load_registry
from floatref_conformance.proving_ground.scenario import MANOEUVRES, STATIONARY, Scenario
from floatref_conformance.proving_ground.vehicles.parameter_sets import find_vehicle
from floatref_conformance.schemas import enforce

SCHEMA = "conformance-edition-1"
NUMBERS = {field.name for field in fields(Scenario)}
BOTH = tuple(find_edition(name) for name in EDITIONS)
FIRST, SECOND = (find_edition(name) for name in ("2026.1", "2026.2"))
every = pytest.mark.parametrize("edition", BOTH, ids=EDITIONS)


@every
def test_the_data_keep_their_schema(edition):
    enforce(SCHEMA, edition.document)


@every
@pytest.mark.parametrize(
    "damage",
    [
        lambda data: data["checks"][0].pop("clause"),
        lambda data: data["checks"][0].update(quick=0),
        lambda data: data["rules"]["light"]["whole"][0].update(nominal=-1.0),
        lambda data: data["manoeuvres"]["braking"].pop("beyond"),
        lambda data: data["delivery"].pop("early_end_m"),
        lambda data: data["slow"].update(excused="yes"),
        lambda data: data["distance"].clear(),
        lambda data: data.update(another={}),
    ],
)
def test_the_schema_refuses_data_that_lack_a_limit_or_a_clause(damage, edition):
    data = deepcopy(edition.document)
    damage(data)
    with pytest.raises(SuiteError, match=SCHEMA):
        enforce(SCHEMA, data)


def test_the_default_edition_is_the_last_and_an_unknown_one_is_refused_in_a_line():
    assert find_edition().name == EDITION == EDITIONS[-1]
    for ask in (find_edition, load_registry):
        with pytest.raises(InputError) as refused:
            ask("2025.9")
        assert str(refused.value) == "edition 2025.9: unknown; choose from 2026.1, 2026.2"


@every
def test_ids_and_titles_are_those_of_the_suites_list(edition):
    checks = driving_checks(edition)
    assert [id_ for id_ in IDS if id_ in checks] == list(checks)
    assert all(IDS[id_] == check.title for id_, check in checks.items())
    assert list(load_registry(edition.name).checks)[: len(IDS)] == list(IDS)


@every
def test_every_check_of_an_edition_has_that_edition(edition):
    checks = load_registry(edition.name).checks
    assert all(checks[id_].edition is edition for id_ in IDS)


@every
def test_every_number_is_one_of_a_scenario(edition):
    # `Scenario.from_dict` ignores a key that it does not know: a slip would go unseen.
    data = edition.document
    shapes = [name for shape in data["shapes"].values() for name in shape]
    named = (edition.defaults, edition.drawn, edition.without_slip, edition.wander, edition.encoder)
    assert {name for table in (*named, *data["distance"], shapes) for name in table} <= NUMBERS
    for table in data["checks"]:
        for row in (*table["rows"], table["simplest"], table.get("every_row", {})):
            assert set(row) <= NUMBERS
    for around in data["surroundings"].values():
        assert around["roads"] in edition.roads
        assert all(find_vehicle(vehicle) for vehicle in around["vehicles"])


@every
def test_every_row_is_judged_by_a_rule_that_the_check_names(edition):
    for check in driving_checks(edition).values():
        found = {id(rule_of(row, edition)) for row in (*check.rows, check.simplest_scenario)}
        assert found == {id(rule) for rule in check.rules.values()}


@every
def test_every_manoeuvre_of_a_drive_has_a_rule(edition):
    manoeuvres = edition.document["manoeuvres"]
    assert set(manoeuvres) <= set(MANOEUVRES)
    assert not set(manoeuvres) & set(STATIONARY)
    named = {v for rule in manoeuvres.values() for v in rule.values() if isinstance(v, str)}
    assert named == set(rules_of(edition))


@every
def test_words_are_whole_sentences_with_every_text_filled_in(edition):
    for check in load_registry(edition.name).checks.values():
        for words in (check.derivation, check.floor):
            assert "{" not in words
            assert "  " not in words
            assert words.rstrip().endswith(".")


@every
def test_the_classes_that_pipelines_reach_are_of_checks_and_classes_that_exist(edition):
    for by_check in edition.document["reached"].values():
        assert set(by_check) <= {"all", *IDS}
        assert set(by_check.values()) <= set(DeviceClass)


@every
def test_a_scenario_has_what_it_says_and_else_the_editions_defaults(edition):
    made = edition.make_scenario(manoeuvre="stop", laser_ahead_m=0.2)
    assert (made.manoeuvre, made.laser_ahead_m) == ("stop", 0.2)
    assert made.slip_percent_per_g == edition.defaults["slip_percent_per_g"]
    with pytest.raises(InputError, match="slip_percent_per_g"):
        edition.make_scenario(slip_percent_per_g=-1.0)


def test_the_first_edition_has_the_scenario_of_its_time():
    # What a file of the first format, and every case file, means by what it does not name.
    assert FIRST.make_scenario() == Scenario.from_dict({"format": "floatref-scenario/1"})
    assert (FIRST.early_end_m, FIRST.true_axis, dict(FIRST.wander)) == (0.0, False, {})
    assert SECOND.make_scenario() == Scenario()


@given(st.integers(0, 2**32))
@settings(max_examples=40, deadline=None)
def test_drawn_numbers_follow_from_the_entropy_and_stay_within_their_ends(entropy):
    numbers = SECOND.draw_numbers((entropy, 3))
    assert numbers == SECOND.draw_numbers((entropy, 3))
    assert set(numbers) == {"slip_percent_per_g", "laser_ahead_m"}
    assert 3.0 <= numbers["slip_percent_per_g"] <= 12.0
    assert -0.3 <= numbers["laser_ahead_m"] <= 0.3
    assert FIRST.draw_numbers((entropy, 3)) == {}


def test_what_a_row_says_is_not_drawn():
    plain, stated = SECOND.make_scenario(), SECOND.make_scenario(slip_percent_per_g=7.25)
    drawn = SECOND.draw_for(stated, (5,))
    assert drawn == replace(stated, laser_ahead_m=drawn.laser_ahead_m)
    assert drawn.laser_ahead_m == SECOND.draw_numbers((5,))["laser_ahead_m"]
    assert SECOND.draw_for(plain, (5,)) == replace(plain, **SECOND.draw_numbers((5,)))
    assert FIRST.draw_for(plain, (5,)) == plain


def test_the_cases_of_a_check_differ_in_slip_and_laser():
    cases = driving_checks(SECOND)["stop"].cases(0, Effort.CERTIFICATION)
    for name in ("slip_percent_per_g", "laser_ahead_m"):
        assert len({getattr(case.scenario, name) for case in cases}) > len(cases) / 3
