"""A stop is the same profile through every native format as from its recording directory."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floatref import Profile, Recording, Setup, process, read_native
from floatref.engine.recordings.readers import native_of, reader_of
from floatref.mapping.draft.drafting import draft_map
from floatref.measures import iri
from floatref_adapters.testing import WRITERS
from floatref_conformance.proving_ground.scenario import scenario_of_run
from floatref_conformance.proving_ground.simulate import simulate

QUANTA = {"vertical_specific_force": 1e-3, "height": 1e-5, "distance": 1e-4}
INTERVAL_M = 0.05


def left_path(recording: Recording) -> Recording:
    """Return the nominal channels of the left wheel path, every fourth sample of them."""
    found = []
    for channel in recording.channels:
        if channel.id.name in QUANTA and channel.id.track in (None, "left"):
            clock = replace(channel.clock, rate=channel.clock.rate / 4)
            found.append(replace(channel, values=channel.values[::4].copy(), clock=clock))
    setup = Setup(profile_interval_m=INTERVAL_M)
    return replace(recording, channels=tuple(found), setup=setup)


@pytest.fixture(scope="module")
def stop() -> Recording:
    return left_path(simulate(scenario_of_run("sg_10.7s_0.20g")).recording)


@pytest.fixture(scope="module")
def straight(stop: Recording) -> Profile:
    return process(stop)


def mapped(path: Path) -> Recording:
    """Return the recording in ``path`` through a drafted map."""
    reader = reader_of(path, None)
    with native_of(reader, path, {}) as native:
        text = draft_map(native, path, reader.name)
    text = text.replace("profile_interval_m = 0.00508", f"profile_interval_m = {INTERVAL_M}")
    chart = path.with_suffix(".toml")
    chart.write_text(text, encoding="utf-8")
    return read_native(path, chart).recording


def elevation(profile: Profile) -> np.ndarray:
    return profile.track("left").elevation


@pytest.mark.slow
@pytest.mark.parametrize("suffix", WRITERS)
def test_as_float64_the_profile_is_the_same_bit_by_bit(
    suffix: str, stop: Recording, straight: Profile, tmp_path: Path
) -> None:
    WRITERS[suffix](stop, tmp_path / f"run{suffix}", None)
    profile = process(mapped(tmp_path / f"run{suffix}"))
    np.testing.assert_array_equal(elevation(profile), elevation(straight))


@pytest.fixture(scope="module")
def propagated(stop: Recording, straight: Profile) -> float:
    """By how much half a quantum of dither, put onto the recording itself, moves the profile."""
    moved = []
    for seed in range(3):
        draw = np.random.default_rng(seed)
        channels = []
        for channel in stop.channels:
            half = QUANTA[channel.id.name] / 2
            values = channel.values + draw.uniform(-half, half, channel.values.size)
            if channel.id.name == "distance":
                values = np.maximum.accumulate(values)
            channels.append(replace(channel, values=values))
        profile = process(replace(stop, channels=tuple(channels)))
        moved.append(np.nanmax(np.abs(elevation(profile) - elevation(straight))))
    return float(max(moved))


@pytest.mark.slow
@pytest.mark.parametrize("suffix", WRITERS)
def test_in_the_quanta_of_a_logger_it_is_off_by_no_more_than_they_are(
    suffix: str, stop: Recording, straight: Profile, propagated: float, tmp_path: Path
) -> None:
    WRITERS[suffix](stop, tmp_path / f"run{suffix}", QUANTA)
    profile = process(mapped(tmp_path / f"run{suffix}"))
    off = np.nanmax(np.abs(elevation(profile) - elevation(straight)))
    assert 0 < off <= 2 * propagated
    roughness = iri(elevation(profile), INTERVAL_M) / iri(elevation(straight), INTERVAL_M)
    assert abs(roughness - 1) < 1e-3
