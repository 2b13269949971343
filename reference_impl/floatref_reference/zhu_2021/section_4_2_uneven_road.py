"""4.2 Uneven Road Surface."""


def obstacle(t: float, v: float = 10.0, t_0: float = 0.8, A: float = 0.2, d: float = 0.8) -> float:
    """Evaluate a rectangular obstacle.

    Equation:
        (16) u_r = A for t_0 <= t <= t_0 + d/v, else 0

    Args:
        t: time, s.
        v: speed, m/s.
        t_0: time at which the wheel meets it, s.
        A: its height, m.
        d: its length, m.

    Returns:
        u_r, m.
    """
    return A if t_0 <= t <= t_0 + d / v else 0.0
