"""The channels of a recording by their clocks, as formats hold them that have groups."""

from floatref import Channel, Recording, UniformClock


def group_by_clock(recording: Recording) -> list[list[Channel]]:
    """Return the channels of ``recording`` that share a clock and a length, in their order."""
    groups: dict[object, list[Channel]] = {}
    for channel in recording.channels:
        groups.setdefault(_key(channel), []).append(channel)
    return list(groups.values())


def _key(channel: Channel) -> object:
    clock = channel.clock
    if isinstance(clock, UniformClock):
        return clock.rate, clock.start_s, channel.values.size
    return clock.times_s.tobytes()
