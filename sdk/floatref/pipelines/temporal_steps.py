"""The stages that the temporal suppression algorithms (5.5 to 5.7) put at the points."""

from collections.abc import Sequence

from floatref.engine.question import Question
from floatref.pipelines import basic_steps
from floatref.stages.conditioning import Drop, FromFirst
from floatref.stages.filters.butterworth import (
    HighPassB3S1,
    HighPassB3S1R,
    HighPassB3S2,
    HighPassB3S2R,
    high_pass_b3,
    high_pass_setting,
)
from floatref.stages.filters.matched_high_pass import MatchedHighPass
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


def _cutoff(question: Question) -> float:
    return high_pass_setting(basic_steps.cutoff_setting(question, "collective_cutoff_hz"))


def _schedule(question: Question) -> AdaptiveCutOff:
    return AdaptiveCutOff(
        low_speed_hz=basic_steps.cutoff_setting(question, "low_speed_cutoff_hz"),
        wavelength_m=question.setting("cutoff_wavelength_m"),
        transition_speed=question.setting("transition_speed_mps"),
        steepness=question.setting("transition_steepness"),
    )


def condition_from_datum(question: Question) -> Sequence[Stage]:
    """Condition as the basic algorithm does, and measure height from its first sample (5.5)."""
    return (*basic_steps.condition(question), FromFirst(HEIGHT))


def condition_with_speed(question: Question) -> Sequence[Stage]:
    """Add the travel speed to that (5.6)."""
    return (*condition_from_datum(question), TravelSpeed())


def first_integration_filtered(question: Question) -> Sequence[Stage]:
    """HPF_B3S1 before the first integration (5.5)."""
    return HighPassB3S1(ACCELERATION, _cutoff(question)), Integrate(ACCELERATION, VELOCITY)


def first_integration_suppressed(question: Question) -> Sequence[Stage]:
    """Local suppression of what the filtered first integration gives (5.6)."""
    suppress = SuppressLocally(
        VELOCITY,
        question.setting("suppression_speed_mps"),
        question.setting("suppression_proportional"),
        question.setting("suppression_integral_per_s"),
    )
    return (*first_integration_filtered(question), suppress, Drop(TRAVEL_SPEED))


def second_integration_filtered(question: Question) -> Sequence[Stage]:
    """HPF_B3S2 before the second integration, from zero (5.5)."""
    return HighPassB3S2(VELOCITY, _cutoff(question)), Integrate(VELOCITY, REFERENCE_HEIGHT)


def combine_filtered(question: Question) -> Sequence[Stage]:
    """HPF_B3 of the height, subtraction, and the backward stages in time (5.5)."""
    cutoff = _cutoff(question)
    backward = HighPassB3S2R(ELEVATION, cutoff), HighPassB3S1R(ELEVATION, cutoff)
    return (*high_pass_b3(HEIGHT, cutoff), Combine(), *backward)


def condition_with_cutoff(question: Question) -> Sequence[Stage]:
    """Height from its first sample, speed, and the cut-off that follows it (5.7)."""
    return (*condition_with_speed(question), ScheduleCutOff(_schedule(question)))


def condition_matched(question: Question) -> Sequence[Stage]:
    """Speed and cut-off; the observer starts at the first height itself."""
    schedule = ScheduleCutOff(_schedule(question))
    return (*basic_steps.condition(question), TravelSpeed(), schedule)


def condition_adaptive(question: Question) -> Sequence[Stage]:
    """The same without the speed, which nothing else needs (5.7)."""
    return (*condition_with_cutoff(question), Drop(TRAVEL_SPEED))


def first_integration_adaptive(question: Question) -> Sequence[Stage]:
    """HPF_B3S1 at the varying cut-off before the first integration (5.7)."""
    return VaryingHighPassB3S1(ACCELERATION), Integrate(ACCELERATION, VELOCITY)


def second_integration_adaptive(question: Question) -> Sequence[Stage]:
    """HPF_B3S2 at the varying cut-off before the second integration (5.7)."""
    return VaryingHighPassB3S2(VELOCITY), Integrate(VELOCITY, REFERENCE_HEIGHT)


def combine_forward(question: Question) -> Sequence[Stage]:
    """HPF_B3 of the height at the varying cut-off, and subtraction (5.7)."""
    return VaryingHighPassB3(HEIGHT), Drop(CUTOFF), Combine()


def combine_adaptive(question: Question) -> Sequence[Stage]:
    """The same with the backward stages in time (5.7)."""
    height, backward = VaryingHighPassB3(HEIGHT), VaryingHighPassB3R(ELEVATION)
    return height, Combine(), backward, Drop(CUTOFF)


def finish_backward(question: Question) -> Sequence[Stage]:
    """The backward stages over distance, at the cut-off of each point's speed (fig. 5.12)."""
    return (
        ScheduleWaveNumber(_schedule(question)),
        Drop(TRAVEL_SPEED),
        VaryingHighPassB3R(ELEVATION),
        Drop(CUTOFF),
    )


def finish_matched(question: Question) -> Sequence[Stage]:
    """The backward stages over distance in state-variable form, which bears a stop."""
    return (
        ScheduleWaveNumber(_schedule(question)),
        Drop(TRAVEL_SPEED),
        StateHighPassB3S2R(ELEVATION),
        StateHighPassB3S1R(ELEVATION),
        Drop(CUTOFF),
    )


def observe(question: Question) -> Sequence[Stage]:
    """The matched high-pass in place of both integrations."""
    return MatchedHighPass(), Drop(CUTOFF)
