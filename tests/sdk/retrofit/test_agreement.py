"""Every class alone against the reference."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import floatref
from floatref_reference.appendix_a.cut_off import high_pass_cut_off
from floatref_reference.appendix_a.filters import hpf_b3, hpf_b3s1, hpf_b3s2
from floatref_reference.appendix_a.varying import hpf_b3s1_varying, hpf_b3s2_varying
from floatref_reference.beyond.matched_high_pass import matched_filter
from floatref_reference.beyond.state_variable import (
    hpf_b3s1r_state_variable,
    hpf_b3s2r_state_variable,
)
from floatref_reference.chapter_5 import section_5_6, section_5_7, section_5_10
from floatref_reference.chapter_5.section_5_3 import temporal_profile
from floatref_reference.chapter_5.section_5_5 import backward_passes, from_first

RATE, STEP, INTERVAL = 200.0, 1 / 200.0, 0.05
WAVE_NUMBER = 1 / 105.91
laws = settings(
    deadline=None, max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
SEEDS = st.integers(0, 2**32 - 1)


def close(found, expected, tolerance=1e-11):
    np.testing.assert_allclose(found, np.asarray(expected, dtype=float), rtol=0, atol=tolerance)


@laws
@given(seed=SEEDS)
def test_travel_speed(drive, seed):
    run = drive(seed)
    close(floatref.TravelSpeed(RATE).of(run.distance), section_5_6.travel_speed(run.distance, RATE))


@pytest.mark.parametrize("axis", ["time", "distance"])
@laws
@given(seed=SEEDS)
def test_high_pass_at_a_fixed_cut_off(drive, axis, seed):
    run = drive(seed)
    if axis == "time":
        stage, cutoff, step = floatref.HighPass(RATE), high_pass_cut_off(0.0489), STEP
    else:
        stage, cutoff, step = floatref.SpatialHighPass(INTERVAL), WAVE_NUMBER, INTERVAL
    close(stage.acceleration(run.a), hpf_b3s1(run.a, cutoff, step))
    close(stage.velocity(run.v), hpf_b3s2(run.v, cutoff, step))
    close(stage.height(run.h), hpf_b3(from_first(run.h), cutoff, step))
    close(stage.reverse(run.h), backward_passes(run.h, cutoff, step))


def backward_states(x, cutoff, step):
    return hpf_b3s1r_state_variable(hpf_b3s2r_state_variable(x, cutoff, step), cutoff, step)


def adaptive(run):
    stage = floatref.AdaptiveHighPass(RATE)
    forward = (
        stage.acceleration(run.a, run.speed),
        stage.velocity(run.v, run.speed),
        stage.height(run.h, run.speed),
    )
    return stage, forward


@laws
@given(seed=SEEDS)
def test_adaptive_high_pass(drive, seed):
    run = drive(seed)
    cutoff = section_5_7.cut_off_frequency(run.speed)
    stage, (a, v, h) = adaptive(run)
    close(a, hpf_b3s1_varying(run.a, cutoff, STEP))
    close(v, hpf_b3s2_varying(run.v, cutoff, STEP))
    height = hpf_b3s1_varying(from_first(run.h), cutoff, STEP)
    close(h, hpf_b3s2_varying(height, cutoff, STEP))
    expected = section_5_7.backward_passes_varying(run.h, cutoff, STEP)
    close(stage.reverse(run.h, run.speed), expected)


@laws
@given(seed=SEEDS, matched=st.booleans())
def test_backward_pass_over_distance(drive, seed, matched):
    run = drive(seed)
    wave_number = section_5_7.cut_off_wave_number(run.speed, INTERVAL)
    if matched:
        expected = backward_states(run.h, wave_number, INTERVAL)
        stage = floatref.MatchedHighPass(RATE)
        stage.reference_height(run.a, run.h, run.speed)
    else:
        expected = section_5_7.backward_passes_varying(run.h, wave_number, INTERVAL)
        stage, _ = adaptive(run)
    close(stage.reverse_over_distance(run.h, run.speed, INTERVAL), expected)


@laws
@given(seed=SEEDS)
def test_matched_high_pass(drive, seed):
    run = drive(seed)
    stage = floatref.MatchedHighPass(RATE)
    found = stage.reference_height(run.a, run.h, run.speed) - run.h
    cutoff = section_5_7.cut_off_frequency(run.speed)
    close(found, matched_filter(temporal_profile(run.a, run.h, RATE), cutoff, STEP))
    close(stage.reverse(found, run.speed), backward_states(found, cutoff, STEP))


@laws
@given(seed=SEEDS)
def test_local_suppression(drive, seed):
    run = drive(seed)
    found = floatref.LocalSuppression(RATE).velocity(run.v, run.speed)
    close(found, section_5_6.controlled_velocity(run.v, run.speed, STEP))


@laws
@given(seed=SEEDS)
def test_timer_distortion_and_reflection(drive, seed):
    run = drive(seed)
    stage = floatref.TimerDistortion(INTERVAL)
    limit = section_5_10.time_step_limit(INTERVAL)
    assert stage.limit_s == pytest.approx(float(limit))
    steps = stage.time_step(run.dt)
    close(steps, section_5_10.adjusted_time_step(run.dt, limit))
    found = floatref.HeightReflection().reference_height(run.v, steps, run.dt, run.h)
    close(found, section_5_10.reflected_position(run.v, steps, run.dt, run.h))


def test_settings_are_those_of_the_equations(drive):
    run = drive(5)
    schedule = section_5_7.Schedule(0.3, 50.0, 5.0, 1.0)
    stage = floatref.AdaptiveHighPass(RATE, 0.3, 50.0, 5.0, 1.0)
    assert stage.schedule == floatref.AdaptiveCutOff(0.3, 50.0, 5.0, 1.0)
    cutoff = section_5_7.cut_off_frequency(run.speed, schedule)
    close(stage.acceleration(run.a, run.speed), hpf_b3s1_varying(run.a, cutoff, STEP))
    close(floatref.HighPass(RATE, 2.0).acceleration(run.a), hpf_b3s1(run.a, 2.0, STEP))
    spatial = floatref.SpatialHighPass(INTERVAL, 9.0)
    close(spatial.acceleration(run.a), hpf_b3s1(run.a, 1 / 9, INTERVAL))
    expected = section_5_6.controlled_velocity(run.v, run.speed, STEP, 8.0, 0.1, 2.0)
    close(floatref.LocalSuppression(RATE, 8.0, 0.1, 2.0).velocity(run.v, run.speed), expected)
    limit = section_5_10.time_step_limit(INTERVAL, 2.0)
    expected = section_5_10.adjusted_time_step(run.dt, limit, 5.0)
    close(floatref.TimerDistortion(INTERVAL, 2.0, 5.0).time_step(run.dt), expected)
    wide = floatref.TravelSpeed(RATE, 0.5).of(run.distance)
    close(wide[100:], (run.distance[100:] - run.distance[:-100]) / 0.5)
