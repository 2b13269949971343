"""The transcribed runs: each brakes over the stretch that its own figures say."""

import re

import pytest

from floatref_reference.chapter_5.section_5_2 import TABLE_5_1, TABLE_5_2, braking_distance


@pytest.mark.cites("Table 5.1")
@pytest.mark.parametrize("run", TABLE_5_1, ids=lambda run: run.designation)
def test_a_stop_is_called_after_its_figures(run) -> None:
    duration, deceleration = map(float, re.findall(r"\d+\.\d+", run.designation))
    assert run.duration == pytest.approx(duration, abs=0.05)
    assert run.deceleration == pytest.approx(deceleration, abs=0.0051)


@pytest.mark.cites("Table 5.2")
@pytest.mark.parametrize("run", TABLE_5_2, ids=lambda run: run.designation)
def test_a_brake_is_called_after_its_figures(run) -> None:
    v_0, v_1, deceleration = map(float, re.findall(r"\d+(?:\.\d+)?", run.designation))
    assert (run.v_0, run.v_1) == pytest.approx((v_0, v_1), abs=0.51)
    assert run.deceleration == pytest.approx(deceleration, abs=0.0051)


@pytest.mark.cites("Table 5.2")
def test_the_run_of_figure_5_2_brakes_from_176_4_to_218_6_m() -> None:
    run = next(run for run in TABLE_5_2 if run.location == 218.6)
    assert float(braking_distance(run)) == pytest.approx(218.6 - 176.4, rel=0.01)
