"""Heights without a unit: a road is a road in one of them, and what is none is refused.

Law: a road of 1 to 5 m/km comes back in m, whatever unit of the system of its distances it was
written in, and the sentence names that unit.
"""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.cli.recordings.guessed_units import GUESSED, read_guessing
from floatref.errors import InputError
from floatref.measures import iri

METRES = {"in": 0.0254, "ft": 0.3048, "mil": 2.54e-5, "m": 1.0, "mm": 0.001}
INTERVAL_M = 0.05
Z = np.cumsum(np.random.default_rng(4).normal(0.0, 4e-4, 2000))
ROAD = Z / iri(Z, INTERVAL_M)
"""A road of 1 m/km."""


def text(path: Path, z: np.ndarray, along: str, title: str = "LElev_Full") -> Path:
    places = INTERVAL_M * np.arange(z.size) / METRES[along]
    rows = (f"{place:.12g}\t{value:.12g}" for place, value in zip(places, z, strict=True))
    lines = (f"LElev - Distance ({along})\t{title}", *rows)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@settings(max_examples=8, deadline=None)
@given(
    roughness=st.floats(1.0, 5.0),
    units=st.sampled_from([("ft", "in"), ("ft", "ft"), ("ft", "mil"), ("m", "m"), ("m", "mm")]),
)
def test_the_unit_is_found(
    tmp_path_factory: pytest.TempPathFactory, roughness: float, units: tuple[str, str]
) -> None:
    along, unit = units
    z = roughness * ROAD
    path = text(tmp_path_factory.mktemp("unit") / "run.txt", z / METRES[unit], along)
    profile, note = read_guessing(path)
    np.testing.assert_allclose(profile.tracks[0].elevation, z, atol=1e-9)
    assert f"taken as {unit}, by distance in {along}" in note
    assert profile.provenance[GUESSED] == note


def two(path: Path, left: np.ndarray, right: np.ndarray) -> Path:
    places = INTERVAL_M * np.arange(left.size) / 0.3048
    rows = [
        f"{at:.12g}\t{a:.12g}\t{at:.12g}\t{b:.12g}"
        for at, a, b in zip(places, left, right, strict=True)
    ]
    titles = "LElev - Distance (ft)\tLElev_Full\tRElev - Distance (ft)\tRElev_Full"
    path.write_text("\n".join([titles, *rows]) + "\n", encoding="utf-8")
    return path


def test_a_level_wheel_path_says_nothing_about_the_unit(tmp_path: Path) -> None:
    profile, note = read_guessing(two(tmp_path / "run.txt", 0.9 * ROAD / 0.0254, 0.0 * ROAD))
    assert "taken as in, by distance in ft and an IRI of 0.9 m/km (a road too, in ft 10.8)" in note
    np.testing.assert_allclose(profile.tracks[0].elevation, 0.9 * ROAD, atol=1e-9)


@given(other=st.floats(30.0, 1e3) | st.floats(1e-4, 1e-3))
def test_columns_that_are_no_roads_in_one_unit_are_refused(
    tmp_path_factory: pytest.TempPathFactory, other: float
) -> None:
    path = two(tmp_path_factory.mktemp("two") / "run.txt", ROAD / 0.0254, other * ROAD / 0.0254)
    with pytest.raises(InputError, match="in no unit are they a road"):
        read_guessing(path)


def test_a_unit_that_is_stated_is_not_guessed(tmp_path: Path) -> None:
    profile, note = read_guessing(text(tmp_path / "run.txt", ROAD, "ft", "LElev_Full (ft)"))
    assert note == ""
    np.testing.assert_allclose(profile.tracks[0].elevation, 0.3048 * ROAD, atol=1e-9)


@pytest.mark.parametrize("z", [np.zeros(2000), 1e9 * ROAD, ROAD[:2]])
def test_what_is_no_road_in_any_unit_is_refused_in_one_line(tmp_path: Path, z: np.ndarray) -> None:
    path = text(tmp_path / "run.txt", z, "ft")
    with pytest.raises(InputError, match="in no unit are they a road") as caught:
        read_guessing(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)
