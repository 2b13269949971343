"""The device's side: all points of whatever stream it serves come, and each sync behind them."""

import json
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.profile import ProfileTrack
from floatref_conformance.devices.streams import serving
from floatref_conformance.devices.streams.pieces import cut, even_cuts
from floatref_conformance.devices.streams.questions import say_hello, write_samples
from floatref_conformance.devices.streams.serving import serve_stream


@dataclass(frozen=True)
class Latency:
    travelled_m: float = 1.0
    then_s: float = 0.0
    longest_s: float = 9.0


class Echo:
    """A stream whose points are the heights that were pushed."""

    latency = Latency()

    def __init__(self, setup, clocks):
        self.setup, self.clocks, self.got, self.given = setup, clocks, {}, 0

    def push(self, samples):
        for name, values in samples.items():
            self.got.setdefault(name, []).append(values)

    def ready(self, wait=False):
        heights = np.concatenate([*self.got.get("left.height", []), np.zeros(0)])[self.given :]
        if not heights.size:
            return []
        first, self.given = self.given, self.given + heights.size
        track = ProfileTrack.of("left", heights, sigma=np.abs(heights))
        return [SimpleNamespace(state="final", first=first, interval_m=0.25, tracks=(track,))]

    def finish(self):
        return self.ready()


def served(recording, open_stream, pieces=()):
    answers = []
    messages = [say_hello(recording)]
    for number, piece in enumerate(pieces):
        messages += [json.loads(write_samples(piece.samples)), {"kind": "sync", "number": number}]
    serve_stream(open_stream, [*messages, {"kind": "finish"}], answers.append)
    return answers


@pytest.mark.parametrize("longest", [7, 20_000])
def test_every_point_is_given_once_in_lines_that_are_not_too_long(monkeypatch, recording, longest):
    monkeypatch.setattr(serving, "LONGEST_PIECE", longest)
    made = []

    def open_stream(setup, clocks):
        made.append(Echo(setup, clocks))
        return made[0]

    answers = served(recording, open_stream, cut(recording, even_cuts(recording, 0.3)))
    points = [answer for answer in answers if answer["kind"] == "points"]
    heights = recording.channel("height", "left").values
    assert max(len(p["tracks"]["left"]["elevation"]) for p in points) <= longest
    found = [z for p in points for z in p["tracks"]["left"]["elevation"]]
    assert found == heights.tolist()
    assert [a["number"] for a in answers if a["kind"] == "synced"] == list(range(7))
    assert answers[-1] == {"kind": "finished"}
    times, distances = zip(*made[0].got["distance"], strict=True)
    np.testing.assert_array_equal(np.concatenate(times), recording.channel("distance").times_s)
    np.testing.assert_array_equal(np.concatenate(distances), recording.channel("distance").values)
    assert made[0].setup == recording.setup
    assert made[0].clocks["distance"] is None
    assert made[0].clocks["left.height"] == recording.channel("height", "left").clock


def test_what_the_stream_refuses_is_answered_in_one_line(recording):
    def refuse(setup, clocks):
        raise InputError("channel x: no rate")

    assert served(recording, refuse) == [{"kind": "refused", "text": "channel x: no rate"}]
