"""Roads of OpenCRG surfaces: the file's elevation under every line, holes and edges refused."""

import subprocess
import sys
from math import floor
from pathlib import Path

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads import crg
from floatref_conformance.proving_ground.roads.crg import crg_road
from floatref_conformance.proving_ground.roads.road import FULL_FROM_M
from floatref_conformance.proving_ground.roads.wander import Line

pycrg = pytest.importorskip(
    "pycrg", reason="pycrg writes the surfaces; it comes with floatref[conformance]"
)

STEP_M, ACROSS_M, HALF_M = 0.05, 0.02, 1.2
SECTIONS = 801
ALONE = """
import sys, numpy
from floatref_conformance.proving_ground.roads.crg import read_lines
list(read_lines(sys.argv[1], numpy.arange(9.0), None, {"left": 0.5}))
"""
V = -HALF_M + ACROSS_M * np.arange(121)
U = STEP_M * np.arange(SECTIONS)


def hills() -> FloatArray:
    """Return a surface that ends level, shape (sections, strings), exact in float32."""
    z = 0.01 * np.sin(U / 3)[:, None] * (1 + V) + 0.005 * np.sin(4 * V + U[:, None])
    return z.astype(np.float32).astype(np.float64)


def write(path: Path, z: FloatArray, v: FloatArray = V, **more: object) -> Path:
    pycrg.write(path, z, STEP_M, v, u0=100.0, **more)
    return path


def by_hand(z: FloatArray, row: int, y: float) -> float:
    """Return the elevation of one cross section at a lateral position."""
    position = (y + HALF_M) / ACROSS_M
    string = min(floor(position), V.size - 2)
    return float(z[row, string] + (position - string) * (z[row, string + 1] - z[row, string]))


def no_line(x: FloatArray, difference: FloatArray) -> FloatArray:
    return np.asarray(difference - np.polyval(np.polyfit(x, difference, 1), x))


@pytest.mark.parametrize("line", [None, Line(4, 0.1, 0.03)])
def test_the_road_is_the_surface_under_every_line(tmp_path: Path, line: Line | None) -> None:
    road = crg_road(write(tmp_path / "a.crg", hills()), 60.0, line, 0.05)
    at = FULL_FROM_M + U
    shift = np.zeros(SECTIONS) if line is None else line.at(at)
    z = hills()
    differences = [
        [by_hand(z, row, side + shift[row]) for row in range(SECTIONS)] - road.at(name, at)
        for name, side in road.lateral_m.items()
    ]
    assert differences[0] == pytest.approx(differences[1], abs=1e-6)
    assert no_line(at, differences[0]) == pytest.approx(np.zeros(SECTIONS), abs=1e-6)


def test_slope_and_banking_of_the_reference_line_belong_to_the_surface(tmp_path: Path) -> None:
    banking = 0.01 * np.sin(U / 5)
    path = write(tmp_path / "a.crg", hills(), slope=0.02, banking=banking)
    plain = crg_road(write(tmp_path / "b.crg", hills()), 60.0, spacing_m=0.05)
    found = crg_road(path, 60.0, spacing_m=0.05)
    at = FULL_FROM_M + U
    for name, side in found.lateral_m.items():
        added = found.at(name, at) - plain.at(name, at) - side * banking
        assert no_line(at, added) == pytest.approx(np.zeros(SECTIONS), abs=2e-5)


def test_a_short_surface_is_mirrored_and_its_grade_is_no_roof(tmp_path: Path) -> None:
    z = hills() + 0.05 * U[:, None]
    road = crg_road(write(tmp_path / "a.crg", z), 150.0, spacing_m=0.05)
    at = U[5:-5]
    for track in road.tracks:
        forth = road.at(track, FULL_FROM_M + at)
        back = road.at(track, FULL_FROM_M + 2 * U[-1] - at)
        assert no_line(at, forth - back) == pytest.approx(np.zeros(at.size), abs=1e-5)
        assert np.abs(np.diff(road.elevation[track])).max() < 0.002


def test_holes_under_the_line_are_refused_and_others_are_not(tmp_path: Path) -> None:
    z = hills()
    z[300:320, :8] = np.nan
    path = write(tmp_path / "a.crg", z)
    assert crg_road(path, 60.0, spacing_m=0.05).points
    z[300:320, :20] = np.nan
    with pytest.raises(
        InputError, match=r"a\.crg: the surface has a hole at u 114\.95. m, v -0\.86"
    ):
        crg_road(write(tmp_path / "a.crg", z), 60.0, spacing_m=0.05)


