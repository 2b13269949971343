"""Short recordings, and programs that answer a stream, sound or wrong."""

import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.devices.streams.live_session import LiveCommand

PROGRAM = """
import json, sys, time
sent = 0
for line in sys.stdin:
    message = json.loads(line)
    kind, answers = message["kind"], []
    if kind == "hello":
        answers = [{"kind": "started", "format": "floatref-live/1",
                    "latency": {"travelled_m": 0, "then_s": 1, "longest_s": 1}}]
    if kind == "sync":
        track = {"elevation": [0.5], "valid": [True]}
        answers = [{"kind": "points", "state": "final", "first": sent, "interval_m": 0.25,
                    "tracks": {"left": track}},
                   {"kind": "synced", "number": message["number"]}]
        sent += 1
    if kind == "finish":
        answers = [{"kind": "finished"}]
    WRONG
    for answer in answers:
        print(json.dumps(answer), flush=True)
    if kind == "finish":
        break
"""


@pytest.fixture
def recording():
    """Return two seconds of two channels at a rate and one with times."""
    times = np.arange(0.0, 2.0, 0.01)
    clock, slow = UniformClock.of(100.0), UniformClock.of(50.0, 0.005)
    stamps = np.arange(0.1, 2.0, 0.3)
    channels = (
        Channel.of("vertical_specific_force", STANDARD_GRAVITY + np.sin(times), clock, "left"),
        Channel.of("height", 0.3 + 0.01 * np.cos(times[::2]), slow, "left"),
        Channel.of("distance", 3.0 * stamps, StampedClock.of(stamps)),
    )
    return Recording(channels, Setup(profile_interval_m=0.25))


@pytest.fixture
def program(tmp_path):
    """Return a maker of commands of a program that answers, with ``wrong`` lines of Python."""

    def make(wrong="pass", limit_s=60.0):
        body = PROGRAM.replace("WRONG", textwrap.indent(textwrap.dedent(wrong), "    ").strip())
        path = tmp_path / "device.py"
        path.write_text(body, encoding="ascii")
        return LiveCommand((sys.executable, str(path)), Path.cwd(), limit_s)

    return make
