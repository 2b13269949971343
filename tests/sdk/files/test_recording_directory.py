"""What is written reads back the same, and what is read obeys the schema."""

import json
import tempfile
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from floatref.errors import InputError
from floatref.files import fingerprint, fingerprint_native, read_recording, write_recording
from floatref.values.channels import CHANNELS
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import AxleSetup, Channel, Recording, Setup, TrackSetup, VehicleSetup

METRES = st.floats(-100, 100)
OFFSET = st.tuples(METRES, METRES, METRES)
TRACKS = st.text(
    st.characters(exclude_characters='/\\:*?"<>|', exclude_categories=("Cc", "Cs")),
    min_size=1,
    max_size=20,
).filter(lambda name: not name.startswith(".") and "\x7f" not in name)
VALUES = npst.arrays(
    np.float64,
    st.integers(1, 9),
    elements=st.floats(allow_infinity=False),
)

VEHICLES = st.builds(
    VehicleSetup,
    st.text(min_size=1, max_size=64),
    st.dictionaries(
        st.text(max_size=20), st.floats(allow_nan=False, allow_infinity=False), max_size=6
    ),
    METRES,
)


@st.composite
def clocks(draw: st.DrawFn, count: int) -> UniformClock | StampedClock:
    if draw(st.booleans()):
        rate = draw(st.floats(0.001, 1e7) | st.integers(1, 48000).map(float))
        return UniformClock.of(rate, draw(st.floats(-1e6, 1e6)))
    steps = draw(st.lists(st.floats(1e-3, 10), min_size=count, max_size=count))
    return StampedClock.of(np.cumsum(steps))


@st.composite
def recordings(draw: st.DrawFn) -> Recording:
    tracks = st.none() | TRACKS
    ids = draw(
        st.lists(st.tuples(st.sampled_from(list(CHANNELS)), tracks), min_size=1, unique=True)
    )
    channels = []
    for name, track in ids[:6]:
        values = draw(VALUES)
        channels.append(Channel.of(name, values, draw(clocks(values.size)), track))
    setup = Setup(
        draw(st.floats(1e-5, 10)),
        draw(OFFSET),
        draw(st.dictionaries(TRACKS, st.builds(TrackSetup, OFFSET, OFFSET), max_size=3)),
        draw(st.none() | VEHICLES),
        draw(st.none() | st.builds(AxleSetup, st.floats(0.5, 20), st.floats(-100, 100))),
    )
    return Recording(tuple(channels), setup, draw(st.text()), draw(st.text()))


def assert_same(found: Recording, expected: Recording) -> None:
    assert [c.id for c in found.channels] == [c.id for c in expected.channels]
    for ours, theirs in zip(found.channels, expected.channels, strict=True):
        np.testing.assert_array_equal(ours.values, theirs.values)
        np.testing.assert_array_equal(ours.times_s, theirs.times_s)
        if isinstance(theirs.clock, UniformClock):
            assert ours.clock == theirs.clock
    assert found.setup == expected.setup
    assert (found.vendor, found.model) == (expected.vendor, expected.model)


@pytest.mark.slow
@given(recordings())
@settings(deadline=None, max_examples=40)
def test_a_recording_written_reads_back_the_same(recording: Recording) -> None:
    with tempfile.TemporaryDirectory() as parent:
        write_recording(recording, Path(parent) / "run")
        assert_same(read_recording(Path(parent) / "run"), recording)
        assert_same(read_recording(Path(parent) / "run" / "recording.json"), recording)


def test_samples_are_little_endian_float64_in_the_order_of_time(folder: Path) -> None:
    raw = (folder / "gnss_height.f64").read_bytes()
    assert raw[:8] == bytes.fromhex("0000000000005940")
    assert len(raw) == 24


def test_samples_are_mapped_from_the_file_and_read_only(folder: Path) -> None:
    values = read_recording(folder).channel("height", "left").values
    base: object = values
    while isinstance(base, np.ndarray) and not isinstance(base, np.memmap):
        base = base.base
    assert isinstance(base, np.memmap)
    with pytest.raises(ValueError, match="read-only"):
        values[0] = 1.0


def test_channels_on_one_clock_share_their_time_file(tmp_path: Path) -> None:
    clock = StampedClock.of([0.0, 0.5, 1.5])
    names = ("gnss_height", "gnss_pitch")
    recording = Recording(tuple(Channel.of(name, [1, 2, 3], clock) for name in names))
    write_recording(recording, tmp_path / "run")
    assert len(list((tmp_path / "run").glob("*.time.f64"))) == 1
    first, second = read_recording(tmp_path / "run").channels
    assert first.clock is second.clock


