"""`floatref allan`: what it recommends, writes and draws."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from matplotlib.image import imread

from floatref.cli.allan.allan_report import SETTINGS
from floatref.cli.main import main
from floatref.engine.plugins import plugins
from floatref.values.channels import ChannelId
from floatref.values.recording import Channel

Runs = Callable[..., Result]
Reports = Callable[..., dict[str, Any]]
Refusals = Callable[..., str]


def coefficient(channel: dict[str, Any], name: str) -> dict[str, Any]:
    return next(c for c in channel["coefficients"] if c["name"] == name)


def test_densities_are_those_that_were_drawn_and_the_noisiest_track_counts(
    still: Path, densities: dict[str, float], report: Reports
) -> None:
    found = report(still)
    assert found["warnings"] == []
    settings = found["settings"]
    assert set(settings) == set(densities)
    for name, density in densities.items():
        rel = 0.35 if name == "roll_rate_walk" else 0.06
        assert settings[name] == pytest.approx(density, rel=rel), name


def test_json_holds_curve_coefficients_and_bounds(still: Path, report: Reports) -> None:
    channels = {(c["name"], c["track"]): c for c in report(still)["channels"]}
    assert list(channels) == [
        ("roll_rate", None),
        ("pitch_rate", None),
        ("yaw_rate", None),
        ("vertical_specific_force", "left"),
        ("vertical_specific_force", "right"),
        ("gnss_height", None),
    ]
    left = channels["vertical_specific_force", "left"]
    assert left["unit"] == "m/s^2"
    assert (left["begin_s"], left["end_s"], left["samples"]) == (0.0, 359.99, 36_000)
    assert left["standard_deviation"] == pytest.approx(5e-4, rel=0.02)
    assert left["cluster_s"][0] == left["interval_s"] == pytest.approx(0.01)
    assert left["deviation"][0] == pytest.approx(5e-4, rel=0.02)
    assert len(left["cluster_s"]) == len(left["deviation"]) == len(left["fitted_deviation"])
    density, walk = (coefficient(left, name) for name in ("white_noise", "random_walk"))
    assert density["unit"] == "m/s²/√Hz"
    assert density["value"] == pytest.approx(5e-5, rel=0.06)
    assert 0.0 < density["uncertainty"] < 3e-6
    assert density["below"] is None
    assert density["largest_from_s"] == left["fitted_from_s"]
    assert (walk["value"], walk["uncertainty"], walk["unit"]) == (None, None, "m/s²/√s")
    # As large as this it would be the larger term from a fifth of the longest cluster on.
    assert 0.0 < walk["below"] < np.sqrt(3.0) * 5e-5 / 24.0


def test_tables_give_both_units_and_settings(
    still: Path, channels: dict[ChannelId, Channel], run: Runs
) -> None:
    text = run(still, "--channel", "pitch_rate").stdout
    assert "\x1b" not in text
    spread = channels[ChannelId("pitch_rate")].values.std()
    assert text.startswith(f"pitch_rate: 0 s to 359.98 s at 50 Hz, σ {spread:.3g} rad/s, curve off")
    assert "Settings of the Kalman pipelines" in text
    rows = [line.split() for line in text.splitlines()]
    (density,) = [row for row in rows if row[:2] == ["white", "noise"]]
    value, customary = float(density[2]), float(density[-4])
    assert value == pytest.approx(2.8e-5, rel=0.06)
    assert density[-3] == "deg/√h"
    # 1 rad/√s is 180/π · 60 deg/√h.
    assert customary == pytest.approx(value * 180.0 / np.pi * 60.0, rel=0.01)
    (bound,) = [row for row in rows if row[:3] == ["random", "walk", "<"]]
    assert float(bound[3]) > 0
    assert ["pitch_rate_walk", "–", "not", "seen,", "or", "off", "the", "curve"] in rows


BASIC = "--pipeline", "temporal-basic"


def test_settings_are_written_as_process_reads_them(
    still: Path, tmp_path: Path, report: Reports, refused: Refusals
) -> None:
    target = tmp_path / "noise.json"
    found = report(still, "--settings", target)
    assert json.loads(target.read_text(encoding="utf-8")) == found["settings"]
    outcome = CliRunner().invoke(
        main,
        ["process", str(still), "--out", str(tmp_path / "p"), "--settings", str(target), *BASIC],
    )
    # The basic pipeline has no such setting, and says so by name: the file was read.
    assert "acceleration_density" in outcome.stderr
    assert "exists" in refused(still, "--settings", target)


def test_every_setting_is_one_of_the_kalman_pipelines() -> None:
    known = [p for name, p in plugins().pipelines().items() if name.startswith("kalman-")]
    assert known
    for pipeline in known:
        assert set(SETTINGS) <= set(pipeline.settings)


@pytest.mark.slow
def test_the_plot_is_a_picture(still: Path, tmp_path: Path, run: Runs) -> None:
    assert run(still, "--plot", tmp_path / "a.png").exit_code == 0
    assert imread(tmp_path / "a.png").shape[0] > 800


@pytest.mark.parametrize("name", ["roll_rate", "left.vertical_specific_force"])
def test_one_channel_alone(still: Path, name: str, report: Reports) -> None:
    (channel,) = report(still, "--channel", name)["channels"]
    track = f"{channel['track']}." if channel["track"] else ""
    assert f"{track}{channel['name']}" == name


def test_a_name_without_track_is_that_of_all(still: Path, report: Reports) -> None:
    found = report(still, "--channel", "vertical_specific_force", "--channel", "yaw_rate")
    assert len(found["channels"]) == 3


def test_the_fit_keeps_to_the_times_asked_for(still: Path, report: Reports) -> None:
    for channel in report(still, "--between", 1, 20)["channels"]:
        assert 1.0 <= channel["fitted_from_s"] < channel["fitted_to_s"] <= 20.0


def test_a_failed_plot_leaves_no_settings(
    still: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, refused: Refusals
) -> None:
    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("floatref.plots.draw_allan", fail)
    arguments = ("--plot", tmp_path / "a.png", "--settings", tmp_path / "a.json")
    assert "No space left" in refused(still, *arguments)
    assert [entry.name for entry in tmp_path.iterdir()] == ["still"]


@pytest.mark.slow
def test_progress_is_shown_on_a_terminal_only(
    still: Path, monkeypatch: pytest.MonkeyPatch, run: Runs
) -> None:
    assert "Averaging" not in run(still).output
    # rich takes this for a terminal.
    monkeypatch.setenv("FORCE_COLOR", "1")
    shown = run(still)
    assert "Averaging" in shown.stderr
    assert "Averaging" not in shown.stdout
    assert "Averaging" not in run(still, "--json").output
