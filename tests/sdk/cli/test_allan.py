"""`floatref allan`: what it recommends, writes, draws, doubts and refuses."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from matplotlib.image import imread

from floatref.architectures.plugins import plugins
from floatref.cli.allan_report import SETTINGS
from floatref.cli.main import main
from floatref.files import write_recording
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

GYRO = {"roll_rate": 1.4e-5, "pitch_rate": 2.8e-5, "yaw_rate": 0.7e-5}
"""Densities in rad/s/√Hz."""
WALK = 1e-5
FORCE = {"left": 5e-5, "right": 8e-5}
"""Densities in m/s²/√Hz."""


def white(density: float, rate_hz: float, count: int, seed: int = 0) -> np.ndarray:
    return density * np.sqrt(rate_hz) * np.random.default_rng(seed).normal(size=count)


def still_vehicle() -> dict[ChannelId, Channel]:
    """Six minutes of gyros, of which one walks, and of the accelerometers of two wheel paths."""
    gyro, force, gnss = (UniformClock.of(x) for x in (50.0, 100.0, 10.0))
    channels = []
    for seed, (name, density) in enumerate(GYRO.items()):
        channels.append(Channel.of(name, 1e-3 + white(density, 50.0, 18_000, seed), gyro))
    steps = np.random.default_rng(7).normal(size=18_000)
    walk = WALK / np.sqrt(50.0) * np.cumsum(steps)
    channels[0] = Channel.of("roll_rate", channels[0].values + walk, gyro)
    for seed, (track, density) in enumerate(FORCE.items(), 10):
        x = STANDARD_GRAVITY + white(density, 100.0, 36_000, seed)
        channels.append(Channel.of("vertical_specific_force", x, force, track))
    channels.append(Channel.of("gnss_height", 250.0 + white(1e-3, 10.0, 3600, 20), gnss))
    channels.append(Channel.of("gnss_quality", np.full(3600, 4.0), gnss))
    channels.append(Channel.of("distance", np.zeros(36_000), force))
    return {channel.id: channel for channel in channels}


def written(folder: Path, *changed: Channel) -> Path:
    channels = still_vehicle() | {channel.id: channel for channel in changed}
    write_recording(Recording(tuple(channels.values())), folder / "still")
    return folder / "still"


@pytest.fixture
def still(tmp_path: Path) -> Path:
    return written(tmp_path)


def run(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["allan", *map(str, arguments)])


def report(*arguments: object) -> dict[str, Any]:
    result = run(*arguments, "--json")
    assert result.exit_code == 0, result.output
    return dict(json.loads(result.stdout))


def refused(*arguments: object) -> str:
    result = run(*arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1
    return result.stderr


def coefficient(channel: dict[str, Any], name: str) -> dict[str, Any]:
    return next(c for c in channel["coefficients"] if c["name"] == name)


def test_densities_are_those_that_were_drawn_and_the_noisiest_track_counts(still: Path) -> None:
    found = report(still)
    assert found["warnings"] == []
    settings = found["settings"]
    expected = {f"{name}_density": density for name, density in GYRO.items()}
    expected["acceleration_density"] = max(FORCE.values())
    for name, density in expected.items():
        assert settings[name] == pytest.approx(density, rel=0.06), name
    assert settings["roll_rate_walk"] == pytest.approx(WALK, rel=0.35)
    assert set(settings) == {*expected, "roll_rate_walk"}


def test_json_holds_curve_coefficients_and_bounds(still: Path) -> None:
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


def test_tables_give_both_units_and_settings(still: Path) -> None:
    text = run(still, "--channel", "pitch_rate").stdout
    assert "\x1b" not in text
    spread = still_vehicle()[ChannelId("pitch_rate")].values.std()
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


def test_settings_are_written_as_process_reads_them(still: Path, tmp_path: Path) -> None:
    target = tmp_path / "noise.json"
    found = report(still, "--settings", target)
    assert json.loads(target.read_text(encoding="utf-8")) == found["settings"]
    outcome = CliRunner().invoke(
        main,
        ["process", str(still), "--out", str(tmp_path / "p"), "--settings", str(target)],
    )
    # The basic pipeline has no such setting, and says so by name: the file was read.
    assert "acceleration_density" in outcome.stderr
    assert "exists" in refused(still, "--settings", target)


def test_every_setting_is_one_of_the_kalman_pipelines() -> None:
    known = [p for name, p in plugins().pipelines().items() if name.startswith("kalman-")]
    assert known
    for pipeline in known:
        assert set(SETTINGS) <= set(pipeline.settings)


def test_the_plot_is_a_picture(still: Path, tmp_path: Path) -> None:
    assert run(still, "--plot", tmp_path / "a.png").exit_code == 0
    assert imread(tmp_path / "a.png").shape[0] > 800


@pytest.mark.parametrize("name", ["roll_rate", "left.vertical_specific_force"])
def test_one_channel_alone(still: Path, name: str) -> None:
    (channel,) = report(still, "--channel", name)["channels"]
    track = f"{channel['track']}." if channel["track"] else ""
    assert f"{track}{channel['name']}" == name


def test_a_name_without_track_is_that_of_all(still: Path) -> None:
    found = report(still, "--channel", "vertical_specific_force", "--channel", "yaw_rate")
    assert len(found["channels"]) == 3


def test_the_fit_keeps_to_the_times_asked_for(still: Path) -> None:
    for channel in report(still, "--between", 1, 20)["channels"]:
        assert 1.0 <= channel["fitted_from_s"] < channel["fitted_to_s"] <= 20.0


def test_a_gap_is_said_and_the_longer_side_used(tmp_path: Path) -> None:
    clock = UniformClock.of(50.0, 100.0)
    x = white(1e-5, 50.0, 18_000)
    x[4000:4100] = np.nan
    (warning,) = report(written(tmp_path, Channel.of("yaw_rate", x, clock)))["warnings"]
    assert "channel yaw_rate: samples missing or at uneven times; 182 s to 459.98 s" in warning
    assert "77.2 % of all" in warning


def test_a_stuck_channel_is_left_out_and_said(tmp_path: Path) -> None:
    stuck = Channel.of("pitch_rate", np.full(18_000, 0.01), UniformClock.of(50.0))
    found = report(written(tmp_path, stuck))
    assert found["warnings"] == [
        "channel pitch_rate: every sample is 0.01; a sensor that works has noise, so connect it; "
        "left out"
    ]
    assert "pitch_rate_density" not in found["settings"]
    assert "every sample is 0.01" in refused(tmp_path / "still", "--channel", "pitch_rate")


def test_a_channel_stuck_for_a_while_is_said(tmp_path: Path) -> None:
    x = white(1e-5, 50.0, 18_000)
    x[5000:8000] = x[5000]
    (warning,) = report(written(tmp_path, Channel.of("yaw_rate", x, UniformClock.of(50.0))))[
        "warnings"
    ]
    assert "channel yaw_rate: stuck for 60 s" in warning


def test_a_drive_is_doubted_and_gives_no_density(tmp_path: Path) -> None:
    times = np.arange(36_000) / 100.0
    sway = 0.5 * np.sin(2.0 * np.pi * 1.3 * times)
    force = STANDARD_GRAVITY + white(5e-5, 100.0, times.size) + sway
    clock = UniformClock.of(100.0)
    moved = written(
        tmp_path,
        Channel.of("vertical_specific_force", force, clock, "left"),
        Channel.of("vertical_specific_force", force, clock, "right"),
        Channel.of("distance", 20.0 * times, clock),
    )
    found = report(moved)
    warnings = "\n".join(found["warnings"])
    assert "channel distance: grows by 7200 m; if the vehicle moved" in warnings
    assert "left.vertical_specific_force: 0.3" in warnings
    assert "is more than noise" in warnings
    assert "the curve is off by a factor of" in warnings
    assert "acceleration_density" not in found["settings"]
    assert "roll_rate_density" in found["settings"]


def test_a_hum_that_the_curve_misses_gives_no_setting_but_beside_it(tmp_path: Path) -> None:
    hum = 0.004 * np.sin(2.0 * np.pi * 12.3 * np.arange(36_000) / 100.0)
    clock = UniformClock.of(100.0)
    noisy = [
        Channel.of("vertical_specific_force", 9.81 + hum + white(5e-5, 100.0, hum.size), clock, t)
        for t in ("left", "right")
    ]
    found = report(written(tmp_path, *noisy))
    left = next(c for c in found["channels"] if c["track"] == "left")
    assert coefficient(left, "white_noise")["value"] is not None
    assert left["worst_factor"] > 1.5
    assert "acceleration_density" not in found["settings"]
    assert "left.vertical_specific_force: the curve is off by a factor" in found["warnings"][0]
    beside = report(tmp_path / "still", "--between", 10, 120)
    assert beside["settings"]["acceleration_density"] == pytest.approx(5e-5, rel=0.2)


def test_readings_without_fixed_ambiguities_are_said(tmp_path: Path) -> None:
    quality = np.where(np.arange(3600) < 900, 5.0, 4.0)
    changed = Channel.of("gnss_quality", quality, UniformClock.of(10.0))
    (warning,) = report(written(tmp_path, changed))["warnings"]
    assert warning == "channel gnss_quality: 25 % of the readings are not RTK fixed (4)"


def test_warnings_go_to_stderr(tmp_path: Path) -> None:
    result = run(written(tmp_path, Channel.of("yaw_rate", np.zeros(99), UniformClock.of(50.0))))
    assert result.stderr == (
        "Warning: channel yaw_rate: every sample is 0; a sensor that works has noise, "
        "so connect it; left out\n"
    )
    assert "Warning" not in result.stdout


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--channel", "rol_rate"], "channel rol_rate: not one to look at here; there are roll_"),
        (["--channel", "distance"], "channel distance: not one to look at here"),
        (["--between", "10", "1"], "0 cluster times from 10 s to 1 s"),
        (["--between", "x", "1"], "'x' is not a valid float"),
        (["--plot", "a.txt"], "a.txt: not the name of a drawing"),
        (["--settings", "nowhere/a.json"], "its folder does not exist"),
        (["--settings", ".", "--json"], "exists"),
        (["--channel", "gnss_height", "--settings", "a.json"], "shows no setting"),
    ],
)
def test_what_cannot_be_done_is_one_line(
    still: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], text: str
) -> None:
    monkeypatch.chdir(still.parent)
    before = sorted(still.parent.rglob("*"))
    assert text in refused(still, *arguments)
    assert sorted(still.parent.rglob("*")) == before


def test_nothing_to_look_at_is_one_line(tmp_path: Path) -> None:
    clock = UniformClock.of(10.0)
    for name, channel in {
        "other": Channel.of("distance", np.arange(500.0), clock),
        "short": Channel.of("roll_rate", white(1.0, 10.0, 30), clock),
        "uneven": Channel.of(
            "roll_rate", white(1.0, 10.0, 400), StampedClock.of(np.arange(400.0) ** 3)
        ),
    }.items():
        write_recording(Recording((channel,)), tmp_path / name)
    assert "other: no channel has noise at rest to look at" in refused(tmp_path / "other")
    assert "short: channel roll_rate: of 30 samples no 64" in refused(tmp_path / "short")
    assert "uneven: channel roll_rate: of 400 samples no 64" in refused(tmp_path / "uneven")
    assert "nowhere: not found" in refused(tmp_path / "nowhere")


def test_if_no_channel_can_be_used_the_last_reason_is_told(tmp_path: Path) -> None:
    clock = UniformClock.of(10.0)
    channels = [Channel.of(name, np.zeros(500), clock) for name in ("roll_rate", "yaw_rate")]
    write_recording(Recording(tuple(channels)), tmp_path / "stuck")
    assert "no channel can be used: channel yaw_rate: every sample is 0" in refused(
        tmp_path / "stuck"
    )


def test_a_failed_plot_leaves_no_settings(
    still: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("floatref.plots.draw_allan", fail)
    arguments = ("--plot", tmp_path / "a.png", "--settings", tmp_path / "a.json")
    assert "No space left" in refused(still, *arguments)
    assert [entry.name for entry in tmp_path.iterdir()] == ["still"]


def test_progress_is_shown_on_a_terminal_only(still: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "Averaging" not in run(still).output
    # rich takes this for a terminal.
    monkeypatch.setenv("FORCE_COLOR", "1")
    shown = run(still)
    assert "Averaging" in shown.stderr
    assert "Averaging" not in shown.stdout
    assert "Averaging" not in run(still, "--json").output
