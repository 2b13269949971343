"""Times written as text: numbers with their decimals, ISO 8601, or the time of a day, as ticks."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from floatref import Epoch, InputError, NativeClock
from floatref_adapters.formats.csv_table.table_fields import is_number
from floatref_adapters.formats.csv_table.table_rows import Piece
from floatref_adapters.shared.time_columns import DAY_S
from floatref_adapters.shared.time_texts import CLOCK, ISO, read_day_ns, read_iso_ns

MOST_DIGITS = 18
"""Digits of a tick that int64 holds, whatever they are."""
MOST_WRITTEN = 100
"""Digits before or behind the decimal mark that a time may be written with; most are dropped."""
LARGEST = 2.0**63
EXACT_DIGITS = 15
"""Digits that a float64 holds, so that its product with a power of ten rounds to the tick."""


class Writing(Enum):
    """How times are written."""

    NUMBER = "number"
    ISO = "iso"
    DAY = "day"


def find_writing(texts: Sequence[str], decimal: str) -> Writing | None:
    """Return how the times ``texts`` are written, or None if they are not times."""
    there = [text for text in texts if text]
    if not there:
        return None
    if all(is_number(text, decimal) for text in there):
        return Writing.NUMBER
    if all(ISO.fullmatch(text) for text in there):
        return Writing.ISO
    if all(CLOCK.fullmatch(text) for text in there):
        return Writing.DAY
    # A bad field in a column of numbers is found when it is read.
    return Writing.NUMBER if any(is_number(text, decimal) for text in there) else None


@dataclass(frozen=True)
class Times:
    """The column of time: its place, name, writing and unit in s.

    ``decimals`` is the most that one of its numbers is written with, ``whole`` the most digits
    before the decimal mark; ``exact`` is false where a number has an exponent. ``largest`` is the
    largest of those with more digits than any tick may have, ns since 1970 above all.
    """

    column: int
    name: str
    writing: Writing
    unit_s: Fraction
    decimal: str
    decimals: int = 0
    whole: int = 0
    exact: bool = True
    largest: float = 0.0

    def measure(self, piece: Piece) -> "Times":
        """Return this, with the decimals and digits in ``piece`` taken into account."""
        if self.writing is not Writing.NUMBER:
            return self
        seen = self._measure_digits(piece)
        if seen.decimals + seen.whole <= MOST_DIGITS:
            return seen
        values = np.abs(piece.numbers([self.column]))
        return replace(seen, largest=float(np.fmax.reduce(values[:, 0], initial=self.largest)))

    def _measure_digits(self, piece: Piece) -> "Times":
        plain = piece.grid.plain([self.column]) if piece.grid else None
        if plain is None:
            # What is not plain is read field by field anyway.
            return self._measure_fields(piece)
        codes = np.frombuffer(plain, np.uint8)
        ends = np.flatnonzero(codes == ord(","))
        starts = np.concatenate(([0], ends[:-1] + 1))
        points = np.append(np.flatnonzero(codes == ord(".")), codes.size)
        point = points[np.searchsorted(points, starts)]
        point = np.minimum(point, ends)
        decimals = int(np.maximum(ends - point - 1, 0).max(initial=0))
        whole = int((point - starts).max(initial=0))
        return self.widen(decimals, whole, b"e" not in plain.lower())

    def _measure_fields(self, piece: Piece) -> "Times":
        found = self
        for text in piece.texts(self.column):
            whole, _, part = text.partition(self.decimal)
            found = found.widen(len(part), len(whole), "e" not in text.lower())
        return found

    def widen(self, decimals: int, whole: int, exact: bool) -> "Times":
        """Return this, with room for another number; InputError for one that is no time."""
        if max(decimals, whole) > MOST_WRITTEN:
            raise InputError(
                f"column {self.name}: a time with {max(decimals, whole)} digits on one side of its "
                f"decimal mark; write times with up to {MOST_DIGITS} digits"
            )
        if decimals <= self.decimals and whole <= self.whole and exact >= self.exact:
            return self
        return replace(
            self,
            decimals=max(self.decimals, decimals),
            whole=max(self.whole, whole),
            exact=self.exact and exact,
        )

    @property
    def integral(self) -> bool:
        """Tell whether all times are ticks of the last decimal within int64."""
        digits = self.decimals + self.whole
        large = self.largest * 10.0**self.decimals < LARGEST
        return self.exact and (digits <= MOST_DIGITS or (digits <= MOST_DIGITS + 2 and large))

    def clock(self) -> NativeClock:
        """Return the clock; its ticks are those of `ticks`."""
        if self.writing is Writing.ISO:
            return NativeClock(tick_s=Fraction(1, 10**9), epoch=Epoch.UTC, name="utc")
        if self.writing is Writing.DAY:
            return NativeClock(tick_s=Fraction(1, 10**9), turn_s=Fraction(DAY_S))
        scale = 10**self.decimals if self.integral else 1
        return NativeClock(tick_s=self.unit_s / scale)

    def ticks(
        self, piece: Piece, values: NDArray[np.float64] | None
    ) -> NDArray[np.int64] | NDArray[np.float64]:
        """Return the times in ``piece``; InputError with the row of one that is not a time.

        ``values``, of shape (rows,), are the times as numbers; None where they are text.
        """
        if values is None:
            return self._of_text(piece)
        bad = np.flatnonzero(~np.isfinite(values))
        if bad.size:
            raise self._no_time(piece, int(bad[0]))
        if not self.integral:
            return values
        if self.decimals + self.whole <= EXACT_DIGITS:
            return np.rint(values * 10.0**self.decimals).astype(np.int64)
        texts = piece.texts(self.column)
        return np.array([self._tick(text, piece.first) for text in texts], np.int64)

    def _tick(self, text: str, first: int) -> int:
        whole, _, part = text.partition(self.decimal)
        tick = int(whole + part.ljust(self.decimals, "0"))
        if abs(tick) >= LARGEST:
            raise InputError(f"rows from {first} on: {self.name} is {text}; write fewer decimals")
        return tick

    def _of_text(self, piece: Piece) -> NDArray[np.int64]:
        texts = piece.texts(self.column)
        read = read_iso_ns if self.writing is Writing.ISO else read_day_ns
        found = np.empty(len(texts), np.int64)
        for k, text in enumerate(texts):
            tick = read(text)
            if tick is None:
                raise self._no_time(piece, k)
            found[k] = tick
        return found

    def _no_time(self, piece: Piece, row: int) -> InputError:
        text = piece.texts(self.column)[row]
        return InputError(
            f"row {piece.first + row}: {self.name} is {text[:40]!r}; every row needs its time"
        )
