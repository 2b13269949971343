"""Strategies of numbers with few digits, so that cases are easy to read."""

import json
import zlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

SEED = 2**32 - 1
"""Largest seed."""


def rounded_numbers(low: float, high: float, digits: int = 1) -> "SearchStrategy[float]":
    """Return a strategy of numbers from ``low`` to ``high`` with ``digits`` decimals."""
    from hypothesis import strategies as st

    scale = 10**digits
    whole = st.integers(round(low * scale), round(high * scale))
    return whole.map(lambda n: round(n / scale, digits))


def seeds() -> "SearchStrategy[int]":
    """Return a strategy of seeds of a scenario."""
    from hypothesis import strategies as st

    return st.integers(0, SEED)


def seed_of_its_own(seed: int, *numbers: Mapping[str, Any]) -> int:
    """Return a seed that depends on ``numbers``, so that no two cases have the same road.

    The search may change other numbers of a case and not ``seed``.
    """
    return zlib.crc32(json.dumps([seed, *numbers], sort_keys=True).encode())
