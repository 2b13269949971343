"""The self-test of streams: who is tried on what, and what is a complaint."""

from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.plugins import load_registry
from floatref_conformance.selftest.counts import Counts, find_killers
from floatref_conformance.selftest.stream_tries import (
    SOUND,
    StreamCounts,
    StreamTry,
    list_stream_tries,
)

ALL = tuple(STREAM_CHECKS)
LEAKS = StreamTry("mutant:stream-leaks", 0, ALL)
HONEST = StreamTry(SOUND[0], 3, ALL)


def test_mutants_meet_their_check_and_all_others_if_asked_and_sound_devices_meet_all():
    tries = list_stream_tries(ALL, seeds=2, false_alarms=3, unique=False)
    mutants = [t for t in tries if t.spec.startswith("mutant:")]
    assert (len(mutants), {len(t.checks) for t in mutants}) == (10, {1})
    sound = [t for t in tries if t not in mutants]
    assert sorted((t.spec, t.seed) for t in sound) == sorted(
        (s, k) for s in SOUND for k in range(3)
    )
    assert {t.checks for t in sound} == {ALL}
    unique = list_stream_tries(ALL, seeds=1, false_alarms=0, unique=True)
    assert {t.checks for t in unique} == {ALL}


def test_without_a_check_of_streams_nothing_is_tried():
    assert list_stream_tries((), seeds=3, false_alarms=10, unique=True) == ()
    assert StreamCounts().lines == ()
    assert "streams" not in Counts({}, ()).to_dict()


def test_a_mutant_killed_by_its_check_alone_and_a_sound_device_hold():
    counts = StreamCounts(ALL, {LEAKS: {"live-memory": "grew"}, HONEST: {}})
    assert counts.complaints == ()
    assert counts.to_dict() == {
        "mutants": 1,
        "kills": 1,
        "kills_asked": 1,
        "false_alarms": 0,
        "alarms_asked": 5,
    }
    assert "1 of 1 times" in counts.lines[0]


def test_a_survivor_a_second_killer_and_a_false_alarm_are_complaints():
    failed = {LEAKS: {"live-order": "x"}, HONEST: {"live-final": "y"}}
    assert set(Counts({}, (), streams=StreamCounts(ALL, failed)).complaints) == {
        "mutant:stream-leaks passes live-memory with seed 0",
        "mutant:stream-leaks fails live-order with seed 0: x",
        "builtin:road-prior-smoother fails live-final with seed 3: y",
    }


def test_mutants_of_streams_are_not_asked_of_checks_of_recordings():
    killers = find_killers(load_registry())
    assert killers
    assert not any("stream-" in spec for spec in killers)
