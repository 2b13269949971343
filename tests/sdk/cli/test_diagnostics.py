"""`floatref process --diagnostics` as a user calls it."""

import numpy as np
import pytest

from floatref.cli import process as process_module
from floatref.errors import InputError
from floatref.files import read_profile, write_recording

PIPELINE = ("--pipeline", "road-prior-smoother")


@pytest.fixture
def folder(tmp_path, steady):
    """A recording directory of one wheel path."""
    height = 0.3 + 4e-5 * np.random.default_rng(0).normal(size=6000)
    write_recording(steady(12.0, 500.0, height=height), tmp_path / "run")
    return tmp_path


def test_record_table_and_picture(folder, ran):
    out = folder / "p"
    result = ran("process", folder / "run", "--out", out, *PIPELINE, "--diagnostics")
    (kinds,) = read_profile(out).provenance["innovations"].values()
    assert sorted(kinds["height"]) == sorted(
        [
            *("count", "mean_nis", "lower_95_percent", "upper_95_percent"),
            *("within_2_sigma_percent", "mean_sigmas", "left_out"),
        ]
    )
    assert (folder / "p.innovations.png").read_bytes().startswith(b"\x89PNG")
    assert "mean NIS" in result.output
    assert f"{kinds['height']['mean_nis']:.3f}" in result.output


@pytest.mark.slow
def test_json_has_the_record_and_the_place_of_the_picture(folder, reported):
    report = reported("process", folder / "run", "--out", folder / "p.csv", *PIPELINE)
    assert "innovations" not in report
    report = reported(
        *("process", folder / "run", "--out", folder / "q.csv", *PIPELINE, "--diagnostics")
    )
    assert report["innovations_picture"] == str(folder / "q.csv.innovations.png")
    assert (folder / "q.csv.innovations.png").is_file()
    (kinds,) = report["innovations"].values()
    assert kinds["height"]["count"] > 5000


def test_an_existing_picture_needs_overwrite(folder, ran, refused):
    (folder / "p.innovations.png").write_text("mine")
    given = ("process", folder / "run", "--out", folder / "p", *PIPELINE, "--diagnostics")
    assert "p.innovations.png" in refused(*given)
    assert not (folder / "p").exists()
    assert (folder / "p.innovations.png").read_text() == "mine"
    ran(*given, "--overwrite")
    assert (folder / "p.innovations.png").read_bytes().startswith(b"\x89PNG")


def test_a_pipeline_without_a_filter_is_one_line_and_leaves_nothing(folder, refused):
    given = ("process", folder / "run", "--out", folder / "p", "--pipeline", "temporal-basic")
    line = refused(*given, "--diagnostics")
    assert "pipeline temporal-basic: has no filter with innovations" in line
    assert [path.name for path in folder.iterdir()] == ["run"]


def test_both_pictures_need_names_of_their_own(folder, refused):
    same = folder / "p.innovations.png"
    given = ("process", folder / "run", "--out", folder / "p", *PIPELINE, "--diagnostics")
    assert "choose another" in refused(*given, "--plot", same)
    assert [path.name for path in folder.iterdir()] == ["run"]


def test_no_picture_is_left_behind_when_the_profile_fails(folder, monkeypatch, refused):
    def full(*args):
        raise InputError("disk full")

    monkeypatch.setattr(process_module, "write_as", full)
    refused("process", folder / "run", "--out", folder / "p", *PIPELINE, "--diagnostics")
    assert [path.name for path in folder.iterdir()] == ["run"]
