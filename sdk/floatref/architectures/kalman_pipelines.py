"""The five pipelines of chapter 6 by name, with their settings."""

from floatref.architectures.kalman_steps import NOISE, Estimator, answers
from floatref.architectures.pipeline import Pipeline
from floatref.stages.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref.stages.kalman.inputs import GNSS, IMU

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
    name: str, summary: str, plan: Plan, estimator: Estimator = KalmanSmoother, **settings: float
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
    )


KALMAN = (
    _pipeline(
        "kalman-filter",
        "IMU and GNSS, filter alone (section 6.6.1)",
        Plan(reflects=False),
        KalmanFilter,
        drift_reach_m=105.91,
        acceleration_walk=6.32e-6,
        lean_sigma_rad=1e-9,
        gnss_height_walk=1e-9,
    ),
    _pipeline(
        "kalman-smoother",
        "IMU and GNSS, smoothed (section 6.6.2)",
        Plan(reflects=False),
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
