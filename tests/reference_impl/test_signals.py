"""A signal is one-dimensional, non-empty and finite; sums keep extended precision."""

import numpy as np
import pytest

from floatref_reference.signals import mean, samples, signal


@pytest.mark.parametrize("bad", [[], [[1.0, 2.0]], [1.0, np.nan], [np.inf]])
def test_unusable_signals_are_refused(bad: list[float]) -> None:
    with pytest.raises(ValueError, match="a signal h"):
        samples(bad)


def test_samples_survive_the_round_trip_in_extended_precision() -> None:
    x = np.array([np.longdouble(1) / 3, np.longdouble(2) / 7])
    assert (signal(samples(x)) == x).all()
    assert signal(samples(x)).dtype == np.longdouble


def test_mean_keeps_what_double_precision_loses() -> None:
    small = 2.0**-55
    assert mean([1.0, small, small, small]) == (1 + 3 * np.longdouble(small)) / 4
