"""An observer sees samples, speed, points and the end, in order."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.live.session.messages import Piece
from floatref.live.session.watch import Odometer, Watch
from floatref.values.clock import UniformClock


class Log(Watch):
    def __init__(self):
        self.calls, self.taken, self.points = [], [], []

    def started(self, stream):
        self.calls.append("started")

    def took(self, taken):
        self.calls.append("took")
        self.taken.append(taken)

    def gave(self, points):
        self.points.append(points)

    def event(self, text):
        self.calls.append(text)

    def ended(self, text):
        self.calls.append(text)


def test_it_sees_the_run(drive, live, tmp_path):
    recording = drive([(20.0, 30.0)])
    messages = live.messages_of(recording, step_s=1.0, provisional=True)
    size = recording.channel("height", "left").values.size
    log = Log()
    answers, error = live.serve(tmp_path / "run", messages, watch=log)
    assert error is None
    assert log.calls[0] == "started"
    assert log.calls[-1] == "complete"
    assert set(log.calls[1:-1]) == {"took"}
    assert sum(t.samples.get("left.height", 0) for t in log.taken) == size
    assert log.taken[-1].speed_mps == pytest.approx(20.0, abs=0.01)
    assert log.taken[-1].distance_m == pytest.approx(600.0, abs=0.5)
    assert log.taken[-1].time_s == pytest.approx(30.0, abs=0.05)
    given = [a for a in answers if a["kind"] == "points"]
    assert [(p.first, str(p.state)) for p in log.points] == [
        (a["first"], a["state"]) for a in given
    ]


def test_it_sees_a_refusal(live, tmp_path):
    log = Log()
    live.serve(tmp_path / "run", [{"kind": "finish"}], watch=log)
    assert log.calls == ["line 1: the first message has to be a hello; send one"]


@given(st.lists(st.integers(1, 400), min_size=1, max_size=30), st.floats(0.5, 40.0), st.booleans())
def test_the_speed_is_that_of_the_last_second(sizes, speed, stamped):
    rate = 100.0
    odometer = Odometer(None if stamped else UniformClock.of(rate, 3.0))
    number = 0
    for size in sizes:
        times = 3.0 + (number + np.arange(size)) / rate
        values = speed * times
        values[::3] = np.nan
        odometer.add(Piece(values, times if stamped else None), number)
        number += size
    taken = odometer.see({"distance": number})
    if taken.speed_mps is not None:
        assert taken.speed_mps == pytest.approx(speed, rel=1e-6)
        assert taken.distance_m == pytest.approx(speed * taken.time_s, rel=1e-9)
    assert taken.samples == {"distance": number}
