"""Sound recordings raise no eyebrow; a wrong installation is named, whatever the drive."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.screening.gnss_height import gnss_faults
from floatref.screening.imu_and_gnss import ImuUse, check_kinematics
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


def warnings_of(
    recording: Recording, *tracks: str, gnss: bool = True, attitude: bool = True
) -> tuple[str, ...]:
    return check_kinematics(recording, ImuUse(tracks, gnss, attitude), gnss_faults(recording))


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
