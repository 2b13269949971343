"""The page of pipelines: it names every pipeline and every setting with its default."""

import re
from fnmatch import fnmatch
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.engine.advice.by_sensors import pipelines_by_sensors
from floatref.engine.plugins import plugins
from floatref.measures import high_pass
from floatref_conformance.proving_ground import scenario_of_run, simulate

PAGE = (Path(__file__).parents[2] / "docs" / "pipelines.md").read_text(encoding="utf-8")
UNDECIDED = "the recording's", "off"
SETTING = re.compile(r"^\| `(\w+)` \| ([^|]+) \| ([^|]+) \|$", re.M)


def named(cell: str, pipelines: list[str]) -> set[str]:
    """Return the pipelines that a cell names: all, some patterns, or all but some."""
    patterns = re.findall(r"`([\w*-]+)`", cell)
    found = {name for name in pipelines if any(fnmatch(name, p) for p in patterns)}
    assert not patterns or all(any(fnmatch(name, p) for name in pipelines) for p in patterns)
    return set(pipelines) - found if cell.startswith("all") else found


def test_every_setting_of_every_pipeline_is_on_the_page_with_its_default() -> None:
    pipelines = plugins().pipelines()
    stated: dict[str, dict[str, float | None]] = {name: {} for name in pipelines}
    for setting, default, cell in SETTING.findall(PAGE):
        for name in named(cell, list(pipelines)):
            assert setting not in stated[name], (name, setting)
            stated[name][setting] = None if default in UNDECIDED else float(default)
    assert stated == {name: dict(pipeline.settings) for name, pipeline in pipelines.items()}


@pytest.mark.slow
def test_how_far_off_valid_elevation_is_in_the_picture_of_a_stop() -> None:
    place = {"slip_percent_per_g": 0.3, "laser_ahead_m": 0.0}
    simulation = simulate(scenario_of_run("sg_10.7s_0.20g", imu=False, gnss=False, **place))
    found = {}
    for name in ("temporal-basic", "temporal-adaptive-hpf-spatial-backward"):
        profile = floatref.process(simulation.recording, name)
        track, place = profile.track("left"), round(262.0 / profile.interval_m)
        true = high_pass(simulation.truth.track("left").elevation, profile.interval_m)
        error = np.abs(track.elevation - true[: track.elevation.size])
        assert track.valid[place]
        found[name] = error[place], error[track.valid].max()
        flagged = place + int(np.argmin(track.valid[place:]))
        if name == "temporal-basic":
            assert flagged * profile.interval_m - 262.0 == pytest.approx(5.0, abs=0.5)
    assert f"is {found['temporal-basic'][0]:.1f} m off at 262 m" in PAGE
    worst = found["temporal-adaptive-hpf-spatial-backward"][1]
    assert f"valid points are off by up to {1000.0 * worst:.0f} mm" in PAGE


def test_every_pipeline_has_a_row_with_the_section_of_its_summary() -> None:
    rows = dict(re.findall(r"^\| `([\w-]+)` \| ([56]\.[\d.]+|beyond) \|", PAGE, re.M))
    assert rows.keys() == plugins().pipelines().keys()
    for name, section in rows.items():
        summary = plugins().pipelines()[name].summary
        assert (f"(section {section})" in summary) == (section != "beyond")


def test_the_table_by_sensors_is_what_auto_takes() -> None:
    table = PAGE.partition("| recorded | `auto` takes | at stops |\n|---|---|---|\n")[2]
    rows = table.partition("\n\n")[0].splitlines()
    answers = pipelines_by_sensors(plugins().pipelines())
    for row, answer in zip(rows, answers, strict=True):
        taken = f"`{answer.taken}`" if answer.taken else "no pipeline"
        at_stops = ("yes" if answer.through_stops else "no") if answer.taken else "–"
        assert row == f"| {answer.sensors} | {taken} | {at_stops} |"
