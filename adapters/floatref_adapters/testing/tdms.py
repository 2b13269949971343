"""Recordings as TDMS files, through npTDMS."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from floatref import Channel, Recording
from floatref_adapters.testing.grouping import ClockGroup, by_clock, counts_of

ROWS = 1 << 16
"""Rows of a segment."""


def write_tdms(recording: Recording, path: Path, quanta: Mapping[str, float] | None = None) -> None:
    """Write ``recording`` to ``path``: a group for each clock, a channel called as `left.height`.

    Uniform clocks are kept as `wf_increment` and `wf_start_offset`, others as a channel
    `time_s`. A channel of ``quanta`` is stored in integers with a linear scale; ValueError if
    it has missing samples, for which TDMS has no mark.
    """
    from nptdms import TdmsWriter

    with TdmsWriter(str(path)) as writer:
        for group in by_clock(recording):
            for objects in _segments(group, quanta):
                writer.write_segment(objects)


def _segments(group: ClockGroup, quanta: Mapping[str, float] | None) -> Iterator[list[Any]]:
    from nptdms import ChannelObject

    stored = [(str(c.id), *_stored(c, quanta)) for c in group.channels]
    timing = {"wf_increment": group.step_s, "wf_start_offset": group.start_s}
    if group.times_s is not None:
        timing = {}
        stored.append(("time_s", group.times_s, {"unit_string": "s"}))
    for first in range(0, group.count, ROWS):
        yield [
            ChannelObject(group.name, name, values[first : first + ROWS], {**own, **timing})
            for name, values, own in stored
        ]


def _stored(
    channel: Channel, quanta: Mapping[str, float] | None
) -> tuple[np.ndarray[Any, Any], dict[str, Any]]:
    properties: dict[str, Any] = {"unit_string": channel.unit}
    counted = counts_of(channel, quanta)
    if counted is None:
        return channel.values, properties
    if np.isnan(channel.values).any():
        raise ValueError(f"{channel.id}: missing samples cannot be stored in integers")
    quantum, counts = counted
    scale = {
        "NI_Number_Of_Scales": 1,
        "NI_Scaling_Status": "unscaled",
        "NI_Scale[0]_Scale_Type": "Linear",
        "NI_Scale[0]_Linear_Slope": quantum,
        "NI_Scale[0]_Linear_Y_Intercept": 0.0,
    }
    return counts, properties | scale
