"""Whether what is measured of the vehicle's response can be what it says."""

import numpy as np

from floatref.errors import InputError
from floatref.values.recording import Channel
from floatref.values.scanning import Summary, every, first_where

LIMITS = {
    "deflection": (1.0, "if it is in mm, multiply by 0.001"),
    "displacement": (1.0, "if it is in mm, multiply by 0.001"),
    "velocity": (10.0, "if it is in mm/s, multiply by 0.001"),
    "angle": (1.0, "if it is in degrees, multiply by 0.0174533"),
    "rate": (10.0, "if it is in deg/s, multiply by 0.0174533"),
    "acceleration": (500.0, "if it is in deg/s^2, multiply by 0.0174533"),
}
"""By the last word of a channel's name: no vehicle on a road goes beyond, and the likely cause."""


def check_motion(channel: Channel, summary: Summary) -> None:
    """Refuse a channel of the response that never changes, or goes beyond what a vehicle does.

    Raises InputError with one line naming the channel, the value and what to do.
    """
    if summary.least == summary.greatest:
        raise InputError(
            f"channel {channel.id}: every sample is {summary.least:.6g}, so it measures nothing; "
            "connect the sensor, leave the channel out, and mark missing samples as NaN"
        )
    limit, cause = LIMITS[channel.id.name.rpartition("_")[2]]
    if max(-summary.least, summary.greatest) <= limit:
        return
    typical = float(np.nanmedian(np.abs(every(max(1, channel.values.size >> 16), channel.values))))
    if typical > limit:
        raise InputError(
            f"channel {channel.id}: half of its samples are beyond {typical:.4g} {channel.unit}; "
            f"{cause}, and give it against rest"
        )
    at = first_where(lambda values: np.abs(values) > limit, channel.values) or 0
    raise InputError(
        f"channel {channel.id}: sample {at} is {channel.values[at]:.4g} {channel.unit}, beyond "
        f"{limit:g} {channel.unit}; {cause}, else mark lost samples as NaN"
    )
