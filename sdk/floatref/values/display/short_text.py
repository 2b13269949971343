"""Short texts about values: bounded in length, on one line, whatever the names in a file are."""

from collections.abc import Sequence

import numpy as np

from floatref.errors import one_line
from floatref.values.arrays import BoolArray, FloatArray

LONGEST_NAME = 32
"""Most characters of a name; a longer one loses its end."""
MOST_LISTED = 4
"""Most items of a list in one line."""
NO_VALUE = "–"


def shorten(name: str) -> str:
    """Return ``name`` on one line, with at most `LONGEST_NAME` characters."""
    # Escapes lengthen a name, up to ten characters for each: it is cut before and after them.
    text = one_line(name[: LONGEST_NAME + 1])
    return text if len(text) <= LONGEST_NAME else f"{text[: LONGEST_NAME - 1]}…"


def join_some(items: Sequence[str], most: int = MOST_LISTED) -> str:
    """Return the first ``most`` of ``items``, with commas, and the number of the others."""
    others = len(items) - most
    return ", ".join(items[:most]) + (f" and {others} more" if others > 0 else "")


def share_of(marks: BoolArray) -> float:
    """Return the share of ``marks``, of any size, that are true; 0 of an empty array."""
    return float(np.count_nonzero(marks)) / marks.size if marks.size else 0.0


def percent(share: float) -> str:
    """Return ``share`` in per cent with one decimal; only 0 is 0.0 %, and only 1 is 100.0 %."""
    shown = min(max(100.0 * share, 0.1), 99.9) if 0.0 < share < 1.0 else 100.0 * share
    return f"{shown:.1f} %"


def in_mm_or_m(metres: float) -> str:
    """Return a length given in m as text, in mm below 1 m."""
    return f"{1000.0 * metres:g} mm" if metres < 1.0 else f"{metres:g} m"


def rate_text(rate_hz: float) -> str:
    """Return a rate given in Hz as text; that of a single sample, which is infinite, as a dash."""
    return f"{rate_hz:.5g} Hz" if np.isfinite(rate_hz) else NO_VALUE


def range_text(values: FloatArray, unit: str) -> str:
    """Return lowest and highest of ``values`` with their ``unit``; a dash if all are NaN."""
    finite = values[np.isfinite(values)]
    if not finite.size:
        return NO_VALUE
    return f"{finite.min():.4g} to {finite.max():.4g} {unit}".rstrip()
