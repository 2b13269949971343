"""Whether the sources of travel beside the encoder can be those of a profiler."""

from collections.abc import Iterator, Sequence

import numpy as np

from floatref.errors import InputError
from floatref.values.encoder.direction import check_direction
from floatref.values.encoder.plausible_distance import FASTEST_MPS
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import first_where

SECOND_DISTANCES = ("wheel_distance", "optical_distance")
"""Distances beside the encoder's, which may not decrease either."""
SECOND_SPEED = "gnss_speed"


def check_second_sources(recording: Recording, needed: Sequence[Channel]) -> Iterator[str]:
    """Yield a warning for each second distance or speed that is not used in places or at all."""
    yield from _check_distances(recording, needed)
    yield from _check_speed(recording)


def _check_distances(recording: Recording, needed: Sequence[Channel]) -> Iterator[str]:
    """Yield a warning for each second distance that goes back and that no stage reads."""
    read = {channel.id for channel in needed}
    for channel in recording.channels:
        if channel.id.name in SECOND_DISTANCES and channel.id not in read:
            try:
                check_direction(channel, most=0.0)
            except InputError as error:
                yield f"{error}; it is not used"


def _check_speed(recording: Recording) -> Iterator[str]:
    """Yield a warning for a speed by GNSS that no profiler reaches."""
    for channel in recording.channels:
        if channel.id.name == SECOND_SPEED and channel.scan.largest > FASTEST_MPS:
            at = first_where(lambda values: np.abs(values) > FASTEST_MPS, channel.values) or 0
            yield (
                f"channel {channel.id}: sample {at} is {channel.values[at]:.4g} m/s, faster "
                f"than any profiler ({FASTEST_MPS:g} m/s); such samples are not used"
            )
