"""Alignments far from any pulse: beyond the last one, and those that the user states."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.measures.clocks.clock_alignment import Alignment, align_by_pulses


def test_far_beyond_the_pulses_it_is_told() -> None:
    own = np.arange(100.0, 200.0, 4.0) + np.tile([0.0, 0.7, 0.2, 1.1, 0.4], 5)
    found = align_by_pulses(own, own + 1.0)
    assert found.beyond(80.0, 220.0) is None
    line = found.beyond(0.0, 3600.0)
    assert line is not None
    assert "100 s before and" in line
    assert Alignment.from_offset(3.0).beyond(-1e9, 1e9) is None


def test_a_stated_offset_is_taken_as_it_is() -> None:
    stated = Alignment.from_offset(-3.25, 1e-4)
    assert stated.to_base(np.array([0.0, 10_000.0])) == pytest.approx([-3.25, 9997.75])
    assert stated.inverse().to_base(stated.to_base(np.array([5.0]))) == pytest.approx([5.0])
    with pytest.raises(InputError, match="state finite ones"):
        Alignment.from_offset(float("nan"))
