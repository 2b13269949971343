"""Sections of a stream are those of `floatref iri` over the same points, in bounded memory."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref.live.monitor.sections import BEFORE, SECTION_M, SHOWN, Sections, newest
from floatref.live.points import LivePoints, State
from floatref.measures.roughness.iri_interval import NORMAL_95
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.valid_segments import segment_iris
from floatref.values.profile import ProfileTrack

SEEDS = st.integers(0, 2**31)
NO_SHRINK = [Phase.explicit, Phase.generate]
BY_SECTION = IriSettings(segment_m=SECTION_M)
FORGOTTEN = 1e-7
"""Part of the IRI that the car may still remember of where the points held begin."""


def expected_of(profile):
    return {
        track.name: segment_iris(track, profile.interval_m, BY_SECTION, profile.start_m)
        for track in profile.tracks
    }


def assert_equal(section, number, expected):
    for figures in section.tracks:
        segment = expected[figures.name][number]
        sigma = (segment.interval.high_m_per_km - segment.valid_m_per_km) / NORMAL_95
        found = (section.start_m, section.length_m, figures.counted_share)
        assert found == pytest.approx(
            (segment.start_m, segment.length_m, segment.counted_share), abs=1e-9
        )
        for one, other in (
            (figures.iri_m_per_km, segment.valid_m_per_km),
            (figures.sigma_m_per_km, sigma),
        ):
            assert one == pytest.approx(other, rel=FORGOTTEN, abs=FORGOTTEN, nan_ok=True)


@pytest.mark.slow
@settings(max_examples=25, deadline=None, phases=NO_SHRINK)
@given(
    SEEDS,
    st.sampled_from([0.05, 0.1, 0.25, 0.3]),
    st.floats(300.0, 1500.0),
    st.integers(-5000, 5000),
    st.booleans(),
)
def test_the_iri_of_sections_is_that_of_the_profile(made, seed, interval_m, length_m, first, sigma):
    profile = made.profile(seed, length_m, interval_m, ("left", "right"), first, sigma)
    sections = Sections(True)
    for points in made.points(profile, seed):
        sections.add(points)
    sections.close()
    expected = expected_of(profile)
    assert len(sections.finished) == len(expected["left"])
    for number, section in enumerate(sections.finished):
        assert_equal(section, number, expected)


@settings(max_examples=4, deadline=None, phases=NO_SHRINK)
@given(SEEDS, SEEDS, SEEDS)
def test_how_points_are_cut_changes_no_figure(made, road, one, other):
    profile = made.profile(road, 500.0, 0.25)
    found = []
    for seed in (one, other):
        sections = Sections(True)
        for points in made.points(profile, seed, most_m=300.0):
            sections.add(points)
        found.append([*sections.finished, sections.running()])
    assert repr(found[0]) == repr(found[1])


@settings(max_examples=3, deadline=None, phases=NO_SHRINK)
@given(SEEDS)
def test_memory_does_not_grow_with_the_run(made, seed):
    profile = made.profile(seed, 8000.0, 0.5)
    sections, most = Sections(True), round((BEFORE + 2) * SECTION_M / 0.5) + 40
    for points in made.points(profile, seed, most_m=400.0):
        sections.add(points)
        assert sections.held <= most
        assert all(t.elevation.base is None for t in sections._tracks if sections._number > BEFORE)
    assert len(sections.finished) == SHOWN


@settings(max_examples=8, deadline=None, phases=NO_SHRINK)
@given(SEEDS, st.one_of(st.floats(1.0, 600.0), st.floats(600.0, 2500.0)))
def test_a_gap_is_missing_points(made, seed, gap_m):
    before, behind = (made.profile(s, 500.0, 0.25) for s in (seed, seed + 1))
    gap = round(gap_m / 0.25)
    missing = ProfileTrack.of("left", np.full(gap, np.nan))
    whole, pieces = Sections(True), Sections(True)
    for points in made.points(before, seed):
        whole.add(points)
        pieces.add(points)
    end = before.tracks[0].elevation.size
    whole.add(LivePoints(end, 0.25, (missing,), State.FINAL))
    for points in made.points(behind, seed):
        moved = LivePoints(points.first + end + gap, 0.25, points.tracks, State.FINAL)
        whole.add(moved)
        pieces.add(moved)
    known = {s.start_m: repr(s) for s in whole.finished}
    assert [known[s.start_m] for s in pieces.finished] == [repr(s) for s in pieces.finished]
    assert repr(pieces.running()) == repr(whole.running())
    # Sections of the gap alone may be left out, and no other.
    left_out = set(known) - {s.start_m for s in pieces.finished}
    shares = {s.start_m: s.tracks[0].counted_share for s in whole.finished}
    assert {shares[start] for start in left_out} <= {0.0}


def test_a_profile_in_drawn_pieces_has_its_sections(made):
    profile = made.profile(7, 700.0, 0.25)
    sections = Sections(True)
    for points in made.points(profile, 7, most_m=200.0):
        sections.add(points)
    sections.close()
    for number, section in enumerate(sections.finished):
        assert_equal(section, number, expected_of(profile))


def test_provisional_sections_follow_the_final_ones_and_never_lie_on_them(made):
    final, provisional = Sections(True), Sections(False)
    for points in made.points(made.profile(1, 2000.0, first=37), 1, State.PROVISIONAL):
        provisional.add(points)
    for points in made.points(made.profile(2, 700.0), 1):
        final.add(points)
        provisional.realign(final.origin)
    for points in made.points(made.profile(3, 900.0, first=20_037), 1, State.PROVISIONAL):
        provisional.add(points)
    shown = newest(final, provisional)
    assert [s.is_final for s in shown] == sorted((s.is_final for s in shown), reverse=True)
    starts = np.array([s.start_m for s in shown])
    ends = starts + [s.length_m for s in shown]
    assert (starts[1:] > ends[:-1] - 0.5 * SECTION_M).all()
    # Those after the first final point lie where its sections lie.
    numbers = starts[starts > 2100.0] / SECTION_M
    assert numbers.size >= 3
    assert np.abs(numbers - np.rint(numbers)).max() < 1e-3


@pytest.mark.parametrize("before_m", [1.0, 5.0, 10.5, 12.0])
def test_a_stretch_that_begins_at_the_end_of_a_section_counts_there(made, before_m):
    profile = made.profile(3, 600.0, 0.25, sigma=False)
    track = profile.tracks[0]
    place = np.arange(track.valid.size) * 0.25
    cut = replace(track, valid=np.isfinite(place) & (place > 2.0 * SECTION_M - before_m))
    profile = replace(profile, tracks=(cut,))
    sections = Sections(True)
    for points in made.points(profile, 3, most_m=30.0):
        sections.add(points)
    expected = expected_of(profile)
    assert expected["left"][1].counted_share > 0.0
    for number, section in enumerate(sections.finished):
        assert_equal(section, number, expected)


@pytest.mark.parametrize("first", [0, 30, 643, 644, 645, 10_000])
def test_points_that_begin_behind_the_origin_have_the_sections_of_the_run(made, first):
    profile = made.profile(3, 600.0, 0.25, first=first)
    sections = Sections(False)
    sections.realign(0)
    for points in made.points(profile, 3):
        sections.add(points)
    found = [*sections.finished, sections.running()]
    starts = [s.start_m for s in found]
    edges = [0.25 * round(k * SECTION_M / 0.25) for k in range(40)]
    begun = max(e for e in edges if e <= first * 0.25)
    assert starts == [e for e in edges if begun <= e < first * 0.25 + 599.5]
    assert all(0.0 < s.tracks[0].counted_share <= 1.0 for s in found[1:-1])


def test_points_too_far_apart_for_the_car_have_no_section():
    track = ProfileTrack.of("left", np.zeros(5000))
    sections = Sections(True)
    sections.add(LivePoints(0, 2.5, (track,), State.FINAL))
    assert (list(sections.finished), sections.running(), sections.held) == ([], None, 0)
