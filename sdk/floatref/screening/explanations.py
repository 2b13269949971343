"""Which of several explanations a signal follows, judged window by window.

A window counts for one only if it leaves much less of the signal unexplained than every other,
and than no explanation at all: noise, drift, and a vehicle that hardly moves count for none.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray

RIGHT = "right"
"""Name of the explanation that should hold."""
FEWEST = 12
"""Values of a window."""
HEARD, LOUDEST = 0.3, 3.0
"""A window counts from this logarithm of the ratio of squared residuals on, and up to that."""
CERTAIN, OUTWEIGHED = 3.0, 4.0
"""So much together is certain, if it is so many times what speaks against it."""
LIKELY = 1.5
"""So much is worth a word, if it is twice what speaks against it."""


@dataclass(frozen=True)
class Look:
    """How a signal is looked at.

    Attributes:
        span_s: length of a window in s; windows overlap by half.
        floor: what sensors that work leave unexplained, in the signal's unit.
        degree: of the polynomial that is free in each window; -1 for none.
    """

    span_s: float
    floor: float
    degree: int = 1


@dataclass(frozen=True)
class Evidence:
    """What speaks for the right explanation, and for the wrong one that most speaks for.

    Attributes:
        right: sum over the windows, 0 or above.
        wrong: the same for the wrong explanation.
        name: of the wrong explanation.
    """

    right: float = 0.0
    wrong: float = 0.0
    name: str = ""

    @property
    def certain(self) -> bool:
        """Whether the wrong explanation holds beyond doubt."""
        return self.wrong >= max(CERTAIN, OUTWEIGHED * self.right)

    @property
    def likely(self) -> bool:
        """Whether the wrong explanation is much likelier than the right one."""
        return self.wrong >= max(LIKELY, 2 * self.right)

    @property
    def confirmed(self) -> bool:
        """Whether the right explanation holds beyond doubt."""
        return self.right >= max(CERTAIN, OUTWEIGHED * self.wrong)


def weigh(
    times: FloatArray, signal: FloatArray, explanations: Mapping[str, FloatArray], look: Look
) -> Evidence:
    """Return what speaks for each of ``explanations`` of ``signal``.

    Args:
        times: in s, increasing, shape (n,).
        signal: at these times, NaN where it is missing.
        explanations: what it would be if one of them held, `RIGHT` and others.
        look: windows, and how exact the signal is.
    """
    table = np.stack([signal, *explanations.values()], axis=1)
    known: BoolArray = np.logical_not(np.isnan(table).any(axis=1))
    heard = np.zeros(len(explanations))
    for part in windows(times, look.span_s):
        rows = table[part][known[part]]
        if rows.shape[0] >= max(FEWEST, 0.9 * (part.stop - part.start)):
            left = detrended(times[part][known[part]], rows, look.degree)
            heard += _heard(left, look.floor)
    found = dict(zip(explanations, heard.tolist(), strict=True))
    right = found.pop(RIGHT)
    name = max(found, key=found.__getitem__)
    return Evidence(right, found[name], name)


def _heard(rows: FloatArray, floor: float) -> FloatArray:
    """Return by how much the best explanation beats all others, and none; 0 for the others."""
    left = rows[:, :1] - np.column_stack([np.zeros(rows.shape[0]), rows[:, 1:]])
    squares = np.sum(left**2, axis=0) + rows.shape[0] * floor**2
    best, second = np.argsort(squares)[:2]
    lead = float(np.log(squares[second] / squares[best]))
    heard = np.zeros(squares.size)
    heard[best] = min(lead, LOUDEST) if lead >= HEARD else 0.0
    return heard[1:]


def detrended(times: FloatArray, rows: FloatArray, degree: int) -> FloatArray:
    """Return ``rows``, shape (n, k), less their polynomials of ``degree`` in ``times``."""
    place = 2.0 * (times - times[0]) / (times[-1] - times[0]) - 1.0
    basis: list[FloatArray] = []
    for power in range(degree + 1):
        column = place**power
        for other in basis:
            column = column - (other @ column) * other
        column /= np.sqrt(column @ column)
        basis.append(column)
        rows = rows - np.outer(column, column @ rows)
    return rows


def windows(times: FloatArray, span_s: float) -> Iterator[slice]:
    """Yield slices of ``times``, in s, that are ``span_s`` long and overlap by half."""
    if times.size < FEWEST:
        return
    whole = float(times[-1] - times[0])
    length = min(span_s, whole)
    count = int((whole - length) / (length / 2) + 1.5)
    begins = times[0] + length / 2 * np.arange(count)
    low = np.searchsorted(times, begins - 1e-9)
    high = np.searchsorted(times, begins + length + 1e-9)
    for first, behind in zip(low.tolist(), high.tolist(), strict=True):
        yield slice(first, behind)


def said(evidence: Evidence, lines: Mapping[str, str], fatal: bool = True) -> Iterator[str]:
    """Raise InputError with the line of what is certainly wrong, or yield it as a suspicion.

    A name with "-" that has no line of its own shares that of the name without; of a name without
    a line nothing is said. What is not ``fatal`` is yielded, however certain.
    """
    line = lines.get(evidence.name) or lines.get(evidence.name.removeprefix("-"))
    if line is None:
        return
    if evidence.certain and fatal:
        raise InputError(line)
    if evidence.certain:
        yield line
    elif evidence.likely:
        yield f"{line} (a suspicion: this run moves too little to be sure)"
