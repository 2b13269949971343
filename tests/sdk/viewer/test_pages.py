"""The pages of profiles and of a recording: what they hold is what was measured, and marked."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import IriSettings
from floatref.measures.valid_segments import segment_iris
from floatref.values.parts.windows import Window
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref.viewer import write_profile_page, write_recording_page
from floatref.viewer.page_file import PageOptions

Read = Callable[[Path], Any]
OVER = PageOptions(overwrite=True)


@given(st.lists(st.tuples(st.integers(0, 1200), st.integers(1, 300)), max_size=5), st.booleans())
@settings(max_examples=15)
def test_an_invalid_point_is_never_drawn_without_a_mark(
    tmp_path_factory: pytest.TempPathFactory,
    read_page: Read,
    spans: list[tuple[int, int]],
    missing: bool,
) -> None:
    z = np.random.default_rng(len(spans)).normal(size=1200)
    valid = np.ones(z.size, np.bool_)
    for first, count in spans:
        valid[first : first + count] = False
        z[first : first + count] = np.nan if missing else 50.0
    run = Profile(0.25, (ProfileTrack.of("left", z, valid),))
    path = tmp_path_factory.getbasetemp() / "spans.html"
    write_profile_page(path, {"run": run}, OVER)
    page = read_page(path)
    (line,) = page.lines("Elevation")
    for level in line["levels"]:
        starts = np.arange(0, z.size, level["samples"])
        np.testing.assert_array_equal(page.marked(level), np.logical_or.reduceat(~valid, starts))
        assert not valid.any() or np.nanmax(page.ends(line, level)[1]) <= z[valid].max() + 1e-4
    for means in page.lines("IRI of segments"):
        segments = segment_iris(run["left"], 0.25, IriSettings(segment_m=100.0))
        unsound = [s.marked or np.isnan(s.valid_m_per_km) for s in segments]
        np.testing.assert_array_equal(page.marked(means["levels"][0]), np.repeat(unsound, 2))
    rows = page.document["tables"][0]["rows"]
    assert [row["marked"] for row in rows] == [not valid.all(), *(s.marked for s in segments)]


def test_the_table_has_the_figures_of_iri(
    road: Callable[..., Profile], read_page: Read, tmp_path: Path
) -> None:
    run = road()
    write_profile_page(tmp_path / "p.html", {"run": run}, PageOptions(segment_m=50.0))
    rows = read_page(tmp_path / "p.html").document["tables"][0]["rows"]
    for track in run.tracks:
        own = [row["cells"] for row in rows if row["cells"][1] == track.name]
        whole = segment_iris(track, run.interval_m)
        cut = segment_iris(track, run.interval_m, IriSettings(segment_m=50.0))
        for cells, found in zip(own, (*whole, *cut), strict=True):
            assert cells[2] == found.valid_m_per_km
            assert cells[4:6] == [found.start_m, found.length_m]
            assert cells[6:] == [*found.interval, found.all_m_per_km, found.invalid_m]


def test_a_window_holds_every_point_and_the_figures_of_the_whole(
    road: Callable[..., Profile], read_page: Read, tmp_path: Path
) -> None:
    run = road()
    write_profile_page(tmp_path / "p.html", {"run": run}, PageOptions(Window(100.0, 130.0)))
    page = read_page(tmp_path / "p.html")
    assert page.document["finest"]["samples"] == 1
    assert page.document["span"]["distance"] == pytest.approx([100.0, 130.0])
    for line, track in zip(page.lines("Elevation"), run.tracks, strict=True):
        low, high = page.ends(line, line["levels"][0])
        assert (line["start"], line["step"]) == (pytest.approx(100.0), 0.05)
        np.testing.assert_allclose(low, track.elevation[2000:2601], atol=1e-8)
        np.testing.assert_array_equal(low, high)
    starts = [row["cells"][4] for row in page.document["tables"][0]["rows"]]
    assert starts == pytest.approx([0.0, 100.0, 0.0, 100.0])


def test_runs_have_the_lag_behind_the_first(
    road: Callable[..., Profile], read_page: Read, tmp_path: Path
) -> None:
    runs = {"first": road(), "late": road(shift=-8), "early": road(shift=5)}
    runs["elsewhere"] = Profile(0.05, road().tracks, start_m=1e4)
    write_profile_page(tmp_path / "p.html", runs, OVER)
    found = read_page(tmp_path / "p.html").document["runs"]
    assert [run["name"] for run in found] == list(runs)
    assert [run["lag"] for run in found[:3]] == pytest.approx([0.0, 0.4, -0.25], abs=1e-6)
    assert found[3]["lag"] is None


def test_a_recording_has_its_samples_stops_gaps_and_track(
    drive: Recording, read_page: Read, tmp_path: Path
) -> None:
    write_recording_page(tmp_path / "r.html", "run", drive, OVER)
    page = read_page(tmp_path / "r.html")
    left, _ = page.lines("Height")
    low, _ = page.ends(left, left["levels"][0])
    np.testing.assert_allclose(low, drive.channel("height", "left").values, atol=1e-8)
    assert np.flatnonzero(page.marked(left["levels"][0])).tolist() == list(range(30_000, 31_000))
    events = {event["kind"]: event for event in page.document["events"]}
    assert (events["stop"]["begin"], events["stop"]["end"]) == pytest.approx((18, 22), abs=0.5)
    assert (events["missing"]["begin"], events["missing"]["end"]) == pytest.approx((30, 31))
    assert "left.height" in events["missing"]["detail"]
    travel = page.document["travel"]
    times = travel["start"] + travel["step"] * np.arange(page.arrays[travel["distance"]].size)
    encoder = drive.channel("distance")
    expected = np.interp(times + 100.0, encoder.times_s, encoder.values)
    np.testing.assert_allclose(page.arrays[travel["distance"]], expected, atol=0.02)
    latitude = page.arrays[page.document["map"]["latitude"]]
    np.testing.assert_allclose(np.radians(latitude), drive.channel("gnss_latitude").values)


def test_a_profile_with_its_recording_has_time_speed_and_track(
    road: Callable[..., Profile], drive: Recording, read_page: Read, tmp_path: Path
) -> None:
    write_profile_page(tmp_path / "p.html", {"run": road()}, OVER, drive)
    page = read_page(tmp_path / "p.html")
    (speed,) = page.lines("Speed")
    _, fastest = page.ends(speed, speed["levels"][0])
    assert fastest.max() == pytest.approx(10.0, rel=0.01)
    assert page.document["map"]
    kinds = [event["kind"] for event in page.document["events"]]
    assert {"stop", "not valid"} <= set(kinds)


def test_a_recording_without_gnss_or_encoder_has_no_map_and_no_distance(
    drive: Recording, read_page: Read, tmp_path: Path, road: Callable[..., Profile]
) -> None:
    still = Recording((drive.channel("height", "left"),))
    write_recording_page(tmp_path / "r.html", "run", still, OVER)
    document = read_page(tmp_path / "r.html").document
    assert document["map"] is document["travel"] is None
    with pytest.raises(InputError, match="the recording has no distance that grows"):
        write_profile_page(tmp_path / "p.html", {"run": road()}, OVER, still)
    assert [path.name for path in tmp_path.iterdir()] == ["r.html"]


@pytest.mark.parametrize(("count", "interval_m"), [(2, 0.1), (1000, 5.0)])
def test_a_profile_without_an_iri_is_drawn_without_one(
    read_page: Read, tmp_path: Path, count: int, interval_m: float
) -> None:
    run = Profile(interval_m, (ProfileTrack.of("left", np.arange(float(count))),))
    write_profile_page(tmp_path / "p.html", {"run": run}, OVER)
    document = read_page(tmp_path / "p.html").document
    assert [panel["title"] for panel in document["panels"]] == [
        "Elevation",
        "Roughness over 7.62 m",
    ]
    assert document["tables"] == []


def test_a_long_run_is_drawn_in_coarser_bins(
    drive: Recording, read_page: Read, tmp_path: Path
) -> None:
    write_recording_page(tmp_path / "r.html", "run", drive, PageOptions(most_mb=1.0))
    assert (tmp_path / "r.html").stat().st_size < 1e6
    assert read_page(tmp_path / "r.html").document["finest"]["samples"] == 2
