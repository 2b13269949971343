"""Which points of a profile are valid: drop-outs, stops, run-in and run-out, settings."""

import numpy as np
import pytest

import floatref
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

pytestmark = pytest.mark.slow

BASIC = "temporal-basic"
NOMINAL = [name for name in floatref.pipelines() if not floatref.pipeline_capabilities(name)]
SUPPRESSING = [name for name in NOMINAL if not name.startswith("road-prior-")]
"""Pipelines that do not measure in hard brakes and at stops."""
REACH = {
    "temporal-basic": (47.0, 76.0),
    "temporal-mean-removal": (47.0, 76.0),
    "spatial-basic": (158.865, 158.865),
    "spatial-hpf": (158.865, 158.865),
}


def invalid_within(profile, run_in_m=53.0):
    x = profile.distance_m
    inner = (x > x[0] + run_in_m) & (x < x[-1] - run_in_m)
    return x[inner & ~profile.tracks[0].valid]


def with_gap(steady, name, begin, end):
    values = steady(seconds=30.0).channel(name).values.copy()
    values[begin:end] = np.nan
    return steady(seconds=30.0, **{name: values})


def test_a_huge_cut_off_is_no_more_than_the_whole_run(steady):
    recording = with_gap(steady, "vertical_specific_force", 15_000, 15_050)
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(recording, BASIC, {"cutoff_wavelength_m": 1e308})
    assert not profile.tracks[0].valid.any()


@pytest.mark.parametrize("pipeline", ["temporal-basic", "temporal-mean-removal", "spatial-basic"])
def test_a_laser_drop_out_is_flagged_where_it_is(steady, pipeline):
    recording = with_gap(steady, "height", 15_000, 15_500)
    with pytest.warns(floatref.FloatrefWarning, match=r"height: 500 of 30000 samples missing"):
        profile = floatref.process(recording, pipeline)
    lost = invalid_within(profile)
    assert 299.9 <= lost.min() <= 300.1
    assert 309.8 <= lost.max() <= 310.1
    assert np.isfinite(profile.tracks[0].elevation).all()


def test_an_accelerometer_drop_out_is_flagged_a_cut_off_wavelength_to_either_side(steady):
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(
            with_gap(steady, "vertical_specific_force", 15_000, 15_011), BASIC
        )
    lost = invalid_within(profile)
    assert lost.min() == pytest.approx(300.0 - 105.91, abs=0.2)
    assert lost.max() == pytest.approx(300.2 + 105.91, abs=0.2)


def test_a_drop_out_too_short_to_drift_is_flagged_where_it_is(steady):
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(
            with_gap(steady, "vertical_specific_force", 15_000, 15_010), BASIC
        )
    lost = invalid_within(profile)
    assert 299.9 <= lost.min() <= lost.max() <= 300.3


@pytest.mark.parametrize("pipeline", NOMINAL)
def test_filter_run_in_and_run_out_are_half_a_cut_off_wavelength(steady, pipeline):
    valid = floatref.process(steady(seconds=30.0), pipeline).tracks[0].valid
    points = round(105.91 / 2 / 0.05)
    assert not valid[:points].any()
    assert not valid[-points:].any()
    assert valid[points:-points].all()


@pytest.mark.parametrize("pipeline", SUPPRESSING)
def test_a_stop_is_flagged_with_what_its_pipeline_spreads(steady, pipeline):
    times = np.arange(60_000) / 1000.0
    slowing = np.clip(20.0 - 1.5 * np.clip(times - 20.0, 0.0, None), 0.0, None)
    speed = slowing + np.clip(times - 36.0, 0.0, 10.0)
    distance = np.cumsum(speed) / 1000.0
    recording = steady(seconds=60.0, distance=distance)
    profile = floatref.process(recording, pipeline)
    lost = invalid_within(profile, 100.0)
    before, after = REACH.get(pipeline, (15.0, 30.0))
    slow = distance[speed < 16 / 3.6]
    assert lost.min() == pytest.approx(slow.min() - before, abs=2.0)
    assert lost.max() == pytest.approx(min(slow.max() + after, distance[-1] - 100.0), abs=2.0)


@pytest.mark.parametrize("pipeline", SUPPRESSING)
def test_a_brake_is_flagged_from_five_seconds_before_a_standstill_to_behind_its_release(
    steady, pipeline
):
    times = np.arange(40_000) / 1000.0
    speed = np.clip(30.0 - 3.0 * np.clip(times - 10.0, 0.0, None), 9.0, None)
    distance = np.cumsum(speed) / 1000.0
    recording = steady(seconds=40.0, distance=distance)
    lost = invalid_within(floatref.process(recording, pipeline))
    late_m = 0.5 * 9.0
    behind = 47.0 if pipeline in REACH else 30.0
    begins, released = distance[speed < 5.0 * 3.0][0], distance[speed <= 9.0][0]
    assert begins <= lost.min() <= begins + 0.25 * 15.0 + 0.1
    assert released + behind <= lost.max() <= released + behind + late_m
    assert lost.size == pytest.approx((lost.max() - lost.min()) / 0.05 + 1, abs=1)


