"""Numbers that no road and no sensor has, as damaged files hold: one line of ours, none of numpy.

A warning of numpy fails a test here; to a user it would be a line of its source.
"""

from pathlib import Path

import numpy as np
import pytest

from floatref.files import write_profile, write_recording
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording

SIZES = [1e120, -1e200, 1.7e308]


def profile_with(folder: Path, name: str, size: float | None) -> Path:
    """Write a profile of 200 m with ``size`` at point 77."""
    z = np.cumsum(np.random.default_rng(1).normal(0.0, 4e-4, 4000))
    if size is not None:
        z[77] = size
    write_profile(Profile(0.05, (ProfileTrack.of("left", z),)), folder / name)
    return folder / name


def recording_with(folder: Path, size: float) -> Path:
    """Write a recording with a stop, in which 100 heights are ``size``."""
    clock, times = UniformClock.of(500.0), np.arange(10_000) / 500.0
    speed = 10.0 * np.clip(np.abs(times - 10.5) - 2.5, 0.0, 1.0)
    height = 0.3 - 0.1 / 15.0**2 * np.sin(15.0 * times)
    height[5000:5100] = size
    channels = (
        Channel.of("distance", np.cumsum(speed) / 500.0, clock),
        Channel.of("height", height, clock, "left"),
        Channel.of("vertical_specific_force", 9.8 + 0.1 * np.sin(15.0 * times), clock, "left"),
    )
    write_recording(Recording(channels), folder / "run")
    return folder / "run"


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("damaged", ["reference", "profile"])
def test_a_comparison_names_the_point(size: float, damaged: str, tmp_path: Path, refused) -> None:
    paths = [
        profile_with(tmp_path, name, size if name == damaged else None)
        for name in ("reference", "profile")
    ]
    line = refused("compare", *paths)
    assert str(paths[0]) in line
    assert f"elevation of point 77 is {size:.4g} m, beyond 1000000 m; give elevations in m" in line


@pytest.mark.parametrize("size", SIZES)
def test_a_recording_is_refused_by_channel_and_sample(size: float, tmp_path: Path, refused) -> None:
    run = recording_with(tmp_path, size)
    line = refused("process", run, "--out", tmp_path / "out", "--pipeline", "temporal-basic")
    assert f"{run}: channel left.height: sample 5000 is {size:.4g} m, beyond 100 m" in line


@pytest.mark.parametrize("size", SIZES)
def test_a_page_shows_them_without_a_word_of_numpy(size: float, tmp_path: Path, ran) -> None:
    for source in (recording_with(tmp_path, size), profile_with(tmp_path, "profile", size)):
        result = ran("view", source, "--out", tmp_path / f"{source.name}.html")
        assert result.stderr == ""
