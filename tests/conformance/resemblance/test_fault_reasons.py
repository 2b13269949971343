"""Faults of the protocol name their flaw, by what the judge itself writes of hostile programs."""

import pytest

from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.exercise import close, exercise
from floatref_conformance.mutants.hostile import HOSTILE, hostile_device
from floatref_conformance.mutants.in_streams import STREAM_MUTANTS
from floatref_conformance.resemblance.fault_reasons import (
    REASONS,
    Judged,
    name_protocol_flaws,
    name_stream_flaws,
)
from floatref_conformance.resemblance.naming import name_by_report
from floatref_conformance.resemblance.probes import PROBES

PASSED = Judged("toy", Outcome.PASS, "")


def error(reason):
    return Judged("toy", Outcome.ERROR, f"toy-1: {reason}")


def test_every_hostile_program_has_a_reason():
    assert set(REASONS) == {hostile.name for hostile in HOSTILE}


@pytest.mark.slow
@pytest.mark.parametrize("name", [hostile.name for hostile in HOSTILE])
def test_what_the_judge_writes_of_a_hostile_program_names_it_alone(name):
    device, nominal = hostile_device(name), Description("a", "1", "temporal", ())
    with pytest.raises(DeviceError) as fault:
        exercise(device, nominal, PROBES[0].take(nominal).recording)
    close(device)
    assert [one.mutant for one in name_protocol_flaws([error(str(fault.value))])] == [name]


def test_the_most_frequent_fault_comes_first():
    hang, crash = error("run: no answer within 60 s"), error("run: was killed by SIGSEGV")
    named = name_protocol_flaws([crash, hang, PASSED, hang])
    assert [one.mutant for one in named] == ["hang", "crash"]


@pytest.mark.parametrize(
    "reason",
    [
        "run: answered an error: channel distance: stuck",
        "IRI error, track left: 3 m/km, limit 0.3 m/km",
        "profile from 5.000 m over 395.000 m; the recording goes from 0.000 m to 400.000 m",
    ],
)
def test_what_is_no_fault_of_the_protocol_names_nothing(reason):
    assert name_protocol_flaws([error(reason)]) == ()


@pytest.mark.parametrize("mutant", STREAM_MUTANTS, ids=lambda mutant: mutant.name)
def test_a_check_of_streams_names_the_mutant_that_fails_it(mutant):
    failed = [Judged(id_, Outcome.FAIL, "late") for id_ in mutant.fails]
    assert [one.mutant for one in name_stream_flaws(failed)] == [mutant.name]
    assert [one.mutant for one in name_by_report([PASSED], failed)] == [mutant.name]
    wrong = Judged("toy", Outcome.FAIL, "IRI error")
    assert name_by_report([wrong], failed) == ()
