"""State-variable stages: appendix A at a constant cut-off, and calm where the cut-off sweeps."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a.filters import hpf_b3s1r, hpf_b3s2r
from floatref_reference.appendix_a.varying import substitutions
from floatref_reference.beyond.state_variable import (
    hpf_b3s1r_state_variable,
    hpf_b3s2r_state_variable,
)
from floatref_reference.chapter_5.section_5_7 import backward_passes_varying, cut_off_wave_number

Stage = Callable[..., np.ndarray]
PAIRS = [(hpf_b3s2r_state_variable, hpf_b3s2r), (hpf_b3s1r_state_variable, hpf_b3s1r)]
STAGES = [state_variable for state_variable, _ in PAIRS]
DX = 0.05
STOP = 100.0


def second_order_decay(theta: np.ndarray) -> np.ndarray:
    """Answer of s²/(s² + s + 1) to a unit step, at ``theta`` = ωt."""
    phase = np.sqrt(3) / 2 * theta
    return np.exp(-theta / 2) * (np.cos(phase) - np.sin(phase) / np.sqrt(3))


def around_the_stop(deceleration: float) -> tuple[np.ndarray, np.ndarray]:
    """Brake to a standstill and set off alike: distance and the cut-off wave number there."""
    x = np.arange(4001) * DX
    speed = np.minimum(np.sqrt(2 * deceleration * np.abs(x - STOP)), 20)
    return x, cut_off_wave_number(speed, DX)


def backward_passes(z: np.ndarray, wave_number: np.ndarray) -> np.ndarray:
    second_order = hpf_b3s2r_state_variable(z, wave_number, DX)
    return hpf_b3s1r_state_variable(second_order, wave_number, DX)


@pytest.mark.parametrize(("stage", "printed"), PAIRS)
@settings(deadline=None, max_examples=20)
@given(f_c=st.floats(0.001, 0.45), seed=st.integers(0, 99), count=st.integers(1, 200))
def test_constant_cut_off_is_the_stage_of_appendix_a(
    stage: Stage, printed: Stage, f_c: float, seed: int, count: int
) -> None:
    x = np.random.default_rng(seed).normal(size=count)
    expected = printed(x, f_c, 1.0)
    assert stage(x, np.full(count, f_c), 1.0) == pytest.approx(expected, abs=1e-12)


@settings(deadline=None, max_examples=15)
@given(seed=st.integers(0, 999), dx=st.floats(1e-2, 10.0))
def test_both_states_are_the_integrals_at_every_sample(seed: int, dx: float) -> None:
    rng = np.random.default_rng(seed)
    x, f_c = rng.normal(size=60), rng.uniform(0.001, 0.4, 60) / dx
    hp = hpf_b3s2r_state_variable(x, f_c, dx)
    c = np.array(substitutions(f_c, dx))
    bp, lp = (c[-1] - 1) * hp[-1], x[-1] - c[-1] * hp[-1]
    omega = 2 / np.longdouble(dx) * c
    for k in range(58, -1, -1):
        bp_later = bp
        bp = bp + dx / 2 * (omega[k] * hp[k] + omega[k + 1] * hp[k + 1])
        lp = lp + dx / 2 * (omega[k] * bp + omega[k + 1] * bp_later)
        assert hp[k] + bp + lp == pytest.approx(x[k], abs=1e-12)


@settings(deadline=None, max_examples=15)
@given(seed=st.integers(0, 999), dx=st.floats(1e-2, 10.0))
def test_the_state_is_the_integral_at_every_sample(seed: int, dx: float) -> None:
    rng = np.random.default_rng(seed)
    x, f_c = rng.normal(size=60), rng.uniform(0.001, 0.4, 60) / dx
    hp = hpf_b3s1r_state_variable(x, f_c, dx)
    slope = 2 / np.longdouble(dx) * np.array(substitutions(f_c, dx)) * hp
    trapezoids = dx / 2 * (slope[1:] + slope[:-1])
    lp = x[-1] - hp[-1] + np.cumsum(trapezoids[::-1])[::-1]
    assert hp[:-1] + lp == pytest.approx(x[:-1], abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("stage", "decay"),
    [
        (hpf_b3s2r_state_variable, second_order_decay),
        (hpf_b3s1r_state_variable, lambda theta: np.exp(-theta)),
    ],
)
@settings(deadline=None, max_examples=10)
@given(growth=st.floats(-3.0, 3.0).filter(lambda growth: abs(growth) > 0.01))
def test_a_step_decays_with_the_phase_whatever_the_cut_off_sweeps(
    stage: Stage, decay: Stage, growth: float
) -> None:
    x = np.arange(-1000, 3001) / 1000
    step = 2.0005
    f_c = np.exp(growth * (x - 1)) / 4
    theta = 2 * np.pi / 4 * (np.exp(growth * (step - 1)) - np.exp(growth * (x - 1))) / growth
    expected = np.where(x < step, decay(theta), 0)
    assert stage(1.0 * (x < step), f_c, 1e-3) == pytest.approx(expected, abs=0.02)


@pytest.mark.slow
@settings(deadline=None, max_examples=15)
@given(deceleration=st.floats(0.5, 8.0), place=st.floats(-1.0, 1.0))
def test_a_step_near_a_stop_stays_a_step(deceleration: float, place: float) -> None:
    x, wave_number = around_the_stop(deceleration)
    assert np.abs(backward_passes(1.0 * (x >= STOP + place), wave_number)).max() <= 1.3


@pytest.mark.parametrize("deceleration", [4.0, 5.0, 8.0])
def test_the_literal_passes_multiply_a_step_at_a_stop_and_the_states_do_not(
    deceleration: float,
) -> None:
    x, wave_number = around_the_stop(deceleration)
    step = 1.0 * (x >= STOP)
    assert np.abs(backward_passes_varying(step, wave_number, DX)).max() > 3
    assert np.abs(backward_passes(step, wave_number)).max() <= 1.3


@pytest.mark.parametrize("stage", STAGES)
@settings(deadline=None, max_examples=15)
@given(seed=st.integers(0, 999), first=st.floats(-10, 10), second=st.floats(-10, 10))
def test_sums_pass_as_sums(stage: Stage, seed: int, first: float, second: float) -> None:
    rng = np.random.default_rng(seed)
    x, y, f_c = rng.normal(size=80), rng.normal(size=80), rng.uniform(0.001, 0.45, 80)
    expected = first * stage(x, f_c, 1.0) + second * stage(y, f_c, 1.0)
    assert stage(first * x + second * y, f_c, 1.0) == pytest.approx(expected, abs=1e-11)


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("f_c", [[0.1], [0.1, 0.5]])
def test_a_cut_off_that_is_missing_or_too_high_is_refused(stage: Stage, f_c: list[float]) -> None:
    with pytest.raises(ValueError, match=r"do not fit|more finely"):
        stage([1.0, 2.0], f_c, 1.0)
