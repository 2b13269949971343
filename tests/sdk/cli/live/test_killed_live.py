"""SIGKILL of `floatref live`, or of its peer, at random moments: no final point is lost or changed.

The peer is a file that is fed slowly; whoever is killed, the run is resumed, and goes on. Between
all of it the profile on the disk can be read, and is the beginning of that of the whole run.
"""

import json
import os
import select
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from floatref import read_profile
from floatref.live.as_live import run_as_live

pytestmark = pytest.mark.posix
LEGS = [(20.0, 240.0)]
PIPELINE = "temporal-basic"
LIVE = [sys.executable, "-m", "floatref", "live", "-o"]
WAIT_S = 300.0


@pytest.fixture(scope="module")
def run(drive, messages_of):
    """Return the messages of a run, and its profile."""
    recording = drive(LEGS)
    return messages_of(recording, step_s=1.0), run_as_live(recording, PIPELINE).profile


def start(path: Path, *more: str) -> subprocess.Popen[bytes]:
    resume = ["--resume"] if path.exists() else []
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with said_by(path).open("ab") as said:
        return subprocess.Popen([*LIVE, str(path), *resume, *more], stderr=said, **pipes)


def said_by(path):
    """Return the file of what the commands write to standard error."""
    return path.with_name("said.txt")


def feed(process, messages, pause_s):
    """Send ``messages`` after ``hello``, from the sample that the answer to it names."""
    try:
        write(process, messages[0])
        answer = json.loads(process.stdout.readline() or b"{}")
        begin = answer.get("next", {}).get("distance", 0)
        for message in messages[1:]:
            distance = message.get("channels", {}).get("distance")
            if distance is None or distance["first"] + len(distance["values"]) > begin:
                write(process, message)
                time.sleep(pause_s)
        process.stdin.close()
    except BrokenPipeError:
        pass


def write(process, message):
    process.stdin.write(json.dumps(message).encode() + b"\n")
    process.stdin.flush()


def check_prefix(path, expected, known):
    """Assert that the profile begins as ``expected`` does and has the ``known`` points."""
    if not (path / "profile.json").exists():
        assert known == 0
        return 0
    track = read_profile(path)["left"]
    count = track.elevation.size
    assert count >= known
    np.testing.assert_array_equal(track.elevation, expected["left"].elevation[:count])
    np.testing.assert_array_equal(track.valid, expected["left"].valid[:count])
    return count


def read_on(process, path, expected, known, until_s):
    """Read answers until a moment; every final point is on the disk before it is given out."""
    os.set_blocking(process.stdout.fileno(), False)
    rest = b""
    while time.monotonic() < until_s and process.poll() is None:
        rest += process.stdout.read() or b""
        *lines, rest = rest.split(b"\n")
        for answer in map(json.loads, lines):
            if answer["kind"] == "points" and answer["state"] == "final":
                end = answer["first"] + len(answer["tracks"]["left"]["valid"])
                known = max(known, end - round(expected.start_m / expected.interval_m))
                assert check_prefix(path, expected, known) >= known
        time.sleep(0.01)
    return known


@contextmanager
def fed_slowly(path, messages, rng):
    """Yield the command and its peer, which sends ``messages`` and then says nothing more."""
    process = start(path, "--save-every", str(rng.choice([0.0, 0.2, 2.0])))
    pause_s = str(rng.uniform(0.0, 0.01))
    pipes = {"stdin": subprocess.PIPE, "stdout": process.stdin}
    feeder = subprocess.Popen([sys.executable, "-c", FEEDER, pause_s], **pipes)
    try:
        process.stdin.close()
        feeder.stdin.write(b"".join(json.dumps(m).encode() + b"\n" for m in messages))
        feeder.stdin.close()
        yield process, feeder
    finally:
        for each in (process, feeder):
            each.kill()
            each.wait(WAIT_S)
        process.stdout.close()


def kill_often(run, path, same, times, seed):
    """Kill the command or its peer ``times`` times, each at another moment; then let it finish."""
    messages, expected = run
    rng = np.random.default_rng(seed)
    known = 0
    for _ in range(times):
        with fed_slowly(path, messages[:-1], rng) as victims:
            process, victim = victims[0], victims[rng.integers(2)]
            if rng.uniform() < 0.8:
                select.select([process.stdout], [], [], WAIT_S)
            until_s = time.monotonic() + rng.uniform(0.0, 4.0)
            known = read_on(process, path, expected, known, until_s)
            # Neither ends by itself: the peer goes on and says nothing more.
            assert process.poll() is None, said_by(path).read_text()
            os.kill(victim.pid, signal.SIGKILL)
            known = read_on(process, path, expected, known, time.monotonic() + 0.5)
        known = check_prefix(path, expected, known)
    with start(path) as last:
        feed(last, messages, 0.0)
        answers = last.stdout.read().splitlines()
    assert last.returncode == 0, said_by(path).read_text()
    assert json.loads(answers[-1])["kind"] == "finished"
    same(read_profile(path), expected)


FEEDER = """
import sys, time
for line in sys.stdin.buffer.readlines():
    sys.stdout.buffer.write(line)
    sys.stdout.buffer.flush()
    time.sleep(float(sys.argv[1]))
time.sleep(3600.0)
"""
"""A peer that sends what it is given, with pauses, and stays."""


@pytest.mark.slow
@pytest.mark.parametrize("part", range(4))
def test_killed_at_random_moments_nothing_final_is_lost(run, same, tmp_path, part):
    kill_often(run, tmp_path / "run", same, 5, time.time_ns() % 2**32 + part)