def test_tracks_that_differ_by_case_only_keep_files_of_their_own(tmp_path: Path) -> None:
    clock = UniformClock.of(100.0)
    pair = tuple(Channel.of("height", [x, x], clock, t) for x, t in ((1.0, "a"), (2.0, "A")))
    write_recording(Recording(pair), tmp_path / "run")
    names = [path.name.casefold() for path in (tmp_path / "run").iterdir()]
    assert len(names) == len(set(names)) == 3
    assert read_recording(tmp_path / "run").channel("height", "A").values[0] == 2.0


def test_what_is_left_out_of_the_document_takes_its_default(tmp_path: Path) -> None:
    np.arange(4, dtype="<f8").tofile(tmp_path / "d.f64")
    channel = {"name": "distance", "unit": "m", "file": "d.f64", "rate_hz": 8, "start_s": 0}
    document = {"format": "floatref-recording/1", "channels": [channel | {"colour": "red"}]}
    (tmp_path / "recording.json").write_text(json.dumps(document | {"unknown": [1]}))
    recording = read_recording(tmp_path)
    assert recording.setup == Setup()
    assert recording.tracks == ("main",)
    assert recording.channel("distance", "main").clock == UniformClock(Fraction(8), 0.0)


def test_a_recording_can_replace_the_directory_it_is_mapped_from(folder: Path) -> None:
    before = read_recording(folder)
    write_recording(before, folder, overwrite=True)
    assert_same(read_recording(folder), before)


@pytest.mark.parametrize("track", ["a/b", "..", ".hidden", "", "a" * 49, "x\n", "\ud800", "a\\b"])
def test_a_track_that_cannot_name_a_file_is_refused_on_writing(track: str, tmp_path: Path) -> None:
    channel = Channel.of("height", [0.3], UniformClock.of(1.0), track)
    with pytest.raises(InputError, match=r"channels\[0\]\.track .* expected the name of a wheel"):
        write_recording(Recording((channel,)), tmp_path / "run")
    assert list(tmp_path.iterdir()) == []


def test_geometry_far_outside_a_vehicle_is_refused_on_writing(tmp_path: Path) -> None:
    channel = Channel.of("height", [0.3], UniformClock.of(1.0))
    setup = Setup(gnss_antenna_offset_m=(0.0, 0.0, 2000.0))
    with pytest.raises(InputError, match=r"setup.gnss_antenna_offset_m\[2\] is 2000.0; .* 100 m"):
        write_recording(Recording((channel,), setup), tmp_path / "run")
    setup = Setup(gnss_antenna_offset_m=(0.0, 0.0, np.inf))
    with pytest.raises(InputError, match=r"gnss_antenna_offset_m\[2\] is inf"):
        write_recording(Recording((channel,), setup), tmp_path / "run")


def test_a_vehicle_that_a_document_cannot_hold_is_refused_on_writing(tmp_path: Path) -> None:
    channel = Channel.of("height", [0.3], UniformClock.of(1.0))
    for vehicle, said in (
        (
            VehicleSetup("m" * 65, {}),
            r"setup\.vehicle\.model is .*; expected the name of a vehicle",
        ),
        (VehicleSetup("m", {str(k): 1.0 for k in range(65)}), "an object of at most 64 numbers"),
    ):
        with pytest.raises(InputError, match=said):
            write_recording(Recording((channel,), Setup(vehicle=vehicle)), tmp_path / "run")
        assert list(tmp_path.iterdir()) == []


def test_the_fingerprint_is_the_sha256_of_every_file(folder: Path) -> None:
    import hashlib

    found = fingerprint(folder)
    assert set(found) == {path.name for path in folder.iterdir()}
    for name, digest in found.items():
        assert digest == hashlib.sha256((folder / name).read_bytes()).hexdigest()
    assert fingerprint(folder / "recording.json") == found


def test_the_fingerprint_of_a_native_file_is_its_own(tmp_path: Path) -> None:
    (tmp_path / "run.bin").write_bytes(b"abc")
    known = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    assert fingerprint_native(tmp_path / "run.bin") == {"run.bin": known}
    (tmp_path / "folder").mkdir()
    assert fingerprint_native(tmp_path) == {"run.bin": known}