@pytest.mark.parametrize("stopping_time_s", [3.0, 7.0])
def test_how_near_to_a_standstill_a_brake_is_flagged_is_a_setting(steady, stopping_time_s):
    times = np.arange(40_000) / 1000.0
    speed = np.clip(30.0 - 3.0 * np.clip(times - 10.0, 0.0, None), 6.0, None)
    distance = np.cumsum(speed) / 1000.0
    recording = steady(seconds=40.0, distance=distance)
    profile = floatref.process(recording, BASIC, {"stopping_time_s": stopping_time_s})
    begins = distance[speed < stopping_time_s * 3.0][0]
    first = invalid_within(profile).min()
    assert first == pytest.approx(begins, abs=0.3 * stopping_time_s * 3.0)


@pytest.mark.parametrize("pipeline", ["temporal-basic", "spatial-hpf-timer-distortion"])
@pytest.mark.parametrize("lost", [slice(16_000, 16_950), slice(16_507, 16_518)])
def test_an_accelerometer_drop_out_in_a_stop_is_flagged(steady, pipeline, lost):
    times = np.arange(30_000) / 1000.0
    braking, setting_off = np.clip(times - 12.0, 0.0, 4.0), np.clip(times - 17.0, 0.0, None)
    distance = 20.0 * np.clip(times, None, 12.0) + 20.0 * braking - 2.5 * braking**2
    distance += np.where(setting_off < 4.0, 2.5 * setting_off**2, 20.0 * setting_off - 40.0)
    forces = steady(seconds=30.0).channel("vertical_specific_force").values.copy()
    forces[lost] = np.nan
    recording = steady(seconds=30.0, vertical_specific_force=forces, distance=distance)
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(recording, pipeline)
    invalid = invalid_within(profile)
    assert invalid.min() == pytest.approx(280.0 - 105.91, abs=0.2)
    assert invalid.max() == pytest.approx(280.0 + 105.91, abs=0.2)


@pytest.mark.parametrize("pipeline", ["temporal-hpf", "spatial-hpf-timer-distortion-reflection"])
def test_what_happens_behind_the_last_point_reaches_back_from_there(steady, pipeline):
    times = np.arange(40_000) / 1000.0
    braking = np.clip(times - 23.0, 0.0, 4.0)
    distance = 20.0 * np.clip(times, None, 23.0) + 20.0 * braking - 2.5 * braking**2
    forces = steady(seconds=40.0).channel("vertical_specific_force").values.copy()
    forces[30_000:35_000] = np.nan
    recording = steady(seconds=40.0, vertical_specific_force=forces, distance=distance)
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(recording, pipeline)
    assert invalid_within(profile).min() == pytest.approx(500.0 - 105.91, abs=0.2)


@pytest.mark.parametrize("pipeline", ["temporal-basic", "spatial-hpf"])
@pytest.mark.parametrize("clock", ["common", "own"])
def test_a_lost_encoder_can_hide_a_stop(steady, pipeline, clock):
    before, after = REACH[pipeline]
    every = 1 if clock == "common" else 4
    distance = 20.0 * np.arange(0, 30_000, every) / 1000.0
    distance[14_000 // every : 15_200 // every] = np.nan
    channel = Channel.of("distance", distance, UniformClock.of(1000.0 / every))
    with pytest.warns(floatref.FloatrefWarning, match="distance"):
        profile = floatref.process(steady(seconds=30.0, distance=channel), pipeline)
    lost = invalid_within(profile)
    assert lost.min() == pytest.approx(280.0 - before, abs=0.3)
    assert lost.max() == pytest.approx(304.0 + after, abs=0.3)


@pytest.mark.parametrize(
    ("pipeline", "settings"),
    [
        ("temporal-hpf-local-suppression", {"suppression_speed_mps": 15.0}),
        ("temporal-adaptive-hpf", {"transition_speed_mps": 15.0}),
        ("temporal-matched-hpf", {"transition_speed_mps": 10.0, "transition_steepness": 0.5}),
        ("spatial-hpf-timer-distortion", {"timer_speed_mps": 11.0}),
        ("temporal-basic", {"slow_mps": 13.0}),
    ],
)
def test_travel_below_the_limit_of_a_stage_is_not_valid(steady, pipeline, settings):
    times = np.arange(40_000) / 1000.0
    recording = steady(seconds=40.0, distance=12.0 * times)
    assert floatref.process(recording, pipeline).tracks[0].valid.any()
    assert not floatref.process(recording, pipeline, settings).tracks[0].valid.any()
