"""The sums of two signals that their correlation at every lag needs, gathered in pieces.

Sums count from the mean of the first piece: their size, and so their rounding, is that of the
signals' shape, whatever they are about.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.scanning import CHUNK, chunks


class SignalPiece(NamedTuple):
    """Values of one signal from index ``first`` on, and all those of the other that they meet.

    ``q``, from index ``q_first`` on, goes beyond ``p`` by the largest lag, or to its signal's end.
    """

    first: int
    p: FloatArray
    q_first: int
    q: FloatArray


class LaggedSums:
    """Sums at every lag i from −L to L, over those k for which k and k + i are both points.

    Attributes:
        products: Σ p(k)·q(k + i) less both centres, shape (2L + 1,).
        p, q: the sums of each signal alone.
    """

    def __init__(self, pieces: Iterable[SignalPiece], largest: int) -> None:
        """Gather ``pieces``, one after the other, each of L values or more, for L = ``largest``."""
        self._largest = largest
        self.products = np.zeros(2 * largest + 1)
        self.p, self.q = OneSignal(largest), OneSignal(largest)
        for piece in pieces:
            begin = piece.first - piece.q_first
            self.p.add(piece.p)
            self.q.add(piece.q[begin : begin + piece.p.size])
            self._multiply(piece)

    def _multiply(self, piece: SignalPiece) -> None:
        """Add the products of ``piece``: by transforms of a part with all values that it meets."""
        from scipy.fft import irfft, next_fast_len, rfft

        p, q, largest = piece.p, piece.q, self._largest
        step = max(CHUNK, 2 * largest)
        size = next_fast_len(min(step, p.size) + 2 * largest, real=True)
        for at in range(0, p.size, step):
            part = p[at : at + step] - self.p.centre
            # Value 0 is q's point L before the part's; there is nothing beyond the ends of q.
            first = piece.first + at - largest - piece.q_first
            low, high = max(first, 0), min(first + part.size + 2 * largest, q.size)
            met = np.zeros(part.size + 2 * largest)
            met[low - first : high - first] = q[low:high] - self.q.centre
            spectrum = np.conj(rfft(part, size))
            spectrum *= rfft(met, size)
            self.products += irfft(spectrum, size)[: self.products.size]


class OneSignal:
    """Sums of a signal about ``centre``, the mean of its first piece, and its largest value."""

    def __init__(self, largest: int) -> None:
        """Begin without a value."""
        self.count, self.centre, self.peak = 0, 0.0, 0.0
        self._largest = largest
        self._totals = {1: 0.0, 2: 0.0}
        self._head = self._tail = np.zeros(0)

    def add(self, values: FloatArray) -> None:
        """Add the next piece; InputError for NaN and infinities."""
        if not np.isfinite(values).all():
            raise InputError("a signal holds NaN; bridge it or cut it away before correlating")
        if not self.count:
            self.centre, self.peak = float(values.mean()), -np.inf
            self._head = values[: self._largest].copy()
        self.count += values.size
        self.peak = max(self.peak, float(values.max()), -float(values.min()))
        for power in self._totals:
            parts = (part for _, part in chunks(values))
            self._totals[power] += sum(float(np.sum((x - self.centre) ** power)) for x in parts)
        self._tail = values[::-1][: self._largest].copy()

    def over_overlaps(self, power: int) -> FloatArray:
        """Return, per lag i, the sum of those k for which k + i is a point as well.

        Summed is the ``power``, 1 or 2, of what the values differ by from the centre.
        """
        total = self._totals[power]
        head, tail = (np.cumsum((x - self.centre) ** power) for x in (self._head, self._tail))
        return np.concatenate((total - head[::-1], [total], total - tail))
