"""Wheel paths without a name in common are matched by their road, and else refused."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.locating.matching import match_names


@settings(max_examples=6, deadline=None)
@given(names=st.permutations(["a", "b"]), longer=st.booleans())
def test_each_road_gets_the_name_that_the_reference_has(road, changed, names, longer):
    mine = dict(zip(("left", "right"), names, strict=True))
    length_m = 260.0 if longer else 120.0
    run = road.run(20.0 if not longer else -30.0, length_m)
    other = changed(run, lambda name, z: (mine[name], z))
    found, notes = match_names(road.reference(), other)
    assert len(notes) == 2
    for name in ("left", "right"):
        assert (found.track(name).elevation == run.track(name).elevation).all()


def test_a_profile_with_all_names_stays_as_it_is(road) -> None:
    run = road.run()
    assert match_names(road.reference(), run) == (run, ())


@pytest.mark.parametrize("second", ["another road", "the same road", "nothing"])
@pytest.mark.parametrize("start_m", [20.0, -30.0])
def test_a_wheel_path_that_is_left_over_is_not_the_one_that_is_missing(
    road, roads, changed, second, start_m
) -> None:
    run = road.run(start_m, 260.0 if start_m < 0.0 else 120.0)
    others = {
        "another road": roads(8).run(0.0, 260.0).track("right").elevation,
        "the same road": run.track("left").elevation,
        "nothing": np.zeros(run.track("left").elevation.size),
    }
    mine = {"left": "a", "right": "b"}
    other = changed(
        run,
        lambda name, z: (mine[name], z if name == "left" else np.resize(others[second], z.size)),
    )
    with pytest.raises(InputError, match="give both the same names"):
        match_names(road.reference(), other)


@pytest.mark.parametrize("names", [("left", "b"), ("a", "b")])
def test_one_name_in_common_or_another_road_is_refused(road, roads, changed, names) -> None:
    mine = dict(zip(("left", "right"), names, strict=True))
    run = (road if "left" in names else roads(8)).run()
    with pytest.raises(InputError, match="give both the same names"):
        match_names(road.reference(), changed(run, lambda name, z: (mine[name], z)))
