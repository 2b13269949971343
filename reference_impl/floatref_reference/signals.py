"""Number format of the reference: extended precision for every filter and every sum."""

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Signal: TypeAlias = npt.NDArray[np.longdouble]
Samples: TypeAlias = list[np.longdouble]
Real: TypeAlias = float | np.longdouble

ZERO = np.longdouble(0)
PI = 4 * np.arctan(np.longdouble(1))
STANDARD_GRAVITY = np.longdouble("9.80665")


def samples(x: npt.ArrayLike) -> Samples:
    """List a signal's samples as extended-precision numbers.

    Args:
        x: one-dimensional signal, at least one finite sample.

    Returns:
        The samples, in order.

    Raises:
        ValueError: if the signal is not one-dimensional, is empty or holds NaN or infinity.
    """
    signal = np.asarray(x, dtype=np.longdouble)
    if signal.ndim != 1 or signal.size == 0:
        raise ValueError(f"a signal has one dimension and at least one sample, not {signal.shape}")
    if not np.isfinite(signal).all():
        raise ValueError("a signal holds NaN or infinity: cut it into finite stretches first")
    return list(signal)


def signal(x: Samples | Signal) -> Signal:
    """Put samples back into an array.

    Args:
        x: samples, in order.

    Returns:
        The signal, shape (len(x),), `numpy.longdouble`.
    """
    return np.array(x, dtype=np.longdouble)


def mean(x: npt.ArrayLike) -> np.longdouble:
    """Average a signal, summed one sample after the other.

    Args:
        x: signal, shape (N,).

    Returns:
        Its mean, in the unit of x.
    """
    x_k, total = samples(x), ZERO
    for value in x_k:
        total += value
    return total / len(x_k)
