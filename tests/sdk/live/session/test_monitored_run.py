"""The monitor of an operator counts what a served run has received, dropped and had too late."""

import re

import pytest

from floatref.live.monitor.run_monitor import RunMonitor
from floatref.live.monitor.shown_state import Status

LATE = re.compile(r"channel left\.height: (\d+) samples came more than 5 s later")
CHANNEL = "left.height"


def withheld(pieces, begin, end):
    """Return ``pieces`` in which a channel's samples of ``begin`` to ``end`` come afterwards."""
    taken = [piece["channels"].pop(CHANNEL) for piece in pieces[begin:end]]
    later = [{"kind": "samples", "channels": {CHANNEL: each}} for each in taken]
    return [*pieces[:end], *later, *pieces[end:]]


def test_counts_are_those_of_the_messages(drive, live, tmp_path):
    recording = drive([(20.0, 40.0)])
    hello, *pieces, finish = live.messages_of(recording, step_s=1.0)
    sent = withheld(pieces, 10, 22)
    # Samples of three messages are never sent.
    lost = [piece["channels"].pop(CHANNEL) for piece in sent[-8:-5]]
    monitor = RunMonitor("run")
    answers, error = live.serve(tmp_path / "run", [hello, *sent, finish], watch=monitor)
    shown = monitor.shown()
    assert (error, shown.fault, shown.status) == (None, "", Status.COMPLETE)
    height = next(each for each in shown.sensors if each.name == CHANNEL)
    size = recording.channel("height", "left").values.size
    assert height.dropped == sum(len(each["values"]) for each in lost)
    assert height.samples == size - height.dropped
    texts = [answer["text"] for answer in answers if answer["kind"] == "event"]
    late = sum(int(found[1]) for found in map(LATE.search, texts) if found)
    assert shown.late == height.late == late > 0
    assert {each.text for each in shown.events} == set(texts[-10:])
    assert shown.distance_m == pytest.approx(recording.channel("distance").values[-1])
    assert shown.final_m == pytest.approx(answers[-1]["length_m"], abs=1.0)


def test_a_complete_run_that_is_asked_for_again_is_complete(drive, live, tmp_path):
    hello, *rest = live.messages_of(drive([(20.0, 20.0)]), step_s=2.0)
    live.serve(tmp_path / "run", [hello, *rest])
    monitor = RunMonitor("run")
    _, error = live.serve(tmp_path / "run", [hello], resume=True, watch=monitor)
    assert (error, monitor.shown().status) == (None, Status.COMPLETE)
