"""Horizontal accelerometers against the travel that encoder, yaw rate and GNSS measure."""

from collections.abc import Iterator

from floatref.screening.explanations import RIGHT, Look, report_fault, weigh
from floatref.screening.gnss_readings import course
from floatref.screening.roll_and_pitch import DEGREES, axes
from floatref.screening.slow_series import Motion, integrate, smooth
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Recording

SMOOTH_S = 0.5
TRAVEL = Look(span_s=20.0, floor=0.05)
"""Braking and setting off; the slope of the road and a bias are free."""
CURVES = Look(span_s=10.0, floor=1.5, degree=-1)
"""A road banked by 15 % removes 1.5 m/s². No polynomial is free: a long curve is constant."""
COURSE = Look(span_s=8.0, floor=0.01, degree=0)
"""Turns of the course; its initial direction is free."""


def check_travel_force(recording: Recording, track: str, motion: Motion) -> Iterator[str]:
    """Yield a warning if the longitudinal force does not seem to be the vehicle's acceleration.

    Raises InputError where that is certain: the sign, the axis or the unit is wrong.
    """
    along, across, _ = (smooth(force, SMOOTH_S) for force in motion.forces)
    evidence = weigh(
        motion.times,
        smooth(motion.acceleration, SMOOTH_S),
        {
            RIGHT: along,
            "sign": -along,
            "g": STANDARD_GRAVITY * along,
            "-g": -STANDARD_GRAVITY * along,
            "axis": across,
            "-axis": -across,
        },
        TRAVEL,
    )
    one, two = (
        recording.channel(f"{name}_specific_force", track).id
        for name in ("longitudinal", "lateral")
    )
    against = "against the encoder's acceleration"
    yield from report_fault(
        evidence,
        {
            "sign": f"channel {one}: the sign is inverted {against}; multiply by -1",
            "g": f"channel {one}: a tenth of the encoder's acceleration, looks like g; multiply by "
            "9.80665",
            "-g": f"channel {one}: a tenth {against}, looks like g with the sign inverted; "
            "multiply by -9.80665",
            "axis": f"channels {one} and {two}: exchanged, the lateral one follows the encoder's "
            "acceleration; exchange them (X forward, Y left)",
            "-axis": f"channels {one} and {two}: exchanged, the lateral one is inverted {against}; "
            "exchange them and check the signs (X forward, Y left)",
        },
    )


def check_curves(recording: Recording, track: str, motion: Motion) -> Iterator[str]:
    """Yield a warning if yaw rate and lateral force seem to disagree.

    Raises InputError where that is certain.
    """
    speed, across = smooth(motion.speed, SMOOTH_S), smooth(motion.forces[1], SMOOTH_S)
    evidence = weigh(
        motion.times,
        speed * smooth(motion.rates[2], SMOOTH_S),
        {
            RIGHT: across,
            "sign": -across,
            "unit": DEGREES * across,
            "-unit": -DEGREES * across,
        },
        CURVES,
    )
    force, yaw = (recording.channel(n, track).id for n in ("lateral_specific_force", "yaw_rate"))
    yield from report_fault(
        evidence,
        {
            "sign": f"channels {force} and {yaw}: contradict each other in curves; multiply the "
            "one that is negative in a left turn by -1",
            "unit": f"channel {yaw}: 57.3 times what {force} shows in curves, looks like deg/s; "
            "multiply by 0.0174533",
            "-unit": f"channel {yaw}: -57.3 times what {force} shows in curves, looks like deg/s "
            "with a sign inverted; multiply by 0.0174533 and check both signs",
        },
    )


def check_course(recording: Recording, track: str, motion: Motion) -> Iterator[str]:
    """Yield a warning if the yaw rate and the course of GNSS seem to disagree.

    Raises InputError where that is certain.
    """
    direction = course(recording, motion)
    if direction is None:
        return
    roll, pitch, yaw = (direction.beside(integrate(rate)) for rate in motion.rates)
    evidence = weigh(direction.times, direction.values, axes(yaw, roll, pitch), COURSE)
    name = recording.channel("yaw_rate", track).id
    witness = "the course of gnss_latitude and gnss_longitude"
    yield from report_fault(
        evidence,
        {
            "sign": f"channel {name}: the sign is inverted against {witness}; multiply by -1 (left "
            "turn positive)",
            "unit": f"channel {name}: 57.3 times what {witness} turns by, looks like deg/s; "
            "multiply by 0.0174533",
            "-unit": f"channel {name}: -57.3 times what {witness} turns by, looks like deg/s with "
            "the sign inverted; multiply by -0.0174533",
            "first": f"channels {name} and roll_rate: exchanged, {witness} follows roll_rate; "
            "give the rates about X forward, Y left, Z up",
            "second": f"channels {name} and pitch_rate: exchanged, {witness} follows pitch_rate; "
            "give the rates about X forward, Y left, Z up",
        },
    )
