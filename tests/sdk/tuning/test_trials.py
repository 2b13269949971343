"""Runs put through a pipeline: each once, whatever the number of workers."""

from collections.abc import Callable

import pytest

from floatref.tuning.levels import START, TUNED, Levels
from floatref.tuning.preparation import check_pipeline, prepare
from floatref.tuning.run_scores import HOPELESS
from floatref.tuning.trials import Trials
from floatref_conformance.proving_ground.simulate import Simulation

PIPELINE = "kalman-smoother-reflection"


@pytest.fixture
def trials(driven: Callable[..., Simulation], given: dict[str, float]) -> Callable[[], Trials]:
    runs = {name: driven(name) for name in ("fast", "stop")}
    recordings = {name: run.recording for name, run in runs.items()}
    prepared = prepare(recordings, runs["fast"].truth, PIPELINE, given)
    numbers = check_pipeline(PIPELINE, given)
    levels = Levels.of(numbers, check_pipeline(PIPELINE, {}))
    return lambda: Trials(PIPELINE, given, levels, prepared.runs)


@pytest.mark.slow
def test_every_profile_is_made_once_and_told(trials: Callable[[], Trials]) -> None:
    counts: list[int] = []
    made = trials()
    made.done = counts.append
    first = made.losses(START, ["fast"])
    assert made.losses(START, ["fast", "stop"])["fast"] == first["fast"]
    made.losses((0, -2, 0, 0), ["stop"])
    assert counts == [1, 2, 3]
    assert (made.profiles, made.combinations) == (3, 2)


@pytest.mark.slow
def test_workers_change_nothing(trials: Callable[[], Trials]) -> None:
    point = (0, -8, 0, 0)
    with trials().open_workers() as several:
        found = several.losses(point, ["stop", "fast"])
    assert list(found) == ["stop", "fast"]
    assert found == trials().losses(point, ["stop", "fast"])


@pytest.mark.slow
def test_a_smaller_walk_is_better_than_one_far_too_large(trials: Callable[[], Trials]) -> None:
    made = trials()
    before, after = (made.losses(p, ["stop"])["stop"] for p in (START, (0, -20, 0, 0)))
    assert max(after) < 0.5 * min(before)


def test_values_that_give_no_profile_are_hopeless(trials: Callable[[], Trials]) -> None:
    scores = trials().scores({TUNED[0]: 0.0}, ["fast"])
    assert scores["fast"] == (HOPELESS, HOPELESS)
