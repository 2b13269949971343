"""The pipelines without a height sensor by name, with their settings."""

from floatref.architectures.catalogue import ADAPTIVE
from floatref.architectures.pipeline import Answer, Pipeline
from floatref.architectures.response_steps import estimate_observing

SETTINGS: dict[str, float | None] = {
    **{name: value for name, value in ADAPTIVE.items() if name != "anti_alias_hz"},
    "distance_scale_sigma": 2e-4,
    "points_per_m": 20.0,
    "contact_m": 0.25,
    "parameter_sigma": 0.03,
    "acceleration_density": 1e-3,
    "angular_acceleration_density": 1e-3,
    "deflection_sigma_m": 5e-4,
    "displacement_sigma": 1e-3,
    "velocity_sigma": 1e-2,
    "angular_displacement_sigma": 1e-3,
    "angular_velocity_sigma": 1e-2,
    "denoise_components": None,
    "denoise_window_s": 0.5,
}
JOINT: dict[str, float | None] = {**SETTINGS, "body_disturbance": 0.5}
OBSERVER: dict[str, float | None] = {**SETTINGS, "position_gain_hz": 20.0, "rate_gain_hz": 0.5}


def _pipeline(
    name: str, summary: str, settings: dict[str, float | None], answers: dict[str, Answer]
) -> Pipeline:
    return Pipeline(name, "response", summary, settings, answers, capabilities=("response",))


RESPONSE = (
    _pipeline(
        "response-joint-input-state",
        "no height sensor: the road as the unknown input of a Kalman filter of the vehicle",
        JOINT,
        {},
    ),
    _pipeline(
        "response-observer",
        "the same by an observer of the vehicle's states",
        OBSERVER,
        {"response_estimate": estimate_observing},
    ),
)
