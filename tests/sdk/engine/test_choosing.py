"""`auto` takes the first pipeline all of whose channels are there, and never asks for another."""

from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref import Channel, InputError, Recording, UniformClock
from floatref.builtin_pipelines.signal_flows import NEEDS
from floatref.engine.choosing import BEST, choices_for
from floatref.engine.plugins import plugins

TRACKS = "left", "right"
OWN = (
    "vertical_specific_force",
    "height",
    "longitudinal_specific_force",
    "lateral_specific_force",
)
SHARED = (
    *("distance", "roll_rate", "pitch_rate", "yaw_rate"),
    *("gnss_height", "gnss_vertical_velocity", "gnss_pitch", "gnss_roll"),
)
ALL = frozenset(
    [*((name, track) for name in OWN for track in TRACKS), *((s, None) for s in SHARED)]
)


def recorded(names):
    clock = UniformClock.of(1000.0)
    return Recording(
        tuple(Channel.of(n, np.ones(10), clock, track) for n, track in sorted(names, key=str))
    )


def reads(pipeline, recording):
    """Return the channels of one pipeline, by name and wheel path, that have to be there."""
    needs = NEEDS[pipeline.architecture](recording)
    names = *pipeline.channels, *pipeline.readings
    return needs.channels(recording), [(name, track) for name in names for track in needs.tracks]


@given(absent=st.sets(st.sampled_from(sorted(ALL, key=str)), max_size=len(ALL) - 1))
def test_a_choice_never_needs_an_absent_channel(absent):
    recording, known, found = recorded(ALL - absent), plugins().pipelines(), ()
    with suppress(InputError):
        found = choices_for(recording, known)
    for choice in found:
        _, more = reads(known[choice.pipeline], recording)
        assert all(recording.find(name, track) is not None for name, track in more)


@pytest.mark.parametrize(
    ("absent", "best"),
    [
        ((), "kalman-smoother-reflection"),
        ((("gnss_height", None),), "road-prior-smoother"),
        ((("yaw_rate", None),), "road-prior-smoother"),
        ((("lateral_specific_force", "right"),), "road-prior-smoother"),
        ((("height", "right"),), "kalman-smoother-reflection"),
    ],
)
def test_the_sensors_decide(absent, best):
    found = choices_for(recorded(ALL - set(absent)), plugins().pipelines())
    assert found[0].pipeline == best
    assert found[-1].pipeline == "road-prior-smoother"
    assert found[0].reason == dict(BEST)[best]


@pytest.mark.parametrize(
    ("absent", "named"),
    [
        ((("distance", None),), "distance"),
        ((("height", "left"), ("height", "right")), "height"),
        ((("vertical_specific_force", "left"),), "vertical_specific_force"),
    ],
)
def test_without_the_channels_of_any_pipeline_one_of_them_is_named(absent, named):
    with pytest.raises(InputError, match=named):
        choices_for(recorded(ALL - set(absent)), plugins().pipelines())
