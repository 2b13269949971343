"""The stages that the temporal suppression algorithms (5.5 to 5.7) put at the points."""

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
    high_pass_setting,
)
from floatref.stages.filters.schedule import AdaptiveCutOff, ScheduleCutOff, ScheduleWaveNumber
from floatref.stages.filters.varying import (
    StateHighPassB3S1R,
    StateHighPassB3S2R,
    VaryingHighPassB3,
    VaryingHighPassB3R,
    VaryingHighPassB3S1,
    VaryingHighPassB3S2,
)
from floatref.stages.integration import Combine, Integrate
from floatref.stages.protocol import Stage
from floatref.stages.signals import (
    ACCELERATION,
    CUTOFF,
    ELEVATION,
    HEIGHT,
    REFERENCE_HEIGHT,
    TRAVEL_SPEED,
    VELOCITY,
)
from floatref.stages.speed import TravelSpeed
from floatref.stages.suppression import SuppressLocally


def _cutoff(context: Context) -> float:
    return high_pass_setting(basic_steps.cutoff_setting(context, "collective_cutoff_hz"))


def _schedule(context: Context) -> AdaptiveCutOff:
    return AdaptiveCutOff(
        low_speed_hz=basic_steps.cutoff_setting(context, "low_speed_cutoff_hz"),
        wavelength_m=context.setting("cutoff_wavelength_m"),
        transition_speed=context.setting("transition_speed_mps"),
        steepness=context.setting("transition_steepness"),
    )


def condition_from_datum(context: Context) -> Sequence[Stage]:
    """Condition as the basic algorithm does, and measure height from its first sample (5.5)."""
    return (*basic_steps.condition(context), FromFirst(HEIGHT))


def condition_with_speed(context: Context) -> Sequence[Stage]:
    """Add the travel speed to that (5.6)."""
    return (*condition_from_datum(context), TravelSpeed())


def first_integration_filtered(context: Context) -> Sequence[Stage]:
    """HPF_B3S1 before the first integration (5.5)."""
    return HighPassB3S1(ACCELERATION, _cutoff(context)), Integrate(ACCELERATION, VELOCITY)


def first_integration_suppressed(context: Context) -> Sequence[Stage]:
    """Local suppression of the filtered first integral (5.6)."""
    suppress = SuppressLocally(
        VELOCITY,
        context.setting("suppression_speed_mps"),
        context.setting("suppression_proportional"),
        context.setting("suppression_integral_per_s"),
    )
    return (*first_integration_filtered(context), suppress, Drop(TRAVEL_SPEED))


def second_integration_filtered(context: Context) -> Sequence[Stage]:
    """HPF_B3S2 before the second integration, from zero (5.5)."""
    return HighPassB3S2(VELOCITY, _cutoff(context)), Integrate(VELOCITY, REFERENCE_HEIGHT)


def combine_filtered(context: Context) -> Sequence[Stage]:
    """HPF_B3 of the height, subtraction, and the backward stages in time (5.5)."""
    cutoff = _cutoff(context)
    backward = HighPassB3S2R(ELEVATION, cutoff), HighPassB3S1R(ELEVATION, cutoff)
    return (*high_pass_b3(HEIGHT, cutoff), Combine(), *backward)


def condition_with_cutoff(context: Context) -> Sequence[Stage]:
    """Height from its first sample, speed, and the cut-off that follows it (5.7)."""
    return (*condition_with_speed(context), ScheduleCutOff(_schedule(context)))


def condition_matched(context: Context) -> Sequence[Stage]:
    """Speed and cut-off; the observer starts at the first height itself."""
    schedule = ScheduleCutOff(_schedule(context))
    return (*basic_steps.condition(context), TravelSpeed(), schedule)


def condition_adaptive(context: Context) -> Sequence[Stage]:
    """The same without the speed, which no other stage needs (5.7)."""
    return (*condition_with_cutoff(context), Drop(TRAVEL_SPEED))


def first_integration_adaptive(context: Context) -> Sequence[Stage]:
    """HPF_B3S1 at the varying cut-off before the first integration (5.7)."""
    return VaryingHighPassB3S1(ACCELERATION), Integrate(ACCELERATION, VELOCITY)


def second_integration_adaptive(context: Context) -> Sequence[Stage]:
    """HPF_B3S2 at the varying cut-off before the second integration (5.7)."""
    return VaryingHighPassB3S2(VELOCITY), Integrate(VELOCITY, REFERENCE_HEIGHT)


def combine_forward(context: Context) -> Sequence[Stage]:
    """HPF_B3 of the height at the varying cut-off, and subtraction (5.7)."""
    return VaryingHighPassB3(HEIGHT), Drop(CUTOFF), Combine()


def combine_adaptive(context: Context) -> Sequence[Stage]:
    """The same with the backward stages in time (5.7)."""
    height, backward = VaryingHighPassB3(HEIGHT), VaryingHighPassB3R(ELEVATION)
    return height, Combine(), backward, Drop(CUTOFF)


def finish_backward(context: Context) -> Sequence[Stage]:
    """The backward stages over distance, at the cut-off of each point's speed (fig. 5.12)."""
    return (
        ScheduleWaveNumber(_schedule(context)),
        Drop(TRAVEL_SPEED),
        VaryingHighPassB3R(ELEVATION),
        Drop(CUTOFF),
    )


def finish_matched(context: Context) -> Sequence[Stage]:
    """The backward stages over distance in state-variable form, which is valid at a stop."""
    return (
        ScheduleWaveNumber(_schedule(context)),
        Drop(TRAVEL_SPEED),
        StateHighPassB3S2R(ELEVATION),
        StateHighPassB3S1R(ELEVATION),
        Drop(CUTOFF),
    )
