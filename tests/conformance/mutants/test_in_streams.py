"""Streams wrong on purpose: each has its one error, and the check that names it kills it."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.profile import ProfileTrack
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.mutants.device import MUTANT
from floatref_conformance.mutants.in_streams import (
    AHEAD,
    HELD_S,
    STREAM_MUTANTS,
    DependsOnChunks,
    Leaks,
    LooksAhead,
    Revises,
    Stalls,
    messages_ahead,
    stream_mutant,
)
from floatref_conformance.selftest.stream_tries import StreamTry, attempt_stream


@dataclass(frozen=True)
class Points:
    state: str
    first: int
    tracks: tuple


@dataclass
class Latency:
    longest_s: float = 10.0


@dataclass
class Sound:
    """A stream that gives out what was put into it, and notes what was pushed."""

    made: list = field(default_factory=list)
    pushed: list = field(default_factory=list)
    latency: Latency = field(default_factory=Latency)

    def push(self, samples):
        self.pushed.append(samples)

    def ready(self, wait=False):
        made, self.made = self.made, []
        return made

    def finish(self):
        return self.ready()


def points(state, first=0):
    return Points(state, first, (ProfileTrack.of("left", np.arange(3.0)),))


def height(points_):
    return points_.tracks[0].elevation.tolist()


def test_each_check_of_streams_is_named_by_one_mutant_alone():
    assert [mutant.fails for mutant in STREAM_MUTANTS] == [
        (id_,) for id_ in ("live-order", "live-final", "live-latency", "live-memory", "live-chunks")
    ]
    assert {id_ for mutant in STREAM_MUTANTS for id_ in mutant.fails} == set(STREAM_CHECKS)


def test_they_are_devices_by_their_names():
    entries = {entry.name: entry.fails for entry in MUTANT.entries()}
    for mutant in STREAM_MUTANTS:
        assert MUTANT.make(mutant.name) is mutant
        assert entries[mutant.name] == mutant.fails
        assert mutant.describe()["name"] == mutant.name
    with pytest.raises(InputError, match="stream-leaks"):
        stream_mutant("stream-leak")


def test_what_looks_ahead_moves_provisional_points_by_a_later_height():
    sound = Sound()
    wrong = LooksAhead(sound)
    wrong.push({"left.height": np.array([0.3, 0.4]), "distance": np.array([1.0])})
    sound.made = [points("provisional"), points("final")]
    moved, kept = wrong.ready()
    assert height(moved) == pytest.approx((np.arange(3.0) + 0.4e-4).tolist())
    assert height(kept) == [0.0, 1.0, 2.0]


def test_its_syncs_are_obeyed_behind_the_samples_of_later_ones():
    sent = []
    for number in range(AHEAD + 4):
        sent += [{"kind": "samples", "n": number}, {"kind": "sync", "number": number}]
    sent.append({"kind": "finish"})
    obeyed = list(messages_ahead(iter(sent)))
    assert sorted(map(str, obeyed)) == sorted(map(str, sent))
    assert obeyed[-1] == {"kind": "finish"}
    first = obeyed.index({"kind": "sync", "number": 0})
    assert obeyed.index({"kind": "samples", "n": AHEAD}) < first


def test_what_revises_gives_final_points_twice():
    sound = Sound()
    wrong = Revises(sound)
    sound.made = [points("final", 0)]
    assert [p.first for p in wrong.ready()] == [0]
    sound.made = [points("final", 3)]
    new, again = wrong.ready()
    assert (new.first, again.first) == (3, 0)
    assert height(again) == pytest.approx((np.arange(3.0) + 1e-4).tolist())


def test_what_stalls_holds_final_points_back_and_loses_none():
    sound = Sound()
    wrong = Stalls(sound, rates_hz={"distance": 10.0})
    sound.made = [points("provisional"), points("final")]
    assert [p.state for p in wrong.ready()] == ["provisional"]
    for pushed, there in ((10 * (HELD_S + 9), 0), (20, 1)):
        wrong.push({"distance": np.zeros(int(pushed))})
        assert len(wrong.ready()) == there
    sound.made = [points("final")]
    assert wrong.ready() == []
    assert len(wrong.finish()) == 1


def test_what_leaks_keeps_copies():
    wrong = Leaks(Sound())
    for _ in range(3):
        wrong.push({"left.height": np.zeros(100)})
    assert sum(x.size for x in wrong.kept) == 300


def test_what_depends_on_chunks_smooths_all_but_the_ends():
    sound = Sound()
    x = np.array([0.0, 3.0, 0.0, 0.0, 6.0])
    DependsOnChunks(sound).push({"left.height": x, "distance": x})
    assert sound.pushed[0]["left.height"].tolist() == [0.0, 1.0, 1.0, 2.0, 6.0]
    assert sound.pushed[0]["distance"] is x


def failed_checks(mutant, checks):
    """Return the names of the ``checks`` that fail ``mutant`` with seed 0."""
    return tuple(attempt_stream(StreamTry(f"mutant:{mutant.name}", 0, checks)))


@pytest.mark.slow
@pytest.mark.parametrize("mutant", STREAM_MUTANTS, ids=lambda mutant: mutant.name)
def test_each_is_killed_by_its_check(mutant):
    assert failed_checks(mutant, mutant.fails) == mutant.fails


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.parametrize("mutant", STREAM_MUTANTS, ids=lambda mutant: mutant.name)
def test_each_is_killed_by_no_other_check(mutant):
    others = tuple(id_ for id_ in STREAM_CHECKS if id_ not in mutant.fails)
    assert failed_checks(mutant, others) == ()
