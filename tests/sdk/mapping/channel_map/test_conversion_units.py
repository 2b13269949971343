"""The unit of a mapped channel is what map and file say, or they are refused."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.mapping.channel_map.conversion import Conversion
from floatref.mapping.channel_map.entries import ChannelEntry
from floatref.mapping.channel_map.units import unit_of
from floatref.values.native import Column


def converted(made: Conversion, value: float) -> float:
    return made(np.array([value]), np.zeros(1)).item()


def test_the_unit_of_the_file_counts_where_the_map_says_none() -> None:
    made = Conversion(ChannelEntry("c", "height"), Column("c", "mm"))
    assert converted(made, 250.0) == pytest.approx(0.25)
    assert made.unit == "mm"


@pytest.mark.parametrize("given_", ["", " "])
def test_a_channel_without_a_unit_may_have_none_in_the_file(given_: str) -> None:
    made = Conversion(ChannelEntry("c", "gnss_quality"), Column("c", given_))
    assert converted(made, 4.0) == 4.0
    with pytest.raises(InputError, match="the file gives no unit; state it in the map"):
        Conversion(ChannelEntry("c", "height"), Column("c", given_))


@pytest.mark.parametrize(
    ("channel", "unit", "file", "message"),
    [
        ("height", "m", "deg", "the map says m, the file deg; correct the map, or scale"),
        ("distance", "m", "km/h", "the map says m, the file km/h"),
        ("height", "g", "", "unit 'g' is not a unit of height; expected one of m"),
        ("pitch_rate", "deg", "", "unit 'deg' is not a unit of pitch_rate; expected one of rad/s"),
        ("height", "km/h", "", "is not a unit of height"),
        ("distance", None, "counts", 'give scale, how many m one is, and unit = "m"'),
        ("height", None, "volts", "unit 'volts': unknown"),
        ("height", "volts", "", "unit 'volts': unknown"),
        ("gnss_quality", "m", "", "is not a unit of gnss_quality"),
    ],
)
def test_units_that_cannot_be_are_refused(
    channel: str, unit: str | None, file: str, message: str
) -> None:
    with pytest.raises(InputError) as caught:
        Conversion(ChannelEntry("c", channel, unit=unit), Column("c", file))
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("unit", "file", "scale", "warned"),
    [
        ("mm", "m", 1.0, True),
        ("m", "counts", 1.0, True),
        ("mm", "mm", 1.0, False),
        ("mm", "[MM]", 1.0, False),
        ("m", "V", 0.25, False),
        ("m", "mm", 0.001, False),
        ("m", "furlong", 1.0, False),
    ],
)
def test_a_map_that_overrules_the_file_is_told(
    unit: str, file: str, scale: float, warned: bool
) -> None:
    made = Conversion(ChannelEntry("c", "height", unit=unit, scale=scale), Column("c", file))
    assert made.warnings == (
        [f"the file says unit {file}, the map {unit}; the map counts"] if warned else []
    )
    assert converted(made, 2.0) == pytest.approx(unit_of(unit).factor * scale * 2.0)
