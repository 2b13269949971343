"""What can be seen in a picture."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.image import imread


@pytest.fixture(scope="session")
def colour_share() -> Callable[[Path, str], float]:
    """Share of the picture's columns with a pixel of a colour."""

    def of(path: Path, colour: str) -> float:
        pixels = imread(path)[:, :, :3]
        same = np.abs(pixels - np.array(to_rgb(colour))).max(axis=2) < 0.02
        return float(same.any(axis=0).mean())

    return of
