"""Parameters of vehicles, drawn around plausible ones."""

from dataclasses import asdict

import numpy as np
import pytest

from floatref.response import IMINE_TRAILER, ZHU_HALF_CAR, QuarterCar

CORNER = QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3, 150.0)


@pytest.fixture(scope="session")
def drawn_parameters():
    """Return a function from a seed to drawn parameters of every model."""

    def draw(seed):
        rng = np.random.default_rng(seed)
        known = CORNER, ZHU_HALF_CAR, IMINE_TRAILER
        return [
            type(p)(**{name: v * rng.uniform(0.7, 1.4) for name, v in asdict(p).items()})
            for p in known
        ]

    return draw
