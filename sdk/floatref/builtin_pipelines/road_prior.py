"""The pipeline of the road-prior smoother, with its settings."""

from collections.abc import Sequence
from math import pi

from floatref.builtin_pipelines import basic_steps
from floatref.builtin_pipelines.chapter_6 import filter_sensors
from floatref.builtin_pipelines.laser_place import levers_of
from floatref.estimators.kalman.inputs import IMU
from floatref.estimators.levelling import Level
from floatref.estimators.levelling.level import BLENDED_S
from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.interfaces.pipeline import Context, Pipeline
from floatref.stages.conditioning import Drop, RemoveGravity
from floatref.stages.filters.butterworth import low_pass_b3
from floatref.stages.filters.lateness import Advance
from floatref.stages.protocol import Stage
from floatref.stages.resampling import ToDistance
from floatref.stages.seams import Seams
from floatref.stages.signals import ACCELERATION, HEIGHT, MISSING_SHARE
from floatref.stages.triggers import ToTime

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
"""From settings to the names in `RoadPrior`."""
EXPECTED = "lean_expected_rad", "tilt_expected"
_USUAL = vars(RoadPrior())


def _constants(context: Context) -> RoadPrior:
    names = (name for name in CONSTANTS if name in context.pipeline.settings)
    return RoadPrior(**{CONSTANTS[name]: context.setting(name) for name in names})


def _level(context: Context) -> Sequence[Stage]:
    """Level the forces, and carry the heights, by the pitch of the body on the run's own road."""
    from floatref.estimators.road_slope import LevelByRoad

    levers_m = {track: ahead for track, (ahead, _) in levers_of(context.header).items()}
    wavelength_m = context.setting("cutoff_wavelength_m")
    return (LevelByRoad(levers_m, _constants(context), wavelength_m),)


def _estimate(context: Context) -> Sequence[Stage]:
    smoother = RoadPriorSmoother(_constants(context), context.setting("cutoff_wavelength_m"))
    return smoother, Seams()


ROAD_PRIOR = (
    Pipeline(
        "road-prior-smoother",
        "temporal",
        "nominal sensors; the road is a process in distance, which does not change at a stop",
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
        {
            "temporal_laser": _level,
            "temporal_condition": filter_sensors,
            "temporal_estimate": _estimate,
        },
        signed=EXPECTED,
        through_stops=True,
    ),
)


FILTERED_HZ = 400.0
"""Up to this sampling rate in Hz the accelerometer's own bandwidth must act as slower filter."""
DELAY = 1.0 / pi
"""Delay of LPF_B3 times its cut-off: 2 over the angular frequency, at low frequencies."""

SETTINGS = {name: value for name, value in ROAD_PRIOR[0].settings.items() if name != "edge_sigmas"}
"""At a standstill there are no readings, so an edge cannot be detected."""


def _condition(context: Context) -> Sequence[Stage]:
    """Remove 1 g; LPF_B3 on both sensors, a model of the analog filters before the trigger.

    The accelerometer's is slower: its converter waits for the delay of the filter.
    """
    stages: list[Stage] = [RemoveGravity()]
    height_s = force_s = 0.0
    if context.header.rate > basic_steps.LEAST_RATE_HZ:
        cutoff = basic_steps.cutoff_setting(context, "anti_alias_hz")
        stages += low_pass_b3(HEIGHT, cutoff)
        height_s = DELAY / cutoff
    if context.header.rate > FILTERED_HZ:
        cutoff = basic_steps.cutoff_setting(context, "acceleration_anti_alias_hz")
        stages += low_pass_b3(ACCELERATION, cutoff)
        force_s = DELAY / cutoff
    return *stages, Advance(ACCELERATION, max(0.0, force_s - height_s))


def _estimate_triggered(context: Context) -> Sequence[Stage]:
    """Change to the time axis, level and estimate there, and sample the result at the triggers."""
    from floatref.estimators.road_slope import AddRoad, LevelTriggered

    levers_m = {track: ahead for track, (ahead, _) in levers_of(context.header).items()}
    constants, wavelength_m = _constants(context), context.setting("cutoff_wavelength_m")
    return (
        ToTime(context.setting("unknown_after_s")),
        LevelTriggered(levers_m, constants, wavelength_m),
        RoadPriorSmoother(constants, wavelength_m),
        AddRoad(),
        Seams(),
        Drop(MISSING_SHARE),
        ToDistance(context.setting("interval_m"), context.origin_m),
    )


ROAD_PRIOR_SPATIAL = (
    Pipeline(
        "road-prior-smoother-spatial",
        "spatial",
        "the same from one sample per profile interval, triggered by the encoder",
        {**SETTINGS, "acceleration_anti_alias_hz": 100.0, "unknown_after_s": 0.8},
        {
            "spatial_laser": (),
            "spatial_condition": _condition,
            "spatial_estimate": _estimate_triggered,
        },
        signed=EXPECTED,
        through_stops=True,
    ),
)


NOTHING = 1e-9
"""1-σ of known values."""
ATTITUDE_WALK = 2e-4
"""What is left of the tilt by acceleration, in 1/√s: the attitude drifts by 0.2 mrad in a second.
With the slope of the road out of the bias, a crown is of the road and no longer of the sensor."""
FREE_WAVES = 4e-6
"""Long waves before the run has shown its own, in 1/m: twenty times those of a plain road. A crown
needs more, and a creeping vehicle less: its bias is as slow as a wave."""


def _condition_levelled(context: Context) -> Sequence[Stage]:
    """Level, carry heights; LPF_B3 at 1000 Hz on both where the rate allows it."""
    levers = levers_of(context.header)
    stages: list[Stage] = [Level(context.setting("attitude_blend_s"), levers)]
    if context.header.rate > basic_steps.LEAST_RATE_HZ:
        cutoff = basic_steps.cutoff_setting(context, "anti_alias_hz")
        stages += low_pass_b3(ACCELERATION, cutoff)
        stages += low_pass_b3(HEIGHT, cutoff)
    return stages


ROAD_PRIOR_IMU = (
    Pipeline(
        "road-prior-smoother-imu",
        "temporal",
        "the same with an inertial unit, which measures the tilt of the body",
        {
            **ROAD_PRIOR[0].settings,
            "attitude_blend_s": BLENDED_S,
            "tilt_sigma": NOTHING,
            "acceleration_walk_along": ATTITUDE_WALK,
            "long_waves_per_m": FREE_WAVES,
        },
        {
            **ROAD_PRIOR[0].answers,
            "temporal_laser": (),
            "temporal_condition": _condition_levelled,
        },
        channels=IMU,
        capabilities=("imu",),
        signed=EXPECTED,
        through_stops=True,
    ),
)
