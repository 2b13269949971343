"""The stages that the basic algorithms (5.3, 5.8) put at the points of a signal flow."""

from collections.abc import Sequence

from floatref.errors import InputError
from floatref.interfaces.pipeline import Context
from floatref.stages.conditioning import RemoveGravity
from floatref.stages.filters.butterworth import high_pass_b3x2, low_pass_b3
from floatref.stages.integration import Combine, Integrate
from floatref.stages.marks import SLOW_MPS, STOPPING_TIME_S, MarkDrive
from floatref.stages.protocol import Stage
from floatref.stages.resampling import TimeStep, ToDistance
from floatref.stages.signals import ACCELERATION, ELEVATION, HEIGHT, REFERENCE_HEIGHT, VELOCITY

TIMER_ONSET = 1.2
"""Speed at which timer distortion (5.8) begins to act, as a multiple of its limit speed."""
TRANSITION_WIDTH = 4.0
"""The cut-off (5.3) is that of high speed from v_0 plus this over its steepness."""
LEAST_RATE_HZ = 4000.0
"""Up to this sampling rate in Hz the sensors' own bandwidth must act as anti-alias filter."""


def condition(context: Context) -> Sequence[Stage]:
    """Remove 1 g, mark the drive; LPF_B3 at 1000 Hz on both sensors where the rate allows it."""
    stopping = context.settings.get("stopping_time_s") or STOPPING_TIME_S
    stages: list[Stage] = [RemoveGravity(), MarkDrive(_slow_mps(context), stopping)]
    if context.header.rate > LEAST_RATE_HZ:
        cutoff = cutoff_setting(context, "anti_alias_hz")
        stages += low_pass_b3(ACCELERATION, cutoff)
        stages += low_pass_b3(HEIGHT, cutoff)
    return stages


def _slow_mps(context: Context) -> float:
    """Return the speed in m/s below which the pipeline gives no valid profile."""
    given = {name: value for name, value in context.settings.items() if value}
    speeds = [
        given.get("slow_mps", SLOW_MPS),
        given.get("suppression_speed_mps", 0.0),
        TIMER_ONSET * given.get("timer_speed_mps", 0.0),
    ]
    if "transition_speed_mps" in given:
        width = TRANSITION_WIDTH / given.get("transition_steepness", TRANSITION_WIDTH)
        speeds.append(given["transition_speed_mps"] + width)
    return max(speeds)


def cutoff_setting(context: Context, name: str) -> float:
    """Return cut-off ``name`` in Hz; InputError if it is not below half the rate."""
    value, limit = context.setting(name), float(context.header.rate) / 2
    if not value < limit:
        raise InputError(
            f"setting {name}: {value:g} Hz; give it below {limit:g} Hz, half the sampling rate"
        )
    return value


def first_integration(context: Context) -> Sequence[Stage]:
    """Trapezoidal, from zero velocity."""
    return (Integrate(ACCELERATION, VELOCITY),)


def second_integration(context: Context) -> Sequence[Stage]:
    """Trapezoidal, from the first height: the datum is arbitrary, so elevation starts at 0."""
    return (Integrate(VELOCITY, REFERENCE_HEIGHT, starts_at=HEIGHT),)


def combine(context: Context) -> Sequence[Stage]:
    """Floating reference height minus height (1.2)."""
    return (Combine(),)


def project(context: Context) -> Sequence[Stage]:
    """Decimate by encoder distance (5.3)."""
    return (ToDistance(context.setting("interval_m"), context.origin_m),)


def trigger(context: Context) -> Sequence[Stage]:
    """Capture all channels, and the time, at each profile interval (5.8)."""
    return (ToDistance(context.setting("interval_m"), context.origin_m, keep_time=True),)


def time_step(context: Context) -> Sequence[Stage]:
    """Elapsed time between triggers (5.4)."""
    return (TimeStep(),)


def finish(context: Context) -> Sequence[Stage]:
    """HPF_B3x2 over distance (5.3)."""
    return high_pass_b3x2(ELEVATION, 1.0 / context.setting("cutoff_wavelength_m"))
