"""One pass over a channel finds what looking at the whole of it finds, and is the only one."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from floatref import Channel
from floatref.errors import InputError
from floatref.values import arrays, scan, scanning
from floatref.values.clock import UniformClock
from floatref.values.scan import REACH, Scan

PART = 4
SAMPLES = npst.arrays(
    np.float64,
    st.integers(1, 40),
    elements=st.one_of(
        st.sampled_from([np.nan, 0.0, -0.0, 1.0, -2.5, 7.0, np.inf, -np.inf, 1.7e308, -1.7e308]),
        st.floats(-1e3, 1e3),
    ),
)
PIECES = settings(deadline=None)


@pytest.fixture(autouse=True, scope="module")
def small_parts() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scanning, "CHUNK", PART)
        yield


def known(values: np.ndarray) -> np.ndarray:
    return values[~np.isnan(values)]


@given(SAMPLES)
@PIECES
def test_every_part_has_its_own_samples(values: np.ndarray) -> None:
    found = Scan.of(values)
    assert found.edges.tolist() == [*range(0, values.size, PART), values.size]
    for k, first in enumerate(found.edges[:-1].tolist()):
        own = values[first : first + PART]
        valid = known(own)
        assert found.missing[k] == own.size - valid.size
        assert found.least[k] == min(valid, default=np.inf)
        assert found.greatest[k] == max(valid, default=-np.inf)


@given(SAMPLES)
@PIECES
def test_steps_reach_into_the_next_part(values: np.ndarray) -> None:
    """A step from or to a sample that is missing does not count."""
    found = Scan.of(values)
    for k, first in enumerate(found.edges[:-1].tolist()):
        wide = values[first : first + PART + REACH].tolist()
        with np.errstate(all="ignore"):
            steps = [float(np.float64(b) - np.float64(a)) for a, b in pairwise(wide)]
        valid = [step for step in steps if step == step]
        assert found.fall[k] == min([0.0, *valid])
        assert found.rise[k] == max([0.0, *valid])
        assert found.leap[k] == max([0.0, *map(abs, valid)])


@given(SAMPLES)
@PIECES
def test_the_summary_is_that_of_the_whole(values: np.ndarray) -> None:
    found, valid = Scan.of(values).summary, known(values)
    assert (found.count, found.missing) == (values.size, values.size - valid.size)
    if not valid.size:
        assert np.isnan([found.mean, found.least, found.greatest]).all()
        return
    assert (found.least, found.greatest) == (valid.min(), valid.max())
    if np.abs(valid).max() < 1e4:
        assert found.mean == pytest.approx(valid.mean(), abs=1e-9)


@given(SAMPLES)
@PIECES
def test_the_largest_sample_is_that_of_either_sign(values: np.ndarray) -> None:
    largest = Scan.of(values).largest
    assert largest == max(np.abs(known(values)), default=-np.inf)


@given(SAMPLES, st.integers(0, 3), st.randoms())
@PIECES
def test_chosen_parts_are_read_again(values: np.ndarray, overlap: int, chance) -> None:  # type: ignore[no-untyped-def]
    found = Scan.of(values)
    chosen = np.array([chance.random() < 0.5 for _ in found.missing], np.bool_)
    parts = dict(found.parts(values, chosen, overlap))
    assert list(parts) == found.edges[:-1][chosen].tolist()
    for first, part in parts.items():
        np.testing.assert_array_equal(part, values[first : first + PART + overlap])


def test_a_scan_holds_where_parts_were_when_it_was_made(monkeypatch: pytest.MonkeyPatch) -> None:
    values = np.arange(10.0)
    found = Scan.of(values)
    monkeypatch.setattr(scanning, "CHUNK", 3)
    assert [first for first, _ in found.parts(values, found.missing == 0)] == [0, 4, 8]


def test_a_channel_is_read_once_whoever_asks(monkeypatch: pytest.MonkeyPatch) -> None:
    reads: list[int] = []
    read = arrays.release
    for module in (scan, scanning):
        monkeypatch.setattr(module, "release", lambda values: (reads.append(1), read(values)))
    values = 9.8 + np.random.default_rng(0).normal(size=40)
    channel = Channel.of("vertical_specific_force", values, UniformClock.of(1000.0), "left")
    for _ in range(3):
        assert channel.scan.summary.count == 40
        assert channel.scan.largest == np.abs(values).max()
    assert len(reads) == 40 // PART


@pytest.mark.parametrize("wrong", [np.inf, -np.inf])
def test_an_infinite_sample_is_named(wrong: float) -> None:
    values = np.full(30, 9.8)
    values[[3, 17, 25]] = np.nan, wrong, wrong
    with pytest.raises(InputError, match="sample 17 is infinite"):
        Channel.of("vertical_specific_force", values, UniformClock.of(1000.0), "left")
