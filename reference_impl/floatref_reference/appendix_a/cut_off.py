"""A.4 Cut-off Frequency and A.5 Spatial Filtering: settings for a wanted -3 dB point."""

import numpy as np

from floatref_reference.signals import Real

THIRD_ORDER_RATIO: np.longdouble = (np.sqrt(np.longdouble(2)) - 1) ** (1 / np.longdouble(6))
GOLDEN_RATIO: np.longdouble = (1 + np.sqrt(np.longdouble(5))) / 2


def high_pass_cut_off(f_3db: Real) -> np.longdouble:
    """Set the third-order cut-off of HPF_B3x2 from its -3 dB frequency.

    Equation:
        (A.20) f_c = (√2 - 1)^(1/6) f_-3dB

    Args:
        f_3db: frequency at which the sixth-order set loses 3 dB, Hz.

    Returns:
        f_c, Hz.
    """
    return THIRD_ORDER_RATIO * np.longdouble(f_3db)


def low_pass_cut_off(f_3db: Real) -> np.longdouble:
    """Set the third-order cut-off of LPF_B3x2 from its -3 dB frequency.

    Equation:
        (A.21) f_c = (√2 - 1)^(-1/6) f_-3dB

    Args:
        f_3db: frequency at which the sixth-order set loses 3 dB, Hz.

    Returns:
        f_c, Hz.
    """
    return np.longdouble(f_3db) / THIRD_ORDER_RATIO


def high_pass_cut_off_wavelength(lambda_3db: Real) -> np.longdouble:
    """Set the third-order cut-off wavelength of HPF_B3x2 from its -3 dB wavelength.

    Equation:
        (A.22) λ_c = (√2 - 1)^(-1/6) λ_-3dB

    Args:
        lambda_3db: wavelength at which the sixth-order set loses 3 dB, m.

    Returns:
        λ_c, m.
    """
    return np.longdouble(lambda_3db) / THIRD_ORDER_RATIO


def high_pass_second_stage_3db(f_c: Real) -> np.longdouble:
    """Locate the -3 dB point of the second-order complementary high-pass stage.

    Equation:
        Section A.4: 0.78615 f_c. From |H_2|² = 1/2 in (A.3): Ω⁴ + Ω² - 1 = 0 with
        Ω = ω/ω_a, so Ω is the inverse square root of the golden ratio.

    Args:
        f_c: cut-off frequency of the third-order filter, Hz.

    Returns:
        Frequency, Hz; exact for the analog stage.
    """
    return np.longdouble(f_c) / GOLDEN_RATIO ** np.longdouble("0.5")


def low_pass_second_stage_3db(f_c: Real) -> np.longdouble:
    """Locate the -3 dB point of the second-order complementary low-pass stage.

    Equation:
        Section A.4: 1.27202 f_c. From |H_2|² = 1/2 in (A.5): Ω⁴ - Ω² - 1 = 0 with
        Ω = ω/ω_a, so Ω is the square root of the golden ratio.

    Args:
        f_c: cut-off frequency of the third-order filter, Hz.

    Returns:
        Frequency, Hz; exact for the analog stage.
    """
    return np.longdouble(f_c) * GOLDEN_RATIO ** np.longdouble("0.5")
