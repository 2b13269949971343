"""Without a name the best pipeline is taken that accepts the recording, and its record says so."""

from dataclasses import replace

import numpy as np
import pytest

import floatref
from floatref import InputError
from floatref.engine import automatic
from floatref.engine.automatic import resolve_named_or_best, run_named_or_best
from floatref.engine.choosing import AUTO, Choice
from floatref.engine.plugins import plugins
from floatref.engine.run import run


def test_the_profile_is_that_of_the_pipeline_taken_and_says_why(steady):
    taken, named = floatref.process(steady()), floatref.process(steady(), "road-prior-smoother")
    assert taken.pipeline == "road-prior-smoother"
    np.testing.assert_array_equal(taken.tracks[0].elevation, named.tracks[0].elevation)
    assert taken.provenance["chosen"]["by"] == AUTO
    assert "height sensor" in taken.provenance["chosen"]["reason"]
    assert "chosen" not in named.provenance


def test_a_better_pipeline_that_refuses_is_named_in_a_warning(steady, monkeypatch):
    """As one whose GNSS is never fixed."""
    choices = Choice("kalman-smoother-reflection", "all"), Choice("temporal-basic", "some")
    monkeypatch.setattr(automatic, "choices_for", lambda recording, known: choices)
    result = run_named_or_best(steady())
    assert result.profile.pipeline == "temporal-basic"
    assert result.profile.provenance["chosen"]["reason"] == "some"
    line = result.warnings[0]
    assert line.startswith("pipeline kalman-smoother-reflection: not taken; ")
    assert "roll_rate" in line


def test_the_refusal_of_the_last_is_that_of_all(steady):
    recording = steady()
    worn = tuple(
        replace(c, values=np.full(c.values.size, np.nan)) if c.id.name == "height" else c
        for c in recording.channels
    )
    damaged = replace(recording, channels=worn)
    with pytest.raises(InputError) as alone:
        run(damaged, "road-prior-smoother")
    with pytest.raises(InputError) as chosen:
        run_named_or_best(damaged)
    assert str(chosen.value) == str(alone.value)


@pytest.mark.parametrize("setting", ["no", "suppression_speed_mps"])
def test_a_setting_that_no_pipeline_of_auto_has_is_refused_before_any_work(setting):
    with pytest.raises(InputError, match=f"settings {setting}: no pipeline of `auto`"):
        resolve_named_or_best(AUTO, {setting: 1.0})


def test_settings_are_those_of_every_pipeline_that_has_them():
    assert set(resolve_named_or_best(AUTO, {"road_reach_m": 200.0})) == {"road-prior-smoother"}
    named = resolve_named_or_best("temporal-basic", {})
    assert named == plugins().pipeline("temporal-basic").resolve({})


def test_a_pipeline_that_lacks_a_setting_is_passed_over(steady, monkeypatch):
    choices = Choice("kalman-smoother-reflection", "all"), Choice("temporal-basic", "some")
    monkeypatch.setattr(automatic, "choices_for", lambda recording, known: choices)
    result = run_named_or_best(steady(), settings={"slow_mps": 4.0})
    assert result.profile.pipeline == "temporal-basic"
    assert not any("not taken" in line for line in result.warnings)


def test_a_setting_is_no_fault_of_the_recording(steady, monkeypatch):
    choices = Choice("kalman-smoother-reflection", "all"), Choice("temporal-basic", "some")
    monkeypatch.setattr(automatic, "choices_for", lambda recording, known: choices)
    with pytest.raises(InputError, match="kalman-smoother-reflection has no such setting"):
        run_named_or_best(steady(), settings={"slow_mps": 4.0, "no": 1.0})
