"""A logger of wheels, springs and body goes through a drafted map into a recording."""

import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from floatref import VehicleSetup
from floatref.cli.main import main
from floatref.errors import InputError
from floatref.files import read_recording, write_recording
from floatref.mapping import read_native
from floatref_adapters.testing.mdf4 import MASTER, Stored, StoredGroup, write

G = 9.80665
TIMES = np.arange(2000) / 500
PER_PULSE = 0.02
SIDES = {"FL": "left", "FR": "right"}
KEYS = r"(?m)^# (\[setup\.vehicle|model|x_m|parameters)"
PARAMETERS = {
    "sprung_kg": 700.0,
    "unsprung_kg": 75.0,
    "suspension_n_per_m": 45_000.0,
    "suspension_ns_per_m": 3300.0,
    "tyre_n_per_m": 320_000.0,
}
ENCODER = """
[[channels]]
native = "WheelPulses"
channel = "distance"
scale = 0.02
unit = "m"
"""


def moved(corner: str) -> dict[str, np.ndarray]:
    """Return what a corner of the vehicle does, in SI units, by our channels."""
    phase = 12.0 * TIMES + len(corner.strip("L"))
    return {
        "unsprung_specific_force": G + 60.0 * np.sin(9.0 * phase),
        "sprung_specific_force": G + 1.5 * np.sin(phase),
        "suspension_deflection": 0.02 * np.cos(phase),
    }


def native() -> dict[str, tuple[np.ndarray, str]]:
    """Return the same as the logger has it: its names, its units."""
    columns = {}
    for corner in SIDES:
        wheel, body, spring = moved(corner).values()
        columns[f"HubAcc_{corner}"] = (wheel / G, "g")
        columns[f"BodyAcc_{corner}"] = (body / G, "g")
        columns[f"SuspTravel_{corner}"] = (1e3 * spring, "mm")
    columns["WheelPulses"] = (np.floor(20.0 * TIMES / PER_PULSE), "pulses")
    return columns


def as_csv(path: Path) -> None:
    columns = native()
    header = ",".join(["time_s", *(f"{name} [{unit}]" for name, (_, unit) in columns.items())])
    table = np.column_stack([TIMES, *(values for values, _ in columns.values())])
    np.savetxt(path, table, fmt="%.17g", delimiter=",", header=header, comments="")


def as_mdf4(path: Path) -> None:
    stored = [Stored(name, values, unit) for name, (values, unit) in native().items()]
    clock = Stored("t", TIMES, "s", kind=MASTER)
    groups = [StoredGroup("adc", [clock, *stored[:-1]]), StoredGroup("can", [clock, stored[-1]])]
    write(groups, path)


def completed(text: str) -> str:
    """Return a drafted map with vehicle and pulses stated."""
    text = re.sub(KEYS, r"\1", text).replace("x_m = 0.0", "x_m = 1.72")
    for name, value in PARAMETERS.items():
        text = text.replace(f"parameters.{name} = 0", f"parameters.{name} = {value}")
    return text + ENCODER


@pytest.fixture(params=[("run.csv", as_csv), ("run.mf4", as_mdf4)], ids=["csv", "mdf4"])
def drafted(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Path, str]:
    """A file of the logger and the map that is drafted for it."""
    name, store = request.param
    path = tmp_path / name
    store(path)
    result = CliRunner().invoke(main, ["channels", str(path), "--draft-map"])
    assert result.exit_code == 0, result.output
    return path, result.stdout


def test_every_sensor_becomes_its_channel_and_the_vehicle_is_known(
    drafted: tuple[Path, str], tmp_path: Path
) -> None:
    source, text = drafted
    (tmp_path / "map.toml").write_text(completed(text), "utf-8")
    reading = read_native(source, tmp_path / "map.toml")
    assert reading.warnings == ()
    found = reading.recording
    assert found.setup.vehicle == VehicleSetup("quarter-car", PARAMETERS, 1.72)
    assert len(found.channels) == 7
    for corner, track in SIDES.items():
        for name, values in moved(corner).items():
            channel = found.channel(name, track)
            np.testing.assert_allclose(channel.values, values, rtol=1e-12, atol=1e-14)
            np.testing.assert_allclose(channel.times_s, TIMES, rtol=0, atol=1e-9)
    distance = found.channel("distance").values
    assert (abs(distance - 20.0 * TIMES) <= PER_PULSE + 1e-9).all()


def test_the_recording_that_is_written_is_the_same(
    drafted: tuple[Path, str], tmp_path: Path
) -> None:
    source, text = drafted
    (tmp_path / "map.toml").write_text(completed(text), "utf-8")
    mapped = read_native(source, tmp_path / "map.toml").recording
    write_recording(mapped, tmp_path / "run")
    found = read_recording(tmp_path / "run")
    assert found.setup == mapped.setup
    for ours, theirs in zip(found.channels, mapped.channels, strict=True):
        assert ours.id == theirs.id
        np.testing.assert_array_equal(ours.values, theirs.values)


@pytest.mark.parametrize(
    ("unit", "wrong", "line"),
    [
        ("mm", "m", r"SuspTravel_FL as left\.suspension_deflection: a sample is 20 m, .* 'mm'"),
        ("g", "m/s^2", r"HubAcc_FL as left\.unsprung_.*: mean is \S+, expected about 9\.8 .* 'g'"),
    ],
)
def test_a_unit_that_the_samples_speak_against_is_told_with_the_native_name(
    drafted: tuple[Path, str], tmp_path: Path, unit: str, wrong: str, line: str
) -> None:
    source, text = drafted
    stated = completed(text).replace(f'unit = "{unit}"', f'unit = "{wrong}"')
    (tmp_path / "map.toml").write_text(stated, "utf-8")
    with pytest.raises(InputError, match=line):
        read_native(source, tmp_path / "map.toml")
