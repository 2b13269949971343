"""The extremes of a long line: every level holds those of the samples it covers, and no other."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from floatref.errors import InputError
from floatref.values.parts.extremes import COARSER, FEWEST_BINS, Extremes, samples_per_bin
from floatref.values.scanning import CHUNK

VALUES = arrays(
    np.float64, st.integers(1, 1500), elements=st.floats(-1e6, 1e6) | st.just(float("nan"))
)
FEW = settings(max_examples=25)
POWERS = st.integers(0, 6).map(lambda power: 1 << power)


def bins_of(values: np.ndarray, samples: int) -> list[np.ndarray]:
    """Return the samples of every bin, written plainly."""
    return [values[k : k + samples] for k in range(0, values.size, samples)]


def check(found: Extremes, values: np.ndarray) -> None:
    """Hold ``found`` to the samples it covers."""
    expected = bins_of(values, found.samples)
    assert found.low.size == found.high.size == found.missing.size == len(expected)
    for low, high, missing, samples in zip(
        found.low, found.high, found.missing, expected, strict=True
    ):
        known = samples[~np.isnan(samples)]
        assert missing == (known.size < samples.size)
        if known.size:
            assert (low, high) == (known.min(), known.max())
        else:
            assert np.isnan(low)
            assert np.isnan(high)


@given(VALUES, POWERS)
@FEW
def test_every_level_has_the_extremes_of_its_samples(values: np.ndarray, samples: int) -> None:
    levels = Extremes.of(values, samples).levels()
    for coarser, level in enumerate(levels):
        assert level.samples == samples * COARSER**coarser
        check(level, values)
    assert levels[-1].low.size <= FEWEST_BINS


@given(VALUES, POWERS, st.data())
@FEW
def test_what_is_not_used_has_no_value(
    values: np.ndarray, samples: int, data: st.DataObject
) -> None:
    used = data.draw(arrays(np.bool_, values.size))
    check(Extremes.of(values, samples, used), np.where(used, values, np.nan))


@given(VALUES, POWERS)
@FEW
def test_a_spread_widens_both_ends(values: np.ndarray, samples: int) -> None:
    spread = np.abs(np.sin(np.arange(values.size)))
    found = Extremes.of(values, samples, spread=spread)
    np.testing.assert_array_equal(found.low, Extremes.of(values - spread, samples).low)
    np.testing.assert_array_equal(found.high, Extremes.of(values + spread, samples).high)


def test_pieces_join_where_a_line_is_longer_than_one() -> None:
    values = np.random.default_rng(0).normal(size=CHUNK + 1000)
    values[CHUNK - 5 : CHUNK + 5] = np.nan
    check(Extremes.of(values, 1024), values)


@given(st.integers(1, 10**9), st.integers(FEWEST_BINS, 10**6))
def test_bins_are_as_fine_as_may_be(count: int, most: int) -> None:
    samples = samples_per_bin(count, most)
    assert samples & (samples - 1) == 0
    assert -(-count // samples) <= most or samples == CHUNK
    assert samples == 1 or -(-count // (samples // 2)) > most


@pytest.mark.parametrize("samples", [0, 3, 2 * CHUNK])
def test_a_bin_that_does_not_fit_a_piece_is_refused(samples: int) -> None:
    with pytest.raises(InputError, match="a power of two"):
        Extremes.of(np.zeros(10), samples)
