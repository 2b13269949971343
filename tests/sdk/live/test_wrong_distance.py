"""One wrong sample of the encoder costs what is around it, at whatever time it comes.

Law: the stream cuts the same windows as without it, its axis does not move, and no point is missing
far from the sample. It was once the end of the run where the sample was the last one of a tick.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from floatref import join_points, start_stream
from floatref.live.as_live import clocks_of, run_as_live

PIPELINE, RATE_HZ, LEGS = "temporal-basic", 50.0, [(20.0, 180.0)]
SIZE = round(RATE_HZ * LEGS[0][1])
FAR_M = 120.0
ERRORS = st.sampled_from([50.0, -50.0, 1000.0, 1e5, -5000.0])
AT = st.integers(50, SIZE - 50)
JOINT, END = 3775, 4475
"""The sample at the joint of the first two windows, and the last one of a tick."""


@pytest.fixture(scope="module")
def sound(drive):
    recording = drive(LEGS, rate_hz=RATE_HZ)
    return recording, run_as_live(recording, PIPELINE).profile


def with_wrong(recording, at, error_m):
    channel = recording.channel("distance")
    values = np.array(channel.values)
    values[at] += error_m
    channels = tuple(
        replace(c, values=values) if c.id == channel.id else c for c in recording.channels
    )
    return replace(recording, channels=channels)


def windows_of(profile):
    return [(w["begin_s"], w["end_s"], w["end"]) for w in profile.provenance["live"]["windows"]]


def check(sound, at, error_m):
    recording, expected = sound
    result = run_as_live(with_wrong(recording, at, error_m), PIPELINE)
    found = result.profile
    assert windows_of(found) == windows_of(expected)
    assert found.start_m == expected.start_m
    lost = np.isnan(found["left"].elevation[: expected["left"].elevation.size])
    assert lost.size == expected["left"].elevation.size
    places = found.start_m + found.interval_m * np.arange(lost.size)
    far = np.abs(places - recording.channel("distance").values[at]) > FAR_M
    assert not lost[far].any()
    assert any(line.startswith("channel distance: ") for line in result.warnings)


@settings(max_examples=3, phases=[Phase.explicit, Phase.generate], deadline=None)
@example(END, 50.0)
@example(END, 1e5)
@example(END, -5000.0)
@example(JOINT, 50.0)
@given(AT, ERRORS)
def test_it_costs_what_is_around_it(sound, at, error_m):
    check(sound, at, error_m)


@pytest.mark.slow
@settings(max_examples=100, phases=[Phase.explicit, Phase.generate], deadline=None)
@given(AT, ERRORS)
def test_it_costs_what_is_around_it_at_any_place(sound, at, error_m):
    check(sound, at, error_m)


def test_the_places_of_the_examples_are_what_they_are_called(sound):
    (_, end_s, end), (begin_s, _, _) = windows_of(sound[1])[:2]
    assert end == "joint"
    # The second window begins a run-in of 318 m before the joint, in whole ticks at 20 m/s.
    assert begin_s + 16.0 == JOINT / RATE_HZ
    assert END / RATE_HZ % 0.5 == 0.0
    assert JOINT / RATE_HZ < END / RATE_HZ < end_s


@settings(max_examples=1, phases=[Phase.explicit, Phase.generate], deadline=None)
@given(st.integers(0, 2**31), AT, ERRORS)
def test_a_stream_gives_the_same_points(sound, pieces, same, seed, at, error_m):
    recording = with_wrong(sound[0], at, error_m)
    expected = run_as_live(recording, PIPELINE).profile
    with start_stream(recording.setup, clocks_of(recording), PIPELINE, provisional=False) as stream:
        points = []
        for samples in pieces(recording, seed):
            stream.push(samples)
            points += stream.ready()
        points += stream.finish()
    same(join_points(points), expected)


def test_a_standstill_that_ends_with_a_wrong_sample_does_not_move_the_axis(drive):
    recording = drive([(20.0, 60.0), (0.0, 50.0), (20.0, 60.0)], rate_hz=RATE_HZ)
    expected = run_as_live(recording, PIPELINE).profile
    cut = next(w for w in windows_of(expected) if w[2] == "standstill")
    at = round(cut[1] * RATE_HZ)
    found = run_as_live(with_wrong(recording, at, 50.0), PIPELINE).profile
    assert windows_of(found) == windows_of(expected)
    assert found["left"].elevation.size == expected["left"].elevation.size
