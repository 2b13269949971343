"""Single precision over a long run: what the float build may be off, beside the double build."""

import numpy as np
import pytest

from floatref.measures import iri

RATE, COUNT_M, INTERVAL, SPEED = 4000.0, 0.001, 0.05, 25.0


def signals(metres):
    """Return force, height and counts: a rough road, a body that swings, noise of a laser."""
    rng = np.random.default_rng(7)
    t = np.arange(round(metres / SPEED * RATE)) / RATE
    x = SPEED * t
    road = sum(
        a * np.sin(2 * np.pi * x / length + phase)
        for length, a, phase in ((60, 0.05, 0), (15, 0.01, 1), (3, 0.002, 2), (0.7, 3e-4, 3))
    )
    body = 0.01 * np.sin(2 * np.pi * 1.3 * t)
    force = 9.80665 - (2 * np.pi * 1.3) ** 2 * body + rng.normal(0.0, 0.02, t.size)
    height = 0.3 + body - road + rng.normal(0.0, 5e-5, t.size)
    return force, height, np.rint(x / COUNT_M).astype(np.int64)


def profile(library, force, height, counts):
    encoder = {"travel__rate_hz": RATE, "travel__metres_per_count": COUNT_M}
    made = library.make("adaptive", interval_m=INTERVAL, gravity_mps2=9.80665, **encoder)
    room = 1 + round(counts[-1] * COUNT_M / INTERVAL) + 9
    _, *points = made.push(force, height, counts, outputs=2, capacity=room)
    return made.push(*points, call="finish")[1].astype(float)


@pytest.mark.slow
def test_ten_kilometres_in_float_are_those_in_double(double, single):
    force, height, counts = signals(10_000.0)
    # Both get what a float can hold, as from a converter; the rounding of the input is not theirs.
    rounded = force.astype(np.float32), height.astype(np.float32)
    mine, theirs = (profile(library, *rounded, counts) for library in (single, double))
    assert mine.size == theirs.size == 1 + np.floor(counts[-1] * COUNT_M / INTERVAL + 1e-6)
    assert np.abs(mine - theirs).max() < 1e-5
    assert iri(mine - theirs, INTERVAL) < 1e-3
