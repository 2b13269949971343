"""A profile of the same road is found where it lies, and a place that is not sure is none.

Law: a run moved by any distance is placed at that distance within one sample, whichever of the two
is longer and whatever its invalid points hold. Without a shape in common there is no place.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.locating.shift import Shift, find_shift, move
from floatref.values.profile import Profile, ProfileTrack

SAMPLE_M = 0.04
BEFORE_M = 30.0
FAR_M = st.floats(1.2, 400.0) | st.floats(-400.0, -1.2)
SPANS = st.lists(st.tuples(st.integers(0, 5000), st.integers(20, 700)), max_size=4)


def spoil(profile: Profile, spans: list[tuple[int, int]], seed: int) -> Profile:
    """Return ``profile`` with wild, invalid elevation in ``spans`` of first point and count."""
    draw, tracks = np.random.default_rng(seed), []
    for track in profile.tracks:
        elevation, valid = track.elevation.copy(), track.valid.copy()
        for first, count in spans:
            wild = elevation[first : first + count]
            wild += np.cumsum(draw.normal(0.0, 0.02, wild.size))
            valid[first : first + count] = False
        tracks.append(ProfileTrack.of(track.name, elevation, valid))
    return replace(profile, tracks=tuple(tracks))


@pytest.mark.slow
@settings(max_examples=12)
@given(far_m=FAR_M, spans=SPANS, seed=st.integers(0, 9), swapped=st.booleans())
def test_a_run_is_placed_where_it_was_moved_to(road, far_m, spans, seed, swapped) -> None:
    run = road.run(-BEFORE_M, 240.0, interval_m=SAMPLE_M, noise=0.1, seed=seed)
    run = replace(spoil(run, spans, seed), start_m=far_m - BEFORE_M)
    pair = (run, road.reference()) if swapped else (road.reference(), run)
    found = find_shift(*pair)
    expected = -far_m if swapped else far_m
    assert found.placement_m == pytest.approx(expected, abs=SAMPLE_M), found.note
    assert move(pair[1], found).start_m == pytest.approx(pair[1].start_m - expected, abs=SAMPLE_M)


@pytest.mark.parametrize("away_m", [0.0, 0.7, -0.9])
def test_within_a_metre_of_its_place_nothing_is_moved(road, away_m) -> None:
    run = replace(road.run(-BEFORE_M, 240.0), start_m=away_m - BEFORE_M)
    found = find_shift(road.reference(), run)
    assert found == Shift(0.0)
    assert move(run, found) is run


def of(z: np.ndarray) -> Profile:
    return Profile(0.05, (ProfileTrack.of("left", z),))


def wave(start_m: float) -> np.ndarray:
    return 0.01 * np.sin(2.0 * np.pi * (0.05 * np.arange(8000) - start_m) / 5.0)


NOISE = np.cumsum(np.random.default_rng(3).normal(0.0, 4e-4, (2, 8000)), axis=1)


@pytest.mark.parametrize(
    ("reference", "profile", "reason"),
    [
        (NOISE[0], NOISE[1], "which chance may reach"),
        (NOISE[0], np.zeros(8000), "flat, too short or too coarse"),
        (np.full(8000, 3.0), NOISE[0], "flat, too short or too coarse"),
        (wave(0.0), wave(2.3), "the road repeats itself"),
        (NOISE[0], NOISE[0][::-1], "it goes against the reference"),
    ],
)
def test_a_place_that_is_not_sure_is_none(reference, profile, reason) -> None:
    found = find_shift(of(reference), of(profile))
    assert not found.is_sure
    assert reason in found.note
    assert move(of(profile), found).start_m == 0.0


def test_exchanged_wheel_paths_and_feet_are_named_and_not_moved(road, changed) -> None:
    other = {"left": "right", "right": "left"}
    run = changed(road.run(-20.0, 220.0), lambda name, z: (other[name], z))
    assert "wheel paths fit in another order" in find_shift(road.reference(), run).note
    feet = road.run(-20.0, 220.0)
    feet = replace(feet, interval_m=feet.interval_m / 0.3048)
    assert "fits in ft, not in m" in find_shift(road.reference(), feet).note


def test_heights_upside_down_are_placed_and_named(road, changed) -> None:
    run = changed(road.run(-20.0, 220.0), lambda name, z: (name, -z))
    found = find_shift(road.reference(), replace(run, start_m=45.0))
    assert found.placement_m == pytest.approx(65.0, abs=1.0)
    assert "upside down" in found.note


def test_a_wheel_path_that_is_missing_is_refused(road) -> None:
    one = replace(road.run(), tracks=road.run().tracks[:1])
    with pytest.raises(InputError, match="right"):
        find_shift(road.reference(), one)
