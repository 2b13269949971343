"""A signal follows the explanation that it was made from, and noise follows none."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.screening.explanations import (
    RIGHT,
    Evidence,
    Look,
    detrend,
    report_fault,
    weigh,
    windows,
)

laws = settings(deadline=None, max_examples=30)
TIMES = np.arange(400) / 10.0
LOOK = Look(span_s=4.0, floor=0.01)


def swings(seed: int, rows: int = 3) -> np.ndarray:
    rng = np.random.default_rng(seed)
    f, phase = rng.uniform(0.5, 2.0, (rows, 5, 1)), rng.uniform(0, 6.3, (rows, 5, 1))
    return np.sum(np.sin(2 * np.pi * f * TIMES + phase), axis=1)


def explained(own: np.ndarray, other: np.ndarray) -> dict[str, np.ndarray]:
    return {RIGHT: own, "sign": -own, "unit": own / 57.3, "first": other, "-first": -other}


@laws
@given(
    seed=st.integers(0, 999),
    which=st.sampled_from([RIGHT, "sign", "unit", "first", "-first"]),
    noise=st.floats(0.0, 0.4),
    drift=st.floats(-5, 5),
)
def test_a_signal_follows_what_it_was_made_from(
    seed: int, which: str, noise: float, drift: float
) -> None:
    """Noise as large as a third of the signal, and any drift, change nothing."""
    own, other, dirt = swings(seed)
    candidates = explained(own, other)
    scale = float(np.std(candidates[which]))
    signal = candidates[which] + noise * scale * dirt / np.std(dirt) + drift * TIMES
    look = Look(LOOK.span_s, LOOK.floor * scale)
    evidence = weigh(TIMES, signal, candidates, look)
    if which == RIGHT:
        assert evidence.confirmed
        assert not evidence.likely
    else:
        assert evidence.certain
        assert evidence.name == which
        assert not evidence.confirmed


@laws
@given(seed=st.integers(0, 999), size=st.floats(0.0, 3.0))
def test_noise_follows_nothing(seed: int, size: float) -> None:
    own, other, _ = swings(seed)
    noise = size * np.random.default_rng(seed).standard_normal(TIMES.size)
    evidence = weigh(TIMES, noise, explained(own, other), LOOK)
    assert not evidence.likely
    assert not evidence.confirmed


@laws
@given(seed=st.integers(0, 999), share=st.floats(0.0, 0.1))
def test_what_explains_little_is_not_heard(seed: int, share: float) -> None:
    """A hundredth of the signal, squared, may be chance, however often it is met."""
    own, other, rest = swings(seed)
    small = share * own * np.std(rest) / np.std(own)
    evidence = weigh(TIMES, small + rest, explained(-small, 0.0 * other), LOOK)
    assert (evidence.right, evidence.wrong) == (0.0, 0.0)


@laws
@given(seed=st.integers(0, 999), small=st.floats(0.0, 0.3))
def test_what_is_below_the_floor_is_not_heard(seed: int, small: float) -> None:
    own, *_ = swings(seed)
    own *= small * LOOK.floor / np.std(own)
    evidence = weigh(TIMES, -own, explained(own, own), LOOK)
    assert (evidence.right, evidence.wrong) == (0.0, 0.0)


@pytest.mark.parametrize("seed", range(3))
def test_noise_times_a_factor_shows_no_unit_however_long_it_stands(seed: int) -> None:
    """The noise of a gyro times 57.3 is as large as that of an attitude, for half an hour."""
    times, factor, floor = np.arange(18_000) / 10.0, 57.3, 2e-4
    # Angles wander: they are sums of what a gyro errs by, and a receiver's are smoothed.
    draw = 0.2 * floor * np.cumsum(np.random.default_rng(seed).standard_normal((2, times.size)), 1)
    own, attitude = 0.2 * draw[0], 0.2 * factor * draw[1]
    explanations = explained(own, 0.0 * own) | {"deg": factor * own, "-deg": -factor * own}
    factors = {"deg": factor, "-deg": factor}
    assert weigh(times, attitude, explanations, Look(3.0, floor)).certain
    evidence = weigh(times, attitude, explanations, Look(3.0, floor, factors=factors))
    assert (evidence.right, evidence.wrong) == (0.0, 0.0)
    moves = 10.0 * floor * np.sin(2.0 * times)
    moving = explained(moves, 0.0 * own) | {"deg": factor * moves, "-deg": -factor * moves}
    found = weigh(times, factor * moves + attitude, moving, Look(3.0, floor, factors=factors))
    assert found.certain
    assert found.name == "deg"


@laws
@given(seed=st.integers(0, 999), share=st.floats(0.5, 1.0))
def test_windows_with_a_gap_are_passed_over(seed: int, share: float) -> None:
    own, other, _ = swings(seed)
    signal = -own.copy()
    rng = np.random.default_rng(seed)
    signal[rng.random(TIMES.size) < share] = np.nan
    evidence = weigh(TIMES, signal, explained(own, other), LOOK)
    assert (evidence.right, evidence.wrong) == (0.0, 0.0)


@laws
@given(seed=st.integers(0, 999), degree=st.integers(0, 3), begin=st.floats(-1e6, 1e6))
def test_a_polynomial_is_taken_out_and_nothing_else(seed: int, degree: int, begin: float) -> None:
    rows = swings(seed).T
    left = detrend(begin + TIMES, rows, degree)
    place = TIMES / TIMES[-1] - 0.5
    powers = np.stack([place**k for k in range(degree + 1)], axis=1)
    np.testing.assert_allclose(powers.T @ left, 0.0, atol=1e-6)
    np.testing.assert_allclose(detrend(begin + TIMES, rows - left, degree), 0.0, atol=1e-9)
    np.testing.assert_array_equal(detrend(begin + TIMES, rows, -1), rows)


@laws
@given(span=st.floats(1.5, 100.0), count=st.integers(12, 400))
def test_windows_cover_everything(span: float, count: int) -> None:
    seen = np.zeros(count, np.int64)
    for part in windows(TIMES[:count], span):
        seen[part] += 1
        assert TIMES[part][-1] - TIMES[part][0] <= span + 1e-6
    assert seen[: -max(1, int(0.26 * min(span, TIMES[count - 1]) * 10) + 1)].min() >= 1
    assert list(windows(TIMES[:11], span)) == []


def test_what_is_certain_is_refused_and_what_is_likely_is_told() -> None:
    lines = {"sign": "multiply by -1"}
    with pytest.raises(InputError, match="multiply by -1"):
        list(report_fault(Evidence(0.5, 4.0, "sign"), lines))
    assert list(report_fault(Evidence(0.5, 4.0, "sign"), lines, fatal=False)) == ["multiply by -1"]
    (line,) = report_fault(Evidence(0.5, 2.0, "-sign"), lines)
    assert line.startswith("multiply by -1 (")
    assert list(report_fault(Evidence(3.0, 4.0, "sign"), lines)) == []
    assert list(report_fault(Evidence(), lines)) == []
