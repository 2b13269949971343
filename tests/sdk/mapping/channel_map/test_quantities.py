"""A sensor along a body axis measures one channel, with the sign of its own axis."""

import pytest

from floatref.errors import InputError
from floatref.mapping.channel_map.map_document import quantity_of
from floatref.values.channels import CHANNELS

# ISO 8855: X forward, Y left, Z up; roll about X, pitch about Y, yaw about Z.
ALONG = {
    ("specific_force", "x"): "longitudinal_specific_force",
    ("specific_force", "y"): "lateral_specific_force",
    ("specific_force", "z"): "vertical_specific_force",
    ("angular_rate", "x"): "roll_rate",
    ("angular_rate", "y"): "pitch_rate",
    ("angular_rate", "z"): "yaw_rate",
}
UPRIGHT = [name for name in CHANNELS if name.endswith("sprung_specific_force")]
UPRIGHT += ["equipment_specific_force"]


@pytest.mark.parametrize(("kind", "along"), ALONG)
@pytest.mark.parametrize(("mark", "sign"), [("", 1), ("+", 1), ("-", -1)])
def test_an_axis_says_channel_and_sign(kind: str, along: str, mark: str, sign: int) -> None:
    channel = ALONG[kind, along]
    assert quantity_of(kind, mark + along) == (channel, sign)
    assert quantity_of(channel, mark + along) == (channel, sign)


@pytest.mark.parametrize("channel", CHANNELS)
def test_without_an_axis_a_channel_is_itself(channel: str) -> None:
    assert quantity_of(channel, None) == (channel, 1)


@pytest.mark.parametrize("channel", [c for c in CHANNELS if c not in {*ALONG.values(), *UPRIGHT}])
@pytest.mark.parametrize("axis", ["x", "-z"])
def test_a_channel_that_is_along_no_axis_has_none(channel: str, axis: str) -> None:
    with pytest.raises(InputError, match=f"axis is {axis}, but {channel} has no axis; remove it"):
        quantity_of(channel, axis)


@pytest.mark.parametrize(("kind", "along"), ALONG)
def test_another_axis_than_its_own_is_refused(kind: str, along: str) -> None:
    other = {"x": "y", "y": "z", "z": "-x"}[along]
    with pytest.raises(InputError, match=f"is along {along}; correct one"):
        quantity_of(ALONG[kind, along], other)


@pytest.mark.parametrize("channel", UPRIGHT)
def test_an_accelerometer_of_wheel_or_body_points_up_or_down(channel: str) -> None:
    assert [quantity_of(channel, axis)[1] for axis in ("z", "+z", "-z")] == [1, 1, -1]
    with pytest.raises(InputError, match=f"axis is -x, but {channel} is along z; correct one"):
        quantity_of(channel, "-x")


@pytest.mark.parametrize("kind", ["specific_force", "angular_rate"])
def test_a_sensor_without_an_axis_is_refused(kind: str) -> None:
    with pytest.raises(InputError, match='needs an axis; write axis = "z" or another'):
        quantity_of(kind, None)


def test_an_unknown_channel_is_told_with_one_like_it() -> None:
    with pytest.raises(InputError, match="did you mean pitch_rate"):
        quantity_of("pitchrate", None)
