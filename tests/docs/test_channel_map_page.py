"""The page on channel maps: its map is one, and its names are guessed as it says."""

import re
from pathlib import Path

import pytest

from floatref.mapping import read_map
from floatref.mapping.channel_map.units import UNITS, known_unit
from floatref.mapping.draft.guesses import guess
from floatref.values.native import Column

PAGE = (Path(__file__).parents[2] / "docs" / "channel-map.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (`.*`): ([a-z ,]+) \| (.*) \|$", PAGE, re.M)
KINDS = {
    "acceleration": "g",
    "length": "mm",
    "speed": "m/s",
    "angular acceleration": "deg/s^2",
    "angle": "deg",
}
NAMES = [
    (name, KINDS[kind], row[2])
    for row in ROWS
    for count, name in enumerate(re.findall(r"`([^`]+)`", row[0]))
    for kind in [(row[1].split(", ") * 9)[count]]
]


def test_the_map_is_read(tmp_path: Path) -> None:
    (chart,) = re.findall(r"^```toml\n(.*?)^```$", PAGE, re.M | re.S)
    (tmp_path / "map.toml").write_text(chart, encoding="utf-8")
    found = read_map(tmp_path / "map.toml")
    assert [entry.track for entry in found.channels] == ["left", "left", None, None]
    assert found.setup.vehicle is not None
    assert len(found.setup.vehicle.parameters) == 5


@pytest.mark.parametrize(("name", "unit", "said"), NAMES)
def test_a_name_is_guessed_as_the_page_says(name: str, unit: str, said: str) -> None:
    found = guess("", Column(name, unit))
    assert found is not None
    assert f"`{found.channel.removeprefix('rear_')}`" in said
    assert found.sure != ("a comment" in said)


def test_the_table_of_names_is_found() -> None:
    assert len(NAMES) >= 15


def test_every_unit_that_is_listed_is_known_and_every_kind_is_listed() -> None:
    (listed,) = re.findall(r"^Units are (.*?)\. ", PAGE, re.M | re.S)
    names = [name for name in re.split(r"[,;\s()]+|\band\b", listed) if name]
    assert {known_unit(name) for name in names} <= set(UNITS.values())
    assert {unit.si for unit in map(known_unit, names) if unit} == {u.si for u in UNITS.values()}
