"""The five pipelines of chapter 6 by name, with their settings."""

from collections.abc import Callable, Sequence

from floatref.builtin_pipelines import basic_steps
from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref.estimators.kalman.inputs import GNSS, IMU
from floatref.interfaces.pipeline import Answer, Context, Pipeline
from floatref.stages.conditioning import Drop, RemoveGravity
from floatref.stages.filters.butterworth import low_pass_b3
from floatref.stages.protocol import Stage
from floatref.stages.seams import Seams
from floatref.stages.signals import ACCELERATION, HEIGHT, TRAVEL_SPEED
from floatref.stages.speed import TravelSpeed

Estimator = Callable[[Plan, Noise, float], Stage]
NOISE = {
    "acceleration_density": "acceleration",
    "acceleration_walk": "acceleration_walk",
    "missing_acceleration_density": "missing_acceleration",
    "roll_rate_density": "roll_rate",
    "pitch_rate_density": "pitch_rate",
    "yaw_rate_density": "yaw_rate",
    "roll_rate_walk": "roll_rate_walk",
    "pitch_rate_walk": "pitch_rate_walk",
    "gnss_height_sigma_m": "gnss_height_m",
    "gnss_velocity_sigma_mps": "gnss_velocity_mps",
    "gnss_pitch_sigma_rad": "gnss_pitch_rad",
    "gnss_roll_sigma_rad": "gnss_roll_rad",
    "constant_height_density": "constant_height",
    "constant_velocity_density": "constant_velocity",
    "constant_pitch_density": "constant_pitch",
    "constant_roll_density": "constant_roll",
    "reflection_density": "reflection",
    "gnss_height_walk": "gnss_height_walk",
    "lean_sigma_rad": "lean_rad",
    "height_noise_m": "height_m",
}
"""From settings to the names in `Noise`."""


def filter_sensors(context: Context) -> Sequence[Stage]:
    """Remove 1 g; LPF_B3 at 1000 Hz on both sensors where the rate allows it."""
    stages: list[Stage] = [RemoveGravity()]
    if context.header.rate > basic_steps.LEAST_RATE_HZ:
        cutoff = basic_steps.cutoff_setting(context, "anti_alias_hz")
        stages += low_pass_b3(ACCELERATION, cutoff)
        stages += low_pass_b3(HEIGHT, cutoff)
    return stages


def condition(context: Context) -> Sequence[Stage]:
    """Do what `filter_sensors` does, and add the speed."""
    return (*filter_sensors(context), TravelSpeed())


def noise_of(context: Context) -> Noise:
    """Return the noise of sensors and references from the settings."""
    return Noise(**{field: context.setting(name) for name, field in NOISE.items()})


def answers(plan: Plan, estimator: Estimator) -> dict[str, Answer]:
    """Return the answers of the pipeline that observes the readings of ``plan``."""

    def estimate(context: Context) -> Sequence[Stage]:
        wavelength_m = context.setting("cutoff_wavelength_m")
        return estimator(plan, noise_of(context), wavelength_m), Seams(), Drop(TRAVEL_SPEED)

    return {"temporal_condition": condition, "temporal_estimate": estimate}


_USUAL = vars(Noise())
SETTINGS: dict[str, float | None] = {
    "interval_m": None,
    "anti_alias_hz": 1000.0,
    "cutoff_wavelength_m": 105.91,
    "drift_reach_m": 26.4775,
    "before_slow_m": 2.0,
    "after_slow_m": 7.0,
    "distance_scale_sigma": 2e-4,
    **{name: _USUAL[field] for name, field in NOISE.items()},
}


def _readings(plan: Plan) -> tuple[str, ...]:
    names = [channel.name for channel in GNSS]
    if not plan.gnss:
        return ()
    return tuple(names if plan.attitude else names[:2])


def _pipeline(
    name: str,
    summary: str,
    plan: Plan,
    estimator: Estimator = KalmanSmoother,
    through_stops: bool = True,
    **settings: float,
) -> Pipeline:
    return Pipeline(
        name,
        "temporal",
        summary,
        {**SETTINGS, **settings},
        answers(plan, estimator),
        channels=IMU,
        readings=_readings(plan),
        capabilities=("imu", "gnss") if plan.gnss else ("imu",),
        through_stops=through_stops,
    )


KALMAN = (
    _pipeline(
        "kalman-filter",
        "IMU and GNSS, filter alone (section 6.6.1)",
        Plan(reflects=False),
        KalmanFilter,
        through_stops=False,
        drift_reach_m=105.91,
        acceleration_walk=6.32e-6,
        lean_sigma_rad=1e-9,
        gnss_height_walk=1e-9,
    ),
    _pipeline(
        "kalman-smoother",
        "IMU and GNSS, smoothed (section 6.6.2)",
        Plan(reflects=False),
        # The GNSS height drifts while the vehicle is stationary, and this one follows it.
        through_stops=False,
    ),
    _pipeline(
        "kalman-smoother-reflection",
        "the same, the height sensor in place of GNSS heights at a stop (section 6.6.3)",
        Plan(),
    ),
    _pipeline(
        "kalman-smoother-constant-attitude",
        "the same without attitude from GNSS (section 6.6.4)",
        Plan(attitude=False),
    ),
    _pipeline(
        "kalman-smoother-constant-height-attitude",
        "IMU without GNSS (section 6.6.5)",
        Plan(gnss=False, attitude=False),
        acceleration_walk=3e-4,
        pitch_rate_walk=_USUAL["roll_rate_walk"],
        constant_pitch_density=0.1,
        constant_roll_density=0.04,
    ),
)
