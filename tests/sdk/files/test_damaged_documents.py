"""Damage at random never ends in anything but one clear line."""

import shutil
import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files import read_profile, read_recording, write_profile, write_profile_csv
from floatref.screening.plausibility import examine
from floatref.values.profile import Profile, ProfileTrack

PATIENT = settings(
    deadline=None,
    max_examples=150,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
FLIPS = st.lists(st.tuples(st.integers(0, 10**6), st.integers(0, 255)), max_size=4)


def damaged(whole: bytes, flips: list[tuple[int, int]], cut: int) -> bytes:
    content = bytearray(whole)
    for at, byte in flips:
        content[at % len(content)] = byte
    return bytes(content[: len(content) - cut])


def fails_in_one_line(call: Callable[[], object]) -> None:
    """Call, and hold any InputError to one line; whatever else is raised fails the test."""
    line = ""
    try:
        call()
    except InputError as error:
        line = str(error)
    assert "\n" not in line


@pytest.fixture
def scratch() -> Iterator[Path]:
    parent = Path(tempfile.mkdtemp())
    yield parent
    shutil.rmtree(parent)


@given(flips=FLIPS, cut=st.sampled_from([0, 0, 0, 1, 5, 100]))
@PATIENT
def test_a_damaged_recording_document(folder: Path, flips: list[tuple[int, int]], cut: int) -> None:
    document = folder / "recording.json"
    backup = folder.parent / "backup"
    if not backup.exists():
        shutil.copy(document, backup)
    document.write_bytes(damaged(backup.read_bytes(), flips, cut))
    fails_in_one_line(lambda: examine(read_recording(folder)))


@pytest.mark.slow
@given(st.binary(min_size=8, max_size=80), st.sampled_from(["left.height", "distance"]))
@PATIENT
def test_junk_in_a_sample_file(folder: Path, content: bytes, name: str) -> None:
    (folder / f"{name}.f64").write_bytes(content * 8)
    fails_in_one_line(lambda: examine(read_recording(folder)))


@pytest.mark.slow
@given(flips=FLIPS, cut=st.sampled_from([0, 0, 0, 1, 5, 100]))
@PATIENT
def test_a_damaged_profile(scratch: Path, flips: list[tuple[int, int]], cut: int) -> None:
    track = ProfileTrack.of("left", np.array([0.0, 0.001, np.nan, 0.002] * 5))
    profile = Profile(0.25, (track,), settings={"cutoff": 91.44})
    write_profile(profile, scratch / "p", overwrite=True)
    write_profile_csv(profile, scratch / "p.csv", overwrite=True)
    for path in (scratch / "p" / "profile.json", scratch / "p.csv"):
        path.write_bytes(damaged(path.read_bytes(), flips, cut))
        fails_in_one_line(partial(read_profile, path))
