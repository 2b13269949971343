"""A run is recognised, whatever was done to it, and put back where the reference has it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import agreement, on_common_grid
from floatref.measures.locating.placing import apply_placement, place
from floatref.measures.locating.profile_units import DISTANCE_UNITS, HEIGHT_UNITS
from floatref.values.profile import Profile, ProfileTrack


def correlations(reference, run):
    expected, found = on_common_grid(reference, run)
    return [
        agreement(t.elevation, found.track(t.name).elevation, expected.interval_m).cross_correlation
        for t in expected.tracks
    ]


def put(reference, run):
    placement = place(reference, run)
    assert placement.found, placement.notes
    return placement, apply_placement(run, placement)


@pytest.mark.parametrize("start_m", [0.0, 0.8, -0.8])
def test_a_run_that_lies_right_comes_back_as_the_same_object(road, start_m) -> None:
    run = replace(road.run(start_m - 1.0, 165.0), start_m=-1.0)
    placement, result = put(road.reference(), run)
    assert result is run
    assert placement.notes == ()


@pytest.mark.slow
@settings(max_examples=12, deadline=None)
@given(
    start_m=st.floats(-55.0, -1.5),
    interval_m=st.sampled_from([0.005, 0.0254, 0.04, 0.1]),
    gain=st.floats(0.9, 1.1),
    mirrored=st.booleans(),
    distance=st.sampled_from(["m", "ft", "in", "yd", "cm"]),
    height=st.sampled_from(sorted(HEIGHT_UNITS)),
)
def test_all_that_was_done_to_a_run_is_undone(
    road, changed, start_m, interval_m, gain, mirrored, distance, height
) -> None:
    reference = road.reference()
    run = road.run(start_m, 300.0, interval_m, gain=gain, noise=0.1)
    names = {"left": "right", "right": "left"} if mirrored else {}
    unit = 1.0 / HEIGHT_UNITS[height]
    order = slice(None, None, -1 if mirrored else 1)
    given_run = changed(run, lambda name, z: (names.get(name, name), unit * z[order]))
    given_run = replace(given_run, interval_m=interval_m / DISTANCE_UNITS[distance])
    placement, result = put(reference, given_run)
    assert placement.reversed == mirrored
    assert not placement.inverted
    assert (placement.distance_unit, placement.height_unit) == (distance, height)
    assert placement.offset_m == pytest.approx(-start_m, abs=0.1)
    assert min(correlations(reference, result)) > 0.85
    assert place(reference, result).notes == ()


@pytest.mark.parametrize("mirrored", [False, True])
def test_heights_upside_down_are_said_and_stay_a_fault(road, changed, mirrored) -> None:
    reference, run = road.reference(), road.run(-20.0, 250.0, noise=0.1)
    order = slice(None, None, -1 if mirrored else 1)
    turned = changed(run, lambda name, z: (name, -1000.0 * z[order]))
    placement, result = put(reference, turned)
    assert placement.inverted
    assert (placement.reversed, placement.height_unit) == (mirrored, "mm")
    assert any("upside down" in line for line in placement.notes)
    assert max(correlations(reference, result)) < 0.5
    upright = changed(result, lambda name, z: (name, -z))
    assert min(correlations(reference, upright)) > 0.85


@pytest.mark.parametrize("unit", sorted(DISTANCE_UNITS))
def test_every_unit_of_distance_is_told(road, unit) -> None:
    run = road.run(-20.0, 250.0, 0.05)
    slipped = replace(run, interval_m=run.interval_m / DISTANCE_UNITS[unit])
    placement, _ = put(road.reference(), slipped)
    assert placement.distance_unit == unit
    assert any(f"in {unit}," in s for s in placement.notes) == (unit != "m")


@pytest.mark.slow
@settings(max_examples=15, deadline=None)
@given(percent=st.floats(-5.0, 5.0), start_m=st.floats(-50.0, -20.0))
def test_errors_of_distance_do_not_hide_the_section(road, percent, start_m) -> None:
    scale = 1.0 + percent / 100.0
    run = road.run(start_m, 300.0, scale=scale)
    placement, _ = put(road.reference(), run)
    # Its place is that of the section's beginning.
    assert placement.offset_m == pytest.approx(-start_m * scale, abs=0.1)


def test_a_run_whose_lag_crosses_the_search_somewhere_stays_where_it_is(road) -> None:
    run = road.run(-1.5, 250.0, scale=0.98)
    placement, result = put(road.reference(), run)
    assert result is run
    assert placement.offset_m == 0.0


def test_exchanged_wheel_paths_are_put_right(road, changed) -> None:
    other = {"left": "right", "right": "left"}
    run = changed(road.run(), lambda name, z: (other[name], z))
    placement, result = put(road.reference(), run)
    assert placement.tracks == other
    assert placement.notes == ("wheel paths left and right are exchanged: put right",)
    assert min(correlations(road.reference(), result)) > 0.99


@pytest.mark.parametrize("name", ["left", "right"])
def test_a_run_of_one_wheel_path_tells_which(road, name) -> None:
    run = road.run()
    single = replace(run, tracks=(ProfileTrack.of("main", run.track(name).elevation),))
    placement, result = put(road.reference(), single)
    assert placement.tracks == {name: "main"}
    assert [t.name for t in result.tracks] == [name]
    lacking = ({"left", "right"} - {name}).pop()
    assert f"wheel path {lacking} of the reference is missing in the run" in placement.notes


def test_a_dead_wheel_path_does_not_hide_the_other(road, changed) -> None:
    run = changed(road.run(-30.0, 220.0), lambda name, z: (name, z * (name == "right")))
    placement, _ = put(road.reference(), run)
    assert placement.tracks == {"left": "left", "right": "right"}
    assert placement.offset_m == pytest.approx(30.0, abs=0.05)


def test_gaps_artefacts_and_flags_do_not_move_a_run(road) -> None:
    run = road.run(-30.0, 220.0)
    tracks = []
    for track in run.tracks:
        z, valid = track.elevation.copy(), np.ones(track.elevation.size, bool)
        z[2000:2200] = np.nan
        z[3500:3600] += np.linspace(0.0, 0.5, 100)
        z[3600:] += 0.5
        valid[1000:1400] = False
        tracks.append(ProfileTrack.of(track.name, z, valid))
    placement, _ = put(road.reference(), replace(run, tracks=tuple(tracks)))
    assert placement.offset_m == pytest.approx(30.0, abs=0.1)


def test_a_section_lies_somewhere_in_a_run_of_many_kilometres(road, roads) -> None:
    before = roads(11, 5000.0)
    run = road.run(0.0, 400.0, 0.05)
    tracks = [
        ProfileTrack.of(t.name, np.concatenate((z[::10], t.elevation)))
        for t, z in zip(run.tracks, (before.left, before.right), strict=True)
    ]
    placement, _ = put(road.reference(), replace(run, tracks=tuple(tracks)))
    assert placement.offset_m == pytest.approx(5000.0, abs=0.1)


@pytest.mark.slow
def test_another_road_is_not_found_and_it_is_said_what_was_tried(road, roads) -> None:
    for seed in range(20, 25):
        run = roads(seed).run(-50.0, 600.0)
        placement = place(road.reference(), run)
        assert not placement.found
        assert apply_placement(run, placement) is run
        assert "the best correlation is" in placement.notes[0]


def test_a_run_that_ends_early_says_how_much_is_missing(road) -> None:
    placement, _ = put(road.reference(), road.run(0.0, 70.0))
    assert not placement.moves
    assert placement.notes == (
        "the run covers 70.0 m of the section's 160.9 m, from 0.0 to 70.0 m",
    )


@pytest.mark.parametrize("shape", ["run", "reference"])
def test_a_constant_profile_is_not_found(road, shape) -> None:
    flat = Profile(0.025, tuple(ProfileTrack.of(n, np.full(8000, 3.0)) for n in ("left", "right")))
    pair = (road.reference(), flat) if shape == "run" else (flat, road.run())
    placement = place(*pair)
    assert not placement.found
    assert len(placement.notes) == 1


def test_of_the_repeats_of_a_road_the_nearest_is_taken_and_said() -> None:
    at = np.arange(0.0, 400.0, 0.05)
    slabs = 0.004 * np.abs(np.sin(np.pi * at / 5.0))
    reference = Profile(0.05, (ProfileTrack.of("main", slabs[:3200]),))
    run = Profile(0.05, (ProfileTrack.of("main", slabs[34:]),))
    placement, _ = put(reference, run)
    assert placement.offset_m == pytest.approx(-1.7, abs=0.05)
    assert any("the road repeats itself" in s for s in placement.notes)


@pytest.mark.slow
@settings(max_examples=15, deadline=None)
@given(percent=st.floats(0.2, 5.0), length_m=st.sampled_from([160.0, 400.0]))
def test_a_road_that_does_not_repeat_itself_is_not_said_to(road, percent, length_m) -> None:
    run = road.run(-30.0, length_m + 60.0, scale=1.0 + percent / 100.0, noise=0.5)
    placement, _ = put(road.reference(length_m=length_m), run)
    assert placement.alternatives == 0


def test_a_reference_that_is_not_in_metres_is_told(road, changed) -> None:
    reference = changed(road.reference(), lambda name, z: (name, 1000.0 * z))
    placement, _ = put(reference, road.run())
    assert placement.height_factor == 1.0
    assert any("the reference seems to be in mm" in s for s in placement.notes)


def test_validity_and_sigma_follow_their_points(road) -> None:
    run = road.run(-30.0, 220.0)
    tracks = [
        ProfileTrack.of(
            t.name, -1000.0 * t.elevation[::-1], np.arange(t.elevation.size) % 7 > 0, t.elevation**2
        )
        for t in run.tracks
    ]
    turned = replace(run, tracks=tuple(tracks))
    placement, result = put(road.reference(), turned)
    assert placement.tracks == {"left": "left", "right": "right"}
    for before, after in zip(tracks, result.tracks, strict=True):
        assert np.array_equal(after.valid, before.valid[::-1])
        assert after.sigma == pytest.approx(before.sigma[::-1] / 1000.0)
        assert after.elevation == pytest.approx(before.elevation[::-1] / 1000.0)
