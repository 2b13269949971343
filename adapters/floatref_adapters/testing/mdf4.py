"""Recordings as MDF 4 files, block by block; independent of asammdf, which reads them."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from floatref import Channel, Recording
from floatref_adapters.testing.grouping import ClockGroup, by_clock, counts_of
from floatref_adapters.testing.mdf4_blocks import MASTER, VIRTUAL_MASTER, Stored, StoredGroup, write


def write_mdf4(recording: Recording, path: Path, quanta: Mapping[str, float] | None = None) -> None:
    """Write ``recording`` to ``path``: a group for each clock, a channel called as `left.height`.

    A uniform clock is a virtual master, the number of the record converted with the step and
    the start; any other is a master of float64 seconds. A channel of ``quanta`` is stored in
    integers with a linear conversion, its missing samples with a bit that marks them.
    """
    write([_group(group, quanta) for group in by_clock(recording)], path)


def _group(group: ClockGroup, quanta: Mapping[str, float] | None) -> StoredGroup:
    if group.times_s is None:
        line = (group.step_s, group.start_s)
        master = Stored("time", np.empty(group.count, "V0"), "s", line, VIRTUAL_MASTER)
    else:
        master = Stored("time", group.times_s, "s", kind=MASTER)
    return StoredGroup(group.name, [master, *(_stored(c, quanta) for c in group.channels)])


def _stored(channel: Channel, quanta: Mapping[str, float] | None) -> Stored:
    counted = counts_of(channel, quanta)
    if counted is None:
        return Stored(str(channel.id), channel.values, channel.unit)
    quantum, counts = counted
    missing = np.isnan(channel.values)
    line = (quantum, 0.0)
    return Stored(str(channel.id), counts, channel.unit, line, invalid=missing)
