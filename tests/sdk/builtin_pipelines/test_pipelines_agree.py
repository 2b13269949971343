"""Every pipeline against its reference, on drawn recordings that stop, crawl and restart."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.engine.plugins import plugins
from floatref.engine.run import run
from floatref_reference.beyond import matched_high_pass
from floatref_reference.chapter_5 import (
    section_5_3,
    section_5_4,
    section_5_5,
    section_5_6,
    section_5_7,
    section_5_8,
    section_5_9,
    section_5_10,
)

G = 9.80665
REFERENCES = {
    "temporal-basic": section_5_3.basic_temporal,
    "temporal-mean-removal": section_5_4.mean_removal,
    "temporal-hpf": section_5_5.temporal_high_pass,
    "temporal-hpf-local-suppression": section_5_6.local_suppression,
    "temporal-adaptive-hpf": section_5_7.adaptive_high_pass,
    "temporal-adaptive-hpf-spatial-backward": section_5_7.adaptive_high_pass_spatial_backward,
    "temporal-matched-hpf": matched_high_pass.matched_high_pass,
    "spatial-basic": section_5_8.basic_spatial,
    "spatial-hpf": section_5_9.spatial_high_pass,
    "spatial-hpf-timer-distortion": section_5_10.timer_distortion,
    "spatial-hpf-timer-distortion-reflection": section_5_10.timer_distortion_reflection,
}
VARYING = (
    "temporal-adaptive-hpf",
    "temporal-adaptive-hpf-spatial-backward",
    "temporal-matched-hpf",
)
"""Pipelines whose cut-off follows the speed."""


def test_every_pipeline_without_further_sensors_has_a_reference():
    pipelines = plugins().pipelines()
    nominal = {name for name in pipelines if not pipelines[name].capabilities}
    # The road prior goes from node to node: its stage is held to the literal one by itself.
    road_prior = {name for name in nominal if name.startswith("road-prior-")}
    assert nominal - road_prior == set(REFERENCES)


def drift_range(recording, track):
    """Range of the double integral, which carries the rounding of both."""
    force = recording.channel("vertical_specific_force", track)
    velocity = np.cumsum(force.values - G) / float(force.clock.rate)
    height = np.cumsum(velocity) / float(force.clock.rate)
    return np.ptp(height)


@pytest.mark.slow
@pytest.mark.cites("(5.4)", "Tables 5.3 to 5.12")
@pytest.mark.parametrize("pipeline", REFERENCES)
@settings(
    deadline=None, max_examples=8, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_sdk_and_reference_agree(drawn, pipeline, data):
    rate = data.draw(st.sampled_from([1000.0, 4000.0, 5000.0, 16_000.0]))
    interval = data.draw(st.sampled_from([0.00508, 0.025]))
    recording = data.draw(drawn(rate, interval))
    profile = run(recording, pipeline).profile
    distance = recording.channel("distance").values
    for track in profile.tracks:
        force = recording.channel("vertical_specific_force", track.name).values
        height = recording.channel("height", track.name).values
        start, expected = REFERENCES[pipeline](force - G, height, distance, rate, interval)
        assert profile.start_m == start
        assert track.elevation.size == expected.size
        tolerance = 1e-8 if pipeline in VARYING else 1e-9
        tolerance += 1e-9 * drift_range(recording, track.name)
        assert np.abs(track.elevation - expected).max() <= tolerance


ADAPTIVE = {
    "low_speed_cutoff_hz": 0.3,
    "cutoff_wavelength_m": 60.0,
    "transition_speed_mps": 4.0,
    "transition_steepness": 1.1,
}
TIMER = {"cutoff_wavelength_m": 20.0, "timer_speed_mps": 6.0, "timer_sharpness": 7.0}
SUPPRESSION = {
    "collective_cutoff_hz": 0.2,
    "suppression_speed_mps": 7.0,
    "suppression_proportional": 0.1,
    "suppression_integral_per_s": 2.0,
}
OTHER_SETTINGS = {
    **{
        name: (ADAPTIVE, {"schedule": section_5_7.Schedule(0.3, 60.0, 4.0, 1.1)})
        for name in VARYING
    },
    "temporal-basic": ({"cutoff_wavelength_m": 20.0}, {"lambda_c": 20.0}),
    "temporal-mean-removal": ({"cutoff_wavelength_m": 20.0}, {"lambda_c": 20.0}),
    "temporal-hpf": ({"collective_cutoff_hz": 0.2}, {"f_3db": 0.2}),
    "temporal-hpf-local-suppression": (
        SUPPRESSION,
        {"f_3db": 0.2, "v_on": 7.0, "K_P": 0.1, "K_I": 2.0},
    ),
    "spatial-basic": ({"cutoff_wavelength_m": 20.0}, {"lambda_c": 20.0}),
    "spatial-hpf": ({"cutoff_wavelength_m": 20.0}, {"lambda_c": 20.0}),
    "spatial-hpf-timer-distortion": (TIMER, {"lambda_c": 20.0, "v_0": 6.0, "beta": 7.0}),
    "spatial-hpf-timer-distortion-reflection": (TIMER, {"lambda_c": 20.0, "v_0": 6.0, "beta": 7.0}),
}


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", REFERENCES)
def test_every_setting_of_an_algorithm_reaches_it(steady, pipeline):
    ours, theirs = OTHER_SETTINGS[pipeline]
    times = np.arange(6000) / 1000.0
    speed = np.where(times < 3.0, np.clip(12.0 - 6.0 * times, 0.0, None), 4.0 * (times - 3.0))
    distance = 0.0003 * np.floor(np.cumsum(speed) / 1000.0 / 0.0003)
    recording = steady(seconds=6.0, distance=distance)
    force, height = (
        recording.channel(name).values for name in ("vertical_specific_force", "height")
    )
    _, expected = REFERENCES[pipeline](force - G, height, distance, 1000.0, 0.05, **theirs)
    (track,) = run(recording, pipeline, ours).profile.tracks
    assert np.abs(track.elevation - expected).max() <= 1e-9
    (default,) = run(recording, pipeline).profile.tracks
    assert np.abs(track.elevation - default.elevation).max() > 1e-6
