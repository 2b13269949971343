"""The zero-phase sets HPF_B3x2 and LPF_B3x2 of appendix A.1, on whole arrays."""

import math

import numpy as np

from floatref.kernels.memories import STATE_VARIABLE
from floatref.kernels.state_variable import (
    high_pass_1,
    high_pass_2,
    high_pass_21,
    low_pass_1,
    low_pass_2,
)
from floatref.values.arrays import FloatArray, new_record, read_only


def _c(interval: float, cutoff_wavelength: float) -> float:
    return math.tan(math.pi * interval / cutoff_wavelength)


def high_pass_b3x2(
    x: FloatArray, interval: float, cutoff_wavelength: float, out: FloatArray | None = None
) -> FloatArray:
    """Return HPF_B3x2 of ``x``: HPF_B3S1, HPF_B3S2R, HPF_B3S1R and HPF_B3S2 in this order.

    ``cutoff_wavelength`` is that of each third-order pass; (A.22) gives it from the -3 dB
    wavelength of the set. It has the unit of ``interval`` and must exceed two intervals. With
    ``out``, which may be ``x``, it is written there.
    """
    c = _c(interval, cutoff_wavelength)
    y = np.empty(x.size) if out is None else out
    high_pass_1(read_only(x), y, new_record(STATE_VARIABLE), c, False)
    seen = read_only(y)
    high_pass_21(seen, y, new_record(STATE_VARIABLE), new_record(STATE_VARIABLE), c, True)
    high_pass_2(seen, y, new_record(STATE_VARIABLE), c, False)
    return y


def low_pass_b3x2(
    x: FloatArray, interval: float, cutoff_wavelength: float, out: FloatArray | None = None
) -> FloatArray:
    """Return LPF_B3x2 of ``x``: LPF_B3S1, LPF_B3S2R, LPF_B3S1R and LPF_B3S2 in this order.

    ``cutoff_wavelength`` is that of each third-order pass; (A.21) gives it from the -3 dB
    wavelength of the set. It has the unit of ``interval`` and must exceed two intervals. With
    ``out``, which may be ``x``, it is written there.
    """
    c = _c(interval, cutoff_wavelength)
    y = np.empty(x.size) if out is None else out
    low_pass_1(read_only(x), y, new_record(STATE_VARIABLE), c, False)
    seen = read_only(y)
    low_pass_2(seen, y, new_record(STATE_VARIABLE), c, True)
    low_pass_1(seen, y, new_record(STATE_VARIABLE), c, True)
    low_pass_2(seen, y, new_record(STATE_VARIABLE), c, False)
    return y
