"""The stages that the spatial suppression algorithms (5.9, 5.10) put at the points."""

from collections.abc import Sequence

from floatref.builtin_pipelines import basic_steps
from floatref.interfaces.pipeline import Context
from floatref.stages.conditioning import Drop, FromFirst
from floatref.stages.filters.butterworth import (
    HighPassB3S1,
    HighPassB3S1R,
    HighPassB3S2,
    HighPassB3S2R,
    high_pass_b3,
)
from floatref.stages.integration import Combine, Integrate
from floatref.stages.protocol import Stage
from floatref.stages.resampling import TimeStep
from floatref.stages.signals import (
    ACCELERATION,
    ELEVATION,
    HEIGHT,
    REFERENCE_HEIGHT,
    TIME,
    TIME_STEP,
    TRUE_TIME_STEP,
    VELOCITY,
)
from floatref.stages.timer_distortion import DistortTimer, IntegrateReflecting


def _wave_number(context: Context) -> float:
    return 1.0 / context.setting("cutoff_wavelength_m")


def trigger_from_datum(context: Context) -> Sequence[Stage]:
    """Trigger as the basic algorithm does, and measure height from its first sample (5.9)."""
    return (*basic_steps.trigger(context), FromFirst(HEIGHT))


def time_step(context: Context) -> Sequence[Stage]:
    """Elapsed time between triggers (5.4)."""
    return TimeStep(), Drop(TIME)


def time_step_distorted(context: Context) -> Sequence[Stage]:
    """Elapsed time, replaced by its limit at low speed (5.7, 5.8)."""
    distort = DistortTimer(context.setting("timer_speed_mps"), context.setting("timer_sharpness"))
    return TimeStep(), Drop(TIME), distort


def first_integration_filtered(context: Context) -> Sequence[Stage]:
    """HPF_B3S1 before the first integration (5.9)."""
    return HighPassB3S1(ACCELERATION, _wave_number(context)), Integrate(ACCELERATION, VELOCITY)


def second_integration_filtered(context: Context) -> Sequence[Stage]:
    """HPF_B3S2 before the second integration, from zero (5.9)."""
    return (
        HighPassB3S2(VELOCITY, _wave_number(context)),
        Integrate(VELOCITY, REFERENCE_HEIGHT),
        Drop(TIME_STEP),
    )


def second_integration_distorted(context: Context) -> Sequence[Stage]:
    """The same without the true time step (5.10)."""
    return (*second_integration_filtered(context), Drop(TRUE_TIME_STEP))


def second_integration_reflecting(context: Context) -> Sequence[Stage]:
    """HPF_B3 of the height, and its reflection in the second integration (5.10)."""
    wave_number = _wave_number(context)
    return (
        *high_pass_b3(HEIGHT, wave_number),
        HighPassB3S2(VELOCITY, wave_number),
        IntegrateReflecting(VELOCITY, REFERENCE_HEIGHT, HEIGHT),
        Drop(TIME_STEP, TRUE_TIME_STEP),
    )


def combine_filtered(context: Context) -> Sequence[Stage]:
    """HPF_B3 of the height, and subtraction (5.9)."""
    return (*high_pass_b3(HEIGHT, _wave_number(context)), Combine())


def finish_backward(context: Context) -> Sequence[Stage]:
    """The backward stages alone (5.9)."""
    wave_number = _wave_number(context)
    return HighPassB3S2R(ELEVATION, wave_number), HighPassB3S1R(ELEVATION, wave_number)
