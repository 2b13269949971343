"""Whether a filter's innovations are as large as it expects: bounds of their mean NIS.

n z of a consistent filter are independent and standard normal, so that n times the mean of z² is
chi-square distributed with n degrees of freedom (Bar-Shalom, Li and Kirubarajan 2001, 5.4.2).
"""

from collections.abc import Mapping
from typing import Any

from floatref.errors import InputError
from floatref.values.innovations import Innovations

SHARE = 0.95
"""Of consistent runs, those whose mean NIS lies within the bounds."""


def bound_mean_nis(count: int, share: float = SHARE) -> tuple[float, float]:
    """Return between which values the mean of ``count`` NIS lies with probability ``share``.

    The tails are equal: χ²_(1±share)/2(n)/n of n degrees of freedom. Raises InputError for fewer
    than one, and for a share that is not between 0 and 1.
    """
    from scipy.special import chdtri

    if count < 1:
        raise InputError(f"count is {count}; give 1 or more")
    if not 0.0 < share < 1.0:
        raise InputError(f"share is {share:g}; give one between 0 and 1")
    tail = (1.0 - share) / 2.0
    # chdtri takes the probability of more than its value.
    low, high = chdtri(count, 1.0 - tail), chdtri(count, tail)
    return float(low) / count, float(high) / count


def record_innovations(
    found: Mapping[str, Mapping[str, Innovations]],
) -> dict[str, dict[str, dict[str, Any]]]:
    """Return what a profile's record holds of ``found``, by wheel path and kind of reading.

    ``count`` is the number of innovations and of degrees of freedom; a kind without any that was
    left out every time has None for everything else but ``left_out``.
    """
    return {
        track: {kind: _record(each) for kind, each in kinds.items()}
        for track, kinds in found.items()
    }


def _record(found: Innovations) -> dict[str, Any]:
    low, high = bound_mean_nis(found.count) if found.count else (None, None)
    known = found.count > 0
    return {
        "count": found.count,
        "mean_nis": found.mean_nis if known else None,
        "lower_95_percent": low,
        "upper_95_percent": high,
        "within_2_sigma_percent": 100.0 * found.share_near if known else None,
        "mean_sigmas": found.mean if known else None,
        "left_out": found.left_out,
    }
