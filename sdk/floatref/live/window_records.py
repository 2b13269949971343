"""What made the windows of a profile: a record that stays short however long the stream was.

A document of a profile is read up to 4 MiB, and a window's record takes 2 to 4 KiB: a day of
driving has a thousand windows. The first and the last ones are kept whole, those between them are
counted.
"""

import json
from collections.abc import Mapping, Sequence
from typing import Any

MOST_BYTES = 1 << 20
"""Most bytes of the records of windows in a profile, as JSON."""


def describe_windows(
    records: Sequence[Mapping[str, Any]], most_bytes: int = MOST_BYTES
) -> dict[str, Any]:
    """Return ``windows``, the records of all windows in order, without their settings.

    Of records longer than ``most_bytes`` together, as JSON, those in the middle are left out: as
    many remain of the first as of the last ones, and ``left_out`` says how many are missing, and
    from ``begin_s`` to ``end_s`` of them in s.
    """
    windows = [{k: v for k, v in each.items() if k != "settings"} for each in records]
    kept = _count_that_fit(windows, most_bytes)
    if kept == len(windows):
        return {"windows": windows}
    head = (kept + 1) // 2
    end = len(windows) - (kept - head)
    gap = windows[head:end]
    left_out = {
        "count": len(gap),
        "begin_s": gap[0].get("begin_s"),
        "end_s": gap[-1].get("end_s"),
    }
    return {"windows": [*windows[:head], *windows[end:]], "left_out": left_out}


def _count_that_fit(windows: Sequence[Mapping[str, Any]], most_bytes: int) -> int:
    """Return how many windows fit, taken by turns from the beginning and from the end."""
    left, low, high = most_bytes, 0, len(windows)
    while low < high:
        at = low if low <= len(windows) - high else high - 1
        left -= len(json.dumps(windows[at], default=str)) + 2
        if left < 0:
            break
        low, high = (low + 1, high) if at == low else (low, high - 1)
    return low + len(windows) - high
