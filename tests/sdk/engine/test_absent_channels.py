"""`auto` on every combination of channels: a profile by one that has all of its own, or one line.

No combination makes it ask for an absent channel while another pipeline needs none.
"""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import floatref
from floatref import InputError, Recording
from floatref.builtin_pipelines.signal_flows import NEEDS
from floatref.engine.automatic import run_named_or_best
from floatref.engine.choosing import BEST, choices_for, passed_over
from floatref.engine.plugins import plugins
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

SCENARIO = Scenario(
    manoeuvre="stop", event_at_m=130.0, length_m=280.0, rate_hz=1000.0, profile_interval_m=0.05
)


@pytest.fixture(scope="module")
def whole() -> Recording:
    """Return a recording with every kind of channel that a pipeline reads."""
    return simulate(SCENARIO).recording


def without(recording: Recording, absent: set[str]) -> Recording:
    left = tuple(c for c in recording.channels if str(c.id) not in absent)
    return replace(recording, channels=left)


def reads(name: str, recording: Recording) -> set[tuple[str, str]]:
    """Return name and wheel path of the channels that pipeline ``name`` states it reads."""
    pipeline = plugins().pipeline(name)
    needs = NEEDS[pipeline.architecture](recording)
    force = {(needs.force, track) for track in needs.tracks}
    named = {(each, t) for t in needs.tracks for each in (*pipeline.channels, *pipeline.readings)}
    return {("distance", needs.tracks[0])} | force | named


def absent_of(data: st.DataObject, whole: Recording) -> set[str]:
    names = [str(channel.id) for channel in whole.channels]
    kinds = sorted({channel.id.name for channel in whole.channels})
    some = data.draw(st.sets(st.sampled_from(names), max_size=len(names) - 1))
    gone = data.draw(st.sets(st.sampled_from(kinds), max_size=len(kinds) - 1))
    return some | {str(c.id) for c in whole.channels if c.id.name in gone}


def hold(recording: Recording, absent: set[str], make) -> None:
    """Hold what ``make`` returns, the names of pipelines, or its refusal to the law."""
    try:
        taken = make(recording)
    except InputError as error:
        line = str(error)
        assert "\n" not in line
        assert "missing" in line
        assert any(name.rpartition(".")[2] in line for name in absent), line
        return
    for name in taken:
        for channel, track in reads(name, recording):
            assert recording.find(channel, track) is not None, (name, channel, track)


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(st.data())
def test_the_choices_need_no_absent_channel(whole: Recording, data: st.DataObject) -> None:
    absent = absent_of(data, whole)
    if len(absent) == len(whole.channels):
        return
    known = plugins().pipelines()
    hold(
        without(whole, absent),
        absent,
        lambda recording: [choice.pipeline for choice in choices_for(recording, known)],
    )


@pytest.mark.slow
@settings(deadline=None, max_examples=25)
@given(st.data())
def test_it_gives_a_profile_or_one_line_that_names_an_absent_channel(
    whole: Recording, data: st.DataObject
) -> None:
    absent = absent_of(data, whole)
    if len(absent) == len(whole.channels):
        return

    def make(recording: Recording) -> list[str]:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floatref.FloatrefWarning)
            profile = floatref.process(recording)
        assert profile.provenance["chosen"]["reason"] == dict(BEST)[profile.pipeline]
        return [profile.pipeline]

    hold(without(whole, absent), absent, make)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("gone", "taken"),
    [
        ((), "kalman-smoother-reflection"),
        (("gnss_pitch",), "road-prior-smoother"),
        (("yaw_rate", "gnss_height"), "road-prior-smoother"),
        (("height",), "response-joint-input-state"),
    ],
)
def test_the_next_one_is_taken(whole: Recording, gone: tuple[str, ...], taken: str) -> None:
    absent = {str(c.id) for c in whole.channels if c.id.name in gone}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        assert floatref.process(without(whole, absent)).pipeline == taken


@pytest.fixture(scope="module")
def unfixed(whole: Recording) -> Recording:
    """Return the recording as of a receiver without corrections."""
    channels = tuple(
        replace(c, values=np.ones(c.values.size)) if c.id.name == "gnss_quality" else c
        for c in whole.channels
    )
    return replace(whole, channels=channels)


@pytest.mark.slow
def test_a_reference_that_is_of_no_use_is_not_needed(unfixed: Recording) -> None:
    result = run_named_or_best(unfixed)
    assert result.profile.pipeline == "road-prior-smoother"
    line = "pipeline kalman-smoother-reflection: not taken; no reading of gnss_height is RTK fixed"
    assert result.warnings[0].startswith(line)


@pytest.mark.slow
def test_one_that_is_named_says_which_needs_no_gnss(unfixed: Recording) -> None:
    lines = run_named_or_best(unfixed, "kalman-smoother-reflection").warnings
    assert lines[0] == (
        "kalman-smoother-reflection has no reference: no reading of gnss_height is RTK fixed; "
        "road-prior-smoother needs no GNSS"
    )


def test_the_choice_is_the_next_one_without_a_fixed_reading(unfixed: Recording) -> None:
    known = plugins().pipelines()
    assert choices_for(unfixed, known)[0].pipeline == "road-prior-smoother"
    assert len(list(passed_over(unfixed, known))) == 1
