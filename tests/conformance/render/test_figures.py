"""What is drawn of flagged stretches."""

import numpy as np
import pytest

from floatref_conformance.render.figures import stretches


@pytest.mark.parametrize("size", [1, 7, 760, 5000])
def test_flagged_stretches_hold_every_flagged_point(size):
    flags = np.random.default_rng(size).random(size) < 0.05
    flags[-1] = True
    distance = np.arange(size, dtype=float)
    found = stretches(distance, flags, 100)
    held = np.zeros(size, dtype=bool)
    for start, end in found:
        held |= (distance >= start) & (distance <= end)
    assert held[flags].all()
    assert len(found) <= 100
    if size <= 100:
        assert (held == flags).all()
