"""The data of the driving checks: complete, consistent, and of scenarios that exist."""

from copy import deepcopy
from dataclasses import fields

import pytest

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.driving.check import driving_checks
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.checks.driving.edition import edition
from floatref_conformance.checks.driving.rules import rule_of
from floatref_conformance.errors import SuiteError
from floatref_conformance.proving_ground.scenario import MANOEUVRES, STATIONARY, Scenario
from floatref_conformance.schemas import enforce

SCHEMA = "conformance-driving-1"
NUMBERS = {field.name for field in fields(Scenario)}


def test_the_data_keeps_its_schema():
    enforce(SCHEMA, edition())


@pytest.mark.parametrize(
    "spoil",
    [
        lambda data: data["checks"][0].pop("clause"),
        lambda data: data["checks"][0].update(quick=0),
        lambda data: data["rules"]["light"]["whole"][0].update(nominal=-1.0),
        lambda data: data["manoeuvres"]["braking"].pop("beyond"),
    ],
)
def test_the_schema_refuses_data_that_lack_a_limit_or_a_clause(spoil):
    data = deepcopy(edition())
    spoil(data)
    with pytest.raises(SuiteError, match=SCHEMA):
        enforce(SCHEMA, data)


def test_ids_and_titles_are_those_of_the_suites_list():
    listed = [id_ for id_ in IDS if id_ in driving_checks(find_edition())]
    assert listed == list(driving_checks(find_edition()))
    assert all(IDS[id_] == check.title for id_, check in driving_checks(find_edition()).items())


@pytest.mark.parametrize("table", edition()["checks"], ids=lambda table: table["id"])
def test_every_number_of_a_row_is_one_of_a_scenario(table):
    # `Scenario.from_dict` ignores a key that it does not know: a slip would go unseen.
    for row in (*table["rows"], table["simplest"], table.get("every_row", {})):
        assert set(row) <= NUMBERS


@pytest.mark.parametrize(
    "check", driving_checks(find_edition()).values(), ids=driving_checks(find_edition())
)
def test_every_row_is_judged_by_a_rule_that_the_check_names(check):
    found = {id(rule_of(row)) for row in (*check.rows, check.simplest_scenario)}
    assert found == {id(rule) for rule in check.rules.values()}


def test_every_manoeuvre_of_a_drive_has_a_rule():
    assert set(edition()["manoeuvres"]) <= set(MANOEUVRES)
    assert not set(edition()["manoeuvres"]) & set(STATIONARY)


def test_words_are_whole_sentences_with_every_text_filled_in():
    for check in driving_checks(find_edition()).values():
        for words in (check.derivation, check.floor):
            assert "{" not in words
            assert "  " not in words
            assert words.rstrip().endswith(".")
