"""Which channel an entry of a map means, and with which sign: names and axes."""

from floatref.errors import InputError
from floatref.mapping.gravity import TOLERANCES
from floatref.values.channels import channel_spec

ON_AXES = {
    "specific_force": {
        "x": "longitudinal_specific_force",
        "y": "lateral_specific_force",
        "z": "vertical_specific_force",
    },
    "angular_rate": {"x": "roll_rate", "y": "pitch_rate", "z": "yaw_rate"},
}
"""Channels of a sensor by the body axis that it points along."""
AXES = {name: axis for axes in ON_AXES.values() for axis, name in axes.items()}
AXES |= dict.fromkeys(TOLERANCES, "z")
"""The axis of every channel that has one; wheels and body are measured along Z alone."""


def quantity_of(channel: str, axis: str | None) -> tuple[str, int]:
    """Return the channel that ``channel`` along ``axis`` is, and its sign.

    ``channel`` is one of ours, `specific_force` or `angular_rate`; ``axis`` such as "z" or "-z"
    is the body axis (X forward, Y left, Z up) that the sensor's own axis points along. Raises
    InputError for unknown names, an axis that is missing, and one that the channel is not along.
    """
    sign = -1 if axis is not None and axis.startswith("-") else 1
    along = None if axis is None else axis.lstrip("+-")
    if channel in ON_AXES:
        if along is None:
            raise InputError(f'{channel} needs an axis; write axis = "z" or another of +-x, y, z')
        return ON_AXES[channel][along], sign
    channel_spec(channel)
    if along is None:
        return channel, sign
    if channel not in AXES:
        raise InputError(f"axis is {axis}, but {channel} has none; leave it out")
    if AXES[channel] != along:
        raise InputError(f"axis is {axis}, but {channel} is along {AXES[channel]}; correct one")
    return channel, sign
