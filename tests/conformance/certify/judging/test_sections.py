"""The numbers of a section are `floatref compare`'s, run by run and pair by pair."""

import json
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from click.testing import CliRunner

from floatref.cli.main import main
from floatref.errors import InputError
from floatref.files import write_profile
from floatref.values.arrays import frozen
from floatref_conformance.certify.judging.sections import Run


def compared(folder, first, second):
    """Return what the command prints for two profiles, by wheel path."""
    paths = []
    for k, profile in enumerate((first, second)):
        paths.append(str(folder / f"profile-{k}"))
        write_profile(profile, folder / f"profile-{k}", overwrite=True)
    result = CliRunner().invoke(main, ["compare", *paths, "--json"])
    assert result.exit_code == 0, result.output
    return {track["name"]: track for track in json.loads(result.stdout)["tracks"]}


def check_against_compare(folder, sheet):
    """Check every number of ``sheet`` against the command, on the profiles that it keeps."""
    for run in sheet.runs:
        printed = compared(folder, sheet.reference, run.profile)
        for track in run.tracks:
            line = printed[track.track]
            assert track.accuracy == line["cross_correlation"]
            assert track.offset_m == line["offset_m"]
            assert track.iri_m_per_km == line["iri_m_per_km"]
            assert sheet.reference_iri[track.track] == line["iri_reference_m_per_km"]
            bias = 100 * (line["iri_m_per_km"] / line["iri_reference_m_per_km"] - 1)
            assert track.bias_percent == pytest.approx(bias, abs=1e-12)
    for i, j in combinations(range(len(sheet.runs)), 2):
        printed = compared(folder, sheet.runs[i].profile, sheet.runs[j].profile)
        for name, pairs in sheet.pairs.items():
            assert pairs[i, j] == printed[name]["cross_correlation"]


@pytest.mark.slow
def test_every_number_of_whole_runs_is_compares(tmp_path, sheet_of, reference, ten_runs):
    sheet = sheet_of(ten_runs[:4])
    assert all(run.profile is given for run, given in zip(sheet.runs, ten_runs, strict=False))
    assert sheet.reference is reference
    check_against_compare(tmp_path, sheet)


@pytest.mark.slow
def test_so_it_is_with_runs_that_are_cut_coarse_offset_or_holed(
    tmp_path, sheet_of, run_over, without
):
    runs = (
        run_over(1, start_m=-25.0, end_m=260.0),
        run_over(2, interval_m=0.025, start_m=-3.013, end_m=230.0),
        run_over(3, distance=1.002),
        without(run_over(4), "left", 1000, 30),
        replace(run_over(5), start_m=0.4),
    )
    sheet = sheet_of(runs, stretch_m=(20.0, 180.9))
    assert max(run.profile.length_m for run in sheet.runs) < 161.1
    check_against_compare(tmp_path, sheet)


def test_there_are_half_n_times_n_less_one_pairs_and_nothing_else(sheet_of, ten_runs):
    for pairs in sheet_of(ten_runs).pairs.values():
        assert pairs.shape == (10, 10)
        above = np.triu(np.ones((10, 10), dtype=bool), 1)
        assert np.isfinite(pairs[above]).all()
        assert np.isnan(pairs[~above]).all()


def test_the_average_of_a_run_is_over_its_own_pairs(sheet_of, ten_runs):
    sheet = sheet_of(ten_runs[:4])
    pairs = sheet.pairs["left"]
    (track,) = [t for t in sheet.runs[2].tracks if t.track == "left"]
    own = [pairs[0, 2], pairs[1, 2], pairs[2, 3]]
    assert track.with_others == pytest.approx(np.mean(own), abs=1e-15)


@pytest.mark.slow
def test_the_order_in_which_runs_are_given_changes_nothing(sheet_of, ten_runs):
    named = [Run(f"run-{k}", f"run-{k}", (), p) for k, p in enumerate(ten_runs, 1)]
    there, back = sheet_of(tuple(named)), sheet_of(tuple(named[::-1]))
    assert [run.name for run in back.runs] == [f"run-{k}" for k in range(1, 11)]
    assert there.criteria == back.criteria
    assert [run.tracks for run in there.runs] == [run.tracks for run in back.runs]


def test_the_iri_of_the_reference_is_that_of_the_section(sheet_of, ten_runs, reference):
    from floatref.measures import iri

    part = reference.track("right").elevation[400 : 3600 + 1]
    sheet = sheet_of(ten_runs[:1], stretch_m=(20.0, 180.0))
    assert sheet.reference_iri["right"] == iri(part, 0.05)
    assert (sheet.start_m, sheet.end_m) == pytest.approx((20.0, 180.0))


