"""The smoother of one wheel path with a fixed lag: a part comes out when so much lies behind it.

The run is divided into sections of half a lag. When the third of three has ended, the first comes
out, smoothed by all that is known by then. What has come out stays: with D the height and D' the
slope along the road by which the next part, smoothed later, would leave it at the joint, that part
is moved by (D + (D' + D/L) ξ) e^{-ξ/L} at the travel ξ behind the joint. It begins where the one
before ended, with its slope, and the step goes over far more travel than any wave that the
high-pass filter of a profile lets through.

A standstill takes no room, and no part of the lag: its nodes, which bring no point, count as one.

The smoother itself is in the form of Bryson and Frazier, which inverts no covariance, so that it
can be run in extended precision.
"""

from collections.abc import Sequence
from math import exp
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.road_prior import model
from floatref_reference.road_prior.lag_sections import Sections
from floatref_reference.road_prior.symbols import Constants, Matrix, Recorded, Vector

L_M = 500.0
HALF_SECOND = 0.5
SLOWEST = 1.0


class Step(NamedTuple):
    """What the filter leaves of one sample.

    Equation:
        x̂_{k|k} and P_{k|k}, F from k - 1 to k, the gain K, and the innovation ν and 1/S; these
        three are 0 where no height was read

    Attributes:
        x: shape (ns,).
        P: shape (ns, ns).
        F: shape (ns, ns); the identity at the first sample.
        K: shape (ns,).
        nu: m.
        information: 1/m².
    """

    x: Matrix
    P: Matrix
    F: Matrix
    K: Matrix
    nu: float
    information: float


def forward(run: Recorded, c: Constants, kind: npt.DTypeLike = np.float64) -> list[Step]:
    """Run the Kalman filter of one wheel path, each number of the precision ``kind``.

    Equation:
        (6.5) with F, g and Q of `model`, then for h = r - z + n: ν = h - H x̂, S = H P Hᵀ + σ_h²,
        K = P Hᵀ/S, x̂ ← x̂ + K ν and P ← (I - K H) P (I - K H)ᵀ + K σ_h² Kᵀ

    Args:
        run: the recording of one wheel path.
        c: constants.
        kind: type of the numbers.

    Returns:
        What the filter leaves of each of the N samples.
    """
    ns = model.states(run)
    H, x = model.observation(run).astype(kind)[0], np.zeros(ns, kind)
    P, eye = model.prior(run, c).astype(kind), np.eye(ns, dtype=kind)
    variance = np.asarray(c.sigma_h, kind) ** 2
    steps = []
    for k in range(len(run.t)):
        F = eye
        if k > 0:
            F = model.transition(run, k - 1, c).astype(kind)
            x = F @ x + model.known_input(run, k - 1).astype(kind)
            P = F @ P @ F.T + model.process_noise(run, k - 1, c).astype(kind)
        K, nu, information = np.zeros(ns, kind), 0.0, 0.0
        if not np.isnan(run.h[0, k]):
            S = H @ P @ H + variance
            K, nu, information = P @ H / S, run.h[0, k] - H @ x, 1 / S
            rest = eye - np.outer(K, H)
            x, P = x + K * nu, rest @ P @ rest.T + variance * np.outer(K, K)
        steps.append(Step(x, P, F, K, nu, information))
    return steps


def backward(steps: Sequence[Step], H: Vector) -> Matrix:
    """Smooth all samples by those up to the last.

    Equation:
        x̂_{k|N} = x̂ - P λ, with λ = 0 behind the last sample; before a reading
        λ ← (I - K H)ᵀ λ - Hᵀ ν/S, before a step λ ← Fᵀ λ. It is (6.17) without P_{k+1|k}⁻¹.

    Args:
        steps: what the filter left of them.
        H: how a height shows the state, shape (ns,).

    Returns:
        x̂_{k|N}, shape (N, ns).
    """
    found, adjoint = [], np.zeros_like(steps[-1].x)
    for step in reversed(steps):
        found.append(step.x - step.P @ adjoint)
        if step.information > 0:
            adjoint = adjoint - H * (step.K @ adjoint) - H * (step.nu * step.information)
        adjoint = step.F.T @ adjoint
    return np.array(found[::-1])


