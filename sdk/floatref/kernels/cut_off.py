"""Cut-offs of the third-order passes of HPF_B3x2 and LPF_B3x2 (A.4 and A.5)."""

import math

SIXTH_ORDER = math.pow(math.sqrt(2.0) - 1.0, 1.0 / 6.0)
"""Ratio of (A.20): cut-off of each third-order pass over the -3 dB frequency of both."""


def high_pass_setting(frequency: float) -> float:
    """Return f_c of each pass of HPF_B3x2 for -3 dB at ``frequency``: (A.20)."""
    return SIXTH_ORDER * frequency


def low_pass_setting(frequency: float) -> float:
    """Return f_c of each pass of LPF_B3x2 for -3 dB at ``frequency``: (A.21)."""
    return frequency / SIXTH_ORDER


def high_pass_wavelength_setting(wavelength: float) -> float:
    """Return λ_c of each pass of HPF_B3x2 for -3 dB at ``wavelength``: (A.22)."""
    return wavelength / SIXTH_ORDER
