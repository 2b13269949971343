"""A drive without noise, of which inputs, states and GPS readings agree exactly."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import pytest

from floatref_reference.chapter_6.section_6_3_6_system import f, h

Matrix = npt.NDArray[np.float64]


class Drive(NamedTuple):
    """Inputs (N, 6), states (N, 7) and readings (N, 4) at every step, and the lever arm."""

    dt: float
    u: Matrix
    x: Matrix
    y: Matrix
    lever: Matrix


@pytest.fixture(scope="session")
def drive() -> Drive:
    """Return 1.5 s of braking and swaying at 200 Hz, with drifting sensors."""
    dt, t = 1 / 200, np.arange(300) / 200
    waves = [
        np.sin(2 * np.pi * f_k * t + k) for k, f_k in enumerate([0.7, 0.4, 1.5, 1.1, 1.6, 0.3])
    ]
    u = np.array([-3.0, 0.4, 0.9, 0.08, 0.06, 0.1]) * np.array(waves).T
    u[:, 2] += 9.80665
    states = [np.array([120.0, 0.1, 0.02, -0.03, 0.04, 0.002, -0.003])]
    for u_k in u[:-1]:
        states.append(f(states[-1], u_k, dt))
    lever = np.array([0.8, -0.6, 1.9])
    x = np.array(states)
    y = np.array([h(x_k, u_k, lever) for x_k, u_k in zip(x, u, strict=True)])
    return Drive(dt, u, x, y, lever)
