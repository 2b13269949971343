"""The runs that keep a section from being repeatable: without them the others agree."""

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.comparing import with_others


def outliers(pairs: FloatArray, limit: float) -> tuple[list[int], float]:
    """Return the runs without which the pairs average ``limit``, and what they average then.

    One bad run takes part in all others' pairs, whose averages fall with its own; so the worst is
    left out until the rest agrees. Empty, and NaN, if half of the runs or more would have to go,
    or none has to. ``pairs`` has shape (runs, runs), NaN where there is none.
    """
    kept = np.flatnonzero(~np.isnan(with_others(pairs))).tolist()
    gone: list[int] = []
    while 2 * len(gone) < len(kept) + len(gone):
        part = pairs[np.ix_(kept, kept)]
        average = float(np.nanmean(part)) if np.isfinite(part).any() else np.nan
        if average >= limit:
            return gone, average if gone else np.nan
        gone.append(kept.pop(int(np.nanargmin(with_others(part)))))
    return [], np.nan
