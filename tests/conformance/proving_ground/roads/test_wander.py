"""The line of a pass: offset and wander of the deviations and the correlation that are stated."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.proving_ground.roads.wander import CORRELATION_M, Line

X = np.arange(-20.0, 320.0, 0.5)


def test_offsets_of_passes_have_the_stated_deviation() -> None:
    offsets = np.array([Line(seed, 0.12, 0.03).offset_m for seed in range(2000)])
    assert offsets.std() == pytest.approx(0.12, rel=0.06)
    assert abs(offsets.mean()) < 0.01


def test_the_wander_has_the_stated_deviation_and_correlation() -> None:
    lines = np.array([Line(seed, 0.0, 0.03).at(X) for seed in range(200)])
    assert lines.std(axis=0) == pytest.approx(np.full(X.size, 0.03), rel=0.2)
    for apart in (2.0, 5.0, 10.0, 20.0):
        ahead = round(apart / 0.5)
        found = np.mean(lines[:, ahead:] * lines[:, :-ahead]) / 0.03**2
        assert found == pytest.approx(np.exp(-((apart / CORRELATION_M) ** 2)), abs=0.05)


@pytest.mark.slow
@given(st.integers(0, 2**63 - 1), st.floats(0.0, 0.5), st.floats(0.0, 0.1))
def test_a_line_is_the_same_on_a_longer_road_and_on_another_grid(
    seed: int, between: float, within: float
) -> None:
    line = Line(seed, between, within)
    far = line.at(X)
    assert line.at(X[:400]) == pytest.approx(far[:400], abs=1e-5)
    assert line.at(X[3:400:7]) == pytest.approx(far[3:400:7], abs=1e-5)
    assert np.abs(np.diff(far, 2)).max() <= 0.05 * within + 1e-12


def test_without_deviations_the_line_is_straight() -> None:
    assert Line(3, 0.0, 0.0).is_straight
    assert not Line(3, 0.0, 0.0).at(X).any()
    assert not Line(3, 0.0, 0.01).is_straight
    assert np.ptp(Line(3, 0.1, 0.0).at(X)) == 0


def test_impossible_lines_are_refused() -> None:
    for between, within in ((-0.1, 0.0), (0.0, float("nan")), (float("inf"), 0.0)):
        with pytest.raises(InputError, match="of a line is"):
            Line(1, between, within)
    with pytest.raises(InputError, match="lies before it"):
        Line(1, 0.1, 0.1).at(np.array([-90.0]))
