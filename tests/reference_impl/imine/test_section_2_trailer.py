"""The trailer: its equations are those of springs and dampers between wheels, chassis and road."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.imine.section_2_trailer import TRAILER, Trailer, forces, motion, sides

Vector = npt.NDArray[np.float64]
TRAILERS = st.tuples(*[st.floats(0.3, 3.0)] * 16).map(
    lambda scales: Trailer(*(value * s for value, s in zip(TRAILER, scales, strict=True)))
)
MOTIONS = st.tuples(*[st.floats(-1, 1)] * 5).map(np.array)
ROADS = st.tuples(*[st.floats(-1, 1)] * 2).map(np.array)


def potential(trailer: Trailer, q: Vector, u: Vector) -> float:
    """Return the energy in the springs; with B for k, half of what the dampers take."""
    z_1, z_2, z, theta, phi = q
    z_l, z_r = sides(z, theta, phi, trailer)
    suspensions = trailer.k_1 * (z_l - z_1) ** 2 + trailer.k_2 * (z_r - z_2) ** 2
    tyres = trailer.k_3 * (z_1 - u[0]) ** 2 + trailer.k_4 * (z_2 - u[1]) ** 2
    return float(suspensions + tyres + trailer.k_c * (z_1 - z_2) ** 2) / 2


def gradient(trailer: Trailer, q: Vector, u: Vector) -> Vector:
    """Return the derivatives of the energy; central differences are exact on squares."""
    pairs = [(potential(trailer, q + e, u), potential(trailer, q - e, u)) for e in np.eye(5)]
    return np.array([(up - down) / 2 for up, down in pairs])


@pytest.mark.cites("(2) to (6) of Imine")
@settings(deadline=None, max_examples=40)
@given(trailer=TRAILERS, q=MOTIONS, q_dot=MOTIONS, u=ROADS, u_dot=ROADS)
def test_forces_are_what_springs_and_dampers_give(
    trailer: Trailer, q: Vector, q_dot: Vector, u: Vector, u_dot: Vector
) -> None:
    dampers = trailer._replace(
        k_1=trailer.B_1, k_2=trailer.B_2, k_3=trailer.B_3, k_4=trailer.B_4, k_c=0.0
    )
    expected = -gradient(trailer, q, u) - gradient(dampers, q_dot, u_dot)
    found = np.array(forces(q, q_dot, u, u_dot, trailer))
    assert found == pytest.approx(expected, abs=1e-9 * trailer.k_3)


@pytest.mark.cites("(7) of Imine")
@settings(deadline=None, max_examples=40)
@given(trailer=TRAILERS)
def test_matrices_are_symmetric_and_make_no_energy(trailer: Trailer) -> None:
    for matrix in motion(trailer)[:3]:
        assert matrix == pytest.approx(matrix.T, abs=1e-12 * np.abs(matrix).max())
        assert np.linalg.eigvalsh(matrix)[0] >= -1e-9 * np.abs(matrix).max()


@pytest.mark.slow
@pytest.mark.cites("(7) of Imine")
@settings(deadline=None, max_examples=40)
@given(trailer=TRAILERS, q=MOTIONS, q_dot=MOTIONS, u=ROADS, u_dot=ROADS)
def test_matrices_hold_all_of_the_equations(
    trailer: Trailer, q: Vector, q_dot: Vector, u: Vector, u_dot: Vector
) -> None:
    M, B, K, C, D = motion(trailer)
    expected = np.array(forces(q, q_dot, u, u_dot, trailer))
    assert C @ u + D @ u_dot - B @ q_dot - K @ q == pytest.approx(expected, abs=1e-9 * trailer.k_3)
    assert np.diag(M) == pytest.approx(trailer[:5])


@settings(deadline=None, max_examples=20)
@given(trailer=TRAILERS, z=st.floats(-1, 1))
def test_a_chassis_pitched_about_the_axle_feels_no_spring(trailer: Trailer, z: float) -> None:
    free = np.array([0, 0, z, 0, z / trailer.p])
    K = motion(trailer).K
    assert K @ free == pytest.approx(np.zeros(5), abs=1e-9 * np.abs(K).max())


@pytest.mark.cites("(1) of Imine")
def test_roll_lifts_the_right_side() -> None:
    assert sides(0.1, 0.02, 0.0) == pytest.approx((0.085, 0.115))
    assert sides(0.1, 0.0, 0.05) == pytest.approx((0.07, 0.07))