def speed(run: Recorded, composed: Sequence[bool], k: int, first: int) -> float:
    """Compute the speed at a joint.

    Equation:
        V = ΔX/Δt over the last half second up to k, within the section and since a standstill

    Args:
        run: the recording.
        composed: as in `Sections`.
        k: sample of the joint.
        first: first sample of the section that ends there.

    Returns:
        V, m/s, and 0 below 1 m/s, where a rate in time is no slope along the road.
    """
    j = k
    while j > first and not composed[j] and run.t[k] - run.t[j] < HALF_SECOND - 1e-9:
        j -= 1
    if j == k:
        return 0.0
    v = float((run.distance[k] - run.distance[j]) / (run.t[k] - run.t[j]))
    return v if v >= SLOWEST else 0.0


def fading(gap: float, slope: float, xi: float) -> float:
    """Compute by how much a part is moved.

    Equation:
        (D + (D' + D/L) ξ) e^{-ξ/L}: D at ξ = 0, where its slope is D'

    Args:
        gap: D, m.
        slope: D'.
        xi: ξ, m.

    Returns:
        The shift, m.
    """
    return (gap + (slope + gap / L_M) * xi) * exp(-xi / L_M)


class Joint(NamedTuple):
    """Where a part has ended.

    Equation:
        r and its rate as they have come out, and V

    Attributes:
        at: its last sample; -1 before the first part.
        height: m.
        rate: m/s.
        speed: m/s.
    """

    at: int
    height: float
    rate: float
    speed: float


def moved(run: Recorded, joint: Joint, x: Matrix, k: int) -> tuple[float, float]:
    """Compute by how much a sample of a part is moved.

    Equation:
        `fading` with D = r - r̂ and D' = (r' - v̂)/V at the joint, and its slope along the road

    Args:
        run: the recording.
        joint: where the part before has ended.
        x: states as they are known now, shape (N, ns).
        k: sample.

    Returns:
        The shift, m, and its slope.
    """
    if joint.at < 0:
        return 0.0, 0.0
    gap, xi = joint.height - float(x[joint.at, 0]), float(run.distance[k] - run.distance[joint.at])
    slope = (joint.rate - float(x[joint.at, 1])) / joint.speed if joint.speed > 0 else 0.0
    of_line = slope + gap / L_M
    return fading(gap, slope, xi), (of_line - (gap + of_line * xi) / L_M) * exp(-xi / L_M)


def fixed_lag(
    run: Recorded, c: Constants, sections: Sections, kind: npt.DTypeLike = np.float64
) -> Vector:
    """Give out the height of one wheel path part by part.

    Equation:
        Samples up to end j are smoothed by those up to end j + 2, the last ones by all, and moved
        by `moved`

    Args:
        run: the recording of one wheel path.
        c: constants.
        sections: how it is divided.
        kind: type of the numbers.

    Returns:
        r, m, shape (N,).
    """
    steps, H = forward(run, c, kind), model.observation(run)[0].astype(kind)
    height, joint, last = np.zeros(len(steps), kind), Joint(-1, 0.0, 0.0, 0.0), len(steps) - 1
    parts = [*zip(sections.ends, sections.ends[2:], strict=False), (last, last)]
    for end, known in parts:
        x = backward(steps[: known + 1], H)
        for k in range(joint.at + 1, end + 1):
            height[k] = x[k, 0] + moved(run, joint, x, k)[0]
        v = speed(run, sections.composed, end, joint.at + 1)
        rate = float(x[end, 1]) + moved(run, joint, x, end)[1] * v
        joint = Joint(end, float(height[end]), rate, v)
    return height
