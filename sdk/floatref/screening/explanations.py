"""Which of several explanations a signal follows, judged window by window.

A window counts for an explanation only if this leaves a much smaller residual than every other one,
and than no explanation at all. So noise, drift and a vehicle that hardly moves do not count.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray

RIGHT = "right"
"""Name of the explanation that a correct recording follows."""
FEWEST = 12
"""Fewest values in a window."""
LEAST_EVIDENCE, MOST_EVIDENCE = 0.3, 3.0
"""Smallest and largest evidence of a window: the logarithm of the ratio of squared residuals."""
CERTAIN, OUTWEIGHED = 3.0, 4.0
"""Sum of evidence above which an explanation is accepted, and its smallest ratio to the sum against
it."""
MOVES = 2.0
"""Smallest motion that shows a unit, in multiples of what working sensors err by."""
LIKELY = 1.5
"""Sum of evidence above which a suspicion is reported, if it is twice the sum against it."""


@dataclass(frozen=True)
class Look:
    """How a signal is examined.

    Attributes:
        span_s: length of a window in s; windows overlap by half.
        floor: root mean square residual of working sensors, in the signal's unit.
        degree: of the polynomial that is free in each window; -1 for no polynomial.
        factors: of explanations that are a signal times a number. These count only where that
            signal moves: the noise of a gyro times 57.3 is as large as that of an attitude, and
            in hours of standstill there are windows in which one looks like the other.
    """

    span_s: float
    floor: float
    degree: int = 1
    factors: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Evidence:
    """The evidence for the right explanation, and for the wrong one with the most evidence.

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
    """Return the evidence for ``explanations`` of ``signal``.

    Args:
        times: in s, increasing, shape (n,).
        signal: at these times, NaN where it is missing.
        explanations: the signal expected under each explanation, `RIGHT` and others.
        look: the windows, and the accuracy of the signal.
    """
    table = np.stack([signal, *explanations.values()], axis=1)
    known: BoolArray = np.logical_not(np.isnan(table).any(axis=1))
    evidence = np.zeros(len(explanations))
    least = MOVES * look.floor * np.array([look.factors.get(name, 0.0) for name in explanations])
    for part in windows(times, look.span_s):
        rows = table[part][known[part]]
        if rows.shape[0] >= max(FEWEST, 0.9 * (part.stop - part.start)):
            left = detrend(times[part][known[part]], rows, look.degree)
            moves = np.mean(left[:, 1:] ** 2, axis=0) >= least**2
            evidence += np.where(moves, _score_window(left, look.floor), 0.0)
    found = dict(zip(explanations, evidence.tolist(), strict=True))
    right = found.pop(RIGHT)
    name = max(found, key=found.__getitem__)
    return Evidence(right, found[name], name)


def _score_window(rows: FloatArray, floor: float) -> FloatArray:
    """Return the lead of the best explanation over all others and over no explanation, else 0."""
    left = rows[:, :1] - np.column_stack([np.zeros(rows.shape[0]), rows[:, 1:]])
    squares = np.sum(left**2, axis=0) + rows.shape[0] * floor**2
    best, second = np.argsort(squares)[:2]
    lead = float(np.log(squares[second] / squares[best]))
    evidence = np.zeros(squares.size)
    evidence[best] = min(lead, MOST_EVIDENCE) if lead >= LEAST_EVIDENCE else 0.0
    return evidence[1:]


def detrend(times: FloatArray, rows: FloatArray, degree: int) -> FloatArray:
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


def report_fault(evidence: Evidence, lines: Mapping[str, str], fatal: bool = True) -> Iterator[str]:
    """Raise InputError with the line of a fault that is certain, or yield it as a suspicion.

    A name with "-" that has no line of its own uses the line of the name without it; a name without
    a line gives no report. If not ``fatal``, a certain fault is yielded, too.
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
