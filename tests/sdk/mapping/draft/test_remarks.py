"""What a draft says beside its entries is right and can be put to use."""

from pathlib import Path

import pytest

from floatref.errors import InputError
from floatref.mapping import read_map
from floatref.mapping.draft.drafting import EITHER, SIGNS, draft_map, is_turned, remark
from floatref.mapping.draft.guesses import Guess
from floatref.values.channels import CHANNELS
from floatref.values.native import Column, NativeClock, NativeFile, Stream


def drafted(*columns: Column) -> str:
    native = NativeFile((Stream("adc", columns, 3, NativeClock(), lambda _: iter(())),))
    return draft_map(native, Path("run.log"), "logger")


def vehicle_of(text: str) -> str:
    lines = text.splitlines()
    at = lines.index(next(line for line in lines if line.startswith("# [setup.vehicle]")))
    end = lines.index("", at)
    opened = [line.removeprefix("# ") for line in lines[at:end]]
    return "\n".join([*lines[:at], *opened, *lines[end:]])


def test_every_remark_is_of_a_channel() -> None:
    assert set(SIGNS) | set(EITHER) <= set(CHANNELS)
    for word in EITHER["height"].split():
        assert word in CHANNELS or "_" not in word


def test_the_table_of_the_vehicle_is_there_to_be_completed(tmp_path: Path) -> None:
    text = vehicle_of(drafted(Column("HubAccFL", "g"), Column("SuspTravelFL", "mm")))
    path = tmp_path / "map.toml"
    path.write_text(text.replace("sprung_kg = 0", "sprung_kg = 75.5"))
    vehicle = read_map(path).setup.vehicle
    assert vehicle is not None
    assert vehicle.model == "quarter-car"
    assert vehicle.parameters["unsprung_kg"] == 75.5


def test_without_a_wheel_nothing_is_asked_of_the_vehicle() -> None:
    assert "vehicle]" not in drafted(Column("AccZ", "g"), Column("Laser", "mm"))
    with pytest.raises(StopIteration):
        vehicle_of(drafted(Column("SuspTravel", "mm")))


def test_a_height_that_may_be_over_the_axle_says_what_it_then_is() -> None:
    text = drafted(Column("RideHeight_FL", "mm"))
    assert '# channel = "height"  # range down to the road, positive; to the axle it is' in text
    assert "to the axle" not in drafted(Column("Laser_FL", "mm"))
    assert remark(Guess("distance", None, sure=False)) == ""


@pytest.mark.parametrize("channel", CHANNELS)
def test_what_pitches_is_turned_where_the_note_says_so(channel: str) -> None:
    found = Guess(channel, None, sure=True)
    pitch = channel in {"gnss_pitch", "pitch_rate", "pitch_angle", "pitch_acceleration"}
    assert is_turned(found, "attitude, nose up positive") is pitch
    assert not is_turned(found, "nose down positive")


def test_a_map_that_is_not_completed_is_refused_by_name(tmp_path: Path) -> None:
    text = vehicle_of(drafted(Column("HubAccFL", "g")))
    for wrong, said in (
        ('model = "quarter-car"', "model"),
        ("x_m = 0.0", "x_m"),
        ("parameters.tyre_n_per_m = 0", "parameters.tyre_n_per_m"),
    ):
        key = wrong.partition(" = ")[0]
        (tmp_path / "map.toml").write_text(text.replace(wrong, f"{key} = []"))
        with pytest.raises(InputError, match=rf"setup\.vehicle\.{said} is \[\]; expected "):
            read_map(tmp_path / "map.toml")
