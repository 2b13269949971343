"""The stages that the basic algorithms (5.3, 5.4, 5.8) put at the points of a signal flow."""

from collections.abc import Sequence

from floatref.engine.question import Question
from floatref.errors import InputError
from floatref.stages.conditioning import RemoveGravity
from floatref.stages.filters.butterworth import high_pass_b3x2, low_pass_b3
from floatref.stages.integration import Combine, Integrate, RemoveMean
from floatref.stages.marks import SLOW_MPS, STOPPING_TIME_S, MarkDrive
from floatref.stages.protocol import Stage
from floatref.stages.resampling import TimeStep, ToDistance
from floatref.stages.signals import ACCELERATION, ELEVATION, HEIGHT, REFERENCE_HEIGHT, VELOCITY

TIMER_ONSET = 1.2
"""Timer distortion (5.8) begins to act at so many times its limit speed."""
TRANSITION_WIDTH = 4.0
"""The cut-off (5.3) is that of travel at speed beyond v_0 by this over its steepness."""
LEAST_RATE_HZ = 4000.0
"""Up to this sampling rate the sensors' own bandwidth has to be the anti-alias filter."""


def nothing(question: Question) -> Sequence[Stage]:
    """Leave the point empty."""
    return ()


def condition(question: Question) -> Sequence[Stage]:
    """Remove 1 g, mark the drive; LPF_B3 at 1000 Hz on both sensors where the rate allows it."""
    stopping = question.settings.get("stopping_time_s") or STOPPING_TIME_S
    stages: list[Stage] = [RemoveGravity(), MarkDrive(_slow_mps(question), stopping)]
    if question.header.rate > LEAST_RATE_HZ:
        cutoff = cutoff_setting(question, "anti_alias_hz")
        stages += low_pass_b3(ACCELERATION, cutoff)
        stages += low_pass_b3(HEIGHT, cutoff)
    return stages


def _slow_mps(question: Question) -> float:
    """Return the speed in m/s below which the pipeline gives the profile up."""
    given = {name: value for name, value in question.settings.items() if value}
    speeds = [
        given.get("slow_mps", SLOW_MPS),
        given.get("suppression_speed_mps", 0.0),
        TIMER_ONSET * given.get("timer_speed_mps", 0.0),
    ]
    if "transition_speed_mps" in given:
        width = TRANSITION_WIDTH / given.get("transition_steepness", TRANSITION_WIDTH)
        speeds.append(given["transition_speed_mps"] + width)
    return max(speeds)


def cutoff_setting(question: Question, name: str) -> float:
    """Return cut-off ``name`` in Hz; InputError if it is not below half the rate."""
    value, limit = question.setting(name), float(question.header.rate) / 2
    if not value < limit:
        raise InputError(
            f"setting {name}: {value:g} Hz; give it below {limit:g} Hz, half the sampling rate"
        )
    return value


def first_integration(question: Question) -> Sequence[Stage]:
    """Trapezoidal, from zero velocity."""
    return (Integrate(ACCELERATION, VELOCITY),)


def second_integration(question: Question) -> Sequence[Stage]:
    """Trapezoidal, from the first height: the datum is arbitrary, so elevation starts at 0."""
    return (Integrate(VELOCITY, REFERENCE_HEIGHT, starts_at=HEIGHT),)


def first_integration_without_mean(question: Question) -> Sequence[Stage]:
    """Remove the mean acceleration of the run before the first integration (5.4)."""
    return (RemoveMean(ACCELERATION), *first_integration(question))


def second_integration_without_mean(question: Question) -> Sequence[Stage]:
    """Remove the mean velocity of the run before the second integration (5.4)."""
    return (RemoveMean(VELOCITY), *second_integration(question))


def combine(question: Question) -> Sequence[Stage]:
    """Floating reference height minus height (1.2)."""
    return (Combine(),)


def project(question: Question) -> Sequence[Stage]:
    """Decimate by encoder distance (5.3)."""
    return (ToDistance(question.setting("interval_m"), question.origin_m),)


def trigger(question: Question) -> Sequence[Stage]:
    """Capture all channels, and the time, at each profile interval (5.8)."""
    return (ToDistance(question.setting("interval_m"), question.origin_m, keep_time=True),)


def time_step(question: Question) -> Sequence[Stage]:
    """Elapsed time between triggers (5.4)."""
    return (TimeStep(),)


def finish(question: Question) -> Sequence[Stage]:
    """HPF_B3x2 over distance (5.3)."""
    return high_pass_b3x2(ELEVATION, 1.0 / question.setting("cutoff_wavelength_m"))
