"""Letting go of mapped samples changes none of them."""

import mmap
from pathlib import Path

import numpy as np
import pytest

from floatref.values.arrays import frozen, read_only, release

SAMPLES = np.arange(100_000.0)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    SAMPLES.tofile(tmp_path / "samples.f64")
    return tmp_path / "samples.f64"


def test_mapped_samples_can_be_read_again(path: Path) -> None:
    values = frozen(np.memmap(path, np.uint8, "r").view("<f8"))
    for part in (values, values[10:20], values[::7]):
        before = part.copy()
        release(part)
        np.testing.assert_array_equal(part, before)


def test_changes_that_are_in_memory_alone_stay(path: Path) -> None:
    values = np.memmap(path, np.float64, "c")
    values[5000] = -1.0
    release(values[4000:6000])
    assert values[5000] == -1.0


def test_an_array_in_memory_stays() -> None:
    values = SAMPLES.copy()
    release(values)
    release(values[3:])
    np.testing.assert_array_equal(values, SAMPLES)


def test_a_system_that_cannot_be_told_is_no_failure(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr(mmap, "MADV_DONTNEED", raising=False)
    values = np.memmap(path, np.float64, "r")
    release(values)
    np.testing.assert_array_equal(values, SAMPLES)


def test_a_column_of_a_table_becomes_an_array_of_its_own():
    table = np.arange(12.0).reshape(4, 3)
    column = frozen(table[:, 1])
    assert column.flags.c_contiguous
    assert column.tolist() == [1.0, 4.0, 7.0, 10.0]
    assert np.shares_memory(frozen(table[2]), table)


@pytest.mark.parametrize("step", [1, 2])
def test_a_read_only_view_shows_later_changes_and_makes_none(step: int) -> None:
    values = SAMPLES.copy()[::step]
    view = read_only(values)
    values[3] = -1.0
    assert view[3] == -1.0
    assert values.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        view[3] = 0.0
