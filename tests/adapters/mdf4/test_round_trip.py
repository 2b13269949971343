"""MDF 4: what is written comes back to the last bit, in pieces of bounded size."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Recording
from floatref.engine.plugins import plugins
from floatref_adapters.mdf4.adapter import Mdf4
from floatref_adapters.testing.mdf4 import write_mdf4
from floatref_adapters.testing.mdf4_blocks import MASTER, Stored, StoredGroup, write
from floatref_adapters.testing.reading import read_whole

NS = (1e-9, 0.0)
Make = Callable[..., st.SearchStrategy[Recording]]
Check = Callable[..., None]
tracks = st.text("aß中 .#2", min_size=1, max_size=4).filter(lambda name: name == name.strip())
read = partial(read_whole, Mdf4())


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(data=st.data())
def test_a_recording_comes_back_to_the_last_bit(
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
    recordings: Make,
    check_round_trip: Check,
) -> None:
    recording = data.draw(recordings(tracks))
    path = tmp_path_factory.mktemp("mdf4") / "run.dat"
    write_mdf4(recording, path)
    assert Mdf4().recognises(path)
    check_round_trip(Mdf4(), recording, path, lambda _: 0.0)


@settings(deadline=None, max_examples=25)
@given(data=st.data(), quantum=st.sampled_from([1e-6, 0.01, 0.3]))
def test_integers_are_within_half_a_quantum_and_missing_samples_stay_missing(
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
    quantum: float,
    recordings: Make,
    check_round_trip: Check,
) -> None:
    recording = data.draw(recordings(tracks))
    path = tmp_path_factory.mktemp("mdf4") / "run.mf4"
    write_mdf4(recording, path, {"height": quantum})
    rounding = 4 * np.spacing(1e6)
    stored = {"height": quantum / 2 + rounding}
    check_round_trip(Mdf4(), recording, path, lambda channel: stored.get(channel.id.name, 0.0))


@settings(deadline=None, max_examples=40)
@given(
    numbers=st.lists(st.integers(0, 2**64 - 1), min_size=1, max_size=9),
    first=st.integers(0, 7),
    count=st.integers(1, 57),
    size=st.sampled_from([1, 2, 4, 8]),
    order=st.sampled_from("<>"),
    signed=st.booleans(),
)
def test_a_value_of_any_bits_is_taken_from_among_its_neighbours(
    tmp_path_factory: pytest.TempPathFactory,
    numbers: list[int],
    first: int,
    count: int,
    size: int,
    order: str,
    signed: bool,
) -> None:
    path = tmp_path_factory.mktemp("mdf4") / "bits.mf4"
    count = min(count, 8 * size - first)
    whole_bits = [number % 2 ** (8 * size) for number in numbers]
    stored = np.array(whole_bits, f"u{size}").astype(f"{order}u{size}")
    if signed:
        stored = stored.view(f"{order}i{size}")
    # What is stored high byte first is as many bytes as the bits take, from the first byte on.
    taken = -(-(first + count) // 8)
    if order == ">":
        whole_bits = [bits >> 8 * (size - taken) for bits in whole_bits]
    master = Stored("t", np.arange(len(numbers)), "s", NS, MASTER)
    write([StoredGroup("g", [master, Stored("x", stored, bits=(first, count))])], path)
    expected = [bits >> first & (1 << count) - 1 for bits in whole_bits]
    if signed:
        expected = [v - (1 << count) if v >> (count - 1) else v for v in expected]
    _, [(values, _)] = read(path)
    np.testing.assert_array_equal(values["x"], np.array(expected, float))


def test_reading_begins_anew_and_two_streams_can_be_read_in_turn(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    n = 200_000
    groups = [
        StoredGroup(
            name, [Stored("t", np.arange(n), "s", NS, MASTER), Stored("x", np.arange(n) * k)]
        )
        for k, name in ((2.0, "a"), (3.0, "b"))
    ]
    write(groups, path)
    with Mdf4().streams(path, {}) as native:
        a, b = native.streams
        for one, other in zip(a.read(["x"]), b.read(["x"]), strict=True):
            assert len(one.values["x"]) <= 65_536
            np.testing.assert_array_equal(one.values["x"] * 3, other.values["x"] * 2)
        assert sum(len(rows.values["x"]) for rows in a.read(["x"])) == n
        assert sum(len(rows.ticks) for rows in a.read([]) if rows.ticks is not None) == n


def test_floatref_finds_the_adapter_through_its_entry_point() -> None:
    assert plugins().adapters()["mdf4"].summary == Mdf4.summary
