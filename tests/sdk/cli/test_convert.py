"""`floatref convert`: every format into every other, and what cannot be converted."""

import itertools
from pathlib import Path

import numpy as np
import pytest

from floatref.engine.formats import profile_of
from floatref.files import read_profile, write_profile
from floatref.values.profile import Profile, ProfileTrack

SUFFIXES = {"profile": "", "csv": ".csv", "erd": ".erd", "parquet": ".parquet"}
HALF_DIGIT = 0.5e-7
"""In m: an ERD file of ours has seven decimals."""


def road(interval_m: float = 0.05, start_m: float = 120.0) -> Profile:
    """Two wheel paths of 20 m with a gap, a doubtful stretch, and a 1-sigma on the left."""
    noise = np.random.default_rng(7).normal(0.0, 4e-4, (2, 401))
    left, right = np.cumsum(noise, axis=1)
    left[100:110] = np.nan
    doubtful = np.arange(401) < 350
    sigma = np.full(401, 2e-4)
    tracks = (ProfileTrack.of("left", left, None, sigma), ProfileTrack.of("right", right, doubtful))
    return Profile(interval_m, tracks, start_m, "temporal-basic", {"a": 1.0}, {"b": "c"})


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, ran) -> Path:
    """The same profile in every format, each made from the profile directory."""
    place = tmp_path_factory.mktemp("convert")
    write_profile(road(), place / "made")
    for suffix in list(SUFFIXES.values())[1:]:
        ran("convert", place / "made", "--out", place / f"made{suffix}")
    return place


@pytest.mark.parametrize(("one", "other"), [*itertools.product(SUFFIXES, repeat=2)])
def test_points_heights_and_validity_survive_any_way_round(
    folder: Path, tmp_path: Path, one: str, other: str, ran
) -> None:
    out = tmp_path / f"out{SUFFIXES[other]}"
    ran("convert", folder / f"made{SUFFIXES[one]}", "--out", out)
    found, expected = profile_of(out), road()
    assert found.interval_m == pytest.approx(expected.interval_m, rel=1e-9)
    assert found.start_m == pytest.approx(expected.start_m, abs=1e-9)
    for track in expected.tracks:
        ours = found.track(track.name)
        assert np.array_equal(ours.valid, track.valid)
        tolerance = HALF_DIGIT * 1.001 if "erd" in (one, other) else 0.0
        measured = np.isfinite(track.elevation)
        assert np.allclose(
            ours.elevation[measured], track.elevation[measured], rtol=0.0, atol=tolerance
        )


@pytest.mark.parametrize("other", ["profile", "parquet"])
def test_a_format_that_holds_all_gives_all_back(
    folder: Path, tmp_path: Path, other: str, invoke, ran
) -> None:
    between, back = tmp_path / f"between{SUFFIXES[other]}", tmp_path / "back"
    ran("convert", folder / "made", "--out", between)
    ran("convert", between, "--out", back)
    found, expected = read_profile(back), road()
    assert (found.pipeline, dict(found.settings), dict(found.provenance)) == (
        expected.pipeline,
        dict(expected.settings),
        dict(expected.provenance),
    )
    assert (back / "left.f64").read_bytes() == (folder / "made" / "left.f64").read_bytes()
    assert (back / "left.sigma.f64").read_bytes() == (
        folder / "made" / "left.sigma.f64"
    ).read_bytes()


def test_feet_and_millimetres_become_metres(tmp_path: Path, ran) -> None:
    rows = "\n".join(f"{value}" for value in (0.0, 25.4, 50.8))
    header = "ERDFILEV2.00\n 1, 3, 3, 1, 5, 0.5, -1,\nXUNITS  ft\nSHORTNAMLElev\nUNITSNAMmm\nEND\n"
    (tmp_path / "feet.erd").write_text(header + rows + "\n")
    ran("convert", tmp_path / "feet.erd", "--out", tmp_path / "metres")
    found = read_profile(tmp_path / "metres")
    assert found.interval_m == pytest.approx(0.1524)
    assert found.track("left").elevation == pytest.approx([0.0, 0.0254, 0.0508])


def test_the_name_of_a_format_counts_more_than_the_suffix(
    folder: Path, tmp_path: Path, invoke, ran
) -> None:
    out = tmp_path / "run.txt"
    ran("convert", folder / "made", "--out", out, "--format", "csv")
    assert out.read_text("ascii").startswith("distance_m,left_elevation_m,left_valid,right_")


def test_what_was_written_is_told(folder: Path, tmp_path: Path, invoke) -> None:
    said = invoke("convert", folder / "made.erd", "--out", tmp_path / "out.csv").stdout
    assert "out.csv" in said
    assert [line.split()[:4] for line in said.splitlines()[2:4]] == [
        ["left", "120", "20.00", "0.05"],
        ["right", "120", "20.00", "0.05"],
    ]


def test_an_existing_target_needs_overwrite(
    folder: Path, tmp_path: Path, invoke, ran, refused
) -> None:
    out = tmp_path / "out.csv"
    out.write_text("mine")
    refused("convert", folder / "made", "--out", out)
    assert out.read_text() == "mine"
    ran("convert", folder / "made", "--out", out, "--overwrite")
    assert profile_of(out).tracks[0].name == "left"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nowhere", "--out", "o"], "nowhere"),
        (["text.csv", "--out", "o"], "expected distance_m"),
        (["damaged.erd", "--out", "o"], "damaged.erd"),
        (["made", "--out", "o.xls"], "suffix .xls is no format"),
        (["made", "--out", "nowhere/o.csv"], "its folder does not exist"),
        (["made", "--out", "made", "--overwrite"], "the source itself"),
        (["made/profile.json", "--out", "made", "--overwrite"], "the source itself"),
        (["made", "--out", "made/o.csv"], "the source itself"),
        (["made.csv", "--out", "made.csv", "--format", "erd", "--overwrite"], "source itself"),
        (["made"], "Missing option '-o' / '--out'"),
        (["made", "--out", "o", "--format", "xls"], "'xls' is not one of"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_leaves_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], message: str, refused
) -> None:
    monkeypatch.chdir(folder)
    (folder / "text.csv").write_text("a,b\n1,2\n")
    (folder / "damaged.erd").write_text("ERDFILEV2.00\n 1, 3,\n")
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
    assert message in refused("convert", *arguments)
    assert {path: path.stat().st_mtime_ns for path in folder.rglob("*")} == before
