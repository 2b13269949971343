"""The values that are tried lie half an octave apart, and reach the pipeline's own."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.builtin_pipelines.chapter_6 import KALMAN
from floatref.tuning.levels import FIXED, START, TUNED, UNITS, Levels, move

USUAL = dict.fromkeys(TUNED, 1e-4)
starts = st.fixed_dictionaries({name: st.floats(1e-9, 1e3) for name in TUNED})


@settings(deadline=None, max_examples=30)
@given(starts, st.integers(0, 3), st.integers(-12, 12))
def test_two_steps_double_a_value_and_leave_the_others(
    start: dict[str, float], which: int, step: int
) -> None:
    levels = Levels.of(start, USUAL)
    found = levels.settings(move(START, which, step))
    twice = levels.settings(move(START, which, step + 2))
    name = TUNED[which]
    assert twice[name] == pytest.approx(2.0 * found[name], rel=1e-3) or step in (0, -2)
    assert found[name] == pytest.approx(start[name] * 2.0 ** (step / 2), rel=1e-3)
    assert all(found[other] == start[other] for other in TUNED if other != name)


@settings(deadline=None, max_examples=30)
@given(starts)
def test_the_start_is_kept_to_the_last_digit(start: dict[str, float]) -> None:
    assert Levels.of(start, USUAL).settings(START) == start


@settings(deadline=None, max_examples=30)
@given(starts)
def test_the_usual_value_is_in_reach_unless_twenty_octaves_away(start: dict[str, float]) -> None:
    levels = Levels.of(start, USUAL)
    ends = zip(levels.lowest, levels.highest, strict=True)
    for which, (name, (low, high)) in enumerate(zip(TUNED, ends, strict=True)):
        assert -40 <= low < 0 < high <= 40
        bottom, top = (levels.settings(move(START, which, step))[name] for step in (low, high))
        assert top >= min(60.0 * USUAL[name], 1e6 * start[name])
        assert bottom <= max(USUAL[name] / 3.9, start[name] / 1e6)
        assert bottom <= start[name] / 3.9


def test_every_setting_belongs_to_the_kalman_pipelines_and_has_a_unit() -> None:
    for pipeline in KALMAN:
        assert {*TUNED, *FIXED} <= set(pipeline.settings)
    assert set(UNITS) == {*TUNED, *FIXED}
    assert len(UNITS) == 11
