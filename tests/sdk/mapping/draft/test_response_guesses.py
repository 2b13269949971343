"""Names of sensors on wheels, springs and body lead to the channels of the response."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.mapping.channel_map.units import unit_of
from floatref.mapping.draft.guesses import Guess, guess
from floatref.values.channels import CHANNELS
from floatref.values.native import Column

UNSPRUNG, REAR_UNSPRUNG = "unsprung_specific_force", "rear_unsprung_specific_force"
DEFLECTION, REAR_DEFLECTION = "suspension_deflection", "rear_suspension_deflection"
SURE = [
    ("", "AxleAccFL", "g", UNSPRUNG, "left"),
    ("", "AxleAccRR", "g", REAR_UNSPRUNG, "right"),
    ("", "hub_acc_z_fl", "m/s^2", UNSPRUNG, "left"),
    ("adc", "FRHubAccZ", "g", UNSPRUNG, "right"),
    ("adc", "AccHubFRz", "g", UNSPRUNG, "right"),
    ("", "unsprung", "m/s^2", UNSPRUNG, None),
    ("", "UnsprungAcc_left", "g", UNSPRUNG, "left"),
    ("", "wheel_acc", "g", UNSPRUNG, None),
    ("", "Wheel acceleration rear left", "m/s^2", REAR_UNSPRUNG, "left"),
    ("Hub_RL", "acc_z", "g", REAR_UNSPRUNG, "left"),
    ("Axle right", "Acc", "g", UNSPRUNG, "right"),
    ("", "Achse_hinten_links_Beschl", "m/s^2", REAR_UNSPRUNG, "left"),
    ("", "KnuckleAcc_VR", "g", UNSPRUNG, "right"),
    ("", "SprungAccFL", "g", "sprung_specific_force", "left"),
    ("", "sprung_mass_acc", "m/s^2", "sprung_specific_force", None),
    ("", "EquipmentAccZ", "g", "equipment_specific_force", None),
    ("", "SuspTravel", "mm", DEFLECTION, None),
    ("", "susp_defl_FL", "mm", DEFLECTION, "left"),
    ("", "SuspensionTravelRR", "mm", REAR_DEFLECTION, "right"),
    ("", "LVDT", "in", DEFLECTION, None),
    ("", "LVDT_right", "mm", DEFLECTION, "right"),
    ("", "DamperPos_RL", "mm", REAR_DEFLECTION, "left"),
    ("", "Federweg_VL", "mm", DEFLECTION, "left"),
    ("Suspension", "FL", "mm", DEFLECTION, "left"),
    ("Suspension", "travel_rr", "mm", REAR_DEFLECTION, "right"),
    ("", "unsprung_displacement_raw", "mm", "unsprung_displacement", None),
    ("", "sprung disp left", "mm", "sprung_displacement", "left"),
    ("", "unsprung velocity", "m/s", "unsprung_velocity", None),
    ("", "BodyVelZ", "m/s", "sprung_velocity", None),
    ("", "PitchAcc", "deg/s^2", "pitch_acceleration", None),
    ("", "roll_acceleration_left_gyro", "rad/s^2", "roll_acceleration", None),
    ("", "BodyPitch", "deg", "pitch_angle", None),
    ("", "body roll angle", "mrad", "roll_angle", None),
    ("can", "WheelPulses_FL", "pulses", "distance", None),
]
VERTICAL = "vertical_specific_force"
OTHERS = [
    ("", "body_acc_z", "g", VERTICAL, None),
    ("", "BodyAcc_FL", "g", VERTICAL, "left"),
    ("", "Acc left wheel path", "g", VERTICAL, "left"),
    ("", "Acc_WheelPath_R", "g", VERTICAL, "right"),
    ("", "AccAboveAxle", "g", VERTICAL, None),
    ("", "Chassis acc over wheel", "g", VERTICAL, None),
    ("can", "WheelSpd_RL", "km/h", "distance", None),
    ("wheels", "VehicleSpeed", "km/h", "distance", None),
    ("", "AxleSpeed", "m/s", "distance", None),
    ("axle", "LaserDisplacement_L", "mm", "height", "left"),
    ("", "unsprung lidar height", "mm", "height", None),
    ("IMU", "Pitch Rate", "deg/s", "pitch_rate", None),
    ("INSPVA", "pitch", "deg", "gnss_pitch", None),
]
"""What is of the vehicle as a whole, or of a profiler, and stays so."""


@pytest.mark.parametrize(("stream", "name", "unit", "channel", "track"), SURE + OTHERS)
def test_a_name_and_a_unit_give_the_channel(
    stream: str, name: str, unit: str, channel: str, track: str | None
) -> None:
    assert guess(stream, Column(name, unit)) == Guess(channel, track, sure=True)


@pytest.mark.parametrize(
    ("stream", "name", "unit", "channel"),
    [
        ("", "RideHeight_FL", "mm", "height"),
        ("", "Level height rear", "mm", "height"),
        ("", "SuspAccZ", "g", UNSPRUNG),
        ("", "hub disp", "mm", "unsprung_displacement"),
        ("", "Pitch", "deg", "pitch_angle"),
        ("", "RollAngle", "deg", "roll_angle"),
        ("", "AxleAccFL", "", UNSPRUNG),
        ("", "LVDT", "V", DEFLECTION),
        ("", "SuspTravelRL", "", REAR_DEFLECTION),
    ],
)
def test_a_name_that_means_two_things_or_has_no_unit_is_not_sure(
    stream: str, name: str, unit: str, channel: str
) -> None:
    found = guess(stream, Column(name, unit))
    assert found is not None
    assert (found.channel, found.sure) == (channel, False)


@pytest.mark.parametrize(
    ("stream", "name", "unit"),
    [
        ("", "hub_acc_x", "g"),
        ("Hub FL", "AccY", "g"),
        ("", "AxleAcc lateral", "g"),
        ("", "SuspVelocity_FL", "m/s"),
        ("", "DamperVel", "mm/s"),
        ("", "hub temperature", "g"),
        ("", "suspect", "mm"),
        ("", "SteeringWheelAngle", "deg"),
        ("", "yaw acc", "deg/s^2"),
    ],
)
def test_what_a_wheel_does_besides_is_no_channel(stream: str, name: str, unit: str) -> None:
    assert guess(stream, Column(name, unit)) is None


CORNERS = {"FL": "left", "FR": "right", "RL": "left", "RR": "right"}
PARTS = {"Axle": "g", "Hub": "m/s^2", "Unsprung": "g", "WheelCarrier": "mg", "Susp": "mm"}


@given(
    st.sampled_from(list(CORNERS)),
    st.sampled_from(list(PARTS)),
    st.sampled_from(["", "_", " ", "."]),
    st.booleans(),
)
def test_the_corner_gives_wheel_path_and_axle_wherever_it_stands(
    corner: str, part: str, between: str, first: bool
) -> None:
    what = "Travel" if part == "Susp" else "Acc"
    pieces = [corner, part + what] if first else [part + what, corner]
    found = guess("", Column(between.join(pieces), PARTS[part]))
    assert found is not None
    assert (found.track, found.sure) == (CORNERS[corner], True)
    assert found.channel.startswith("rear_") == corner.startswith("R")
    assert CHANNELS[found.channel].unit == unit_of(PARTS[part]).si
