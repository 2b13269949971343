"""Time a step of the joint input-state filter against Kalman filters on the same matrices.

Zhu's half car at 200 Hz: 10 states, 2 unknown forces, 15 readings. Peers are steps (a)-(c) in
plain numpy, as a reader of the paper writes them, and, where filterpy is installed, its Kalman
filter with the forces as two more states (12): it estimates the same, told how the forces walk.
Prints medians and ratios; below 1 is faster than the peer. Run as
``python tests/benchmarks/bench_joint_filter.py [samples]``; requirements-kalman.txt has the peer.
"""

import sys

import numpy as np
from timing import in_turns, ratio

from floatref.vehicle_response import ZHU_HALF_CAR, Hold, Kind, Reading
from floatref.vehicle_response.estimators.disturbance import hold_error_of
from floatref.vehicle_response.estimators.joint_filter import JointInputState

STEP_S = 0.005


def filter_of_all() -> JointInputState:
    """Return the filter with every acceleration, velocity and displacement measured."""
    model = ZHU_HALF_CAR.model()
    sizes = {Kind.ACCELERATION: 0.5, Kind.VELOCITY: 0.01, Kind.DISPLACEMENT: 1e-3}
    readings = [Reading(kind, f.name, s) for kind, s in sizes.items() for f in model.freedoms]
    noise = hold_error_of(model, STEP_S, 10.0, "E") + 1e-12 * np.eye(10)
    return JointInputState.of(model, readings, STEP_S, noise, np.full(10, 5e-5), Hold.ZERO_ORDER)


def plain(rule: JointInputState, samples: np.ndarray) -> np.ndarray:
    """Return the forces by steps (a)-(c) of Zhu with the inverses of the print."""
    s = rule.system
    a, b, g, j, r = s.transition, s.influence, s.output, s.feedthrough, np.diag(s.variance)
    x, p, forces = np.zeros(len(a)), rule.initial, []
    for z in samples:
        tilde = np.linalg.inv(g @ p @ g.T + r)
        spread = np.linalg.inv(j.T @ tilde @ j)
        f = spread @ j.T @ tilde @ (z - g @ x)
        gain = p @ g.T @ tilde
        x = x + gain @ (z - g @ x - j @ f)
        p = p - gain @ (np.linalg.inv(tilde) - j @ spread @ j.T) @ gain.T
        crossed = -gain @ j @ spread
        forces.append(f)
        both = np.hstack([a, b])
        joint = np.block([[p, crossed], [crossed.T, spread]])
        p = both @ joint @ both.T + s.disturbance
        x, p = a @ x + b @ f, 0.5 * (p + p.T)
    return np.array(forces)


def augmented(rule: JointInputState, samples: np.ndarray) -> np.ndarray:
    """Return the forces by filterpy's Kalman filter, as states that walk."""
    from filterpy.kalman import KalmanFilter

    s = rule.system
    size, inputs = s.influence.shape
    kalman = KalmanFilter(dim_x=size + inputs, dim_z=len(s.variance))
    kalman.F = np.block([[s.transition, s.influence], [np.zeros((inputs, size)), np.eye(inputs)]])
    kalman.H, kalman.R = np.hstack([s.output, s.feedthrough]), np.diag(s.variance)
    kalman.P = np.diag([*np.diag(rule.initial), *[1e10] * inputs])
    kalman.Q = np.diag([*np.diag(s.disturbance), *[1e8] * inputs])
    forces = []
    for z in samples:
        kalman.update(z)
        forces.append(kalman.x[size:, 0].copy())
        kalman.predict()
    return np.array(forces)


def main(count: int) -> None:
    """Report the time of a step and the ratios to the peers."""
    rule, rng = filter_of_all(), np.random.default_rng(0)
    samples = np.sqrt(rule.system.variance) * rng.standard_normal((count, len(rule.readings)))
    error = np.abs(rule.estimate(samples).force - plain(rule, samples)).max()
    print(f"joint input-state filter, 10 states, 2 forces, 15 readings, {count} samples")
    print(f"  forces differ by at most {error:.1e} N from those of steps (a)-(c) in numpy")
    peers = {"numpy, steps (a)-(c)": lambda: plain(rule, samples)}
    try:
        import filterpy  # noqa: F401  # To see whether it is there.

        peers["filterpy, forces as states"] = lambda: augmented(rule, samples)
    except ImportError:
        print("  filterpy is not installed")
    ours, *others = in_turns(lambda: rule.estimate(samples), *peers.values())
    print(f"  {'floatref':28} {np.median(ours) / count * 1e9:9.0f} ns/step")
    for name, times in zip(peers, others, strict=True):
        each = np.median(times) / count * 1e9
        print(f"  {name:28} {each:9.0f} ns/step   ratio {ratio(ours, times):.3f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 4000)
