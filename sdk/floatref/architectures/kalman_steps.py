"""The stages that the Kalman pipelines (chapter 6) put at the points of the temporal flow."""

from collections.abc import Callable, Sequence

from floatref.architectures import steps
from floatref.architectures.pipeline import Answer, Context
from floatref.stages.butterworth import low_pass_b3
from floatref.stages.conditioning import RemoveGravity
from floatref.stages.dropping import Drop
from floatref.stages.kalman import Noise, Plan
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
"""From settings to what they are in `Noise`."""


def condition(context: Context) -> Sequence[Stage]:
    """Remove 1 g; LPF_B3 at 1000 Hz on both sensors where the rate allows it; add the speed."""
    stages: list[Stage] = [RemoveGravity()]
    if context.header.rate > steps.LEAST_RATE_HZ:
        cutoff = steps.cutoff_setting(context, "anti_alias_hz")
        stages += low_pass_b3(ACCELERATION, cutoff)
        stages += low_pass_b3(HEIGHT, cutoff)
    return (*stages, TravelSpeed())


def noise_of(context: Context) -> Noise:
    """Return what the settings say of sensors and references."""
    return Noise(**{field: context.setting(name) for name, field in NOISE.items()})


def answers(plan: Plan, estimator: Estimator) -> dict[str, Answer]:
    """Return the answers of the pipeline that observes what ``plan`` says."""

    def estimate(context: Context) -> Sequence[Stage]:
        wavelength_m = context.setting("cutoff_wavelength_m")
        return estimator(plan, noise_of(context), wavelength_m), Seams(), Drop(TRAVEL_SPEED)

    return {"temporal_condition": condition, "temporal_estimate": estimate}
