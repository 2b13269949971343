"""Runs of one road lie over the first of them on its page, wherever their axes begin.

Law: a run moved by any distance up to a kilometre is moved back by it, and its lag there is below
a sample. What is not sure stays where it lies, without a lag, and the page says why.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.parts.windows import Window
from floatref.values.profile import Profile, ProfileTrack
from floatref.viewer import write_profile_page
from floatref.viewer.lags import FARTHEST_M, find_place, lag_of
from floatref.viewer.page_file import PageOptions
from floatref.viewer.tables import IRI_HEADER

INTERVAL_M = 0.05
FAR_M = st.floats(1.2, 900.0) | st.floats(-900.0, -1.2)
Read = Callable[[Path], Any]


def page_of(read_page: Read, path: Path, runs: dict[str, Profile], **options: Any) -> Any:
    write_profile_page(path, runs, PageOptions(overwrite=True, **options))
    return read_page(path)


@pytest.mark.slow
@settings(max_examples=15)
@given(far_m=FAR_M, shift=st.integers(-500, 500), seed=st.integers(0, 9))
def test_a_run_is_found_where_it_was_moved_to(road, far_m, shift, seed) -> None:
    """Its first point lies ``shift`` samples along the road, and ``far_m`` along its axis."""
    reference = road(seed=seed)
    profile = replace(road(shift=shift, seed=seed), start_m=far_m)
    expected = far_m - INTERVAL_M * shift
    place = find_place(reference, profile)
    assert place.is_sure, place.note
    total = place.placement_m + lag_of(
        reference, replace(profile, start_m=far_m - place.placement_m)
    )
    assert total == pytest.approx(expected, abs=INTERVAL_M)


def test_runs_65_m_apart_lie_over_each_other(road, read_page, tmp_path) -> None:
    record = {"distance": {"along_m": [65.0, 465.0], "speed_mps": [10.0, 12.0]}}
    late = replace(road(), start_m=65.0, provenance=record)
    page = page_of(read_page, tmp_path / "p.html", {"first": road(), "late": late})
    first, found = page.document["runs"]
    assert (first["moved"], first["lag"]) == (0.0, 0.0)
    assert found["moved"] == pytest.approx(-65.0, abs=1e-3)
    assert found["lag"] == pytest.approx(0.0, abs=1e-3)
    assert page.document["span"]["distance"] == pytest.approx([0.0, 399.95], abs=1e-3)
    lines = page.lines("Elevation")
    assert [line["start"] for line in lines] == pytest.approx([0.0] * 4, abs=1e-3)
    (at,) = [k for k, (head, _) in enumerate(IRI_HEADER) if head == "from"]
    starts = [row["cells"][at] for row in page.document["tables"][0]["rows"]]
    assert starts == pytest.approx([0, 0, 100, 200, 300] * 4, abs=1e-3)
    (speed,) = page.lines("Speed")
    along = page.arrays[speed["levels"][0]["at"]] + speed["start"]
    np.testing.assert_allclose(along, [0.0, 400.0], atol=1e-3)


def test_a_window_is_on_the_axis_of_the_first_run(road, read_page, tmp_path) -> None:
    runs = {"first": road(), "late": replace(road(), start_m=5e2)}
    page = page_of(read_page, tmp_path / "p.html", runs, window=Window(100.0, 130.0))
    assert page.document["span"]["distance"] == pytest.approx([100.0, 130.0], abs=0.051)


def other(track: str) -> Profile:
    values = np.cumsum(np.random.default_rng(77).normal(0.0, 3e-4, 8000))
    return Profile(INTERVAL_M, (ProfileTrack.of(track, values),))


@pytest.mark.parametrize(
    ("change", "note"),
    [
        (lambda run: other("left"), "which chance may reach"),
        (lambda run: other("centre"), "no wheel path of the reference"),
        (lambda run: replace(run, start_m=FARTHEST_M + 401.0), "lies within 1000 m"),
        (lambda run: replace(run, tracks=tuple(map(without_shape, run.tracks))), "flat"),
    ],
)
def test_a_place_that_is_not_sure_moves_nothing(road, read_page, tmp_path, change, note) -> None:
    profile = change(road())
    page = page_of(read_page, tmp_path / "p.html", {"first": road(), "other": profile})
    _, found = page.document["runs"]
    assert (found["moved"], found["lag"]) == (0.0, None)
    assert note in found["note"]
    assert page.lines("Elevation")[2]["start"] == profile.start_m


def without_shape(track: ProfileTrack) -> ProfileTrack:
    return ProfileTrack.of(track.name, np.zeros(track.elevation.size))
