"""A stream that is saved and resumed goes on as if it had not been."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref import InputError, StageError, join_points, resume_stream, start_stream
from floatref.live.as_live import clocks_of, run_as_live
from floatref.live.points import State

LEGS = [(20.0, 100.0), (0.0, 60.0), (20.0, 100.0)]


@pytest.fixture(scope="module")
def made(drive):
    recording = drive(LEGS, tracks=("left", "right"), distance="times", height_hz=150.0)
    return recording, run_as_live(recording, "road-prior-smoother").profile


@pytest.mark.slow
@settings(max_examples=6, phases=[Phase.explicit, Phase.generate])
@given(st.integers(0, 2**31), st.lists(st.integers(0, 150), min_size=1, max_size=3))
def test_a_resumed_stream_gives_the_same_profile(
    made, pieces, same, tmp_path_factory, seed, stopped
):
    recording, expected = made
    path = tmp_path_factory.mktemp("saved") / "stream.npz"
    stream = start_stream(recording.setup, clocks_of(recording), "road-prior-smoother")
    points = []
    for number, piece in enumerate(pieces(recording, seed, lateness_s=3.0)):
        stream.push(piece)
        if number in stopped:
            points += stream.ready(wait=True)
            stream.save(path)
            stream.close()
            stream = resume_stream(path)
    points += stream.finish()
    same(join_points(points), expected)


@pytest.mark.slow
def test_a_state_is_saved_again_as_it_was(made, pieces, tmp_path):
    recording, _ = made
    with start_stream(recording.setup, clocks_of(recording), "temporal-basic") as stream:
        for piece, _ in zip(pieces(recording, 5), range(80), strict=False):
            stream.push(piece)
        stream.save(tmp_path / "one.npz")
    with resume_stream(tmp_path / "one.npz") as again:
        again.save(tmp_path / "two.npz")
    one, two = (np.load(tmp_path / f"{name}.npz") for name in ("one", "two"))
    assert sorted(one.files) == sorted(two.files)
    assert all(one[name].tobytes() == two[name].tobytes() for name in one.files)


def test_provisional_points_come_again_after_a_resumption(made, pieces, tmp_path):
    recording, _ = made
    pushes = list(pieces(recording, 5))
    with start_stream(recording.setup, clocks_of(recording), "temporal-basic") as stream:
        for piece in pushes[:30]:
            stream.push(piece)
        stream.save(tmp_path / "saved.npz")
    with resume_stream(tmp_path / "saved.npz") as again:
        for piece in pushes[30:60]:
            again.push(piece)
        states = {points.state for points in again.ready(wait=True)}
    assert State.PROVISIONAL in states


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"hello"])
def test_a_file_that_is_no_saved_stream_is_named(tmp_path, content):
    path = tmp_path / "other.npz"
    path.write_bytes(content)
    with pytest.raises(InputError, match="is no saved stream"):
        resume_stream(path)


def test_a_file_whose_places_are_wrong_is_no_saved_stream(tmp_path):
    """Its first array begins two bytes before the file."""
    np.savez(tmp_path / "other.npz", state=np.zeros(3, np.uint8))
    data = bytearray((tmp_path / "other.npz").read_bytes())
    data[data.rindex(b"PK\x05\x06") + 16] += 2
    (tmp_path / "other.npz").write_bytes(data)
    with pytest.raises(InputError, match="is no saved stream"):
        resume_stream(tmp_path / "other.npz")


def test_a_file_that_is_missing_or_of_another_version_is_named(made, tmp_path):
    with pytest.raises(InputError, match=r"missing\.npz: cannot be read"):
        resume_stream(tmp_path / "missing.npz")
    recording, _ = made
    path = tmp_path / "saved.npz"
    with start_stream(recording.setup, clocks_of(recording), "temporal-basic") as stream:
        stream.save(path)
    with np.load(path) as stored:
        arrays = dict(stored)
    text = arrays["state"].tobytes().replace(b'"floatref": "', b'"floatref": "9')
    arrays["state"] = np.frombuffer(text, np.uint8)
    with path.open("wb") as out:
        np.savez(out, **arrays)
    with pytest.raises(InputError, match=r"was saved by floatref 9.*resume it with that version"):
        resume_stream(path)


@pytest.mark.parametrize("lost", ["state", "values_0", "times_1", "places"])
def test_a_file_without_one_of_its_arrays_is_named(made, tmp_path, lost):
    """A checksum protects what an array holds, and not its name."""
    path = tmp_path / "saved.npz"
    with start_stream(made[0].setup, clocks_of(made[0]), "temporal-basic") as stream:
        stream.save(path)
    with np.load(path) as stored:
        arrays = {name: stored[name] for name in stored.files if name != lost}
    with path.open("wb") as out:
        np.savez(out, **arrays)
    with pytest.raises(InputError, match=rf"saved\.npz: .*no array {lost}\)?; give a"):
        resume_stream(path)


def test_a_stream_that_has_ended_cannot_be_saved(made, tmp_path):
    recording, _ = made
    stream = start_stream(recording.setup, clocks_of(recording), "temporal-basic")
    stream.close()
    with pytest.raises(StageError, match="save: the stream has ended"):
        stream.save(tmp_path / "late.npz")
    assert not list(tmp_path.iterdir())
