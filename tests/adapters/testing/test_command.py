"""`python -m floatref_adapters.testing`: a recording directory in another format."""

from pathlib import Path

import numpy as np
import pytest

from floatref import Channel, Recording, UniformClock, write_recording
from floatref_adapters.formats.arrow.adapter import Parquet
from floatref_adapters.testing.__main__ import main


@pytest.fixture
def run(tmp_path: Path) -> Path:
    values = np.array([0.30004, np.nan, 0.29996])
    channel = Channel.of("height", values, UniformClock.of(16000.0, 0.25), "left")
    write_recording(Recording((channel,)), tmp_path / "run")
    return tmp_path / "run"


def test_a_recording_is_written_with_its_quantum(run: Path) -> None:
    path = run.with_suffix(".parquet")
    assert main([str(run), str(path), "--quantum", "left.height=1e-4"]) == 0
    (stream,) = Parquet().streams(path, {}).streams
    (rows,) = stream.read(["left.height"])
    np.testing.assert_allclose(rows.values["left.height"], [0.3, np.nan, 0.3], atol=1e-12)
    assert (stream.clock.rate, stream.clock.first_tick * stream.clock.tick_s) == (16000, 0.25)


@pytest.mark.parametrize(
    ("file", "more", "said"),
    [
        ("run.xyz", (), "no format of that suffix; use .mf4, .tdms, .parquet"),
        ("run.h5", ("--quantum", "height"), "--quantum height: give CHANNEL=VALUE"),
        ("run.h5", ("--quantum", "heigth=1"), "quantum of heigth: no such channel"),
        ("none/run.csv", (), "cannot be written"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_exit_code_2(
    run: Path, capsys: pytest.CaptureFixture[str], file: str, more: tuple[str, ...], said: str
) -> None:
    path = run.parent / file
    assert main([str(run), str(path), *more]) == 2
    assert said in (line := capsys.readouterr().err)
    assert line.count("\n") == 1
    assert not path.exists()


def test_a_missing_recording_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(tmp_path / "none"), str(tmp_path / "run.csv")]) == 2
    assert "none" in capsys.readouterr().err
