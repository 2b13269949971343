"""Agreement against lateral separation: lines that are known are found as far apart as they are.

Law: on any course a line at a constant distance is found at that distance within a millimetre, to
its side. On simulated passes, whose lines are known, agreement falls with separation as in figures
4.9 and 4.10, and separations are those of the lines.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.files import write_recording
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.certify.judging.contents import RunSheet, RunTrack
from floatref_conformance.certify.judging.lateral import (
    EARTH_RADIUS_M,
    REFERENCE,
    Stretch,
    pair_runs,
    separation,
)
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.sections import Run, section_sheet, truth_of
from floatref_conformance.certify.plan.plan_document import SectionPlan
from floatref_conformance.certify.plan.trails import Trail, read_trail
from floatref_conformance.devices.builtin import process_quietly
from floatref_conformance.proving_ground import Scenario, simulate
from floatref_conformance.proving_ground.roads.wander import Line
from floatref_conformance.proving_ground.scenario import repeat_passes
from floatref_conformance.proving_ground.sensors.satellite import START_RAD

HERE = np.array(START_RAD)
SECTION = Stretch(20.0, 120.0)


def trail(
    left_m: float, heading: float = 0.0, curvature: float = 0.0, end_m: float = 150.0
) -> Trail:
    """Return a course from `HERE` on, ``left_m`` left of the one that turns with ``curvature``."""
    at = np.arange(0.0, end_m + 0.1, 0.5)
    turned = heading + curvature * at
    middle = turned - 0.5 * curvature * at
    chord = at * np.sinc(curvature * at / (2 * np.pi))
    north = chord * np.cos(middle) + left_m * np.sin(turned)
    east = chord * np.sin(middle) - left_m * np.cos(turned)
    latitude, longitude = HERE
    return Trail(
        at,
        np.degrees(latitude + north / EARTH_RADIUS_M),
        np.degrees(longitude + east / (EARTH_RADIUS_M * np.cos(latitude))),
    )


def sheet(name: str, iri: float) -> RunSheet:
    track = RunTrack("left", 0.9, 0.0, iri, 1.0, 0.9, 0.0, 0.0, 0.0, 0.0, 0.0)
    return RunSheet(name, name, (), (track,))


@given(
    left_m=st.floats(-2.0, 2.0),
    heading=st.floats(-3.0, 3.0),
    curvature=st.sampled_from([0.0, 1e-3, -2e-3]),
)
def test_a_line_beside_another_is_as_far_left_as_it_is(left_m, heading, curvature) -> None:
    found = separation(trail(0.0, heading, curvature), trail(left_m, heading, curvature), SECTION)
    assert found.shape == SECTION.steps().shape
    assert np.abs(found - left_m).max() < 1e-3


def test_pairs_have_separation_agreement_and_iri() -> None:
    runs = [sheet("a", 2.0), sheet("b", 2.1)]
    pairs = {"left": np.array([[np.nan, 0.95], [np.nan, np.nan]])}
    trails = {"a": trail(0.1), "b": trail(-0.2)}
    first, second, both = pair_runs(SECTION, runs, pairs, trails, trail(0.0))
    assert (first.first, first.second, second.second) == (REFERENCE, "a", "b")
    assert (first.left_m, second.left_m) == pytest.approx((0.1, -0.2), abs=1e-3)
    assert (both.first, both.second, both.agreement) == ("a", "b", 0.95)
    assert (both.separation_m, both.left_m) == pytest.approx((0.3, -0.3), abs=1e-3)
    assert both.iri_percent == pytest.approx(5.0)


@pytest.mark.parametrize("lacking", [None, trail(0.0, end_m=100.0), "hole"])
def test_without_the_places_of_one_run_there_is_no_table(lacking) -> None:
    if lacking == "hole":
        latitude = trail(0.0).latitude.copy()
        latitude[100] = np.nan
        lacking = replace(trail(0.0), latitude=latitude)
    runs, pairs = [sheet("a", 2.0), sheet("b", 2.0)], {"left": np.full((2, 2), 0.9)}
    assert not pair_runs(SECTION, runs, pairs, {"a": trail(0.0), "b": lacking}, trail(0.0))


def on_its_line(recording: Recording, line: Line) -> Recording:
    """Return ``recording``, whose course is northward, with fixes on the line that it drove."""
    latitude, longitude = HERE
    fixes = recording.find("gnss_latitude", recording.tracks[0])
    assert fixes is not None
    north = (fixes.values - latitude) * EARTH_RADIUS_M
    places = {
        "gnss_latitude": fixes.values,
        "gnss_longitude": longitude - line.at(north) / (EARTH_RADIUS_M * np.cos(latitude)),
    }
    channels = tuple(
        replace(c, values=places[c.id.name]) if c.id.name in places else c
        for c in recording.channels
    )
    return replace(recording, channels=channels)


@pytest.mark.slow
def test_agreement_falls_with_separation_on_simulated_passes(tmp_path: Path) -> None:
    drive = Scenario(
        seed=41,
        length_m=200.0,
        wander_m=0.15,
        wander_within_m=0.02,
        rate_hz=1000.0,
        imu=False,
        response=False,
    )
    passes = repeat_passes(drive, 5)
    lines = [Line(one.seed, one.wander_m, one.wander_within_m) for one in passes]
    runs = []
    for k, (one, line) in enumerate(zip(passes, lines, strict=True)):
        recording = on_its_line(simulate(one).recording, line)
        write_recording(recording, tmp_path / f"run-{k}")
        profile = process_quietly(recording, "temporal-basic")
        place = read_trail(tmp_path / f"run-{k}", profile)
        runs.append(Run(f"run-{k}", f"run-{k}", (), profile, trail=place))
    truth = simulate(replace(drive, wander_m=0.0, wander_within_m=0.0)).truth
    plan = SectionPlan("main", Path("reference"), (), (40.0, 170.0))
    found = section_sheet(plan, truth_of(plan, truth), runs, CertificationLimits(runs=5)).lateral
    at = np.arange(40.0, 170.0, 0.5)
    for one in found:
        first, second = (lines[int(name[-1])].at(at) for name in (one.first, one.second))
        assert one.separation_m == pytest.approx(np.abs(second - first).mean(), abs=0.02)
    assert len(found) == 20
    apart, agreed = np.array([(one.separation_m, one.agreement) for one in found]).T
    assert np.corrcoef(apart, agreed)[0, 1] < -0.5


def test_a_profile_is_no_recording(tmp_path: Path) -> None:
    profile = Profile(0.1, (ProfileTrack.of("left", np.zeros(9)),))
    assert read_trail(tmp_path, profile) is None
