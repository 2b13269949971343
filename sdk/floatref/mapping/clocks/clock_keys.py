"""The clock of a stream, as far as its file gives it."""

from floatref.mapping.channel_map.entries import SOURCE
from floatref.mapping.clocks.columns import UNKNOWN, Taken
from floatref.values.native import Epoch, Stream

Key = tuple[str, str]
"""Label of a file, and name of a stream in it."""
ClockKey = tuple[str, str, Epoch]
"""Label of a file, name of a clock in it, and its epoch."""


def clock_key(key: Key, taken: Taken) -> ClockKey:
    """Return the clock of the stream ``key``; one without any time has a clock of its own."""
    clock = taken.stream.clock
    name = f"{UNKNOWN} {key[1]}" if clock.name == UNKNOWN else clock.name
    return key[0], name, clock.epoch


def absolute(clock: ClockKey) -> bool:
    """Tell whether ``clock`` has the time of day."""
    return clock[2] is not Epoch.LOCAL


def name_clock(key: Key) -> str:
    """Return the name of the stream ``key`` in messages."""
    file = "the source" if key[0] == SOURCE else key[0]
    return f"{file}, {key[1]}" if key[1] else file


def has_no_start(stream: Stream) -> bool:
    """Tell whether the file of ``stream`` counts it from zero by a rate."""
    clock = stream.clock
    begun = clock.first_tick or clock.origin_ns or clock.name
    return clock.rate is not None and not begun and clock.epoch is Epoch.LOCAL


def warn_of_beginning(key: Key, stream: Stream) -> tuple[str, ...]:
    """Return a warning on the stream ``key`` if it is taken to begin with the accelerometer's."""
    if not has_no_start(stream):
        return ()
    return (
        f"clock of {name_clock(key)}: counted from zero by its rate; taken to begin with the "
        'accelerometer, on its clock; if so, write align = "offset" for it under [[clocks]]',
    )
