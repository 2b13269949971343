"""Every pipeline is live: with the samples of the whole vehicle, late and in any pieces."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from floatref import join_points, pipelines, start_stream
from floatref.live.as_live import clocks_of, run_as_live
from floatref.live.points import State
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

DRIVE = Scenario(
    manoeuvre="stop",
    event_at_m=700.0,
    length_m=3500.0,
    final_speed_kmh=90.0,
    rate_hz=1000.0,
    response=True,
    seed=5,
)


@pytest.fixture(scope="module")
def recording():
    return simulate(DRIVE).recording


RATES_HZ = {"height": (300.0, 1200.0), "distance": (100.0, 1200.0)}
OTHER_HZ = 200.0, 1000.0
"""Least and greatest rate that is drawn for a channel."""


def needed(recording, pipeline):
    """Return the recording as the pipeline takes it: those from response have no laser."""
    if not pipeline.startswith("response"):
        return recording
    return replace(
        recording, channels=tuple(c for c in recording.channels if c.id.name != "height")
    )


def at_own_rates(recording, seed, stamped):
    """Return a recording in which every channel has a drawn rate and start, but accelerometers.

    These share the clock of a run. Distance has a time for each sample where it is ``stamped``.
    """
    rng = np.random.default_rng(seed)
    return replace(
        recording, channels=tuple(_at_own_rate(c, rng, stamped) for c in recording.channels)
    )


def _at_own_rate(channel, rng, stamped):
    name = channel.id.name
    if not isinstance(channel.clock, UniformClock) or name.endswith("specific_force"):
        return channel
    rate_hz = rng.uniform(*RATES_HZ.get(name, OTHER_HZ))
    begin_s, end_s = channel.span_s
    times = np.arange(begin_s + rng.uniform(0.0, 1.0 / rate_hz), end_s, 1.0 / rate_hz)
    clock = UniformClock.of(rate_hz, times[0])
    if stamped and name == "distance":
        times = times + rng.uniform(0.0, 0.9 / rate_hz, times.size)
        clock = StampedClock.of(times)
    return Channel(channel.id, np.interp(times, channel.times_s, channel.values), clock)


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", pipelines())
@settings(
    max_examples=2,
    deadline=None,
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    seed=st.integers(0, 2**31),
    stamped=st.booleans(),
    most_s=st.floats(0.1, 5.0),
    lateness_s=st.sampled_from([0.0, 1.3, 4.9]),
)
def test_any_rates_pieces_and_lateness_give_the_same_profile(
    recording, pieces, same, pipeline, seed, stamped, most_s, lateness_s
):
    drawn = at_own_rates(needed(recording, pipeline), seed, stamped)
    expected, points = run_as_live(drawn, pipeline).profile, []
    with start_stream(drawn.setup, clocks_of(drawn), pipeline) as stream:
        for piece in pieces(drawn, seed, most_s=most_s, lateness_s=lateness_s):
            stream.push(piece)
            points += stream.ready()
        points += stream.finish()
    assert any(track.valid.any() for track in expected.tracks)
    same(join_points(points), expected)


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", pipelines())
def test_a_stream_equals_the_recording_as_live_and_is_as_late_as_declared(
    recording, pieces, same, pipeline
):
    recording = needed(recording, pipeline)
    expected = run_as_live(recording, pipeline)
    distance = recording.channel("distance")
    seed = len(pipeline)
    points = []
    with start_stream(recording.setup, clocks_of(recording), pipeline) as stream:
        latency = stream.latency
        for piece in pieces(recording, seed, most_s=2.0, lateness_s=4.0):
            stream.push(piece)
            points += stream.ready(wait=True)
        during = [p for p in points if p.state is State.FINAL]
        points += stream.finish()
    same(join_points(points), expected.profile)
    assert during
    # The run goes on for less than the latency behind the joint.
    joint_m = during[-1].distance_m[-1]
    left_m = float(np.nanmax(distance.values)) - joint_m
    assert left_m < latency.travelled_m + 40.0 * latency.then_s
    provisional = [p for p in points if p.state is State.PROVISIONAL]
    assert bool(provisional) == (latency.provisional_s is not None)
    assert bool(provisional) != pipeline.startswith("response")
