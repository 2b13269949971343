"""Rates and attitude: which of them has a wrong sign, unit or axis.

Where a rate and GNSS disagree, the tilt decides: braking pitches a vehicle, and gravity shows it.
"""

from collections.abc import Iterator

import numpy as np

from floatref.errors import InputError
from floatref.screening.explanations import Evidence, detrend, report_fault, windows
from floatref.screening.roll_and_pitch import (
    ATTITUDE,
    AXES,
    Axis,
    Witnesses,
    read_attitudes,
    weigh_witnesses,
)
from floatref.screening.slow_series import RATES, Motion, bridge, integrate
from floatref.values.arrays import FloatArray
from floatref.values.recording import Recording

SUSTAINED = 1.0
"""Limit of a vehicle's turns over some seconds, in rad/s, root mean square."""
SWAYS = 0.08
"""Limit of its roll and pitch about a straight line over that time, for half of the run, in rad."""
FRAME = "right-handed about X forward, Y left, Z up"


def check_plausible_rates(recording: Recording, track: str, motion: Motion) -> None:
    """Raise InputError for a rate above the limit of a vehicle, as one in deg/s is."""
    parts = list(windows(motion.times, ATTITUDE.span_s))
    for name, row in zip(RATES, motion.rates, strict=True):
        rate = bridge(row)
        angle = integrate(rate)
        highest = max(float(np.sqrt(np.mean(rate[part] ** 2))) for part in parts)
        sways = float(np.median([_sway(motion.times[part], angle[part]) for part in parts]))
        if highest > SUSTAINED:
            what = f"turns by {highest:.3g} rad/s root mean square over {ATTITUDE.span_s:g} s"
        elif sways > SWAYS and name != "yaw_rate":
            what = f"swings by {sways:.3g} rad root mean square for half of the run"
        else:
            continue
        raise InputError(
            f"channel {recording.channel(name, track).id}: {what}, more than a vehicle does; if "
            "it is in deg/s, multiply by 0.0174533"
        )


def _sway(times: FloatArray, angle: FloatArray) -> float:
    return float(np.sqrt(np.mean(detrend(times, angle[:, None], 1) ** 2)))


def check_rates(
    recording: Recording, track: str, motion: Motion, uses_attitude: bool
) -> Iterator[str]:
    """Yield warnings about rates and attitude that seem to disagree.

    Raises InputError where a sign, a unit or an axis is certainly wrong; the attitude's faults
    are warnings unless the pipeline ``uses_attitude``.
    """
    roll, pitch = weigh_witnesses(motion, read_attitudes(recording, motion))
    names = [str(recording.channel(axis.rate, track).id) for axis in AXES]
    for axis, own, other in zip(AXES, (roll, pitch), (pitch, roll), strict=True):
        yield from _compare_with_attitude(axis, names, own, other, uses_attitude)
        if not own.attitude.certain:
            yield from _compare_with_tilt(axis, names, own, other, uses_attitude)


def _compare_with_attitude(
    axis: Axis, names: list[str], own: Witnesses, other: Witnesses, uses_attitude: bool
) -> Iterator[str]:
    """Yield or raise a contradiction of GNSS and a rate; the tilt shows which one is wrong."""
    rate, evidence = names[axis.row], own.attitude
    if "first" in evidence.name and other.attitude.confirmed:
        return
    asked = (own, other) if "first" in evidence.name else (own,)
    angle_blamed = "deg" in evidence.name or any(w.angle.certain or w.rate.confirmed for w in asked)
    rate_blamed = "unit" in evidence.name or any(w.rate.certain or w.angle.confirmed for w in asked)
    if angle_blamed and not rate_blamed:
        yield from report_fault(evidence, _lines_on_angle(axis, rate), uses_attitude)
    elif rate_blamed and not angle_blamed:
        yield from report_fault(evidence, _lines_on_rate(axis, names, axis.angle))
    else:
        yield from report_fault(evidence, _lines_on_either(axis, names), uses_attitude)


def _compare_with_tilt(
    axis: Axis, names: list[str], own: Witnesses, other: Witnesses, uses_attitude: bool
) -> Iterator[str]:
    """Yield or raise the faults that the tilt proves."""
    if own.rate.certain and _is_exchange(axis, own.rate, other.rate):
        lines = _lines_on_rate(axis, names, axis.tilt)
        if own.attitude.confirmed:
            lines |= _lines_on_both(axis, names)
        yield from report_fault(own.rate, lines)
    if own.angle.certain and _is_exchange(axis, own.angle, other.angle):
        yield from report_fault(own.angle, _lines_on_angle(axis, axis.tilt), uses_attitude)


def _is_exchange(axis: Axis, own: Evidence, other: Evidence) -> bool:
    """Return whether the tilt is conclusive: braking in a curve tilts roll and pitch alike."""
    if "first" not in own.name:
        return True
    alike = other.name == own.name and other.likely
    return alike or (axis.rate == "pitch_rate" and not other.right and not other.wrong)


def _lines_on_rate(axis: Axis, names: list[str], witness: str) -> dict[str, str]:
    rate, twin = names[axis.row], names[1 - axis.row]
    inverted = f"channel {rate}: the sign is inverted against {witness}; multiply by -1 ({FRAME})"
    degrees = (
        f"turns {{}} times as far as {witness}, looks like deg/s{{}}; multiply by {{}}0.0174533"
    )
    return {
        "sign": inverted,
        "unit": f"channel {rate}: " + degrees.format("57.3", "", ""),
        "-unit": f"channel {rate}: " + degrees.format("-57.3", " with the sign inverted", "-"),
        "first": f"channels {rate} and {twin}: exchanged, {twin} is what follows {witness}; give "
        f"the rates {FRAME}",
        "second": f"channels {rate} and yaw_rate: exchanged, yaw_rate is what follows {witness}; "
        f"give the rates {FRAME}",
    }


def _lines_on_angle(axis: Axis, witness: str) -> dict[str, str]:
    angle, twin = axis.angle, AXES[1 - axis.row].angle
    degrees = (
        f"channel {angle}: turns 57.3 times as far as {witness}, looks like degrees; multiply by "
        "0.0174533"
    )
    return {
        "sign": f"channel {angle}: the sign is inverted against {witness}; multiply by -1 "
        f"({axis.positive})",
        "unit": degrees,
        "deg": degrees,
        "first": f"channels {angle} and {twin}: exchanged, {twin} is what follows {witness}; "
        "exchange them",
        "second": f"channel {angle}: follows yaw_rate, not {witness}; check the antennas' places",
    }


def _lines_on_either(axis: Axis, names: list[str]) -> dict[str, str]:
    rate, twin, angle = names[axis.row], names[1 - axis.row], axis.angle
    other = AXES[1 - axis.row].angle
    return {
        **_lines_on_angle(axis, rate),
        **_lines_on_rate(axis, names, angle),
        "sign": f"channels {rate} and {angle}: turn against each other; multiply the one whose "
        f"sign is inverted by -1 ({axis.positive})",
        "first": f"channels {rate} and {twin}, or {angle} and {other}: exchanged, {angle} follows "
        f"{twin}; give the rates {FRAME}",
    }


def _lines_on_both(axis: Axis, names: list[str]) -> dict[str, str]:
    """Return the lines for GNSS and a rate that agree while the tilt contradicts both."""
    return {
        "sign": f"channels {names[axis.row]} and {axis.angle}: agree, but turn against "
        f"{axis.tilt}; multiply the pair whose signs are inverted by -1"
    }