def test_a_surface_narrower_than_the_line_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "a.crg", hills())
    for seed, sign in ((26, 1), (3, -1)):
        line = Line(seed, 0.5, 0.0)
        assert sign * line.offset_m > 0.4
        with pytest.raises(InputError, match=r"a\.crg: the surface reaches from -1\.2 to 1\.2 m"):
            crg_road(path, 60.0, line, 0.05)
    narrow = np.abs(V) < 0.85
    with pytest.raises(InputError, match="take a wider one"):
        crg_road(write(tmp_path / "b.crg", hills()[:, narrow], V[narrow]), 60.0, spacing_m=0.05)


def test_a_surface_just_as_wide_and_as_long_as_the_wheel_paths_is_wide_enough(
    tmp_path: Path,
) -> None:
    just = np.abs(V) < 0.861
    edges = {"border_mode_u": 0.0, "border_mode_v": 0.0}
    path = write(tmp_path / "a.crg", hills()[:, just], V[just], opts=edges)
    assert crg_road(path, 100.0).points


def test_what_is_no_surface_is_named_in_one_line(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    whole = write(tmp_path / "a.crg", hills()).read_bytes()
    for content in (b"", b"hello", whole[: len(whole) // 2], whole[:300]):
        path = tmp_path / "broken.crg"
        path.write_bytes(content)
        with pytest.raises(InputError, match=r"broken\.crg: not a whole OpenCRG file") as caught:
            crg_road(path, 60.0)
        assert "\n" not in str(caught.value)
    with pytest.raises(InputError, match="3 cross sections"):
        crg_road(write(tmp_path / "c.crg", hills()[:3]), 60.0)
    assert caplog.records == []


def test_damage_that_ends_the_process_of_the_library_is_refused_in_one_line(tmp_path: Path) -> None:
    """Without its end, and with longer steps, pycrg ends its process by a segmentation fault."""
    pycrg.write(tmp_path / "a.crg", hills()[:6, ::30], 0.5, V[::30], u0=100.0)
    damaged = (tmp_path / "a.crg").read_bytes()
    longer = b"increment  =   5.0000000000000000e"
    for whole, part in ((b"reference_line_end_u", b"xeference_line_end_u"), (longer, longer[:-1])):
        assert whole in damaged
        damaged = damaged.replace(whole, part, 1)
    path = tmp_path / "broken.crg"
    path.write_bytes(damaged)
    with pytest.raises(InputError, match=r"broken\.crg: .*broke down\); copy the complete file"):
        crg_road(path, 60.0)
    seen = subprocess.run([sys.executable, "-c", ALONE, str(path)], capture_output=True)
    assert seen.returncode < 0, "the library has been mended: this tries nothing any more"


def test_a_missing_library_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write(tmp_path / "a.crg", hills())
    monkeypatch.setitem(sys.modules, "pycrg", None)
    with pytest.raises(InputError, match=r"a\.crg: .* pip install -e \"\.\[conformance\]\""):
        crg_road(path, 60.0)


def test_a_file_of_more_bytes_than_memory_should_hold_is_refused_at_once(tmp_path: Path) -> None:
    """Zeros behind a surface cost no disk, and pycrg takes memory for each."""
    path = write(tmp_path / "a.crg", hills())
    with path.open("r+b") as file:
        file.truncate(3 << 30)
    with pytest.raises(InputError, match=r"a\.crg: has 3\.2 GB, .*; cut it into shorter ones"):
        crg_road(path, 60.0)


def test_a_longer_road_is_given_more_time_and_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, limits = write(tmp_path / "a.crg", hills()), list[tuple[float, int]]()

    def read(
        reader: str, arguments: tuple[Path, FloatArray, None, dict[str, float]], broken: str,
        silence_s: float, most_memory: int,
    ) -> list[dict[str, FloatArray]]:  # fmt: skip
        limits.append((silence_s, most_memory))
        return [dict.fromkeys(arguments[3], 0.0 * arguments[1])]

    monkeypatch.setattr(crg, "read_apart", read)
    points = [crg_road(path, length_m).points for length_m in (60.0, 10_060.0)]
    (short_s, short), (long_s, long) = limits
    assert long_s - short_s > 0.99e-4 * (points[1] - points[0])
    assert long - short >= 512 * (points[1] - points[0])
