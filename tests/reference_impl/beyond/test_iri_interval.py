"""The reference's interval of an IRI against closed forms."""

import numpy as np
import pytest

from floatref_reference.beyond.iri_interval import (
    MEMORY,
    correlation,
    impulse_response,
    iri_interval,
    output_covariance,
    standard_error,
)
from floatref_reference.signals import PI


def test_correlation_is_one_in_place_and_smooth_there() -> None:
    assert correlation(0.0) == 1
    # (1 + d/L) exp(-d/L) = 1 - d²/(2L²) + …, L = 30 m / 2π
    assert 1 - correlation(0.01) == pytest.approx(float((0.01 * 2 * PI / 30) ** 2 / 2), rel=1e-2)
    assert correlation(3.0) == correlation(-3.0) > correlation(4.0) > 0


def test_a_point_that_is_high_lifts_and_lowers_the_car_alike() -> None:
    h = impulse_response(1.0)
    assert len(h) == MEMORY + 1
    # Up and down again: a constant height moves no car.
    assert abs(float(h.sum())) < 1e-3 * float(np.abs(h).max())


def test_errors_that_are_not_alike_average_out() -> None:
    one = [np.longdouble(4)]
    for n in (1, 9, 100):
        assert standard_error([1.0] * n, [0.5] * n, one) == pytest.approx(1.0 / np.sqrt(n))
    alike = [np.longdouble(4)] * 100
    assert standard_error([1.0] * 100, [0.5] * 100, alike) == pytest.approx(1.0)
    assert standard_error([1.0, -1.0] * 50, [0.5] * 100, alike) == pytest.approx(0.0, abs=1e-9)


def test_interval_of_a_constant_output() -> None:
    low, high = iri_interval([2.0] * 4, [0.5] * 4, [np.longdouble(4)])
    # q = 4 · 0.25/4, s = 1/2
    assert float(high) == pytest.approx(2.0 + 1.959963984540054 / 2)
    assert float(low) == pytest.approx(2.0 * np.sqrt(0.75) - 1.959963984540054 / 2)
    assert iri_interval([2.0] * 4, [5.0] * 4, [np.longdouble(4)])[0] == 0


def test_covariance_is_largest_in_place() -> None:
    R = output_covariance(2.0, 20)
    assert np.abs(R).max() == R[0] > 0
