"""Names as loggers give them lead to the right channel, or to none: never to a wrong one surely."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.mapping.channel_map.units import known_unit
from floatref.mapping.draft.guesses import Guess, guess
from floatref.values.channels import CHANNELS
from floatref.values.native import Column

VERTICAL, LONGITUDINAL = "vertical_specific_force", "longitudinal_specific_force"
LATERAL = "lateral_specific_force"
SURE = [
    ("", "Acc_Z_left", "g", VERTICAL, "left"),
    ("adc", "AccelRight", "m/s^2", VERTICAL, "right"),
    ("adc", "ACC LWP", "g", VERTICAL, "left"),
    ("adc", "Beschl_links", "m/s\u00b2", VERTICAL, "left"),
    ("IMU", "AccX", "m/s^2", LONGITUDINAL, None),
    ("IMU", "acc_y", "g", LATERAL, None),
    ("IMU", "az", "m/s^2", VERTICAL, None),
    ("IMU", "Acc lat", "g", LATERAL, None),
    ("IMU", "Longitudinal Acceleration", "g", LONGITUDINAL, None),
    ("instrument 1", "AccelZ", "g", VERTICAL, None),
    ("", "Laser LWP", "mm", "height", "left"),
    ("", "Laser_RWP_Height", "in", "height", "right"),
    ("", "LaserDistance_L", "mm", "height", "left"),
    ("adc", "Laser position R", "mm", "height", "right"),
    ("adc", "Gocator center", "mm", "height", "center"),
    ("adc", "Hgt_L", "mm", "height", "left"),
    ("adc", "las_l", "mm", "height", "left"),
    ("adc", "laser recorder", "mm", "height", None),
    ("", "DMI", "m", "distance", None),
    ("", "Odometer", "km", "distance", None),
    ("position", "DMI", "m", "distance", None),
    ("can", "VehicleSpeed", "km/h", "distance", None),
    ("can", "Encoder", "counts", "distance", None),
    ("IMU", "GyroX", "deg/s", "roll_rate", None),
    ("IMU", "wz", "rad/s", "yaw_rate", None),
    ("IMU", "Pitch Rate", "\u00b0/s", "pitch_rate", None),
    ("IMU", "YawRate", "deg/s", "yaw_rate", None),
    ("GGA", "altitude", "m", "gnss_height", None),
    ("GGA", "latitude", "deg", "gnss_latitude", None),
    ("GGA", "longitude", "deg", "gnss_longitude", None),
    ("GGA", "quality", "1", "gnss_quality", None),
    ("BESTPOS", "quality", "", "gnss_quality", None),
    ("BESTPOS", "height", "m", "gnss_height", None),
    ("BESTPOS", "hgt", "m", "gnss_height", None),
    ("BESTPOS", "lat", "deg", "gnss_latitude", None),
    ("GNS", "ellipsoidal_height", "m", "gnss_height", None),
    ("PASHR", "pitch", "deg", "gnss_pitch", None),
    ("BESTVEL", "z", "m/s", "gnss_vertical_velocity", None),
    ("BESTVEL", "vert speed", "m/s", "gnss_vertical_velocity", None),
    ("BESTVEL", "hor speed", "m/s", "gnss_speed", None),
    ("VTG", "speed", "km/h", "gnss_speed", None),
    ("", "GPS speed", "km/h", "gnss_speed", None),
    ("INSPVA", "pitch", "deg", "gnss_pitch", None),
    ("INSPVAX", "roll", "deg", "gnss_roll", None),
    ("INSPVA", "up velocity", "m/s", "gnss_vertical_velocity", None),
    ("", "GPS_Height", "m", "gnss_height", None),
    ("", "Lat", "deg", "gnss_latitude", None),
    ("", "left.height", "", "height", "left"),
]


@pytest.mark.parametrize(("stream", "name", "unit", "channel", "track"), SURE)
def test_a_name_and_a_unit_of_a_logger_give_its_channel(
    stream: str, name: str, unit: str, channel: str, track: str | None
) -> None:
    assert guess(stream, Column(name, unit)) == Guess(channel, track, sure=True)


@pytest.mark.parametrize(
    ("stream", "name", "unit"),
    [
        ("", "Heading", "deg"),
        ("", "Temperature", "\u00b0C"),
        ("", "Battery", "V"),
        ("can", "Max", "V"),
        ("", "Pitch", "deg"),
        ("GGA", "age", "s"),
        ("", "Laser", "deg"),
        ("adc", "Acc_Q", "deg/s"),
        ("adc", "spare", "kPa"),
        ("BESTPOS", "undulation", "m"),
        ("BESTPOS", "lat std", "m"),
        ("GGA", "geoid height", "m"),
        ("BESTPOS", "hgt std", "m"),
        ("", "Laser temperature", "mm"),
        ("BESTPOS", "solution_status", ""),
        ("Engine", "ASAM.M.SCALAR.SLONG.IDENTICAL", "m/s^2"),
        ("GGA", "hdop", "1"),
    ],
)
def test_what_is_no_channel_is_not_surely_one(stream: str, name: str, unit: str) -> None:
    found = guess(stream, Column(name, unit))
    assert found is None or not found.sure


@pytest.mark.parametrize(
    ("name", "channel"),
    [
        ("Acc_Z_left", VERTICAL),
        ("gyro_z", "yaw_rate"),
        ("Laser_L", "height"),
        ("DMI", "distance"),
        ("Odo", "distance"),
    ],
)
def test_a_name_alone_is_a_guess_that_is_not_sure(name: str, channel: str) -> None:
    found = guess("", Column(name))
    assert found is not None
    assert (found.channel, found.sure) == (channel, False)


def test_text_is_no_channel() -> None:
    assert guess("", Column("Laser", "mm", numeric=False)) is None


units = st.sampled_from(["", "m", "mm", "g", "km/h", "deg", "deg/s", "counts", "V", "%"])
words = st.sampled_from([n for _, n, *_ in SURE])
texts = st.one_of(words, st.text(max_size=12), st.lists(words, max_size=3).map("".join))


@pytest.mark.slow
@settings(deadline=None, max_examples=300)
@given(stream=texts, name=texts, unit=units)
def test_what_is_sure_has_a_unit_that_speaks_for_it(stream: str, name: str, unit: str) -> None:
    found = guess(stream, Column(name, unit))
    if found is None or name.rpartition(".")[2] in CHANNELS:
        return
    assert found.channel in CHANNELS
    known = known_unit(unit)
    alone = found.channel == "gnss_quality" and not unit
    assert known is not None or found.sure == alone
    if known is not None:
        also = {"m/s", "1"} if found.channel == "distance" else set()
        assert known.si in also | {CHANNELS[found.channel].unit}
