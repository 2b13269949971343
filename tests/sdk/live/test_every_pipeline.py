"""Every pipeline is live: with the samples of the whole vehicle, late and in any pieces."""

from dataclasses import replace

import numpy as np
import pytest

from floatref import join_points, pipelines, start_stream
from floatref.live.as_live import clocks_of, run_as_live
from floatref.live.points import State
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


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", pipelines())
def test_a_stream_equals_the_recording_as_live_and_is_as_late_as_declared(
    recording, pieces, same, pipeline
):
    if pipeline.startswith("response"):
        kept = (c for c in recording.channels if c.id.name != "height")
        recording = replace(recording, channels=tuple(kept))
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
