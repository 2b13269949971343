"""Sensitivity: every setting is changed alone, and the worst run is told."""

from collections.abc import Callable

import pytest

from floatref.tuning.levels import Levels
from floatref.tuning.preparation import check_pipeline, prepare
from floatref.tuning.run_scores import Score
from floatref.tuning.sensitivity import FACTORS, Sensitivity, sensitivities
from floatref.tuning.trials import Trials
from floatref_conformance.proving_ground.simulate import Simulation

PIPELINE = "kalman-smoother-reflection"


def scored(*losses: float) -> tuple[Score, ...]:
    return tuple(Score(1.0 - loss) for loss in losses)


def test_the_largest_rise_is_that_above_the_value_itself() -> None:
    found = Sensitivity(
        "acceleration_walk",
        1.0,
        {
            FACTORS[0]: {"a": scored(0.1, 0.3), "b": scored(0.5, 0.5)},
            1.0: {"a": scored(0.2, 0.4), "b": scored(0.3, 0.3)},
            FACTORS[2]: {"a": scored(0.4, 0.6), "b": scored(0.1, 0.1)},
        },
    )
    assert found.losses("a") == pytest.approx([0.2, 0.3, 0.5])
    assert found.mean_losses == pytest.approx([0.35, 0.3, 0.3])
    rise, run = found.worst
    assert rise == pytest.approx(0.2)
    assert run in ("a", "b")


def test_a_value_that_is_best_has_no_rise_below_zero() -> None:
    scores = {factor: {"a": scored(0.3 if factor == 1.0 else 0.2)} for factor in FACTORS}
    assert Sensitivity("acceleration_walk", 1.0, scores).worst == (0.0, "a")


@pytest.mark.slow
def test_one_setting_is_changed_at_a_time_by_half_an_octave(
    driven: Callable[..., Simulation], given: dict[str, float]
) -> None:
    fast, stop = driven("fast"), driven("stop")
    recordings = {"fast": fast.recording, "stop": stop.recording}
    prepared = prepare(recordings, fast.truth, PIPELINE, given)
    usual = check_pipeline(PIPELINE, {})
    levels = Levels.of(check_pipeline(PIPELINE, given), usual)
    trials = Trials(PIPELINE, given, levels, prepared.runs)
    chosen = {"acceleration_walk": 0.02, "acceleration_density": 5e-5}
    values = {"acceleration_walk": 0.5, "gnss_height_sigma_m": 0.012, "anti_alias_hz": 1000.0}
    walk, height = sensitivities(trials, values, chosen, ["stop"])
    assert (walk.setting, walk.value) == ("acceleration_walk", 0.02)
    assert (height.setting, height.value) == ("gnss_height_sigma_m", 0.012)
    alone = {
        walk.setting: {**chosen, walk.setting: 0.02828},
        height.setting: {**chosen, height.setting: 0.01697},
    }
    for item in (walk, height):
        assert item.scores[1.0] == trials.scores(chosen, ["stop"])
        assert item.scores[FACTORS[2]] == trials.scores(alone[item.setting], ["stop"])
        assert item.scores[FACTORS[2]] != item.scores[1.0]
    assert trials.profiles == 5
