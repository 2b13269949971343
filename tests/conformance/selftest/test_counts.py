"""The counts of the self-test: survivors, only killers, false alarms."""

import pytest

from floatref_conformance import EDITIONS
from floatref_conformance.checks.catalogue import IDS as CATALOGUE
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.builtin import CLAIMS
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.plugins import load_registry
from floatref_conformance.selftest.counts import (
    Counts,
    find_killers,
    list_claim_tries,
    list_named_tries,
    list_other_tries,
)
from floatref_conformance.selftest.grading import Limit
from floatref_conformance.selftest.trying import Try, TryResult

KILLERS = {"mutant:flat": ("bounce", "quiescent"), "mutant:noisy": ("quiescent",)}
IDS = ("quiescent", "bounce")
EDITION = find_edition()
KILLED = tuple(
    TryResult(one, "too rough") for one in list_named_tries(KILLERS, IDS, range(3), EDITION)
)
SPARED = tuple(TryResult(one, "") for one in list_other_tries(KILLERS, IDS, range(3), EDITION))
SOUND = Limit("bounce", "IRI", DeviceClass.NOMINAL, 0.0, 1.5, 0.67, (0.0, ""))


def test_every_mutant_is_tried_on_what_it_names_and_no_more():
    assert {(t.spec, t.check) for t in list_named_tries(KILLERS, IDS, [4], EDITION)} == {
        ("mutant:flat", "bounce"),
        ("mutant:flat", "quiescent"),
        ("mutant:noisy", "quiescent"),
    }


def test_those_that_name_one_check_are_tried_on_all_others():
    (tried,) = list_other_tries(KILLERS, IDS, [4], EDITION)
    assert tried == Try("mutant:noisy", "bounce", 4, edition=EDITION.name)


@pytest.mark.parametrize("name", EDITIONS)
def test_a_pipeline_is_judged_by_the_class_that_the_edition_says_it_reaches(name):
    edition = find_edition(name)
    tries = list_claim_tries(tuple(CATALOGUE), range(2), edition)
    assert len(set(tries)) == len(tries)
    reached = edition.document["reached"]
    for pipeline, by_check in reached.items():
        own = {t.check: t.device_class for t in tries if t.spec == f"builtin:{pipeline}"}
        everywhere = dict.fromkeys(CATALOGUE, by_check["all"]) if "all" in by_check else {}
        named = {id_: c for id_, c in by_check.items() if id_ != "all"}
        assert own == everywhere | named
        assert all(isinstance(c, DeviceClass) for c in own.values())
    assert {t.spec for t in tries} == {f"builtin:{pipeline}" for pipeline in reached}
    assert {t.edition for t in tries} == {name}
    assert {t.seed for t in tries} == {0, 1}


def test_in_the_first_edition_pipelines_reach_what_they_claim():
    tries = list_claim_tries(IDS, range(2), find_edition("2026.1"))
    assert len(tries) == 2 * 2 * len(CLAIMS)
    assert all(CLAIMS[t.spec.partition(":")[2]] is t.device_class for t in tries)


def test_nothing_to_complain_of():
    counts = Counts(KILLERS, ("quiescent",), KILLED, SPARED, limits=(SOUND,))
    assert counts.complaints == ()
    assert counts.only_killed_by("quiescent") == ("mutant:noisy",)
    document = counts.to_dict()
    assert document["holds"]
    assert (document["kills"], document["kills_asked"], document["limits"]) == (9, 9, 1)


def test_a_survivor_is_told_with_its_seed():
    passed = (*KILLED[:-1], TryResult(KILLED[-1].tried, ""))
    counts = Counts(KILLERS, IDS, passed)
    assert counts.complaints == (
        f"{KILLED[-1].tried.spec} passes {KILLED[-1].tried.check} with seed 2",
    )
    assert counts.to_dict()["kills"] == 8


def test_a_check_that_is_the_only_killer_of_nothing_is_told():
    counts = Counts(KILLERS, IDS, KILLED, SPARED)
    assert counts.complaints == ("bounce is not the only killer of a device",)


def test_a_second_killer_with_one_seed_is_enough_to_lose_the_first():
    others = (*SPARED[:-1], TryResult(SPARED[-1].tried, "too rough"))
    counts = Counts(KILLERS, ("quiescent",), KILLED, others)
    assert counts.only_killed_by("quiescent") == ()
    assert counts.complaints == ("quiescent is not the only killer of a device",)


def test_a_survivor_is_nobodys_only_victim():
    passed = tuple(
        TryResult(k.tried, "" if k.tried.spec == "mutant:noisy" else "no") for k in KILLED
    )
    assert Counts(KILLERS, IDS, passed, SPARED).only_killed_by("quiescent") == ()


def test_a_false_alarm_is_told():
    alarms = tuple(
        TryResult(one, "too rough") for one in list_claim_tries(["bounce"], [7], EDITION)[:1]
    )
    counts = Counts(KILLERS, IDS, KILLED, alarms=alarms)
    assert "fails bounce with seed 7: too rough" in counts.complaints[0]
    assert counts.to_dict()["false_alarms"] == 1


def test_limits_without_a_graded_error_are_told():
    counts = Counts(KILLERS, IDS, KILLED, limits=(SOUND,), ungraded=("bounce: place",))
    assert counts.complaints == ("no graded error of bounce: place",)
    assert counts.to_dict()["limits_asked"] == 2


def test_the_killers_are_those_that_the_devices_name():
    registry = load_registry()
    killers = find_killers(registry)
    for id_ in registry.checks:
        specs = {spec for spec, fails in killers.items() if id_ in fails}
        assert specs == set(registry.killers(id_))
