"""The collector pauses in compilations, however they overlap, and is as it was after them."""

import gc

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.kernels.compilation.garbage import CollectorPause
from floatref.kernels.compiling import compiled


@given(st.lists(st.booleans(), max_size=20), st.booleans())
def test_it_runs_when_no_compilation_does(steps: list[bool], was_on: bool):
    before = gc.isenabled()
    try:
        gc.enable() if was_on else gc.disable()
        pause, running = CollectorPause(), 0
        for begins in steps:
            if begins:
                pause.begin()
            elif running:
                pause.end()
            running = max(running + (1 if begins else -1), 0)
            assert gc.isenabled() == (was_on and not running)
    finally:
        gc.enable() if before else gc.disable()


@pytest.mark.slow
def test_it_runs_after_a_compilation_that_failed():
    def add(x: float, y: str) -> float:
        return x + y  # type: ignore[operator]  # numba is to refuse it

    assert gc.isenabled()
    with pytest.raises(Exception, match="Failed in nopython mode"):
        compiled(add)(1.0, "a")
    assert gc.isenabled()
