"""A pipeline that is named says what of the recording it cannot measure, and which one can."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

import floatref
from floatref import InputError
from floatref.engine.automatic import run_named_or_best
from floatref.engine.plugins import plugins

RATE_HZ = 500.0
LOSES, MEASURES = "temporal-basic", "road-prior-smoother"


def speeds(slowest: float, last_s: float) -> np.ndarray:
    """Return 15 m/s for 8 s, a brake to ``slowest`` at 5 m/s² for ``last_s``, and 15 m/s again."""
    steps = np.arange(15.0, slowest, -5.0 / RATE_HZ)
    fast = np.full(int(8.0 * RATE_HZ), 15.0)
    middle = np.full(int(last_s * RATE_HZ), slowest)
    return np.concatenate([fast, steps, middle, steps[::-1], fast])


@pytest.fixture
def driven(steady):
    """Return a maker of recordings with those speeds, and the place of the slowest."""

    def make(slowest: float, last_s: float = 2.0):
        speed = speeds(slowest, last_s)
        distance = np.cumsum(speed) / RATE_HZ
        rng = np.random.default_rng(0)
        recording = steady(
            speed.size / RATE_HZ,
            RATE_HZ,
            distance=distance,
            height=0.3 + 1e-5 * rng.normal(size=speed.size),
            vertical_specific_force=9.80665 + 1e-3 * rng.normal(size=speed.size),
        )
        return recording, distance[np.argmin(speed)]

    return make


def lines_of(recording, pipeline: str) -> list[str]:
    found = run_named_or_best(recording, pipeline).warnings
    return [line for line in found if "cannot measure" in line]


def test_a_stop_is_named_with_its_place_and_who_measures_it(driven):
    recording, place = driven(0.0)
    (line,) = lines_of(recording, LOSES)
    assert line == (
        f"{LOSES} cannot measure the stop at {place:.0f} m: {MEASURES} can, with the channels of "
        "this recording"
    )


@pytest.mark.parametrize(("slowest", "number"), [(1.0, 1), (4.0, 1), (6.0, 0)])
def test_creeping_is_what_is_below_the_speed_of_its_settings(driven, slowest, number):
    recording, _ = driven(slowest)
    lines = lines_of(recording, LOSES)
    assert len(lines) == number
    assert all("cannot measure travel below 4.47 m/s from " in line for line in lines)


@pytest.mark.parametrize("pipeline", [MEASURES, "auto"])
def test_one_that_measures_stops_has_nothing_to_say(driven, pipeline):
    assert lines_of(driven(0.0)[0], pipeline) == []


def test_a_stop_that_nobody_measures_at_an_end_of_the_run_is_no_fault_of_the_pipeline(driven):
    recording, place = driven(0.0)
    (distance,) = (c.values for c in recording.channels if c.id.name == "distance")
    last = int(np.searchsorted(distance, place + 40.0))
    cut = tuple(replace(c, values=c.values[:last]) for c in recording.channels)
    assert lines_of(replace(recording, channels=cut), LOSES) == []


def test_python_warns_and_a_pipeline_that_states_nothing_is_not_judged(driven, monkeypatch):
    recording, _ = driven(0.0)
    with pytest.warns(floatref.FloatrefWarning, match="cannot measure the stop"):
        floatref.process(recording, LOSES)
    known = plugins().pipelines()
    silent = {**known, LOSES: replace(known[LOSES], through_stops=None)}
    monkeypatch.setattr(plugins(), "pipelines", lambda: silent)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        floatref.process(recording, LOSES)


def test_every_built_in_pipeline_states_whether_it_measures_stops():
    assert None not in {each.through_stops for each in plugins().pipelines().values()}


def test_a_derived_pipeline_measures_what_its_origin_does_unless_it_states_otherwise():
    origin = floatref.pipeline(LOSES)
    assert origin.with_answers(name="a", summary="").through_stops is False
    assert origin.with_answers(name="a", summary="", through_stops=True).through_stops is True


def test_a_refusal_for_a_missing_channel_names_who_needs_none(steady):
    with pytest.raises(InputError) as refused:
        run_named_or_best(steady(), "kalman-smoother")
    text = str(refused.value)
    assert "missing" in text
    assert text.endswith(f"; {MEASURES} can be taken, with the channels of this recording")


def test_a_refusal_for_another_reason_names_nobody(steady):
    with pytest.raises(InputError) as refused:
        run_named_or_best(steady(), LOSES, {"slow_mps": -1.0})
    assert MEASURES not in str(refused.value)
