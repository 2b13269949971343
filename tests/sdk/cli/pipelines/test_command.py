"""`floatref pipelines` answers which pipeline for which sensors, and for a recording."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref import Recording
from floatref.engine.advice.by_sensors import SENSORS
from floatref.engine.choosing import BEST
from floatref.engine.plugins import plugins
from floatref.files import write_recording


def test_every_pipeline_is_listed_with_what_it_does_at_stops(reported, ran) -> None:
    known, listed = plugins().pipelines(), reported("pipelines")["pipelines"]
    assert [p["name"] for p in listed] == list(known)
    text = ran("pipelines").stdout
    for name, pipeline in known.items():
        at_stops = "yes" if pipeline.through_stops else "no"
        assert re.search(rf"^ {name} +{at_stops} +{re.escape(pipeline.summary)}$", text, re.M)


def test_the_answer_comes_first_and_is_what_auto_takes(reported, ran) -> None:
    answers = {each["sensors"]: each for each in reported("pipelines")["by_sensors"]}
    assert list(answers) == list(SENSORS)
    assert {each["taken"] for each in answers.values()} == {None, *dict(BEST)}
    text = ran("pipelines").stdout
    assert text.startswith("Which for my sensors\n")
    for sensors, each in answers.items():
        taken = each["taken"] or "no pipeline"
        assert re.search(rf"^ {re.escape(sensors)} +{taken} ", text, re.M)
        measures = plugins().pipelines()
        assert each["taken"] not in each["others"]
        assert all(measures[name].through_stops for name in each["others"])


@pytest.fixture
def stopped(steady, tmp_path: Path) -> Path:
    """Return a recording of nominal sensors that stops at 40 m."""
    brake = np.linspace(8.0, 0.0, 2000)
    speed = np.concatenate([np.full(4000, 8.0), brake, np.zeros(2000), brake[::-1]])
    write_recording(steady(10.0, distance=np.cumsum(speed) / 1000.0), tmp_path / "run")
    return tmp_path / "run"


def test_a_recording_is_answered_with_what_others_lack(stopped: Path, reported, ran) -> None:
    found = reported("pipelines", stopped)
    recording = floatref.read_recording(stopped)
    assert found["taken"] == floatref.process(recording).pipeline == "road-prior-smoother"
    assert found["stops_m"] == pytest.approx([40.0], abs=0.1)
    lacks = {each["name"]: each["lacks"] for each in found["pipelines"]}
    assert lacks["temporal-basic"] is None
    assert lacks["kalman-smoother-reflection"] == "longitudinal_specific_force"
    assert lacks["response-observer"] == "setup.vehicle"
    text = ran("pipelines", stopped).stdout
    assert f"{stopped}: auto takes road-prior-smoother, since " in text
    assert "The vehicle stops at 40 m\n" in text


@pytest.mark.parametrize("absent", ["height", "distance"])
def test_a_recording_that_no_pipeline_takes_is_no_error(
    stopped: Path, absent: str, tmp_path: Path, ran
) -> None:
    whole = floatref.read_recording(stopped)
    left = tuple(channel for channel in whole.channels if channel.id.name != absent)
    write_recording(replace(whole, channels=left), tmp_path / "less")
    text = ran("pipelines", tmp_path / "less").stdout
    assert "auto takes no pipeline" in text
    assert re.search(rf"^ temporal-basic +no +no +{absent}$", text, re.M)


def test_what_cannot_be_read_is_one_line(tmp_path: Path, refused) -> None:
    assert "give RECORDING" in refused("pipelines", "--adapter", "csv")
    assert "no: not found" in refused("pipelines", tmp_path / "no")


def test_a_pipeline_of_a_plug_in_that_states_nothing_is_shown_so(ran, monkeypatch) -> None:
    known = plugins().pipelines()
    silent = {**known, "acme": replace(known["temporal-basic"], name="acme", through_stops=None)}
    monkeypatch.setattr(plugins(), "pipelines", lambda: silent)
    assert re.search(r"^ acme +not stated ", ran("pipelines").stdout, re.M)


def test_a_recording_is_not_processed(stopped: Path, reported, monkeypatch) -> None:
    def refuse(*_: object) -> Recording:
        raise AssertionError("processed")

    monkeypatch.setattr("floatref.engine.run.run", refuse)
    assert reported("pipelines", stopped)["taken"]
