"""The page on files: its examples are read, and its channels are the ones there are."""

import json
import re
from pathlib import Path

import numpy as np

from floatref.files import read_profile, read_recording
from floatref.files.recording_directory import setup_of
from floatref.mapping.reading import read_native
from floatref.values.channels import CHANNELS

PAGE = (Path(__file__).parents[2] / "docs" / "files.md").read_text(encoding="utf-8")
RECORDING, PROFILE = (json.loads(t) for t in re.findall(r"^```json\n(.*?)^```$", PAGE, re.M | re.S))


def test_the_table_of_channels_is_complete() -> None:
    rows = re.findall(r"^\| `(\w+)` \| (\S+) \| (.+) \|$", PAGE, re.M)
    assert rows == [(name, spec.unit, spec.meaning) for name, spec in CHANNELS.items()]


def test_the_recording_is_read(tmp_path: Path) -> None:
    (tmp_path / "recording.json").write_text(json.dumps(RECORDING), encoding="utf-8")
    for channel in RECORDING["channels"]:
        for key in ("file", "time_file"):
            if key in channel:
                np.arange(5.0).astype("<f8").tofile(tmp_path / channel[key])
    recording = read_recording(tmp_path)
    assert [c.id.name for c in recording.channels] == [c["name"] for c in RECORDING["channels"]]


def test_the_vehicle_is_read() -> None:
    (table,) = re.findall(r'^```text\n"vehicle": (.*?)^```$', PAGE, re.M | re.S)
    vehicle = setup_of({"vehicle": json.loads(table)}).vehicle
    assert vehicle is not None
    assert (vehicle.model, vehicle.x_m, len(vehicle.parameters)) == ("quarter-car", 1.72, 6)


def test_the_profile_is_read(tmp_path: Path) -> None:
    (tmp_path / "profile.json").write_text(json.dumps(PROFILE), encoding="utf-8")
    np.zeros(5).astype("<f8").tofile(tmp_path / "left.f64")
    np.ones(5, np.uint8).tofile(tmp_path / "left.valid.u8")
    assert read_profile(tmp_path).interval_m == PROFILE["interval_m"]


def test_the_csv_table_is_read(tmp_path: Path) -> None:
    (table,) = re.findall(r"^```text\n(time_s,.*?)^```$", PAGE, re.M | re.S)
    path = tmp_path / "run.csv"
    path.write_text(table, encoding="utf-8")
    recording = read_native(path).recording
    np.testing.assert_array_equal(recording.channel("height", "left").values, [0.3, np.nan, 0.2999])
    assert float(recording.channels[0].clock.rate) == 1000.0
