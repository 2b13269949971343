"""A save that fails once, or a signal at any line of the run, costs no point.

Law: after the failure the run resumes, with the samples that `started` asks for, to the profile of
a run without one.
"""

import json
import signal
import sys
import time

import numpy as np
import pytest

from floatref import InputError, read_profile
from floatref.cli.program.interrupts import Interrupt, raising_interrupt
from floatref.files import growing_profile
from floatref.live.as_live import run_as_live
from floatref.live.gathering import Gathering
from floatref.live.session import live_run, run_directory
from floatref.live.session.messages import read_message
from floatref.live.stream import LiveStream

LEGS = [(20.0, 240.0)]
WATCHED = ("live_run.py", "run_directory.py", "growing_profile.py", "stream.py")


@pytest.fixture(scope="module")
def made(drive, live):
    recording = drive(LEGS, rate_hz=50.0)
    return live.messages_of(recording, step_s=5.0), run_as_live(recording, live.PIPELINE).profile


def cut(messages, next_samples):
    """Return ``messages`` without the samples before ``next_samples``."""
    hello, *pieces, finish = json.loads(json.dumps(messages))
    for message in pieces:
        for name, piece in message["channels"].items():
            known = min(max(next_samples[name] - piece["first"], 0), len(piece["values"]))
            piece["first"] += known
            piece["values"] = piece["values"][known:]
    return [hello, *pieces, finish]


@pytest.mark.posix
def test_a_signal_of_a_command_comes_behind_samples_that_are_being_taken(made, live, tmp_path):
    def hear_signal(self, *given):
        signal.raise_signal(signal.SIGTERM)
        return take(self, *given)

    def take_and_wait():
        list(run.take(read_message(made[0][1], "line")))
        taken.append(True)
        for _ in range(600):  # One call would not end by a signal just before it.
            time.sleep(0.05)

    take, taken = Gathering.take, []
    run = live_run.LiveRun(tmp_path / "run", False)
    list(run.greet(read_message(made[0][0], "line")))
    with pytest.MonkeyPatch.context() as patch, raising_interrupt():
        patch.setattr(Gathering, "take", hear_signal)
        with pytest.raises(Interrupt):
            take_and_wait()
    assert taken
    assert list(run.save())
    assert run.is_saved
    run.close()


def test_a_signal_while_the_thread_is_woken_leaves_the_count_of_what_waits(made, tmp_path):
    def interrupt(*_):
        raise KeyboardInterrupt

    run = live_run.LiveRun(tmp_path / "run", False)
    list(run.greet(read_message(made[0][0], "line")))
    stream = run._stream
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stream._changed, "notify_all", interrupt)
        with pytest.raises(KeyboardInterrupt):
            list(run.take(read_message(made[0][1], "line")))
    assert stream._waiting == 0
    assert list(run.save())
    assert run.is_saved
    run.close()


def check_resumes(path, made, live, same):
    messages, expected = made
    answers, _ = live.serve(path, messages[:1], resume=True)
    if answers[-1]["kind"] != "finished":
        _, error = live.serve(path, cut(messages, answers[0]["next"]), resume=True)
        assert error is None
    same(read_profile(path), expected)


def fail_at(call, number):
    """Return ``call``, which fails the ``number``-th time."""
    count = [0]

    def failing(*given):
        count[0] += 1
        if count[0] == number:
            raise InputError("cannot be written (No space left on device)")
        return call(*given)

    return failing


@pytest.mark.parametrize("number", [1, 2, 3, 4, 5, 6])
def test_one_write_that_fails_costs_no_point(made, live, same, tmp_path, number):
    failing = fail_at(growing_profile.append_durably, number)
    with pytest.MonkeyPatch.context() as patch:
        for module in (growing_profile, run_directory):
            patch.setattr(module, "append_durably", failing)
        answers, error = live.serve(tmp_path / "run", made[0])
    assert "No space left" in str(error)
    final = [a for a in answers if a["kind"] == "points" and a["state"] == "final"]
    on_disk = read_profile(tmp_path / "run")["left"].elevation.size if final else 0
    assert sum(len(a["tracks"]["left"]["valid"]) for a in final) == on_disk
    check_resumes(tmp_path / "run", made, live, same)


