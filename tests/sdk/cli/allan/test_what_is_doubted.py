"""`floatref allan`: what it doubts, leaves out and refuses."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result

from floatref.files import write_recording
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

Written = Callable[..., Path]
Runs = Callable[..., Result]
Reports = Callable[..., dict[str, Any]]
Refusals = Callable[..., str]
Noises = Callable[..., np.ndarray]


def coefficient(channel: dict[str, Any], name: str) -> dict[str, Any]:
    return next(c for c in channel["coefficients"] if c["name"] == name)


def test_a_gap_is_said_and_the_longer_side_used(
    tmp_path: Path, written: Written, report: Reports, noise: Noises
) -> None:
    clock = UniformClock.of(50.0, 100.0)
    x = noise(1e-5, 50.0, 18_000)
    x[4000:4100] = np.nan
    (warning,) = report(written(tmp_path, Channel.of("yaw_rate", x, clock)))["warnings"]
    assert "channel yaw_rate: samples missing or at uneven times; 182 s to 459.98 s" in warning
    assert "77.2 % of all" in warning


def test_a_stuck_channel_is_left_out_and_said(
    tmp_path: Path, written: Written, report: Reports, refused: Refusals
) -> None:
    stuck = Channel.of("pitch_rate", np.full(18_000, 0.01), UniformClock.of(50.0))
    found = report(written(tmp_path, stuck))
    assert found["warnings"] == [
        "channel pitch_rate: every sample is 0.01; a sensor that works has noise, so connect it; "
        "not analysed"
    ]
    assert "pitch_rate_density" not in found["settings"]
    assert "every sample is 0.01" in refused(tmp_path / "still", "--channel", "pitch_rate")


def test_a_channel_stuck_for_a_while_is_said(
    tmp_path: Path, written: Written, report: Reports, noise: Noises
) -> None:
    x = noise(1e-5, 50.0, 18_000)
    x[5000:8000] = x[5000]
    (warning,) = report(written(tmp_path, Channel.of("yaw_rate", x, UniformClock.of(50.0))))[
        "warnings"
    ]
    assert "channel yaw_rate: stuck for 60 s" in warning


def test_a_drive_is_doubted_and_gives_no_density(
    tmp_path: Path, written: Written, report: Reports, noise: Noises
) -> None:
    times = np.arange(36_000) / 100.0
    sway = 0.5 * np.sin(2.0 * np.pi * 1.3 * times)
    force = STANDARD_GRAVITY + noise(5e-5, 100.0, times.size) + sway
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


def test_a_hum_that_the_curve_misses_gives_no_setting_but_beside_it(
    tmp_path: Path, written: Written, report: Reports, noise: Noises
) -> None:
    hum = 0.004 * np.sin(2.0 * np.pi * 12.3 * np.arange(36_000) / 100.0)
    clock = UniformClock.of(100.0)
    noisy = [
        Channel.of("vertical_specific_force", 9.81 + hum + noise(5e-5, 100.0, hum.size), clock, t)
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


def test_readings_without_fixed_ambiguities_are_said(
    tmp_path: Path, written: Written, report: Reports
) -> None:
    quality = np.where(np.arange(3600) < 900, 5.0, 4.0)
    changed = Channel.of("gnss_quality", quality, UniformClock.of(10.0))
    (warning,) = report(written(tmp_path, changed))["warnings"]
    assert warning == "channel gnss_quality: 25 % of the readings are not RTK fixed (4)"


def test_warnings_go_to_stderr(tmp_path: Path, written: Written, run: Runs) -> None:
    result = run(written(tmp_path, Channel.of("yaw_rate", np.zeros(99), UniformClock.of(50.0))))
    assert result.stderr == (
        "Warning: channel yaw_rate: every sample is 0; a sensor that works has noise, "
        "so connect it; not analysed\n"
    )
    assert "Warning" not in result.stdout


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (
            ["--channel", "rol_rate"],
            "channel rol_rate: cannot be analysed here; did you mean roll_",
        ),
        (["--channel", "distance"], "channel distance: cannot be analysed here"),
        (["--between", "10", "1"], "0 cluster times from 10 s to 1 s"),
        (["--between", "x", "1"], "'x' is not a valid float"),
        (["--plot", "a.txt"], "a.txt: not the name of a drawing"),
        (["--settings", "nowhere/a.json"], "its folder does not exist"),
        (["--settings", ".", "--json"], "exists"),
        (["--channel", "gnss_height", "--settings", "a.json"], "gives no setting"),
    ],
)
def test_what_cannot_be_done_is_one_line(
    still: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], text: str, refused: Refusals
) -> None:
    monkeypatch.chdir(still.parent)
    before = sorted(still.parent.rglob("*"))
    assert text in refused(still, *arguments)
    assert sorted(still.parent.rglob("*")) == before


def test_nothing_to_look_at_is_one_line(tmp_path: Path, refused: Refusals, noise: Noises) -> None:
    clock = UniformClock.of(10.0)
    for name, channel in {
        "other": Channel.of("distance", np.arange(500.0), clock),
        "short": Channel.of("roll_rate", noise(1.0, 10.0, 30), clock),
        "uneven": Channel.of(
            "roll_rate", noise(1.0, 10.0, 400), StampedClock.of(np.arange(400.0) ** 3)
        ),
    }.items():
        write_recording(Recording((channel,)), tmp_path / name)
    assert "other: no channel has noise at rest to analyse" in refused(tmp_path / "other")
    assert "short: channel roll_rate: of 30 samples no 64" in refused(tmp_path / "short")
    assert "uneven: channel roll_rate: of 400 samples no 64" in refused(tmp_path / "uneven")
    assert "nowhere: not found" in refused(tmp_path / "nowhere")


def test_if_no_channel_can_be_used_the_last_reason_is_told(
    tmp_path: Path, refused: Refusals
) -> None:
    clock = UniformClock.of(10.0)
    channels = [Channel.of(name, np.zeros(500), clock) for name in ("roll_rate", "yaw_rate")]
    write_recording(Recording(tuple(channels)), tmp_path / "stuck")
    assert "no channel can be used: channel yaw_rate: every sample is 0" in refused(
        tmp_path / "stuck"
    )
