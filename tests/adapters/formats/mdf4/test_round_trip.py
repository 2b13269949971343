"""MDF 4: what is written comes back to the last bit, in pieces of bounded size."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_adapters.formats.mdf4.adapter import Mdf4
from floatref_adapters.testing.mdf4 import MASTER, Stored, StoredGroup, write
from floatref_adapters.testing.whole_reading import read_whole

NS = (1e-9, 0.0)
read = partial(read_whole, Mdf4())


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(
    numbers=st.lists(st.integers(0, 2**64 - 1), min_size=1, max_size=9),
    first=st.integers(0, 7),
    count=st.integers(1, 57),
    size=st.sampled_from([1, 2, 4, 8]),
    order=st.sampled_from("<>"),
    signed=st.booleans(),
    mixed=st.booleans(),
)
def test_a_value_of_any_bits_is_taken_from_among_its_neighbours(
    tmp_path_factory: pytest.TempPathFactory,
    numbers: list[int],
    first: int,
    count: int,
    size: int,
    order: str,
    signed: bool,
    mixed: bool,
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
    marks = np.arange(len(numbers)) % 3 == 2
    field = Stored("x", stored, bits=(first, count), invalid=marks)
    groups = [StoredGroup(name, [master, field]) for name in "gh"[: 1 + mixed]]
    write(groups, path, mixed=mixed)
    expected = [bits >> first & (1 << count) - 1 for bits in whole_bits]
    if signed:
        expected = [v - (1 << count) if v >> (count - 1) else v for v in expected]
    _, numbers_of_groups = read(path)
    assert len(numbers_of_groups) == 1 + mixed
    for values, _ in numbers_of_groups:
        np.testing.assert_array_equal(
            values["x"], np.where(marks, np.nan, np.array(expected, float))
        )


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
