"""The road-prior smoother from samples that the encoder triggers."""

from collections.abc import Sequence
from math import pi

from floatref.architectures import steps
from floatref.architectures.pipeline import Context, Pipeline
from floatref.architectures.road_prior_pipeline import CONSTANTS, EXPECTED, ROAD_PRIOR
from floatref.stages.butterworth import low_pass_b3
from floatref.stages.conditioning import RemoveGravity
from floatref.stages.dropping import Drop
from floatref.stages.lateness import Advance
from floatref.stages.protocol import Stage
from floatref.stages.resampling import ToDistance
from floatref.stages.road_prior import RoadPrior, RoadPriorSmoother
from floatref.stages.seams import Seams
from floatref.stages.signals import ACCELERATION, HEIGHT, MISSING_SHARE
from floatref.stages.triggers import ToTime

FILTERED_HZ = 400.0
"""Up to this sampling rate the accelerometer's own bandwidth has to be the slower filter."""
DELAY = 1.0 / pi
"""Delay of LPF_B3 times its cut-off: 2 over the angular frequency, at low frequencies."""

SETTINGS = {name: value for name, value in ROAD_PRIOR[0].settings.items() if name != "edge_sigmas"}
"""At a standstill there is no reading, so none that could tell of an edge."""


def _condition(context: Context) -> Sequence[Stage]:
    """Remove 1 g; LPF_B3 on both sensors, which stands for what is analog before the trigger.

    The accelerometer's is slower: its converter waits until the filter has caught up.
    """
    stages: list[Stage] = [RemoveGravity()]
    height_s = force_s = 0.0
    if context.header.rate > steps.LEAST_RATE_HZ:
        cutoff = steps.cutoff_setting(context, "anti_alias_hz")
        stages += low_pass_b3(HEIGHT, cutoff)
        height_s = DELAY / cutoff
    if context.header.rate > FILTERED_HZ:
        cutoff = steps.cutoff_setting(context, "acceleration_anti_alias_hz")
        stages += low_pass_b3(ACCELERATION, cutoff)
        force_s = DELAY / cutoff
    return *stages, Advance(ACCELERATION, max(0.0, force_s - height_s))


def _estimate(context: Context) -> Sequence[Stage]:
    """Go back to time, estimate there, and take what the triggers get."""
    known = {CONSTANTS[name]: context.setting(name) for name in SETTINGS if name in CONSTANTS}
    return (
        ToTime(context.setting("unknown_after_s")),
        RoadPriorSmoother(RoadPrior(**known), context.setting("cutoff_wavelength_m")),
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
        {"spatial_condition": _condition, "spatial_estimate": _estimate},
        signed=EXPECTED,
    ),
)
