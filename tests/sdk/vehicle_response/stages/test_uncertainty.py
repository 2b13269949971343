"""What an estimator does not know of its error, against what is drawn and integrated."""

import numpy as np
import pytest
from scipy.integrate import quad

from floatref.vehicle_response.stages.estimation import LOCAL_S, LocalSquare, drift_sigma


@pytest.mark.parametrize("cutoff_hz", [0.07, 0.2, 0.45])
def test_the_drift_is_the_integral_of_its_spectrum(cutoff_hz: float) -> None:
    def passed(f: float) -> float:
        both_ways = (f**6 / (f**6 + cutoff_hz**6)) ** 2
        return 2.0 * 3e-3**2 / (2.0 * np.pi * f) ** 4 * both_ways

    variance = quad(passed, 0.0, 1.0)[0] + quad(passed, 1.0, np.inf)[0]
    assert drift_sigma(3e-3, cutoff_hz).item() == pytest.approx(np.sqrt(variance), rel=1e-6)


def test_no_density_is_no_drift() -> None:
    np.testing.assert_array_equal(drift_sigma(0.0, np.array([0.1, 0.4])), [0.0, 0.0])


def test_a_steady_signal_has_its_own_square() -> None:
    square = LocalSquare(0.01)
    found = square.advance(square.begin(), np.full(1000, 3e-3))
    np.testing.assert_allclose(found, 9e-6, rtol=1e-9)


def test_a_sine_has_its_mean_square_and_a_bump_counts_at_once() -> None:
    square, memory = LocalSquare(1e-3), LocalSquare(1e-3).begin()
    sine = 2e-3 * np.sin(2.0 * np.pi * 11.0 * np.arange(4000) / 1000.0)
    found = square.advance(memory, sine)
    assert np.median(found[2000:]) == pytest.approx(2e-6, rel=0.4)
    assert square.advance(memory, np.array([0.01]))[0] == 1e-4
    later = square.advance(memory, np.zeros(round(5 * LOCAL_S / 1e-3)))
    assert later[-1] < 0.02 * later[0]


def test_missing_samples_leave_no_trace() -> None:
    square = LocalSquare(0.01)
    found = square.advance(square.begin(), np.array([np.nan, np.nan, 1e-3]))
    assert found[1] == 0.0
    assert found[2] == 1e-6
