"""Looking for damage in a file leaves no more of it in memory than a few pieces."""

import re
from pathlib import Path

import numpy as np
import pytest

from floatref.screening.damage.encoder_damage import encoder_damage
from floatref.screening.damage.saturation import find_saturation
from floatref.screening.damage.spikes import find_spikes
from floatref.screening.damage.stuck_sensors import find_stuck_force, find_stuck_height
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel
from floatref.values.scanning import CHUNK

RATE_HZ, COUNT, MEBIBYTE = 4000.0, 16 * CHUNK, 1 << 20
CLOCK = UniformClock.of(RATE_HZ)
LEFT_MIB = 6.0
"""Two pieces, and what the system reads ahead of a few samples; a file has 32 MiB."""
SMAPS = Path("/proc/self/smaps")
pytestmark = pytest.mark.skipif(not SMAPS.exists(), reason="no account of mapped memory here")


def resident_mib(path: Path) -> float:
    """Return how much of the file is in the memory of this process."""
    found, at_file = 0, False
    for line in SMAPS.read_text(encoding="utf-8").splitlines():
        if re.match(r"[0-9a-f]+-[0-9a-f]+ ", line):
            at_file = line.endswith(str(path))
        elif at_file and line.startswith("Rss:"):
            found += 1024 * int(line.split()[1])
    return found / MEBIBYTE


def mapped(path: Path, values: np.ndarray) -> np.ndarray:
    values.astype(np.float64).tofile(path)
    return np.memmap(path, np.float64, "r")


@pytest.fixture
def force(tmp_path):
    """An accelerometer with a spike, a stretch at the end of its range, and a stuck one."""
    values = 9.81 + np.random.default_rng(0).standard_normal(COUNT)
    values[COUNT // 2] += 200.0
    values[5000:5200], values[9000:9400] = values.max(), values[9000]
    path = tmp_path / "force.f64"
    return path, Channel.of("vertical_specific_force", mapped(path, values), CLOCK, track="left")


@pytest.fixture
def height(tmp_path):
    """A laser with a spike that is stuck for a while."""
    values = 0.3 + 1e-3 * np.random.default_rng(1).standard_normal(COUNT)
    values[COUNT // 3] += 0.2
    values[7000:8000] = values[7000]
    path = tmp_path / "height.f64"
    return path, Channel.of("height", mapped(path, values), CLOCK, track="left")


@pytest.fixture
def distance(tmp_path):
    """An encoder that loses counts for a second, in counts of 2 mm at 20 m/s."""
    values = 0.002 * np.floor(20.0 / RATE_HZ * np.arange(COUNT) / 0.002)
    values[40_000:44_000] = values[40_000]
    path = tmp_path / "distance.f64"
    return path, Channel.of("distance", mapped(path, values), CLOCK)


def test_the_account_sees_a_file_that_is_read(force):
    path, channel = force
    assert np.isfinite(channel.values).all()
    assert resident_mib(path) > 0.9 * COUNT * 8 / MEBIBYTE


def test_an_encoder(distance):
    path, channel = distance
    assert encoder_damage(channel).gone.size
    assert resident_mib(path) < LEFT_MIB


def test_an_encoder_with_times(distance, tmp_path):
    path, channel = distance
    times = tmp_path / "times.f64"
    stamps = mapped(times, np.arange(COUNT) / RATE_HZ)
    stamped = Channel.of("distance", channel.values, StampedClock(stamps))
    assert encoder_damage(stamped).gone.size
    assert resident_mib(path) < LEFT_MIB
    assert resident_mib(times) < LEFT_MIB


def test_an_accelerometer(force, distance):
    path, channel = force
    for find in (find_saturation, find_spikes, lambda c: find_stuck_force(c, distance[1])):
        assert find(channel).gone.size
        assert resident_mib(path) < LEFT_MIB, find


def test_a_laser(height, force, distance):
    path, channel = height
    for find in (find_spikes, lambda c: find_stuck_height(c, force[1], distance[1])):
        assert find(channel).gone.size
        assert resident_mib(path) < LEFT_MIB, find
