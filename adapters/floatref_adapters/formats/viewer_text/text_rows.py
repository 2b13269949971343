"""The rows of viewers' text: a pair of numbers for every channel, some shorter than others.

Numbers are written in at most 15 characters, so that 0.0254 is 0.0254 whatever its last bit is.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, constant_interval, count_decimals
from floatref_adapters.formats.viewer_text.column_pairs import TAB, Pair

Floats = NDArray[np.float64]
ROWS = 1 << 14
"""Rows that are handled together."""
FIRST_ROWS = 1000
"""Rows at the start and at the end whose distances tell with how many decimals they are written.

Viewers write 15 digits, so distances far from zero have fewer decimals than near ones.
"""
DECIMALS, DIGITS = 12, 13
"""Decimals of numbers below one, and significant digits of others: a picometre, or a part in 1e12.

With a sign and a point either has 15 characters."""


def write_number(value: float) -> str:
    """Return the shortest text within 5e-13 of ``value``, or of its share above one; "" for NaN.

    It has at most 15 characters up to 1e11, which no elevation in m exceeds.
    """
    if value != value:
        return ""
    if -1.0 < value < 1.0:
        return repr(round(value, DECIMALS) + 0.0)
    return repr(float(f"{value:.{DIGITS}g}"))


def distance_decimals(start: float, interval: float, count: int) -> int:
    """Return the decimals with which the farthest of ``count`` distances has 13 digits.

    All of them have these: a column that is rounded alike has one interval when it is read.
    """
    farthest = max(abs(start), abs(start + interval * (count - 1)))
    return DECIMALS - max(0, math.floor(math.log10(farthest))) if farthest > 0.0 else DECIMALS


class Columns:
    """The numbers of the wanted columns of a file, and the decimals of its distances."""

    def __init__(self, stream: TextIO, width: int, pairs: Sequence[Pair], titles: Sequence[str]):
        """Read all rows behind the header; ``width`` is the number of its columns.

        Raises InputError with the row and the column for what is no number.
        """
        self._titles = titles
        places = [place for pair in pairs for place in (pair.distance, pair.values)]
        parts: dict[int, list[Floats]] = {place: [np.empty(0)] for place in places}
        self._decimals = dict.fromkeys(places, 0)
        last: dict[int, list[str]] = {place: [] for place in places}
        first = 2
        for rows in _blocks(stream):
            _check_widths(rows, width, first)
            for place in places:
                texts = [row[place].strip() if place < len(row) else "" for row in rows]
                parts[place].append(self._numbers(texts, place, first))
                if first < FIRST_ROWS:
                    self._decimals[place] = max(map(count_decimals, texts[:FIRST_ROWS]))
                last[place] = [*last[place], *filter(None, texts)][-FIRST_ROWS:]
            first += len(rows)
        for place, texts in last.items():
            decimals = max(map(count_decimals, texts), default=0)
            self._decimals[place] = min(self._decimals[place], decimals)
        self._values = {place: np.concatenate(found) for place, found in parts.items()}

    def values(self, pair: Pair) -> Floats:
        """Return the values of ``pair``, NaN where a field is empty, to its last distance."""
        return self._values[pair.values][: self._count(pair)]

    def start_and_interval(self, pair: Pair) -> tuple[float, float]:
        """Return start and interval of the distances of ``pair``, in their unit.

        Raises InputError if they have no constant interval, and for values without a distance.
        """
        count = self._count(pair)
        beyond = np.flatnonzero(~np.isnan(self._values[pair.values][count:]))
        if beyond.size:
            row = count + int(beyond[0]) + 2
            raise InputError(f"row {row}: {pair.distance_title} is missing; every value needs one")
        distances = self._values[pair.distance][:count]
        decimals = self._decimals[pair.distance]
        return constant_interval(distances, decimals, pair.distance_title, pair.distance_unit)

    def _count(self, pair: Pair) -> int:
        """Return the number of rows up to the last distance of ``pair``."""
        known = np.flatnonzero(~np.isnan(self._values[pair.distance]))
        return int(known[-1]) + 1 if known.size else 0

    def _numbers(self, texts: list[str], place: int, first: int) -> Floats:
        try:
            return np.array([float(text) if text else np.nan for text in texts])
        except ValueError:
            row, text = next(_bad(texts, first))
            comma = "decimal points, not decimal commas" if "," in text else "a number, or nothing"
            title = self._titles[place].strip()
            raise InputError(f"row {row}: {title} is {text[:40]!r}; write {comma}") from None


def _blocks(stream: TextIO) -> Iterator[list[list[str]]]:
    while rows := [line.rstrip("\r\n").split(TAB) for line in islice(stream, ROWS)]:
        yield rows


def _check_widths(rows: list[list[str]], width: int, first: int) -> None:
    for number, row in enumerate(rows, first):
        if len(row) > width:
            raise InputError(
                f"row {number} has {len(row)} fields, the header {width}; export again"
            )


def _bad(texts: list[str], first: int) -> Iterator[tuple[int, str]]:
    for row, text in enumerate(texts, first):
        try:
            float(text or "nan")
        except ValueError:
            yield row, text
