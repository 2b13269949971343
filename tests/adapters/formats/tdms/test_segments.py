"""Segments of TDMS: values are found however they are laid, side by side or one by one."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.testing.tdms import (
    BIG,
    INTERLEAVED,
    META,
    NEW,
    RAW,
    doubles,
    lay_out,
    segment,
)
from floatref_adapters.testing.whole_reading import read_whole

read = partial(read_whole, Tdms())


@settings(deadline=None, max_examples=60)
@given(
    channels=st.integers(1, 4),
    chunk=st.integers(1, 5),
    chunks=st.lists(st.integers(1, 4), min_size=2, max_size=5),
    interleaved=st.booleans(),
    repeated=st.booleans(),
    cut=st.integers(0, 60),
)
def test_values_are_found_however_they_are_laid(
    tmp_path_factory: pytest.TempPathFactory,
    channels: int,
    chunk: int,
    chunks: list[int],
    interleaved: bool,
    repeated: bool,
    cut: int,
) -> None:
    path = tmp_path_factory.mktemp("tdms") / "laid.tdms"
    rng = np.random.default_rng(chunk)
    columns = rng.normal(size=(channels, chunk * sum(chunks)))
    flags, data, first = RAW | INTERLEAVED * interleaved, b"", 0
    for number, count in enumerate(chunks):
        part = columns[:, first : first + chunk * count]
        stated = not number or repeated
        metadata = doubles(channels, chunk) if stated else b""
        raw = lay_out(part, chunk, interleaved)
        data += segment(flags | (META | NEW if stated else 0), metadata, raw)
        first += chunk * count
    cut = min(cut, len(raw) - 1)
    path.write_bytes(data[: len(data) - cut])
    native, [(values, _)] = read(path)
    assert bool(cut) == any("cut off" in line for line in native.warnings)
    size, row = 8 * channels * chunk, 8 * channels
    complete, rest = divmod(len(raw) - cut, size)
    rows = rest // row if interleaved else max(rest - (channels - 1) * 8 * chunk, 0) // 8
    expected = columns[:, : (sum(chunks[:-1]) + complete) * chunk + rows]
    assert native.streams[0].count == expected.shape[1]
    for k in range(channels):
        np.testing.assert_array_equal(values[f"c{k}"], expected[k])


def test_high_byte_first_is_read_too(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    rows = lay_out(np.arange(6.0).reshape(2, 3), 3, False)
    little = segment(META | NEW | RAW, doubles(2, 3), rows)
    big = np.arange(6.0, 12).reshape(2, 3).astype(">f8").tobytes()
    path.write_bytes(little + segment(RAW | BIG, b"", big))
    _, [(values, _)] = read(path)
    np.testing.assert_array_equal(values["c0"], [0, 1, 2, 6, 7, 8])
    np.testing.assert_array_equal(values["c1"], [3, 4, 5, 9, 10, 11])


@pytest.mark.parametrize("chunk", [1000, 75_000])
def test_chunks_of_any_size_are_read_in_pieces(tmp_path: Path, chunk: int) -> None:
    path = tmp_path / "a.tdms"
    columns = np.random.default_rng(1).normal(size=(3, 150_000))
    raw = segment(META | NEW | RAW, doubles(3, chunk), lay_out(columns, chunk, False))
    path.write_bytes(raw)
    with Tdms().streams(path, {}) as native:
        pieces = [rows.values["c1"] for rows in native.streams[0].read(["c1"])]
    assert max(map(len, pieces)) <= 65_536
    np.testing.assert_array_equal(np.concatenate(pieces), columns[1])


def test_an_index_of_another_file_changes_nothing(tmp_path: Path) -> None:
    from nptdms import ChannelObject, TdmsWriter

    path = tmp_path / "a.tdms"
    with TdmsWriter(str(path), index_file=True) as writer:
        writer.write_segment([ChannelObject("g", "old", np.arange(30.0))])
    assert path.with_suffix(".tdms_index").is_file()
    assert not Tdms().recognises(path.with_suffix(".tdms_index"))
    columns = np.arange(8.0).reshape(2, 4)
    path.write_bytes(segment(META | NEW | RAW, doubles(2, 4), lay_out(columns, 4, False)))
    _, [(values, _)] = read(path)
    np.testing.assert_array_equal(values["c1"], columns[1])


def test_texts_and_empty_channels_are_told(tmp_path: Path) -> None:
    from nptdms import ChannelObject, TdmsWriter

    with TdmsWriter(str(tmp_path / "a.tdms")) as writer:
        words = ChannelObject("g", "words", ["a", "b"])
        writer.write_segment([words, ChannelObject("g", "none", np.empty(0))])
    native, _ = read(tmp_path / "a.tdms")
    assert native.warnings[0] == "g: 1 channels hold no values"
    assert native.warnings[-1] == "g: 1 channels are text"
    assert not native.streams[0].columns[0].numeric
