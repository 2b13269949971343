"""Names and units of channels: known ones pass, others are named with advice."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.channels import CHANNELS, ChannelId, channel_spec, check_unit

NAMES = st.sampled_from(list(CHANNELS))


@given(NAMES)
def test_every_channel_takes_its_own_unit_and_no_other(name: str) -> None:
    own = CHANNELS[name].unit
    check_unit(ChannelId(name), own)
    for other in {spec.unit for spec in CHANNELS.values()} - {own}:
        with pytest.raises(InputError, match=f"channel {name}: unit '.*', expected '.*'"):
            check_unit(ChannelId(name), other)


@pytest.mark.parametrize("unit", ["1", "-", "–", ""])
def test_no_dimension_has_several_spellings(unit: str) -> None:
    check_unit(ChannelId("gnss_quality"), unit)
    with pytest.raises(InputError, match="convert the samples"):
        check_unit(ChannelId("height"), unit)


def test_a_superscript_is_a_spelling_of_the_same_unit() -> None:
    check_unit(ChannelId("lateral_specific_force"), "m/s²")


@pytest.mark.parametrize(
    ("name", "unit", "factor"),
    [
        ("vertical_specific_force", "g", "9.80665"),
        ("height", "mm", "0.001"),
        ("distance", "km", "1000"),
        ("pitch_rate", "deg/s", "0.017453292519943295"),
        ("gnss_pitch", "deg", "0.017453292519943295"),
    ],
)
def test_the_factor_of_a_common_unit_is_told(name: str, unit: str, factor: str) -> None:
    with pytest.raises(InputError, match=f"convert the samples, multiply them by {factor}$"):
        check_unit(ChannelId(name, "left"), unit)


@given(NAMES, st.data())
def test_a_letter_lost_from_a_name_is_understood(name: str, data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(name) - 1))
    typo = name[:at] + name[at + 1 :]
    with pytest.raises(InputError, match=f"channel {typo}: unknown name; did you mean {name}"):
        channel_spec(typo)


def test_a_name_like_no_other_gets_the_list() -> None:
    with pytest.raises(InputError, match="channel zzz: unknown name; known: vertical_specific"):
        channel_spec("zzz")


def test_a_channel_is_shown_with_its_track() -> None:
    assert str(ChannelId("height", "left")) == "left.height"
    assert str(ChannelId("distance")) == "distance"