@pytest.mark.parametrize("number", [2, 3])
def test_one_stream_that_cannot_be_written_costs_no_point(made, live, same, tmp_path, number):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(LiveStream, "save", fail_at(LiveStream.save, number))
        _, error = live.serve(tmp_path / "run", made[0], save_s=0.0)
    assert "No space left" in str(error)
    check_resumes(tmp_path / "run", made, live, same)


class Signal:
    """Raises KeyboardInterrupt at a line of the modules that take and store points."""

    def __init__(self, number):
        self.number, self.count = number, 0

    def __call__(self, frame, event, _):
        if not frame.f_code.co_filename.endswith(WATCHED):
            return None
        if event == "line":
            self.count += 1
            if self.count == self.number:
                raise KeyboardInterrupt
        return self


def serve_with_signal(path, messages, live, number):
    """Serve until a signal at line ``number``; return how many lines were passed."""
    signal = Signal(number)
    before = sys.gettrace()
    sys.settrace(signal)
    try:
        live.serve(path, messages)
    except KeyboardInterrupt:
        pass
    finally:
        sys.settrace(before)
    return signal.count


# A signal at the line that leaves `with open(…)` comes before the file is closed, and Python closes
# it then: of a file it opens, no code in Python can do better. The law is about points.
@pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")
@pytest.mark.parametrize(
    "count", [12, pytest.param(150, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_a_signal_at_any_line_costs_no_point(made, live, same, tmp_path, count):
    lines = serve_with_signal(tmp_path / "whole", made[0], live, -1)
    for number in np.random.default_rng().integers(1, lines, count):
        path = tmp_path / str(number)
        serve_with_signal(path, made[0], live, int(number))
        if path.exists() and not (path / "live.json").exists():
            same(read_profile(path), made[1])
        elif path.exists():
            check_resumes(path, made, live, same)


def test_a_signal_between_ready_and_stored_costs_no_point(made, live, same, tmp_path):
    def interrupt(*_):
        raise KeyboardInterrupt

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run_directory.RunDirectory, "store", fail_once(interrupt))
        with pytest.raises(KeyboardInterrupt):
            live.serve(tmp_path / "run", made[0])
    check_resumes(tmp_path / "run", made, live, same)


def fail_once(interrupt):
    """Return `RunDirectory.store`, interrupted the first time that it has points."""
    store, count = run_directory.RunDirectory.store, [0]

    def failing(self, points, stream, sent):
        if points and not count[0]:
            count[0] += 1
            interrupt()
        store(self, points, stream, sent)

    return failing


def test_a_signal_while_the_end_is_calculated_finds_the_run_saved(made, live, same, tmp_path):
    def interrupt(self):
        finish(self)
        raise KeyboardInterrupt

    finish = LiveStream.finish
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(LiveStream, "finish", interrupt)
        with pytest.raises(KeyboardInterrupt):
            live.serve(tmp_path / "run", made[0])
    answers, _ = live.serve(tmp_path / "run", made[0][:1], resume=True)
    last = made[0][-2]["channels"]
    for name, number in answers[0]["next"].items():
        assert number == last[name]["first"] + len(last[name]["values"])
    check_resumes(tmp_path / "run", made, live, same)


def test_a_run_that_is_torn_keeps_what_was_saved(made, live, same, tmp_path):
    def interrupt(self, samples):
        take(self, samples)
        raise KeyboardInterrupt

    take = LiveStream.take_whole
    run = live_run.LiveRun(tmp_path / "run", False)
    with pytest.MonkeyPatch.context() as patch:
        list(run.greet(read_message(made[0][0], "line")))
        patch.setattr(LiveStream, "take_whole", interrupt)
        with pytest.raises(KeyboardInterrupt):
            list(run.take(read_message(made[0][1], "line")))
    assert not run.is_saved
    assert not list(run.save())
    run.close()
    check_resumes(tmp_path / "run", made, live, same)
