"""The pipeline of the road-prior smoother, with its settings."""

from collections.abc import Sequence

from floatref.architectures.kalman_steps import condition
from floatref.architectures.pipeline import Context, Pipeline
from floatref.stages.dropping import Drop
from floatref.stages.protocol import Stage
from floatref.stages.road_prior import RoadPrior, RoadPriorSmoother
from floatref.stages.seams import Seams
from floatref.stages.signals import TRAVEL_SPEED

CONSTANTS = {
    "acceleration_density": "acceleration",
    "acceleration_bias_sigma": "acceleration_bias",
    "acceleration_walk": "acceleration_walk",
    "acceleration_walk_along": "walk_along",
    "missing_acceleration_density": "missing_acceleration",
    "road_reading_sigma_m": "reading_m",
    "road_intensity_m": "road",
    "long_waves_per_m": "long_waves",
    "road_reach_m": "road_reach_m",
    "road_memory_m": "road_memory_m",
    "edge_sigmas": "edge_sigmas",
    "lean_expected_rad": "lean_expected_rad",
    "lean_sigma_rad": "lean_sigma_rad",
    "tilt_expected": "tilt_expected",
    "tilt_sigma": "tilt_sigma",
    "pitch_hz": "pitch_hz",
    "pitch_damping": "pitch_damping",
    "height_noise_m": "height_m",
    "most_sigma_share": "most_sigma_share",
}
"""From settings to what they are in `RoadPrior`."""
EXPECTED = "lean_expected_rad", "tilt_expected"
_USUAL = vars(RoadPrior())


def _estimate(context: Context) -> Sequence[Stage]:
    constants = RoadPrior(**{field: context.setting(name) for name, field in CONSTANTS.items()})
    smoother = RoadPriorSmoother(constants, context.setting("cutoff_wavelength_m"))
    return smoother, Seams(), Drop(TRAVEL_SPEED)


ROAD_PRIOR = (
    Pipeline(
        "road-prior-smoother",
        "temporal",
        "nominal sensors; the road is a process in distance, which stands still when we do",
        {
            "interval_m": None,
            "anti_alias_hz": 1000.0,
            "cutoff_wavelength_m": 105.91,
            "drift_reach_m": 2.0,
            "before_slow_m": 2.0,
            "after_slow_m": 7.0,
            "distance_scale_sigma": 2e-4,
            **{name: _USUAL[field] for name, field in CONSTANTS.items()},
        },
        {"temporal_condition": condition, "temporal_estimate": _estimate},
        signed=EXPECTED,
    ),
)