def test_a_run_that_was_not_read_stays_as_it_is_and_the_rest_goes_on(sheet_of, ten_runs):
    bad = Run("run-2b", "runs/broken.erd", ("said",), None, "line 3 is cut short")
    sheet = sheet_of((ten_runs[0], bad, *ten_runs[1:]))
    found = {run.name: run for run in sheet.runs}["run-2b"]
    assert (found.error, found.tracks, found.profile) == ("line 3 is cut short", (), None)
    assert found.notes == ("said",)
    assert sum(bool(run.tracks) for run in sheet.runs) == 10
    assert np.isfinite(sheet.pairs["left"]).sum() == 45


@pytest.mark.parametrize(
    ("numbers", "said"),
    [
        ({"tracks": ("left",)}, "right"),
        ({"start_m": 230.0, "end_m": 290.0}, "nothing of the section"),
        ({"start_m": 198.0, "end_m": 290.0}, "the car needs 11 m"),
    ],
)
def test_a_run_that_cannot_be_compared_is_named_with_the_reason(
    sheet_of, run_over, ten_runs, numbers, said
):
    sheet = sheet_of((*ten_runs[:2], run_over(3, **numbers)))
    assert said in sheet.runs[2].error
    assert sheet.runs[2].tracks == ()
    assert sheet.runs[0].tracks[0].with_others == sheet.pairs["left"][0, 1]


def test_a_wheel_path_that_holds_nothing_leaves_the_other_one(sheet_of, ten_runs, without):
    blind = without(ten_runs[0], "left", 0, 4001)
    sheet = sheet_of((blind, *ten_runs[1:3]))
    left, right = sheet.runs[0].tracks
    assert np.isnan([left.accuracy, left.iri_m_per_km, left.with_others]).all()
    assert right.accuracy > 0.9
    assert "track left" in " ".join(sheet.runs[0].notes)
    assert left.missing_m == pytest.approx(200.05)


@pytest.mark.slow
def test_what_a_run_flags_or_lacks_is_measured_in_m(sheet_of, ten_runs, without, run_over):
    flagged = without(ten_runs[0], "left", 100, 40, flags_only=True)
    holed = without(ten_runs[1], "right", 100, 40)
    short = run_over(3, end_m=190.0)
    sheet = sheet_of((flagged, holed, short, ten_runs[3]))
    lengths = [[(t.flagged_m, t.missing_m) for t in run.tracks] for run in sheet.runs]
    expected = [
        [(2.0, 0.0), (0.0, 0.0)],
        [(0.0, 0.0), (2.0, 2.0)],
        [(10.0, 10.0), (10.0, 10.0)],
        [(0.0, 0.0), (0.0, 0.0)],
    ]
    assert np.array(lengths) == pytest.approx(np.array(expected), abs=1e-9)


def test_a_copy_of_a_run_or_of_the_reference_is_no_run(sheet_of, ten_runs, reference):
    moved = replace(ten_runs[0], start_m=0.5)
    sheet = sheet_of((ten_runs[0], ten_runs[1], moved, reference))
    assert "same elevations as run-1," in sheet.runs[2].error
    assert "same elevations as the reference," in sheet.runs[3].error
    assert [run.error for run in sheet.runs[:2]] == ["", ""]
    assert [bool(run.tracks) for run in sheet.runs] == [True, True, False, False]
    assert np.count_nonzero(np.isfinite(sheet.pairs["left"])) == 1
    assert sheet.criteria[0].value == 2.0


def test_a_level_reference_is_refused(sheet_of, ten_runs, reference):
    left, right = reference.tracks
    level = replace(right, elevation=frozen(1e-4 * right.elevation))
    with pytest.raises(InputError, match=r"section main: .*track right .*no road is so even"):
        sheet_of(ten_runs[:1], reference=replace(reference, tracks=(left, level)))


def test_a_reference_that_cannot_serve_is_refused_by_the_name_of_its_section(sheet_of, ten_runs):
    with pytest.raises(InputError, match=r"section main: reference: .* reaches beyond"):
        sheet_of(ten_runs[:1], stretch_m=(0.0, 300.0))


@pytest.mark.slow
def test_a_run_that_agrees_has_no_cause_whatever_it_flags(sheet_of, run_over, without):
    runs = (without(run_over(1), "left", 0, 1000, flags_only=True), run_over(2), run_over(3))
    sheet = sheet_of(runs)
    assert sheet.runs[0].tracks[0].flagged_m == pytest.approx(50.0)
    assert all(track.causes == () for run in sheet.runs for track in run.tracks)
