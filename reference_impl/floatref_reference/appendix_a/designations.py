"""A.1 Designations: the analog transfer functions behind the filter stages."""


def hpf_b3(s: complex, omega_a: float) -> complex:
    """Evaluate the third-order Butterworth high-pass filter.

    Equation:
        (A.1) H(s) = s³ / (s³ + 2 ω_a s² + 2 ω_a² s + ω_a³)

    Args:
        s: Laplace operator, rad/s; jω for a frequency response.
        omega_a: analog angular cut-off frequency ω_a, rad/s.

    Returns:
        H(s), dimensionless.
    """
    return s**3 / (s**3 + 2 * omega_a * s**2 + 2 * omega_a**2 * s + omega_a**3)


def hpf_b3s1(s: complex, omega_a: float) -> complex:
    """Evaluate the first-order stage of the high-pass filter.

    Equation:
        (A.2) H_1(s) = s / (s + ω_a)

    Args:
        s: Laplace operator, rad/s.
        omega_a: analog angular cut-off frequency ω_a, rad/s.

    Returns:
        H_1(s), dimensionless.
    """
    return s / (s + omega_a)


def hpf_b3s2(s: complex, omega_a: float) -> complex:
    """Evaluate the complementary second-order stage of the high-pass filter.

    Equation:
        (A.3) H_2(s) = s² / (s² + ω_a s + ω_a²)

    Args:
        s: Laplace operator, rad/s.
        omega_a: analog angular cut-off frequency ω_a, rad/s.

    Returns:
        H_2(s), dimensionless.
    """
    return s**2 / (s**2 + omega_a * s + omega_a**2)


def lpf_b3s1(s: complex, omega_a: float) -> complex:
    """Evaluate the first-order stage of the low-pass filter.

    Equation:
        (A.4) H_1(s) = ω_a / (s + ω_a)

    Args:
        s: Laplace operator, rad/s.
        omega_a: analog angular cut-off frequency ω_a, rad/s.

    Returns:
        H_1(s), dimensionless.
    """
    return omega_a / (s + omega_a)


def lpf_b3s2(s: complex, omega_a: float) -> complex:
    """Evaluate the complementary second-order stage of the low-pass filter.

    Equation:
        (A.5) H_2(s) = ω_a² / (s² + ω_a s + ω_a²)

    Args:
        s: Laplace operator, rad/s.
        omega_a: analog angular cut-off frequency ω_a, rad/s.

    Returns:
        H_2(s), dimensionless.
    """
    return omega_a**2 / (s**2 + omega_a * s + omega_a**2)
