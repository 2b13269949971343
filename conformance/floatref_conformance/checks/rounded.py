"""Strategies of numbers that people would write down: few digits."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

SEED = 2**32 - 1
"""Largest seed that is drawn."""


def rounded(low: float, high: float, digits: int = 1) -> "SearchStrategy[float]":
    """Return a strategy of numbers from ``low`` to ``high`` with so many ``digits`` decimals."""
    from hypothesis import strategies as st

    scale = 10**digits
    whole = st.integers(round(low * scale), round(high * scale))
    return whole.map(lambda n: round(n / scale, digits))


def seeds() -> "SearchStrategy[int]":
    """Return a strategy of seeds of a scenario."""
    from hypothesis import strategies as st

    return st.integers(0, SEED)
