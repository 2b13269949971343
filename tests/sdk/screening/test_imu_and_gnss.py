"""Sound recordings raise no eyebrow; a wrong installation is named, whatever the drive."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.screening.drives import (
    DRIVES,
    LAT,
    LONG,
    PITCH,
    ROLL,
    YAW,
    Change,
    driven,
    each,
    warnings_of,
)

from floatref.errors import InputError
from floatref.values.recording import Recording

DEG = 180.0 / np.pi


def times(names: str | tuple[str, ...], factor: float) -> Change:
    return each(names, lambda c: replace(c, values=factor * c.values))


def exchanged(first: str, second: str) -> Change:
    twin = {first: second, second: first}
    return each((first, second), lambda c: replace(c, id=c.id._replace(name=twin[c.id.name])))


def no_gnss(recording: Recording) -> Recording:
    channels = tuple(c for c in recording.channels if not c.id.name.startswith("gnss_"))
    return replace(recording, channels=channels)


@pytest.mark.slow
@pytest.mark.parametrize("drive", DRIVES)
def test_a_sound_recording_gives_no_warning(drive: str) -> None:
    assert warnings_of(driven(drive), "left", "right") == ()
    assert warnings_of(no_gnss(driven(drive)), "left", gnss=False, attitude=False) == ()


@dataclass(frozen=True)
class Fault:
    change: Change
    begins: str
    advice: str
    drive: str = "hill"


FAULTS = (
    Fault(times(LONG, -1.0), f"channel left.{LONG}: the sign", "multiply by -1"),
    Fault(times(LONG, 1 / 9.80665), f"channel left.{LONG}: a tenth", "multiply by 9.80665"),
    Fault(times(LONG, -1 / 9.80665), f"channel left.{LONG}: a tenth", "multiply by -9.80665"),
    Fault(times(LONG, 0.0), f"channel left.{LONG}: every sample is 0", "connect the sensor"),
    Fault(exchanged(LONG, LAT), f"channels left.{LONG} and left.{LAT}: exchanged", "X forward"),
    Fault(
        times(LAT, -1.0), f"channels left.{LAT} and yaw_rate: contradict", "in a left turn", "curve"
    ),
    Fault(times(LAT, 0.0), f"channel left.{LAT}: every sample is 0", "connect the sensor", "curve"),
    Fault(times(ROLL, -1.0), "channels roll_rate and gnss_roll: turn against", "left side up"),
    Fault(times(PITCH, -1.0), "channel pitch_rate: the sign", "multiply by -1"),
    Fault(times(PITCH, 0.0), "channel pitch_rate: every sample is 0", "connect the sensor"),
    Fault(
        times(YAW, -1.0),
        "channel yaw_rate: the sign",
        "multiply by -1 (left turn positive)",
        "curve",
    ),
    Fault(times(YAW, DEG), "channel yaw_rate: ", "multiply by 0.0174533", "curve"),
    Fault(times(PITCH, DEG), "channel pitch_rate: ", "multiply by 0.0174533"),
    Fault(exchanged(PITCH, YAW), "channels pitch_rate and yaw_rate: exchanged", "about X forward"),
    Fault(times("gnss_pitch", -1.0), "channel gnss_pitch: the sign", "nose down is positive"),
    Fault(times("gnss_pitch", DEG), "channel gnss_pitch: turns 57.3", "multiply by 0.0174533"),
    Fault(times("gnss_roll", DEG), "channel gnss_roll: turns 57.3", "multiply by 0.0174533"),
)


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(fault=st.sampled_from(FAULTS), seed=st.integers(0, 3))
def test_a_wrong_sign_unit_or_axis_is_refused_by_name(fault: Fault, seed: int) -> None:
    with pytest.raises(InputError) as caught:
        warnings_of(fault.change(driven(fault.drive, seed)), "left")
    line = str(caught.value)
    assert line.startswith(fault.begins)
    assert fault.advice in line
    assert "\n" not in line


@pytest.mark.parametrize("names", [(ROLL, PITCH), ("gnss_roll", "gnss_pitch")])
def test_gravity_tells_which_pair_is_exchanged(names: tuple[str, str]) -> None:
    with pytest.raises(InputError, match=rf"^channels {names[0]} and {names[1]}: exchanged"):
        warnings_of(exchanged(*names)(driven("hill")), "left")


@pytest.mark.slow
@settings(deadline=None, max_examples=8)
@given(seed=st.integers(0, 3), fault=st.sampled_from(["sign", "unit"]))
def test_without_gnss_gravity_tells_what_braking_does(seed: int, fault: str) -> None:
    change = times(PITCH, -1.0 if fault == "sign" else 10.0 * DEG)
    with pytest.raises(InputError, match=r"^channel pitch_rate: "):
        warnings_of(no_gnss(change(driven("hill", seed))), "left", gnss=False, attitude=False)


def test_rate_and_attitude_that_are_both_inverted_are_found_by_gravity() -> None:
    both = times((PITCH, "gnss_pitch"), -1.0)(driven("hill"))
    with pytest.raises(InputError, match=r"^channels pitch_rate and gnss_pitch: agree, but turn"):
        warnings_of(both, "left")


def test_the_attitude_is_no_obstacle_to_a_pipeline_that_does_without() -> None:
    (line,) = warnings_of(times("gnss_pitch", -1.0)(driven("hill")), "left", attitude=False)
    assert line.startswith("channel gnss_pitch: the sign is inverted")
