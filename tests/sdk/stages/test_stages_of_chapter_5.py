"""The stages of chapter 5, each alone, against its equation in the reference."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.engine import flow
from floatref.stages import resampling, signals, suppression, timer_distortion
from floatref.stages.filters import matched_high_pass, varying
from floatref.stages.filters.schedule import AdaptiveCutOff
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref_reference.appendix_a import varying as literal
from floatref_reference.beyond.matched_high_pass import matched_filter
from floatref_reference.chapter_5 import section_5_6, section_5_7, section_5_8, section_5_10
from floatref_reference.chapter_5.section_5_3 import temporal_profile

RATE = 200.0
INTERVAL = 0.05
FEW = settings(deadline=None, max_examples=10)
SEEDS = st.integers(0, 2**32 - 1)


def both(x, cutoff, step):
    return literal.hpf_b3s2_varying(literal.hpf_b3s1_varying(x, cutoff, step), cutoff, step)


def both_reversed(x, cutoff, step):
    return literal.hpf_b3s1r_varying(literal.hpf_b3s2r_varying(x, cutoff, step), cutoff, step)


STAGES = {
    "B3": (varying.VaryingHighPassB3, both),
    "B3R": (varying.VaryingHighPassB3R, both_reversed),
    "S1": (varying.VaryingHighPassB3S1, literal.hpf_b3s1_varying),
    "S2": (varying.VaryingHighPassB3S2, literal.hpf_b3s2_varying),
    "S1R": (varying.VaryingHighPassB3S1R, literal.hpf_b3s1r_varying),
    "S2R": (varying.VaryingHighPassB3S2R, literal.hpf_b3s2r_varying),
}


def through(stage, axis, **channels):
    shared = {signals.TRAVEL_SPEED, signals.CUTOFF, signals.TIME, signals.TIME_STEP}
    shared.add(signals.TRUE_TIME_STEP)
    values = {
        ChannelId(name, None if name in shared else "main"): np.asarray(x, dtype=float)
        for name, x in channels.items()
    }
    step = 1 / RATE if axis is Axis.TIME else INTERVAL
    header = Header(axis, step, 0.0, Fraction(RATE), frozenset(values), ("main",))
    _, blocks = flow.run((stage,), header, [Block(0, values)])
    out = list(blocks)
    return {c.name: np.concatenate([block[c] for block in out]) for c in out[0].values}


def moving(seed, length=400):
    steps = np.random.default_rng(seed).normal(size=length)
    return np.clip(4.0 + np.cumsum(steps), 0.0, 15.0)


@pytest.mark.cites("(5.3)")
@FEW
@given(seed=SEEDS)
def test_cut_off_that_follows_the_speed(seed):
    speed = moving(seed)
    expected = section_5_7.cut_off_frequency(speed)
    assert AdaptiveCutOff().frequency(speed) == pytest.approx(expected.astype(float), rel=1e-12)


@pytest.mark.cites("(A.9)", "(A.10)", "Table A.1")
@pytest.mark.parametrize("name", STAGES)
@FEW
@given(seed=SEEDS)
def test_stage_at_a_varying_cut_off(name, seed):
    stage, expected = STAGES[name]
    cutoff = AdaptiveCutOff().frequency(moving(seed))
    x = np.random.default_rng(seed).normal(size=400)
    out = through(stage("elevation"), Axis.TIME, elevation=x, high_pass_cutoff=cutoff)
    assert np.abs(out["elevation"] - expected(x, cutoff, 1 / RATE)).max() <= 1e-11


@pytest.mark.cites("(5.1)", "(5.2)")
@FEW
@given(seed=SEEDS)
def test_controller_at_low_speed(seed):
    speed = moving(seed)
    d = np.cumsum(np.random.default_rng(seed).normal(size=400)) / RATE
    stage = suppression.SuppressLocally()
    out = through(stage, Axis.TIME, vertical_velocity=d, travel_speed=speed)
    expected = section_5_6.controlled_velocity(d, speed, 1 / RATE)
    assert np.abs(out["vertical_velocity"] - expected).max() <= 1e-13


@pytest.mark.cites("(5.1)")
def test_an_offset_decays_with_the_time_constant():
    t = np.arange(2000) / RATE
    stage = suppression.SuppressLocally()
    out = through(stage, Axis.TIME, vertical_velocity=0 * t + 1, travel_speed=0 * t)
    tau = section_5_6.time_constant()
    assert out["vertical_velocity"] == pytest.approx(np.exp(-t / tau) / 1.001, abs=1e-5)


@pytest.mark.cites("(5.2)")
@pytest.mark.parametrize("hertz", [0.13, 0.5, 2.0])
def test_a_sine_comes_out_with_the_response_of_the_controller(hertz):
    t = np.arange(8000) / RATE
    wave = np.exp(2j * np.pi * hertz * t)
    stage = suppression.SuppressLocally()
    out = through(stage, Axis.TIME, vertical_velocity=wave.imag, travel_speed=0 * t)
    steady = section_5_6.frequency_response(2 * np.pi * hertz) * wave
    assert out["vertical_velocity"][6000:] == pytest.approx(steady.imag[6000:], abs=1e-3)


@pytest.mark.cites("(5.4)")
def test_time_between_triggers():
    t = np.cumsum(np.random.default_rng(3).uniform(0.0, 2.0, 50))
    out = through(resampling.TimeStep(), Axis.DISTANCE, time=t)
    assert out["time_step"] == pytest.approx(section_5_8.time_step(t).astype(float), abs=1e-14)


@pytest.mark.cites("(5.7)", "(5.8)")
@FEW
@given(slowness=st.floats(-4.0, 6.0), speed=st.floats(0.5, 10.0), beta=st.floats(2.0, 50.0))
def test_time_step_of_a_slow_vehicle(slowness, speed, beta):
    limit = section_5_10.time_step_limit(INTERVAL, speed)
    steps = float(limit) * np.array([0.0, 1.0, 10.0**slowness])
    out = through(timer_distortion.DistortTimer(speed, beta), Axis.DISTANCE, time_step=steps)
    expected = section_5_10.adjusted_time_step(steps, limit, beta)
    assert out["time_step"] == pytest.approx(expected.astype(float), rel=1e-9)
    assert (out["true_time_step"] == steps).all()


@pytest.mark.cites("(5.9)")
@FEW
@given(seed=SEEDS)
def test_reflected_height(seed):
    rng = np.random.default_rng(seed)
    v, h = rng.normal(size=(2, 200))
    true = rng.choice([0.0, 1e-3, 0.02, 10.0], 200)
    adjusted = np.minimum(true, 0.01)
    stage = timer_distortion.IntegrateReflecting()
    out = through(
        stage,
        Axis.DISTANCE,
        vertical_velocity=v,
        height=h,
        time_step=adjusted,
        true_time_step=true,
    )
    expected = section_5_10.reflected_position(v, adjusted, true, h)
    assert np.abs(out["floating_reference_height"] - expected).max() <= 1e-12


@pytest.mark.cites("(A.1)")
@FEW
@given(seed=SEEDS)
def test_observer_is_the_filter_of_the_profile(seed):
    rng = np.random.default_rng(seed)
    a, h = rng.normal(size=(2, 400))
    cutoff = AdaptiveCutOff().frequency(moving(seed))
    out = through(
        matched_high_pass.MatchedHighPass(),
        Axis.TIME,
        vertical_acceleration=a,
        height=h,
        high_pass_cutoff=cutoff,
    )
    profile = temporal_profile(a, h, RATE)
    found = out["floating_reference_height"] - out["height"]
    assert np.abs(found - matched_filter(profile, cutoff, 1 / RATE)).max() <= 1e-10
