"""A run of a stream with a program: times are those of the samples, and faults are named."""

import numpy as np
import pytest

from floatref_conformance.devices.streams.live_session import WINDOW, LiveSession
from floatref_conformance.devices.streams.pieces import cut, even_cuts
from floatref_conformance.devices.streams.questions import say_hello
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceRefused

WRONG = {
    "answers = [{'kind': 'refused', 'text': 'no such rate'}]": "refused: no such rate",
    "answers = [{'kind': 'points'}] if kind == 'hello' else answers": "to hello, expected started",
    "answers = [] if kind == 'hello' else answers; kind == 'hello' and sys.exit(3)": "status 3",
    "answers = answers[:1] if kind == 'sync' else answers": "before it answered every sync",
    "answers += [{'kind': 'finished'}] if kind == 'sync' else []": "finished before it answered",
    "answers += [{'kind': 'hum'}] if kind == 'sync' else []": "kind 'hum'",
    "answers += [{'kind': 'synced', 'number': 7}] if kind == 'sync' else []": "answered sync 7",
    "answers = [float('nan')] if kind == 'sync' else answers": "not JSON",
}


def run(command, recording, length_s=0.1):
    """Return the transcript of a whole run, and the ends of its pieces in s."""
    session = LiveSession(command, say_hello(recording))
    cuts = even_cuts(recording, length_s)
    try:
        for piece in cut(recording, cuts):
            session.push(piece)
        return session.finish(), cuts
    finally:
        session.kill()


def test_what_comes_before_a_sync_is_answered_is_of_the_samples_before_it(program, recording):
    found, cuts = run(program(), recording)
    assert [each.until_s for each in found.final] == list(cuts)
    assert [each.points.first for each in found.final] == list(range(len(cuts)))


def test_a_device_that_waits_for_more_samples_is_not_given_their_time(program, recording):
    late = """
    held = globals().setdefault("held", [])
    if kind == "sync":
        held += [answers]; answers = held.pop(0) if len(held) > 5 else []
    if kind == "finish":
        answers = [a for each in held for a in each] + answers
    """
    found, cuts = run(program(late), recording)
    assert [each.until_s for each in found.final] == list(cuts)


def test_points_that_come_at_the_end_have_no_time_of_the_run(program, recording):
    found, _ = run(
        program(
            """
            if kind == "sync":
                answers = answers[1:]
            if kind == "finish":
                track = {"elevation": [1.0], "valid": [True]}
                answers = [{"kind": "points", "state": "final", "first": 0, "interval_m": 0.25,
                            "tracks": {"left": track}}] + answers
            """
        ),
        recording,
    )
    assert [each.until_s for each in found.final] == [np.inf]


@pytest.mark.slow
@pytest.mark.parametrize("wrong", WRONG)
def test_a_wrong_answer_ends_the_run_with_a_reason(program, recording, wrong):
    with pytest.raises(DeviceError) as caught:
        run(program(wrong), recording)
    assert WRONG[wrong] in str(caught.value)
    assert str(caught.value).startswith("stream: ")
    assert isinstance(caught.value, DeviceRefused) == ("refused" in WRONG[wrong])


@pytest.mark.slow
def test_a_device_that_stops_answering_hangs_when_the_window_is_full(program, recording):
    silent = "answers = [] if kind == 'sync' else answers"
    with pytest.raises(DeviceHung):
        run(program(silent, limit_s=1.0), recording, length_s=1.9 / (WINDOW + 5))
