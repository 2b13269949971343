"""Slips in the print of Imine et al.: the printed form fails, the mended one holds."""

import numpy as np
import numpy.typing as npt
import pytest

from floatref_reference.imine.section_2_trailer import TRAILER, forces, motion, sides
from floatref_reference.imine.section_4_b_convergence import (
    error_matrix,
    printed_conditions,
    slowest_rate,
)
from floatref_reference.imine.section_4_state_form import output_matrix, state_form

Matrix = npt.NDArray[np.float64]
FORM = state_form()


def test_roll_at_the_right_wheel_3() -> None:
    """Rolled right side up, the right suspension lifts its wheel; and K has to be symmetric."""
    rolled = np.array([0, 0, 0, 0.01, 0])
    force = forces(rolled, np.zeros(5), np.zeros(2), np.zeros(2))[1]
    _, z_r = sides(0.0, 0.01, 0.0)
    assert force == pytest.approx(TRAILER.k_2 * z_r)
    for mended in motion()[1:3]:
        printed = mended.copy()
        printed[1, 3] = -mended[1, 3]
        assert np.array_equal(mended, mended.T)
        assert printed[1, 3] == -printed[3, 1]


@pytest.mark.parametrize(("row", "lever"), [(3, "l_x"), (4, "p")])
def test_lever_of_the_moments_5(row: int, lever: str) -> None:
    """Printed are I θ̈/l and I φ̈/p of forces that carry a factor p, then the same without it."""
    q, arm = np.array([0.01, -0.02, 0.03, 0.004, -0.005]), getattr(TRAILER, lever)
    z_l, z_r = sides(*q[2:])
    left, right = TRAILER.k_1 * (q[0] - z_l), TRAILER.k_2 * (q[1] - z_r)
    pushed = right - left if lever == "l_x" else -right - left
    moment = forces(q, np.zeros(5), np.zeros(2), np.zeros(2))[row]
    assert moment == pytest.approx(arm * pushed)
    K = motion().K
    printed = K.copy()
    printed[row] *= TRAILER.p
    assert np.array_equal(K[row], K[:, row])
    assert np.abs(printed[row] - printed[:, row]).max() > 0.3 * np.abs(K[row, :3]).max()


def test_order_of_the_state_8() -> None:
    """The equation of a wheel and (9) cancel only if both have the state in the same order."""
    wheels_first = [0, 1, 2, 5, 6, 7, 3, 4, 8, 9]
    printed = FORM.A[np.ix_(wheels_first, wheels_first)]
    assert np.array_equal(printed[1, :6], [0, 0, 0, 0, 1, 0])
    D_printed = FORM.D_1[wheels_first]
    together = printed + D_printed @ FORM.A_2
    scale = np.abs(FORM.A).max()
    assert np.abs(together[[3, 4]]).max() > 0.1 * scale
    mended = (FORM.A + FORM.D_1 @ FORM.A_2)[[5, 6]]
    assert mended == pytest.approx(np.zeros((2, 10)), abs=1e-12 * scale)


def test_sign_of_the_acceleration_9() -> None:
    """Of any motion, (9) has to give back the rate of the road that made it."""
    rng = np.random.default_rng(4)
    x, (u, u_dot) = rng.normal(size=10), rng.normal(size=(2, 2))
    z_ddot = (FORM.A @ x + FORM.C_1 @ u + FORM.D_1 @ u_dot)[5:7]
    known = FORM.A_2 @ x + FORM.C_2 @ u
    assert known + FORM.D_2 @ z_ddot == pytest.approx(u_dot, abs=1e-9)
    off = known - FORM.D_2 @ z_ddot - u_dot
    assert off == pytest.approx(-2 * FORM.D_2 @ z_ddot)


def test_ten_gains_for_five_outputs() -> None:
    """IV.A measures five displacements, for which a diagonal of ten gains has no place."""
    C_prime = output_matrix([0, 1, 2, 3, 4])
    with pytest.raises(ValueError, match="mismatch"):
        error_matrix(FORM, np.diag(np.full(10, 60.0)), C_prime)
    G = np.vstack([60 * np.eye(5), 900 * np.eye(5)])
    assert slowest_rate(error_matrix(FORM, G, C_prime)) < -20


def test_conditions_on_the_gains_20() -> None:
    """Gains that meet all conditions, and gains that miss some: both are stable."""
    for g, met in ((np.full(10, 60.0), True), (np.full(10, 1.0), False)):
        L = error_matrix(FORM, np.diag(g), np.eye(10))
        assert printed_conditions(g, TRAILER) is met
        assert np.linalg.eigvalsh(L + L.T).max() > 300
        assert slowest_rate(L) < -0.99
