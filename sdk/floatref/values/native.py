"""A native file before it is mapped: streams of columns, each stream on a clock of its own.

An adapter delivers the content of the file unchanged: its names, its units, its ticks. A channel
map assigns columns of the file to channels of a recording.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import FloatArray

Ticks = NDArray[np.int64] | NDArray[np.float64]


class Epoch(Enum):
    """The time that the zero of a clock means."""

    LOCAL = "local"
    """A time of the device's own, such as its start, or not known."""
    DAY = "day"
    """Midnight UTC of an unknown day."""
    UTC = "utc"
    """1970-01-01 UTC; leap seconds are not counted."""
    GPS = "gps"
    """1980-01-06 UTC; leap seconds are counted."""


@dataclass(frozen=True)
class NativeClock:
    """When the rows of a stream were taken.

    With a ``rate`` in Hz, row k was taken ``first_tick * tick_s + k / rate`` seconds after
    ``origin_ns``; without one every row has its tick, and was taken ``tick * tick_s`` seconds
    after it. ``origin_ns`` is in ns since the zero of ``epoch``. Streams of one file whose clocks
    have one ``name`` are on one clock, whatever their rates. ``turn_s`` is the time in s after
    which ticks begin again at 0, as times of a day do at midnight; None if they do not.
    """

    rate: Fraction | None = None
    tick_s: Fraction = Fraction(1)
    first_tick: int = 0
    epoch: Epoch = Epoch.LOCAL
    origin_ns: int = 0
    name: str = ""
    turn_s: Fraction | None = None

    def __post_init__(self) -> None:
        """Refuse a rate or a tick that is not above zero."""
        if self.tick_s <= 0 or (self.rate is not None and self.rate <= 0):
            raise InputError(f"clock of {self.rate} Hz with ticks of {self.tick_s} s; correct it")


@dataclass(frozen=True)
class Column:
    """A quantity of a stream: its name and unit, both as the file has them; "" is no unit.

    ``note`` is one line for the user who lists the file. A column without numbers is listed but
    cannot be mapped.
    """

    name: str
    unit: str = ""
    note: str = ""
    numeric: bool = True


@dataclass(frozen=True, eq=False)
class Rows:
    """Successive rows of a stream: ``values`` by column, each of shape (n,), NaN = missing.

    ``ticks``, of shape (n,), are integers, or float64 where the file has no integers; None for a
    clock with a rate.
    """

    values: Mapping[str, FloatArray]
    ticks: Ticks | None = None


@dataclass(frozen=True, eq=False)
class Stream:
    """Columns of a native file that share one clock, and how to read them.

    ``read(names)`` yields the rows of the columns ``names`` from the first one on, in pieces of at
    most a few megabytes; with no names, the ticks alone. It can be called again. ``count`` is the
    number of rows that the file states.
    """

    name: str
    columns: tuple[Column, ...]
    count: int
    clock: NativeClock
    read: Callable[[Sequence[str]], Iterator[Rows]]

    def __post_init__(self) -> None:
        """Refuse a name that is given twice."""
        seen: set[str] = set()
        for column in self.columns:
            if column.name in seen:
                raise InputError(f"{self.name}/{column.name}: given twice; rename one of them")
            seen.add(column.name)


def _nothing() -> None:
    """Do nothing: the file needs no closing."""


@dataclass(frozen=True, eq=False)
class NativeFile:
    """The content of a native file; a context manager that closes the file.

    ``warnings`` has one line for each kind of content that could not be decoded, with its count.
    """

    streams: tuple[Stream, ...]
    warnings: tuple[str, ...] = ()
    vendor: str = ""
    model: str = ""
    close: Callable[[], None] = field(default=_nothing)

    def __enter__(self) -> "NativeFile":
        """Return the file itself."""
        return self

    def __exit__(self, *raised: object) -> None:
        """Close it."""
        self.close()


__all__ = ["Column", "Epoch", "NativeClock", "NativeFile", "Rows", "Stream", "Ticks"]
