"""Rows: the IRI of `floatref iri --segment`, and lengths that add up."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.batch.results.segments import measure_segments
from floatref.cli.iri import iri_report
from floatref.errors import InputError
from floatref.measures import IriSettings
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording

SHARED = (
    "start_m",
    "length_m",
    "iri_m_per_km",
    "iri_of_valid_m_per_km",
    "iri_of_valid_low_m_per_km",
    "iri_of_valid_high_m_per_km",
    "counted_share",
)
"""What a row and a segment of the command's JSON call alike."""


def road(points: int, interval_m: float, start_m: float = 0.0, tracks: int = 2) -> Profile:
    """Return a rough road with points that are missing and points that are not valid."""
    rng = np.random.default_rng(points)
    made = []
    for name in ("left", "right", "middle")[:tracks]:
        elevation = np.cumsum(rng.normal(0.0, 1e-3, points))
        elevation[points // 3 : points // 3 + points // 50] = np.nan
        valid = np.repeat(rng.random(points // 300 + 1) > 0.2, 300)[:points]
        made.append(ProfileTrack.of(name, elevation, valid, rng.random(points) * 1e-3))
    return Profile(interval_m, tuple(made), start_m)


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@given(
    points=st.integers(700, 5000),
    interval_m=st.sampled_from([0.025, 0.05, 0.1]),
    start_m=st.floats(-1e4, 1e6),
    segment_m=st.none() | st.floats(0.2, 600.0),
    tracks=st.integers(1, 3),
)
def test_rows_are_those_of_the_iri_command_and_add_up(
    points: int, interval_m: float, start_m: float, segment_m: float | None, tracks: int
) -> None:
    profile = road(points, interval_m, start_m, tracks)
    rows, remarks = measure_segments(profile, segment_m)
    report = iri_report(profile, IriSettings(segment_m=segment_m))
    assert remarks == ()
    for track in report["tracks"]:
        mine = [row for row in rows if row.track == track["name"]]
        assert [row.segment for row in mine] == list(range(len(track["segments"])))
        for row, segment in zip(mine, track["segments"], strict=True):
            for key in SHARED:
                np.testing.assert_equal(getattr(row, key), segment[key])
            assert row.flagged_m == segment["invalid_m"] <= row.length_m
        # Each last point, one more than the intervals, may be one too many for its segment.
        assert sum(row.flagged_m for row in mine) == pytest.approx(
            track["invalid_m"], abs=1.01 * interval_m
        )
        assert sum(row.length_m for row in mine) == pytest.approx(profile.length_m)
    if segment_m is None:
        assert [r.iri_m_per_km for r in rows] == [t["iri_m_per_km"] for t in report["tracks"]]
        for key in (key for key in report if key.startswith("mean_roughness_index")):
            expected = np.nan if report[key] is None else report[key]
            np.testing.assert_equal(getattr(rows[0], key), expected)


def test_the_mean_is_of_both_wheel_paths_in_the_same_segment() -> None:
    rows, _ = measure_segments(road(4000, 0.05), 60.0)
    left, right = ([row for row in rows if row.track == name] for name in ("left", "right"))
    assert len(left) == 4
    for one, other in zip(left, right, strict=True):
        mean = (one.iri_m_per_km + other.iri_m_per_km) / 2
        assert one.mean_roughness_index_m_per_km == pytest.approx(mean)
        assert other.mean_roughness_index_m_per_km == one.mean_roughness_index_m_per_km


def test_flagged_points_count_in_the_segment_they_lie_in() -> None:
    valid = np.ones(1001, dtype=bool)
    valid[[0, 399, 400, 1000]] = False
    profile = Profile(0.1, (ProfileTrack.of("main", np.zeros(1001), valid),))
    rows, _ = measure_segments(profile, 20.0)
    assert [row.flagged_m for row in rows] == pytest.approx([0.1, 0.1, 0.1, 0.0, 0.1])


@pytest.mark.parametrize(
    ("profile", "segment_m", "count", "remark"),
    [
        (road(100, 0.05), None, 1, "track left: no IRI: .*the car needs 11 m"),
        (road(100, 0.05), 2.0, 3, "track left: no IRI: .*the car needs 11 m"),
        (road(100, 5.0), 100.0, 5, "track left: no IRI: interval is 5 m"),
        (road(1, 0.05), 10.0, 1, "track left: no IRI"),
        (road(3000, 0.05), 0.01, 1, "not cut into segments: segment is 0.01 m, less than"),
    ],
)
def test_a_profile_without_an_iri_has_rows_all_the_same(
    profile: Profile, segment_m: float | None, count: int, remark: str
) -> None:
    rows, remarks = measure_segments(profile, segment_m)
    assert [row.segment for row in rows if row.track == "left"] == list(range(count))
    assert all(np.isnan(row.iri_m_per_km) for row in rows)
    assert all(np.isnan(row.mean_roughness_index_m_per_km) for row in rows)
    assert sum(row.length_m for row in rows) == pytest.approx(2 * profile.length_m)
    assert any(re.match(remark, line) for line in remarks)


@pytest.mark.parametrize("segment_m", [0.0, -1.0, float("nan"), float("inf")])
def test_a_segment_that_is_none_is_refused(segment_m: float) -> None:
    with pytest.raises(InputError, match="segment_m is"):
        measure_segments(road(3000, 0.05), segment_m)


def test_places_are_those_of_the_segments_starts(recording: Recording) -> None:
    profile = road(3200, 0.05)
    rows, _ = measure_segments(profile, 50.0, recording)
    for row in rows:
        assert np.radians(row.latitude_deg) == pytest.approx(0.8 + row.start_m / 6.4e6, abs=1e-9)
        assert np.radians(row.longitude_deg) == pytest.approx(0.2)
    assert all(np.isnan(row.latitude_deg) for row in measure_segments(profile, 50.0)[0])
