"""Sound recordings raise no eyebrow; a wrong installation is named, whatever the drive."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.architectures.kinematic_checks import check_kinematics
from floatref.errors import InputError
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate

LONG, LAT = "longitudinal_specific_force", "lateral_specific_force"
ROLL, PITCH, YAW = "roll_rate", "pitch_rate", "yaw_rate"
DEG = 180.0 / np.pi
Change = Callable[[Recording], Recording]

BRAKE = {
    "manoeuvre": "stop",
    "event_at_m": 110.0,
    "length_m": 220.0,
    "speed_kmh": 60.0,
    "final_speed_kmh": 45.0,
}
DRIVES: dict[str, dict[str, Any]] = {
    "curve": {**BRAKE, "curvature_per_km": 16.0},
    "hill": {**BRAKE, "grade_percent": 8.0, "vehicle": "trailer"},
    "constant": {"length_m": 250.0, "vehicle": "soft-van"},
    "banked": {"length_m": 150.0, "speed_kmh": 30.0, "curvature_per_km": 20.0,
               "cross_slope_percent": -15.0, "vehicle": "pickup"},
    "banked stop": {**BRAKE, "speed_kmh": 40.0, "final_speed_kmh": 40.0, "curvature_per_km": 20.0,
                    "cross_slope_percent": -15.0},
    "quiescent": {"manoeuvre": "quiescent"},
    "bounce": {"manoeuvre": "bounce", "vehicle": "minivan"},
    "perfect": {**BRAKE, "sensors": 0.0},
    "parked, perfect": {"manoeuvre": "quiescent", "sensors": 0.0},
    "level, perfect": {"length_m": 150.0, "road": "flat", "sensors": 0.0},
    "slippery": {**BRAKE, "slip_percent_per_g": 20.0, "deceleration_g": 0.4},
}  # fmt: skip


@cache
def driven(drive: str, seed: int = 0) -> Recording:
    scenario = Scenario.from_dict({**DRIVES[drive], "seed": seed, "rate_hz": 1000.0})
    return simulate(scenario).recording


def each(names: str | tuple[str, ...], change: Callable[[Channel], Channel]) -> Change:
    chosen = (names,) if isinstance(names, str) else names

    def changed(recording: Recording) -> Recording:
        channels = (change(c) if c.id.name in chosen else c for c in recording.channels)
        return replace(recording, channels=tuple(channels))

    return changed


def times(names: str | tuple[str, ...], factor: float) -> Change:
    return each(names, lambda c: replace(c, values=factor * c.values))


def exchanged(first: str, second: str) -> Change:
    twin = {first: second, second: first}
    return each((first, second), lambda c: replace(c, id=c.id._replace(name=twin[c.id.name])))


def without(*names: str) -> Change:
    return lambda recording: replace(
        recording, channels=tuple(c for c in recording.channels if c.id.name not in names)
    )


def no_gnss(recording: Recording) -> Recording:
    channels = tuple(c for c in recording.channels if not c.id.name.startswith("gnss_"))
    return replace(recording, channels=channels)


@pytest.mark.parametrize("drive", DRIVES)
def test_a_sound_recording_gives_no_warning(drive: str) -> None:
    for track in ("left", "right"):
        assert check_kinematics(driven(drive), track, True, True) == ()
    assert check_kinematics(no_gnss(driven(drive)), "left", False, False) == ()


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


@settings(deadline=None, max_examples=60)
@given(fault=st.sampled_from(FAULTS), seed=st.integers(0, 3))
def test_a_wrong_sign_unit_or_axis_is_refused_by_name(fault: Fault, seed: int) -> None:
    with pytest.raises(InputError) as caught:
        check_kinematics(fault.change(driven(fault.drive, seed)), "left", True, True)
    line = str(caught.value)
    assert line.startswith(fault.begins)
    assert fault.advice in line
    assert "\n" not in line


@pytest.mark.parametrize("names", [(ROLL, PITCH), ("gnss_roll", "gnss_pitch")])
def test_gravity_tells_which_pair_is_exchanged(names: tuple[str, str]) -> None:
    with pytest.raises(InputError, match=rf"^channels {names[0]} and {names[1]}: exchanged"):
        check_kinematics(exchanged(*names)(driven("hill")), "left", True, True)


@settings(deadline=None, max_examples=8)
@given(seed=st.integers(0, 3), fault=st.sampled_from(["sign", "unit"]))
def test_without_gnss_gravity_tells_what_braking_does(seed: int, fault: str) -> None:
    change = times(PITCH, -1.0 if fault == "sign" else 10.0 * DEG)
    with pytest.raises(InputError, match=r"^channel pitch_rate: "):
        check_kinematics(no_gnss(change(driven("hill", seed))), "left", False, False)


def test_rate_and_attitude_that_are_both_inverted_are_found_by_gravity() -> None:
    both = times((PITCH, "gnss_pitch"), -1.0)(driven("hill"))
    with pytest.raises(InputError, match=r"^channels pitch_rate and gnss_pitch: agree, but turn"):
        check_kinematics(both, "left", True, True)


def test_the_attitude_is_no_obstacle_to_a_pipeline_that_does_without() -> None:
    (line,) = check_kinematics(times("gnss_pitch", -1.0)(driven("hill")), "left", True, False)
    assert line.startswith("channel gnss_pitch: the sign is inverted")


@pytest.mark.parametrize(
    ("gone", "gnss", "attitude", "text"),
    [
        ((ROLL,), False, False, "channel roll_rate: missing"),
        ((LONG, YAW), True, True, f"channels left.{LONG}, yaw_rate: missing"),
        (("gnss_height", "gnss_roll"), True, True, "channels gnss_height, gnss_roll: missing"),
        (("gnss_vertical_velocity",), True, False, "channel gnss_vertical_velocity: missing"),
    ],
)
def test_all_channels_that_are_missing_are_named_at_once(
    gone: tuple[str, ...], gnss: bool, attitude: bool, text: str
) -> None:
    with pytest.raises(InputError, match=rf"^{text}"):
        check_kinematics(without(*gone)(driven("hill")), "left", gnss, attitude)


def test_what_a_pipeline_does_not_read_may_be_missing() -> None:
    recording = driven("hill")
    assert check_kinematics(without("gnss_roll")(recording), "left", True, False) == ()
    assert check_kinematics(without("gnss_height")(recording), "left", False, False) == ()
    (line,) = check_kinematics(without("gnss_quality")(recording), "left", True, True)
    assert (
        line == "channel gnss_quality: missing; every reading of gnss_height is taken as RTK fixed"
    )


@settings(deadline=None, max_examples=10)
@given(
    name=st.sampled_from([ROLL, PITCH, YAW]),
    at=st.integers(0, 1500),
    length=st.integers(12, 400),
    stamped=st.booleans(),
)
def test_a_silent_gyro_is_told_and_survived(name: str, at: int, length: int, stamped: bool) -> None:
    """Whether samples are NaN or left out; the second one counts half a step to each side."""

    def silenced(channel: Channel) -> Channel:
        values = channel.values.copy()
        lost = np.zeros(values.size, np.bool_)
        lost[at : at + length] = True
        if stamped and 0 < at < at + length < values.size:
            return replace(
                channel, values=values[~lost], clock=StampedClock.of(channel.times_s[~lost])
            )
        values[lost] = np.nan
        return replace(channel, values=values)

    (line,) = check_kinematics(each(name, silenced)(driven("curve")), "left", True, True)
    seconds = length / 100
    assert line == (
        f"channel {name}: no samples for {seconds:.4g} s in 1 place, at most {seconds:.4g} s from "
        f"{at / 100:.6g} s; bridged and flagged"
    )


@pytest.mark.parametrize("value", [20.5, -30.0])
def test_a_wild_rate_is_refused(value: float) -> None:
    def wild(channel: Channel) -> Channel:
        values = channel.values.copy()
        values[77] = value
        return replace(channel, values=values)

    with pytest.raises(InputError, match=rf"^channel yaw_rate: sample 77 is {value:.4g} rad/s"):
        check_kinematics(each(YAW, wild)(driven("hill")), "left", True, True)


@pytest.mark.parametrize("change", [lambda c: 0.0 * c.values + np.nan, lambda c: c.values])
def test_a_run_of_a_second_is_checked_for_what_it_has(change: Callable[[Channel], Any]) -> None:
    clock = UniformClock.of(100.0)
    names = ("distance", LONG, LAT, ROLL, PITCH, YAW, "vertical_specific_force", "height")
    rng = np.random.default_rng(0)
    channels = tuple(Channel.of(n, rng.standard_normal(100), clock) for n in names)
    short = Recording(channels)
    assert check_kinematics(short, "main", False, False) == ()
    gone = each(ROLL, lambda c: replace(c, values=change(c)))(short)
    if np.isnan(change(channels[0])).all():
        with pytest.raises(InputError, match=r"^channel roll_rate: no samples for 1 of"):
            check_kinematics(gone, "main", False, False)


NAMES = (LONG, LAT, ROLL, PITCH, YAW, "distance", "vertical_specific_force", "gnss_height",
         "gnss_vertical_velocity", "gnss_pitch", "gnss_roll", "gnss_quality", "gnss_latitude",
         "gnss_longitude")  # fmt: skip


@settings(deadline=None, max_examples=60)
@given(
    damage=st.lists(
        st.tuples(
            st.sampled_from(NAMES),
            st.sampled_from(["lost", "constant", "zero", "cut", "few", "wild", "absent"]),
            st.floats(0.0, 0.9),
            st.floats(0.1, 1.0),
        ),
        max_size=6,
    )
)
def test_whatever_is_damaged_gets_lines_or_a_refusal(
    damage: list[tuple[str, str, float, float]],
) -> None:
    """Nothing else is raised, and no arithmetic warning is let through.

    Wild samples of the nominal channels are refused before.
    """
    recording = driven("level, perfect" if len(damage) % 2 else "banked")
    for name, kind, begin, share in damage:
        if name in ("distance", "vertical_specific_force") and kind in ("wild", "absent"):
            continue
        if kind == "absent":
            recording = without(name)(recording)
        else:
            recording = each(name, lambda c, k=kind, b=begin, s=share: spoilt(c, k, b, s))(
                recording
            )
    try:
        lines = check_kinematics(recording, "left", True, True)
    except InputError as error:
        lines = (str(error),)
    assert all(line.startswith(("channel", "setup.")) and "\n" not in line for line in lines)


def spoilt(channel: Channel, kind: str, begin: float, share: float) -> Channel:
    values = channel.values.copy()
    first = int(begin * values.size)
    part = slice(first, max(first + int(share * values.size), first + 1))
    if kind in ("cut", "few"):
        kept = np.arange(values.size)[part][:: 97 if kind == "few" else 1]
        return replace(channel, values=values[kept], clock=StampedClock.of(channel.times_s[kept]))
    values[part] = {"lost": np.nan, "constant": values[first], "zero": 0.0, "wild": 1e200}[kind]
    return replace(channel, values=values)
