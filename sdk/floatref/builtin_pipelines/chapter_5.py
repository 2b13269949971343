"""The built-in pipelines: every algorithm of chapter 5 by name, with its settings."""

from dataclasses import replace

from floatref.builtin_pipelines import basic_steps
from floatref.builtin_pipelines import spatial_steps as spatial
from floatref.builtin_pipelines import temporal_steps as temporal
from floatref.interfaces.pipeline import Answer, Pipeline
from floatref.interfaces.stage_calls import StageCall
from floatref.stages.signals import ACCELERATION, CUTOFF, HEIGHT, REFERENCE_HEIGHT, VELOCITY

VALIDITY: dict[str, float | None] = {
    "slow_mps": 4.4704,
    "stopping_time_s": 5.0,
    "before_slow_m": 15.0,
    "after_slow_m": 30.0,
    "after_braking_m": 30.0,
}
UNSUPPRESSED = {"before_slow_m": 47.0, "after_slow_m": 76.0, "after_braking_m": 47.0}
UNLIMITED = {"before_slow_m": 158.865, "after_slow_m": 158.865, "after_braking_m": 47.0}
"""In the spatial architecture a stop is one time step, which only timer distortion limits."""
INTERVAL = {"interval_m": None, "anti_alias_hz": 1000.0, **VALIDITY}
WAVELENGTH = {**INTERVAL, "cutoff_wavelength_m": 105.91}
COLLECTIVE = {
    **INTERVAL,
    "collective_cutoff_hz": 0.0489,
    "run_in_m": 52.955,
    "drift_reach_m": 105.91,
}
SUPPRESSION = {
    **COLLECTIVE,
    "suppression_speed_mps": 4.4704,
    "suppression_proportional": 0.001,
    "suppression_integral_per_s": 0.834,
}
ADAPTIVE = {
    **WAVELENGTH,
    "low_speed_cutoff_hz": 0.45,
    "transition_speed_mps": 2.778,
    "transition_steepness": 2.5,
}
BASIC = {**WAVELENGTH, **UNSUPPRESSED}
SPATIAL = {**WAVELENGTH, **UNLIMITED}
TIMER = {**WAVELENGTH, "timer_speed_mps": 3.576, "timer_sharpness": 25.0}

TEMPORAL_HPF: dict[str, Answer] = {
    "temporal_condition": temporal.condition_from_datum,
    "temporal_first_integration": temporal.first_integration_filtered,
    "temporal_second_integration": temporal.second_integration_filtered,
    "temporal_combine": temporal.combine_filtered,
    "temporal_finish": (),
}
TEMPORAL_ADAPTIVE: dict[str, Answer] = {
    "temporal_condition": temporal.condition_adaptive,
    "temporal_first_integration": temporal.first_integration_adaptive,
    "temporal_second_integration": temporal.second_integration_adaptive,
    "temporal_combine": temporal.combine_adaptive,
    "temporal_finish": (),
}
SPATIAL_HPF: dict[str, Answer] = {
    "spatial_trigger": spatial.trigger_from_datum,
    "spatial_time_step": spatial.time_step,
    "spatial_first_integration": spatial.first_integration_filtered,
    "spatial_second_integration": spatial.second_integration_filtered,
    "spatial_combine": spatial.combine_filtered,
    "spatial_finish": spatial.finish_backward,
}

_PRINTED = (
    Pipeline("temporal-basic", "temporal", "no error suppression (section 5.3)", BASIC),
    Pipeline(
        "temporal-mean-removal",
        "temporal",
        "the run's mean removed before each integration (section 5.4)",
        BASIC,
        {
            "temporal_first_integration": (
                StageCall("RemoveMean", ACCELERATION),
                StageCall("Integrate", ACCELERATION, VELOCITY),
            ),
            "temporal_second_integration": (
                StageCall("RemoveMean", VELOCITY),
                StageCall("Integrate", VELOCITY, REFERENCE_HEIGHT, starts_at=HEIGHT),
            ),
        },
    ),
    Pipeline(
        "temporal-hpf",
        "temporal",
        "high-pass filters before the integrations (section 5.5)",
        COLLECTIVE,
        TEMPORAL_HPF,
    ),
    Pipeline(
        "temporal-hpf-local-suppression",
        "temporal",
        "the same, velocity held near zero at low speed (section 5.6)",
        SUPPRESSION,
        {
            **TEMPORAL_HPF,
            "temporal_condition": temporal.condition_with_speed,
            "temporal_first_integration": temporal.first_integration_suppressed,
        },
    ),
    Pipeline(
        "temporal-adaptive-hpf",
        "temporal",
        "cut-off that follows the speed (section 5.7)",
        ADAPTIVE,
        TEMPORAL_ADAPTIVE,
    ),
    Pipeline(
        "temporal-adaptive-hpf-spatial-backward",
        "temporal",
        "the same, its backward pass over distance (section 5.7)",
        ADAPTIVE,
        {
            **TEMPORAL_ADAPTIVE,
            "temporal_condition": temporal.condition_with_cutoff,
            "temporal_combine": temporal.combine_forward,
            "temporal_finish": temporal.finish_backward,
        },
    ),
    Pipeline(
        "temporal-matched-hpf",
        "temporal",
        "an observer with that cut-off, exact for the vehicle's motion",
        ADAPTIVE,
        {
            "temporal_condition": temporal.condition_matched,
            "temporal_estimate": (StageCall("MatchedHighPass"), StageCall("Drop", CUTOFF)),
            "temporal_finish": temporal.finish_matched,
        },
    ),
    Pipeline("spatial-basic", "spatial", "no error suppression (section 5.8)", SPATIAL),
    Pipeline(
        "spatial-hpf",
        "spatial",
        "high-pass filters before the integrations (section 5.9)",
        SPATIAL,
        SPATIAL_HPF,
    ),
    Pipeline(
        "spatial-hpf-timer-distortion",
        "spatial",
        "the same, the time step limited at low speed (section 5.10)",
        TIMER,
        {
            **SPATIAL_HPF,
            "spatial_time_step": spatial.time_step_distorted,
            "spatial_second_integration": spatial.second_integration_distorted,
        },
    ),
    Pipeline(
        "spatial-hpf-timer-distortion-reflection",
        "spatial",
        "the same, the height sensor reflected there (section 5.10)",
        TIMER,
        {
            **SPATIAL_HPF,
            "spatial_time_step": spatial.time_step_distorted,
            "spatial_second_integration": spatial.second_integration_reflecting,
            "spatial_combine": basic_steps.combine,
        },
    ),
)
PIPELINES = tuple(replace(pipeline, through_stops=False) for pipeline in _PRINTED)
"""At a stop they lose the road: their integrals drift there, or are held back with the road."""
