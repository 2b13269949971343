"""A short recording for hostile programs, none of which may outlive its test."""

import os
from pathlib import Path

import numpy as np
import pytest

from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup

RATE_HZ, LENGTH_S, SPEED_MPS, INTERVAL_M = 200.0, 2.0, 10.0, 0.05


def children():
    """Return the processes whose parent is this one, dead ones that nobody waited for too."""
    found = set()
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            words = Path("/proc", entry, "stat").read_text(errors="replace").rpartition(")")[2]
        except OSError:
            continue
        if int(words.split()[1]) == os.getpid():
            found.add(int(entry))
    return found


@pytest.fixture(autouse=True)
def no_process_is_left():
    before = children()
    yield
    assert children() <= before


@pytest.fixture
def recording():
    times = np.arange(int(RATE_HZ * LENGTH_S)) / RATE_HZ
    samples = {
        "vertical_specific_force": 9.80665 + 1e-9 * np.cos(times),
        "height": 0.3 + 0.01 * np.sin(times),
    }
    channels = [
        # No two sensors have the same samples.
        Channel.of(name, values + own, UniformClock.of(RATE_HZ), track)
        for name, values in samples.items()
        for track, own in (("left", 0.0), ("right", 0.001))
    ]
    channels.append(Channel.of("distance", SPEED_MPS * times, UniformClock.of(RATE_HZ)))
    return Recording(tuple(channels), Setup(INTERVAL_M))
