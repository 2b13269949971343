"""Grades and curvatures are derivatives, and a vehicle feels them as on a lane of that grade."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.proving_ground.roads.alignment import Alignment, Crown, GradeBreak
from floatref_conformance.proving_ground.roads.road import flat_road
from floatref_conformance.proving_ground.roads.shaping import with_alignment
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.staging import alignment_of

lengths = st.floats(4.0, 60.0)
features = st.one_of(
    st.builds(Crown, st.floats(50.0, 150.0), lengths, st.floats(-0.15, 0.15)),
    st.builds(GradeBreak, st.floats(50.0, 150.0), lengths, st.floats(-0.06, 0.06)),
)
PLAIN = Scenario(road="flat", sensors=0.0, rate_hz=2000.0, gnss=False, length_m=400.0)


@pytest.mark.slow
@given(st.lists(features, min_size=1, max_size=3))
def test_grade_and_curvature_are_the_derivatives_of_the_height(found):
    alignment, x = Alignment(tuple(found)), np.linspace(0.0, 200.0, 40001)
    step = x[1] - x[0]
    rise = np.diff(alignment.height(x)) / step
    middle = (x[1:] + x[:-1]) / 2
    # The curvature jumps at the ends of a feature, and all may end at once: the grade in the middle
    # of a step differs by up to an eighth of that step times the jump, 1.2e-4 for the largest one.
    jumps = sum(np.abs(Alignment((each,)).curvature(x)).max() for each in found)
    np.testing.assert_allclose(rise, alignment.grade(middle), atol=jumps * step / 8 + 1e-6)
    bend = np.diff(alignment.grade(x)) / step
    apart = np.abs(bend - alignment.curvature(middle)) > 1e-3
    assert np.count_nonzero(apart) <= 2 * len(found)


@given(features)
def test_a_road_is_raised_by_its_alignment_and_remembers_it(feature):
    road = flat_road(180.0, spacing_m=0.1)
    raised = with_alignment(with_alignment(road, Alignment((feature,))), Alignment((feature,)))
    for name in road.tracks:
        np.testing.assert_allclose(raised.elevation[name], 2 * feature.height(road.distance_m))
    assert raised.alignment.features == (feature, feature)


@pytest.mark.slow
@pytest.mark.parametrize("speed_kmh", [36.0, 72.0])
def test_at_constant_speed_a_long_crown_accelerates_the_body_by_its_curvature(speed_kmh):
    """2π²·h/L² in the middle, times the speed squared; the body follows waves this long."""
    crown = {"crown_mm": 200.0, "crown_length_m": 160.0, "crown_at_m": 250.0}
    motion = simulate(replace(PLAIN, speed_kmh=speed_kmh, **crown)).motion
    expected = -((speed_kmh / 3.6) ** 2) * 2 * np.pi**2 * 0.2 / 160.0**2
    # The point is behind the centre of gravity: it is in the middle later.
    found = min(
        track.acceleration[motion.distance > 100.0].min() for track in motion.tracks.values()
    )
    assert found == pytest.approx(expected, rel=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("vehicle", ["loaded-van", "trailer"])
def test_behind_a_grade_break_all_is_as_on_a_lane_of_that_grade(vehicle):
    """Left out, the pull of gravity changes the pitch by 1.4e-3 to 3.5e-3 rad, at 2 to 5 deg/g."""
    drive = replace(
        PLAIN, vehicle=vehicle, manoeuvre="stop", event_at_m=250.0, deceleration_g=0.1, dwell_s=4.0
    )
    lane = simulate(replace(drive, grade_percent=4.0)).motion
    road = simulate(replace(drive, break_percent=4.0, break_length_m=20.0, break_at_m=60.0)).motion
    later = lane.distance > 120.0
    np.testing.assert_allclose(road.pitch[later], lane.pitch[later], atol=5e-4)
    for name, track in lane.tracks.items():
        other = road.tracks[name]
        for force in ("longitudinal", "vertical"):
            apart = getattr(other, force)[later] - getattr(track, force)[later]
            assert np.sqrt(np.mean(apart**2)) < 2e-3 * STANDARD_GRAVITY


@pytest.mark.parametrize("length", [0.0, -1.0, float("nan")])
def test_a_feature_without_length_is_refused(length):
    for made in (Crown, GradeBreak):
        with pytest.raises(InputError, match="must be above zero"):
            made(100.0, length, 0.01)


@given(at_m=st.floats(0.0, 400.0), length_m=st.floats(4.0, 60.0), crown=st.booleans())
def test_a_shape_behind_the_end_of_the_drive_is_refused(at_m, length_m, crown):
    """A stop on a crown that is not there must not go unseen."""
    name = "crown" if crown else "break"
    size = {"crown_mm": 50.0} if crown else {"break_percent": 2.0}
    place = {f"{name}_at_m": at_m, f"{name}_length_m": length_m}
    scenario = Scenario(road="flat", length_m=200.0, **size, **place)
    if at_m - length_m / 2 >= 200.0:
        with pytest.raises(InputError, match=rf"^{name}_at_m is .*; the drive ends at 200 m$"):
            alignment_of(scenario)
    else:
        assert alignment_of(scenario).features
