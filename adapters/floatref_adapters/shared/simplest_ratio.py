"""Numbers of a file as the fractions that they were rounded from."""

import math
from fractions import Fraction


def find_simplest(value: float) -> Fraction:
    """Return the simplest fraction that rounds to ``value``: 1/3240 for 0.00030864197530864197.

    The simplest has the smallest denominator. ``value`` is finite; ValueError or OverflowError
    if it is not.
    """
    exact = Fraction(value)
    size = abs(value)
    if exact.denominator == 1:
        return exact
    low = (abs(exact) + Fraction(math.nextafter(size, 0.0))) / 2
    high = (abs(exact) + Fraction(math.nextafter(size, math.inf))) / 2
    simple = (math.copysign(1, value) < 0 and -between(low, high)) or between(low, high)
    return simple if float(simple) == value else exact


def between(low: Fraction, high: Fraction) -> Fraction:
    """Return the fraction of the smallest denominator in [``low``, ``high``], both above 0."""
    terms = []
    while True:
        whole = math.floor(low)
        if whole == low or whole + 1 <= high:
            terms.append(whole if whole == low else whole + 1)
            break
        terms.append(whole)
        low, high = 1 / (high - whole), 1 / (low - whole)
    found = Fraction(terms.pop())
    while terms:
        found = terms.pop() + 1 / found
    return found
