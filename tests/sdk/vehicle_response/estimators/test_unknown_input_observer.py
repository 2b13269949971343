"""The loop is its recursion, and what is absent takes the second matrices."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.vehicle_response.estimators import unknown_inputs as kernel

SIZE, WIDTH, TAPS, ROADS = 4, 3, 2, 2


def plainly(transition, taps, start, of_state, of_input, settling, inputs):
    """The recursion in numpy; NaN before the first whole sample."""
    state, held, rows = None, None, []
    left = broken = 0
    for values in inputs:
        absent = np.isnan(values).any()
        if state is None and absent:
            rows.append((np.full(SIZE, np.nan), np.full(ROADS, np.nan), False))
            continue
        if state is None:
            held = [values] * TAPS
            state, left = start @ values, settling
        else:
            broken = TAPS if absent else max(broken - 1, 0)
            left = settling if absent else max(left - 1, 0)
            held = [np.where(np.isnan(values), held[0], values), *held[:-1]]
            which = int(broken > 0)
            pushed = sum(tap @ each for tap, each in zip(taps[which], held, strict=True))
            state = transition[which] @ state + pushed
        rows.append((state, of_state @ state + of_input @ held[0], left == 0))
    return [np.array(column) for column in zip(*rows, strict=True)]


@settings(deadline=None, max_examples=40)
@given(
    seed=st.integers(0, 2**32 - 1),
    lost=st.sets(st.tuples(st.integers(0, 49), st.integers(0, WIDTH - 1)), max_size=6),
    settling=st.integers(0, 12),
)
def test_the_loop_is_the_recursion(seed, lost, settling):
    rng = np.random.default_rng(seed)
    transition = 0.2 * rng.normal(size=(2, SIZE, SIZE))
    taps = rng.normal(size=(2, TAPS, SIZE, WIDTH))
    start = rng.normal(size=(SIZE, WIDTH))
    roads = rng.normal(size=(ROADS, SIZE)), rng.normal(size=(ROADS, WIDTH))
    inputs = rng.normal(size=(50, WIDTH))
    for place in lost:
        inputs[place] = np.nan
    states, road, settled = np.empty((50, SIZE)), np.empty((50, ROADS)), np.empty(50, dtype=bool)
    memory = kernel.ObserverMemory.of(taps)
    arguments = (transition, taps, start, *roads, settling, inputs)
    kernel.observe(*arguments, memory, states, road, settled)
    for found, expected in zip((states, road, settled), plainly(*arguments), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)
