"""The list of faults: long enough, of one thing each, and made by pure functions of a seed."""

from collections import Counter

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.faults.fault_list import FAULTS, find_fault
from floatref_conformance.faults.of_accelerometers import FORCE, G
from floatref_conformance.faults.study import DRIVES, drive_healthy
from floatref_conformance.faults.twins import make_twin

FEWEST, MOST_HIDDEN = 130, 20


def recording() -> Recording:
    """Return 30 s of all channels at 1 kHz, 20 m/s, with something in each."""
    clock = UniformClock.of(1000.0)
    source = np.random.default_rng(0)

    def channel(name: str, level: float, track: str | None = None, size: float = 0.01) -> Channel:
        return Channel.of(name, level + size * source.standard_normal(30_000), clock, track)

    shared = (
        *("roll_rate", "pitch_rate", "yaw_rate"),
        *("gnss_height", "gnss_vertical_velocity", "gnss_pitch", "gnss_quality"),
    )
    sided = ("longitudinal_specific_force", "lateral_specific_force", "suspension_deflection")
    forces = (FORCE, "unsprung_specific_force", "sprung_specific_force")
    channels = [Channel.of("distance", 0.02 * np.arange(30_000.0), clock)]
    channels += [channel(name, 0.0) for name in shared]
    for side in ("left", "right"):
        channels += [channel(name, 0.0, side) for name in sided]
        channels += [channel(name, G, side, 2.0) for name in forces]
        channels.append(channel("height", 0.3, side))
    return Recording(tuple(channels))


def changed(before: Recording, after: Recording) -> set[str]:
    """Return the names of the channels in which two recordings differ."""
    pairs = zip(before.channels, after.channels, strict=True)
    return {
        str(a.id)
        for a, b in pairs
        if a.clock != b.clock or not np.array_equal(a.values, b.values, equal_nan=True)
    }


def test_the_list_is_long_and_little_of_it_is_hidden() -> None:
    assert len(FAULTS) >= FEWEST
    assert 0 < sum(bool(fault.twin) for fault in FAULTS.values()) <= MOST_HIDDEN
    sensors = Counter(fault.sensor for fault in FAULTS.values())
    assert set(sensors) == {"accelerometer", "laser", "sides", "encoder", "imu", "gnss", "response"}
    assert {fault.whole_run for fault in FAULTS.values()} == {True, False}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_changes_its_channel_alone_and_leaves_the_healthy_recording(name: str) -> None:
    healthy, again = recording(), recording()
    faulty = FAULTS[name].damage(healthy)
    if name not in UNTOUCHED:
        assert 1 <= len(changed(healthy, faulty)) <= 4, name
    assert not changed(healthy, again)


UNTOUCHED = ("accelerometer-range-2-g",)
"""Faults that do nothing to a calm recording."""


@pytest.mark.parametrize("name", FAULTS)
def test_random_numbers_follow_from_the_seed(name: str) -> None:
    healthy = recording()
    once, twice = (FAULTS[name].damage(healthy, 7) for _ in range(2))
    assert not changed(once, twice)


def test_an_unknown_fault_is_refused_with_the_nearest_name() -> None:
    with pytest.raises(InputError, match="laser-in-mm"):
        find_fault("laser-in-mmm")


@pytest.mark.slow
@pytest.mark.parametrize("drive", DRIVES)
@pytest.mark.parametrize("name", [f.name for f in FAULTS.values() if f.twin])
def test_a_hidden_fault_has_a_healthy_twin_on_another_road(drive: str, name: str) -> None:
    # A healthy recording with the same samples, and the truth of which is another road.
    twin = make_twin(DRIVES[drive], name)
    assert twin.differ < 0.001
    road, other = drive_healthy(drive)[1].road, twin.healthy.truth
    apart = road.tracks[0].elevation - other.tracks[0].elevation
    assert np.abs(apart).max() > 0.015
