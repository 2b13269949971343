"""Drawn recordings: braking to a stop, standing, setting off, with laser samples missing."""

from collections.abc import Callable

import numpy as np
import pytest

from floatref_reference.road_prior.symbols import Recorded, recorded

Draw = Callable[..., Recorded]


@pytest.fixture(scope="session")
def drawn() -> Draw:
    """Return what draws a recording; its last third but one is a stop."""

    def draw(
        seed: int,
        n: int = 1,
        J: int = 1,
        N: int = 30,
        dt: float = 0.02,
        share: float = 0.7,
        shared: bool = True,
    ) -> Recorded:
        rng = np.random.default_rng(seed)
        t = np.cumsum(dt * rng.uniform(0.5, 1.5, N))
        moving = (np.arange(N) < N // 3) | (np.arange(N) >= 2 * N // 3)
        distance = np.cumsum(moving * rng.uniform(0, 10 * dt, N))
        h = 0.3 + 0.005 * np.cumsum(rng.normal(size=(n, N)), axis=1)
        h[rng.uniform(size=(n, N)) > share] = np.nan
        u, a_x = rng.normal(size=(n, N, J)), rng.normal(size=N)
        return recorded(t, distance, rng.normal(size=(n, N)), h, u, a_x, shared)

    return draw
