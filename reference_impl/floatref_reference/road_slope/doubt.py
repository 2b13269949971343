"""How sure the elevation is: the covariance for it, and the doubt of gain and grade."""

from math import sqrt

import numpy as np

from floatref_reference.road_slope.gauss_newton import Answer, jacobian
from floatref_reference.road_slope.held import Held
from floatref_reference.road_slope.symbols import Matrix, Stretch, Vector
from floatref_reference.road_slope.unknowns import as_vector, by_name
from floatref_reference.road_slope.wheels import road_points

BRAKES = 0.5
"""|a| in m/s² above which the vehicle brakes or drives off."""
KNOWN_REACH = 8.0
"""Metres that the points of a known second difference are apart."""
BESIDE = 2.0
"""Metres between them and the places of a brake."""


def braking(stretch: Stretch) -> list[int]:
    """Return the nodes at which the vehicle brakes or drives off.

    Equation:
        |a_k| > 0.5 m/s²

    Args:
        stretch: what is known.
    """
    return [k for k, a in enumerate(stretch.readings.along) if abs(a) > BRAKES]


def is_outside(stretch: Stretch, place: float) -> bool:
    """Tell whether a place is 2 m or more from all places of the laser where it brakes."""
    run = stretch.readings
    return all(abs(place - run.place[k]) >= BESIDE for k in braking(stretch))


def known_points(stretch: Stretch) -> list[tuple[int, int, int]]:
    """Return the points of the road whose second difference is known.

    Equation:
        j-m, j and j+m, m = round(8 m/d), all three 2 m or more outside of where |a| > 0.5 m/s²

    Args:
        stretch: what is known.
    """
    points = road_points(stretch)
    m = round(KNOWN_REACH / points.spacing)
    places = [points.first + points.spacing * j for j in range(points.number)]
    outside = [is_outside(stretch, place) for place in places]
    triples = [(j - m, j, j + m) for j in range(m, points.number - m)]
    return [triple for triple in triples if all(outside[j] for j in triple)]


def known_rows(stretch: Stretch, unknowns: int) -> Matrix:
    """Return the derivatives of what is known outside of a brake.

    Equation:
        (z_{j-m} - 2 z_j + z_{j+m})/2 mm

    Args:
        stretch: what is known.
        unknowns: M.

    Returns:
        One row for each of `known_points`, shape (n, M).
    """
    triples = known_points(stretch)
    rows = np.zeros((len(triples), unknowns))
    for row, triple in zip(rows, triples, strict=True):
        for j, factor in zip(triple, (1, -2, 1), strict=True):
            row[j] = factor / stretch.constants.known_m
    return rows


def known_covariance(vector: Vector, stretch: Stretch, held: Held) -> Matrix:
    """Return the covariance of all unknowns where the road outside of a brake is known.

    Equation:
        C = (JᵀJ)⁻¹ = R⁻¹ R⁻ᵀ, J = QR of all rows and `known_rows`

    Args:
        vector: unknowns, shape (M,).
        stretch: what is known.
        held: what is held.

    Returns:
        C, shape (M, M).
    """
    J = jacobian(vector, stretch, held)
    J = np.concatenate([J, known_rows(stretch, len(vector))])
    root = np.linalg.inv(np.linalg.qr(J, "r"))
    return np.asarray(root @ root.T)


def turning(beta: Vector, stretch: Stretch) -> float:
    """Return how much the slope under the wheels changes over a wheelbase.

    Equation:
        τ² = mean of (β_k - β(x_k - L))² over nodes with |a_k| > 0.5 m/s², β(x) linear between
        the nodes' places, the first of equal ones, and before the first place as there; 0 without
        such nodes

    Args:
        beta: β_k, shape (K,).
        stretch: what is known.

    Returns:
        τ.
    """
    x, L = stretch.readings.place, stretch.places.front - stretch.places.rear
    first: dict[float, float] = {}
    for place, slope in zip(x, beta, strict=True):
        first.setdefault(float(place), float(slope))
    places = sorted(first)
    slopes = [first[place] for place in places]
    changes = [beta[k] - np.interp(x[k] - L, places, slopes) for k in braking(stretch)]
    return sqrt(np.mean(np.square(changes))) if changes else 0.0


def gain_doubt(beta: Vector, stretch: Stretch) -> float:
    """Return the share of the gain that is not sure.

    Equation:
        ε = √(0.045² + τ²)

    Args:
        beta: β_k, shape (K,).
        stretch: what is known.
    """
    c = stretch.constants
    return sqrt(c.gain_doubt**2 + (c.turn_doubt * turning(beta, stretch)) ** 2)


def grade_doubt(covariance: Matrix, mean_slope: Vector, stretch: Stretch) -> float:
    """Return the 1-σ of the grade of the stretch that its rows do not have.

    Equation:
        ε_2 = min(8 √(e_2ᵀ C e_2), 0.016)

    Args:
        covariance: C, shape (M, M).
        mean_slope: e_2, shape (M,).
        stretch: what is known.
    """
    c = stretch.constants
    return min(c.grade_together * sqrt(mean_slope @ covariance @ mean_slope), c.grade_doubt)


def deviation(weights: Matrix, covariance: Matrix, doubted: Matrix, doubts: Vector) -> Vector:
    """Return the 1-σ of weighted sums of unknowns, as a high-pass of the road forms them.

    Equation:
        √(w_mᵀ C w_m + Σ_i (ε_i w_mᵀ C e_i/(e_iᵀ C e_i))²)

    Args:
        weights: w_m of n marks, shape (n, M).
        covariance: C, shape (M, M).
        doubted: e_i, weights of the sums in doubt, shape (p, M).
        doubts: ε_i, their 1-σ, shape (p,).

    Returns:
        Shape (n,).
    """
    sigmas = []
    for w in weights:
        variance = w @ covariance @ w
        for e, doubt in zip(doubted, doubts, strict=True):
            variance += (doubt * (w @ covariance @ e) / (e @ covariance @ e)) ** 2
        sigmas.append(np.sqrt(variance))
    return np.array(sigmas)


def in_doubt(points: int, nodes: int, unknowns: int) -> Matrix:
    """Return the weights of the gain and of the mean slope in the unknowns.

    Equation:
        e_1: 1 at κ; e_2: 1/N at each s_j

    Args:
        points: N.
        nodes: K.
        unknowns: M.

    Returns:
        Shape (2, M).
    """
    where = by_name(np.arange(unknowns), points, nodes)
    found = np.zeros((2, unknowns))
    found[0, int(where.gain)] = 1.0
    for j in where.slope:
        found[1, int(j)] = 1.0 / points
    return found


def elevation_sigma(weights: Matrix, answer: Answer, stretch: Stretch) -> Vector:
    """Return the 1-σ of the elevation that levelling adds.

    Equation:
        `deviation` with C of `known_covariance`, ε_1 = ε κ by `gain_doubt` and ε_2 by
        `grade_doubt`, at the unknowns found

    Args:
        weights: w_m of n marks, shape (n, M).
        answer: what least squares found.
        stretch: what is known.

    Returns:
        Shape (n,).
    """
    vector, x = as_vector(answer.unknowns), answer.unknowns
    C = known_covariance(vector, stretch, answer.held)
    gain = gain_doubt(answer.held.beta, stretch) * float(x.gain)
    doubted = in_doubt(len(x.slope), len(x.pitch), len(vector))
    grade = grade_doubt(C, doubted[1], stretch)
    return deviation(weights, C, doubted, np.array([gain, grade]))
