"""The road-prior smoother with an inertial unit: tilt is measured, not learned."""

from collections.abc import Sequence

from floatref.architectures import steps
from floatref.architectures.pipeline import Context, Pipeline
from floatref.architectures.road_prior_pipeline import EXPECTED, ROAD_PRIOR
from floatref.stages.butterworth import low_pass_b3
from floatref.stages.kalman.inputs import IMU
from floatref.stages.levelling import Level
from floatref.stages.levelling.stage import BLENDED_S
from floatref.stages.protocol import Stage
from floatref.stages.signals import ACCELERATION, HEIGHT
from floatref.stages.speed import TravelSpeed

NOTHING = 1e-9
"""1-σ of what is known."""


def _condition(context: Context) -> Sequence[Stage]:
    """Level; LPF_B3 at 1000 Hz on both sensors where the rate allows it; add the speed."""
    stages: list[Stage] = [Level(context.setting("attitude_blend_s"))]
    if context.header.rate > steps.LEAST_RATE_HZ:
        cutoff = steps.cutoff_setting(context, "anti_alias_hz")
        stages += low_pass_b3(ACCELERATION, cutoff)
        stages += low_pass_b3(HEIGHT, cutoff)
    return (*stages, TravelSpeed())


ROAD_PRIOR_IMU = (
    Pipeline(
        "road-prior-smoother-imu",
        "temporal",
        "the same with an inertial unit, which measures the tilt of the body",
        {
            **ROAD_PRIOR[0].settings,
            "attitude_blend_s": BLENDED_S,
            "tilt_sigma": NOTHING,
        },
        {**ROAD_PRIOR[0].answers, "temporal_condition": _condition},
        channels=IMU,
        capabilities=("imu",),
        signed=EXPECTED,
    ),
)
