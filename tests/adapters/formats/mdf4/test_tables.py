"""Channels of MDF 4 that asammdf has written with numbers for some values and text for others."""

import contextlib
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import NativeFile
from floatref_adapters.formats.mdf4.adapter import Mdf4

Line = tuple[float, float]
LINES = st.tuples(st.floats(-9, 9), st.floats(-9, 9))


def written(path: Path, raw: np.ndarray, table: dict[str, Any]) -> NativeFile:
    """Return channel `x` with the values ``raw`` and the conversion ``table``."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from asammdf import MDF, Signal
        from asammdf.blocks.conversion_utils import from_dict

        signal = Signal(raw, np.arange(len(raw)) * 0.1, name="x", conversion=from_dict(table))
        with contextlib.closing(MDF(version="4.10")) as mdf:
            mdf.append(signal)
            mdf.save(path, overwrite=True)
    return Mdf4().streams(path, {})


def samples(native: NativeFile) -> list[float]:
    (stream,) = native.streams
    return [float(v) for rows in stream.read(["x"]) for v in rows.values["x"]]


def of_line(line: Line) -> dict[str, Any]:
    return {"a": line[0], "b": line[1], "unit": "m/s"}


@settings(deadline=None, max_examples=40)
@given(
    limits=st.lists(st.integers(0, 200), min_size=2, max_size=8, unique=True).map(sorted),
    entries=st.lists(LINES | st.none(), min_size=4, max_size=4),
    rest=LINES | st.none(),
    raw=st.lists(st.integers(0, 200), min_size=1, max_size=30),
    kind=st.sampled_from(["u1", "i2", "f4"]),
)
def test_ranges_with_a_line_give_numbers_and_those_with_a_text_none(
    tmp_path_factory: pytest.TempPathFactory,
    limits: list[int],
    entries: list[Line | None],
    rest: Line | None,
    raw: list[int],
    kind: str,
) -> None:
    ranges = list(zip(limits[::2], limits[1::2], entries, strict=False))
    table: dict[str, Any] = {"default_addr": b"" if rest is None else of_line(rest)}
    for k, (lower, upper, line) in enumerate(ranges):
        text = b"not available" if line is None else of_line(line)
        table |= {f"lower_{k}": lower, f"upper_{k}": upper, f"text_{k}": text}

    def meant(value: int) -> float:
        for lower, upper, line in ranges:
            if lower <= value < upper or (value == upper and kind != "f4"):
                return np.nan if line is None else line[0] * value + line[1]
        return np.nan if rest is None else rest[0] * value + rest[1]

    path = tmp_path_factory.mktemp("mdf4") / "a.mf4"
    with written(path, np.array(raw, kind), table) as native:
        (column,) = native.streams[0].columns
        if rest is None and not any(line for _, _, line in ranges):
            assert (column.numeric, column.note) == (False, "text by a table")
            return
        assert (column.unit, column.note) == ("m/s", "texts are missing samples")
        np.testing.assert_allclose(samples(native), [meant(value) for value in raw])


def test_texts_of_single_values_are_missing_among_numbers(tmp_path: Path) -> None:
    table: dict[str, Any] = {"default_addr": of_line((0.5, 1.0))}
    for k, value in enumerate((65535, 3, 4)):
        table |= {f"val_{k}": value, f"text_{k}": b"error"}
    with written(tmp_path / "a.mf4", np.array([0, 3, 4, 5, 65535], np.uint16), table) as native:
        np.testing.assert_array_equal(samples(native), [1, np.nan, np.nan, 3.5, np.nan])


@pytest.mark.parametrize("kind", ["u1", "f4"])
def test_a_range_of_numbers_holds_its_upper_limit_where_values_are_integers(
    tmp_path: Path, kind: str
) -> None:
    table: dict[str, Any] = {"default": -1.0}
    for k, (lower, upper) in enumerate(((0, 9), (10, 19))):
        table |= {f"lower_{k}": lower, f"upper_{k}": upper, f"phys_{k}": 100.0 + k}
    with written(tmp_path / "a.mf4", np.array([0, 9, 10, 19, 20], kind), table) as native:
        at_limit = kind == "u1"
        expected = [100, 100 if at_limit else -1, 101, 101 if at_limit else -1, -1]
        np.testing.assert_array_equal(samples(native), expected)
