"""The firmware as a stream: `make live` passes the checks of streams, and refuses the rest."""

import json
import subprocess

import numpy as np
import pytest

import floatref
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.executable import ExecDevice
from floatref_conformance.devices.streams.live_session import LiveCommand, LiveSession
from floatref_conformance.devices.streams.pieces import cut, even_cuts
from floatref_conformance.devices.streams.questions import say_hello
from floatref_conformance.devices.streams.transcript import lines_of
from floatref_conformance.judge.exercise import describe
from floatref_conformance.judge.stream_judging import StreamPlan, StreamTrial, judge_streams

pytestmark = [pytest.mark.posix, pytest.mark.slow]


def test_its_points_are_those_of_the_forward_pass(build, simulated, tmp_path):
    recording = simulated(length_m=200.0)
    command = LiveCommand((str(build("live")),), tmp_path, 600.0)
    session = LiveSession(command, say_hello(recording))
    for piece in cut(recording, even_cuts(recording)):
        session.push(piece)
    found = lines_of(session.finish().final)
    speed = floatref.TravelSpeed(4000.0).of(recording.channel("distance").values)
    for name, line in found.items():
        hpf = floatref.AdaptiveHighPass(4000.0)
        force = recording.channel("vertical_specific_force", name).values
        height = recording.channel("height", name).values
        v = integral(hpf.acceleration(force - 9.80665, speed))
        z = integral(hpf.velocity(v, speed)) - hpf.height(height, speed)
        expected = at_points(line.distance_m, recording.channel("distance").values, z)
        np.testing.assert_allclose(line.elevation, expected, atol=1e-9)
        assert line.valid[line.distance_m > 110.0].all()
        assert not line.valid[line.distance_m < 105.0].any()


def at_points(points_m, distance, z):
    """Return ``z`` of the sample that reaches each point first.

    Where samples are further apart than points, it is that of the line between two of them.
    """
    at = np.searchsorted(distance, points_m - 1e-9)
    apart = np.diff(distance, prepend=distance[:1])[at] > points_m[1] - points_m[0] + 1e-9
    return np.where(apart, np.interp(points_m, distance, z), z[at])


def integral(x):
    areas = 0.5 / 4000.0 * (x + np.concatenate((x[:1], x[:-1])))
    areas[0] = 0.0
    return np.cumsum(areas)


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.nightly)])
def test_it_passes_every_check_of_streams(build, seed):
    program = build("live")
    device = ExecDevice((str(program),), program.parent)
    described = describe(device)
    trial = StreamTrial(described, DeviceClass.NOMINAL, seed, Effort.QUICK, lambda event: None)
    found = judge_streams(StreamPlan.of(()), device, trial, lambda: device.close() or "")
    expected = [(id_, Outcome.PASS, "") for id_ in STREAM_CHECKS]
    assert [(r.id, r.outcome, r.reason) for r in found] == expected


@pytest.mark.parametrize(
    ("messages", "named"),
    [
        ([{"kind": "hello"}], "hello without"),
        ([{"kind": "hello", "setup": {"profile_interval_m": 0.1}, "channels": []}], "no channel"),
        ([{"kind": "sample"}], "kind is not"),
    ],
)
def test_what_it_cannot_follow_is_refused_in_one_line(build, messages, named):
    lines = "".join(json.dumps(message) + "\n" for message in messages)
    done = subprocess.run([build("live")], input=lines, capture_output=True, text=True, check=True)
    answer = json.loads(done.stdout)
    assert answer["kind"] == "refused"
    assert named in answer["text"]
