"""A recording as a CSV table: column `time_s`, then one column per channel in its SI unit.

There is a row for every time at which any channel has a sample, and a field is empty where a
channel has no sample, or a missing one. So a channel on a slower clock, or on time stamps of its
own, is a column with few numbers: a map takes it for `sparse`, as it does a fast one where others
have rows in between. Times have the decimals that all clocks need, at most nine.
"""

import csv
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from math import lcm
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, InputError, Recording, UniformClock
from floatref_adapters.testing.file_writing import (
    check_quanta,
    exact_start,
    quantum_of,
    replace_file,
    round_to_quantum,
)

ROWS = 1 << 16
MOST_DECIMALS = 9
Ticks = NDArray[np.int64]


def write_csv(recording: Recording, path: Path, quanta: Mapping[str, float] | None = None) -> None:
    """Write ``recording`` to ``path``.

    InputError if that fails, if a channel has two samples within a nanosecond, or if a name
    holds the end of a line.
    """
    check_quanta(recording, quanta)
    decimals = max(_decimals(channel) for channel in recording.channels)
    ticks = {str(c.id): _ticks(c, decimals) for c in recording.channels}
    every = np.unique(np.concatenate(list(ticks.values())))
    with replace_file(path) as beside, beside.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["time_s", *ticks])
        for first in range(0, every.size, ROWS):
            rows = every[first : first + ROWS]
            columns = [
                _fields(c, ticks[str(c.id)], rows, quantum_of(c, quanta))
                for c in recording.channels
            ]
            times = [_text(tick, decimals) for tick in rows.tolist()]
            writer.writerows(zip(times, *columns, strict=True))


def _decimals(channel: Channel) -> int:
    """Return how many decimals the times of ``channel`` need, at most nine."""
    clock = channel.clock
    if not isinstance(clock, UniformClock):
        return MOST_DECIMALS
    whole = lcm((1 / clock.rate).denominator, exact_start(clock).denominator)
    return next((d for d in range(MOST_DECIMALS) if 10**d % whole == 0), MOST_DECIMALS)


def _ticks(channel: Channel, decimals: int) -> Ticks:
    """Return the times of ``channel`` in units of the last decimal."""
    name = str(channel.id)
    if "\n" in name or "\r" in name:
        raise InputError(f"channel {name!r}: a table has no such name; rename the wheel path")
    clock, scale = channel.clock, 10**decimals
    if isinstance(clock, UniformClock):
        start, step = exact_start(clock) * scale, scale / clock.rate
        ticks = _round(start, step, channel.values.size)
    else:
        ticks = np.rint(clock.times_s * scale).astype(np.int64)
    if (np.diff(ticks) <= 0).any():
        raise InputError(f"channel {name}: samples closer than 1e-{decimals} s; thin them out")
    return ticks


def _round(start: Fraction, step: Fraction, count: int) -> Ticks:
    """Return ``start + k * step``, rounded to whole numbers, without float error."""
    bottom = start.denominator * step.denominator * 2
    base = int(start * bottom) + bottom // 2
    rise = int(step * bottom)
    if abs(base) + rise * count < 2**62:
        return (base + rise * np.arange(count, dtype=np.int64)) // bottom
    return np.array([(base + rise * k) // bottom for k in range(count)], np.int64)


def _text(tick: int, decimals: int) -> str:
    """Return a time in s with all its decimals."""
    return format(Decimal(tick).scaleb(-decimals), "f")


def _fields(channel: Channel, ticks: Ticks, rows: Ticks, quantum: float | None) -> list[str]:
    """Return the fields of ``channel`` in the rows at the times ``rows``."""
    first, stop = np.searchsorted(ticks, (rows[0], rows[-1] + 1))
    fields = [""] * rows.size
    values = round_to_quantum(channel.values[first:stop], quantum).tolist()
    places = np.searchsorted(rows, ticks[first:stop]).tolist()
    shown = repr if quantum is None else f"{{:.{_places(quantum)}f}}".format
    for place, value in zip(places, values, strict=True):
        if value == value:
            fields[place] = shown(value)
    return fields


def _places(quantum: float) -> int:
    """Return the decimals that a multiple of ``quantum`` needs."""
    return max(0, -int(Decimal(repr(quantum)).as_tuple().exponent))


__all__ = ["write_csv"]
