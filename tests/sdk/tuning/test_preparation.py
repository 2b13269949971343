"""Before the search: what runs are told apart as, and what cannot be used."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.tuning.preliminary_runs import Kind
from floatref.tuning.preparation import Prepared, check_pipeline, prepare
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref_conformance.proving_ground.simulate import Simulation

PIPELINE = "kalman-smoother-reflection"
Driven = Callable[..., Simulation]
Given = dict[str, float]


def shifted(profile: Profile, by_m: float) -> Profile:
    return replace(profile, start_m=profile.start_m + by_m)


def prepared(reference: Profile, given: Given, **recordings: Recording) -> Prepared:
    return prepare(recordings, reference, PIPELINE, given)


def without(recording: Recording, *names: str) -> Recording:
    kept = tuple(c for c in recording.channels if c.id.name not in names)
    return replace(recording, channels=kept)


@pytest.mark.slow
def test_runs_are_told_apart_and_the_nominal_profiler_is_good_at_speed_alone(
    driven: Driven, given: Given
) -> None:
    fast, stop = driven("fast"), driven("stop")
    found = prepared(fast.truth, given, fast=fast.recording, stop=stop.recording)
    assert found.kinds == {"fast": Kind.HIGH, "stop": Kind.SHORT}
    assert len(found.missing) == 4
    assert min(score.cross_correlation for score in found.nominal["fast"]) > 0.95
    assert max(score.cross_correlation for score in found.nominal["stop"]) < 0.5
    (place,) = found.runs["stop"].comparison.drive.critical_m
    assert place == pytest.approx(90.0, abs=1.0)


def test_a_run_is_compared_beyond_its_run_in(driven: Driven, given: Given) -> None:
    fast = driven("fast")
    comparison = prepared(fast.truth, given, fast=fast.recording).runs["fast"].comparison
    assert comparison.begin_m == pytest.approx(15.0, abs=0.5)
    assert comparison.end_m == pytest.approx(145.0, abs=0.5)


@pytest.mark.slow
def test_without_high_speed_there_is_no_tuning(driven: Driven, given: Given) -> None:
    stop = driven("stop")
    with pytest.raises(InputError, match=r"no run at a constant speed.*\(stop: short stop\)"):
        prepared(stop.truth, given, stop=stop.recording)


def test_another_road_is_refused(driven: Driven, given: Given) -> None:
    fast, other = driven("fast"), driven("fast", road_seed=4)
    with pytest.raises(InputError, match=r"fast: track left correlates by .* of the same road"):
        prepared(other.truth, given, fast=fast.recording)


def test_another_start_of_distance_is_refused_with_the_offset(driven: Driven, given: Given) -> None:
    fast = driven("fast")
    with pytest.raises(InputError, match=r"at an offset of (3\.9\d|4\.0\d) m: give a larger"):
        prepared(shifted(fast.truth, -4.0), given, fast=fast.recording)


@pytest.mark.parametrize("by_m", [500.0, 100.0])
def test_a_reference_elsewhere_is_refused(driven: Driven, given: Given, by_m: float) -> None:
    fast = driven("fast")
    with pytest.raises(InputError, match=r"^fast: the reference is valid from .* the same start"):
        prepared(shifted(fast.truth, by_m), given, fast=fast.recording)


def test_a_wheel_path_that_is_missing_is_named(driven: Driven, given: Given) -> None:
    fast = driven("fast")
    left, right = fast.truth.tracks
    renamed = ProfileTrack.of("middle", right.elevation)
    reference = replace(fast.truth, tracks=(left, renamed))
    with pytest.raises(InputError, match="fast: track middle of the reference is missing"):
        prepared(reference, given, fast=fast.recording)


def test_a_wheel_path_beyond_those_of_the_reference_is_left_out(
    driven: Driven, given: Given
) -> None:
    fast = driven("fast")
    reference = replace(fast.truth, tracks=fast.truth.tracks[1:])
    found = prepared(reference, given, fast=fast.recording)
    assert len(found.nominal["fast"]) == 1


@pytest.mark.parametrize("names", [("pitch_rate",), ("longitudinal_specific_force",)])
def test_a_recording_without_imu_is_named(
    driven: Driven, given: Given, names: tuple[str, ...]
) -> None:
    fast = driven("fast")
    with pytest.raises(InputError, match=rf"^fast: channel .*{names[0]}.*missing"):
        prepared(fast.truth, given, fast=without(fast.recording, *names))


def test_a_reference_with_nothing_valid_is_refused(driven: Driven, given: Given) -> None:
    fast = driven("fast")
    tracks = tuple(
        ProfileTrack.of(t.name, t.elevation, np.zeros(t.elevation.size, np.bool_))
        for t in fast.truth.tracks
    )
    with pytest.raises(InputError, match="the reference is valid nowhere"):
        prepared(replace(fast.truth, tracks=tracks), given, fast=fast.recording)


def test_a_pipeline_without_these_settings_is_refused() -> None:
    with pytest.raises(InputError, match=r"temporal-basic: has no .* take kalman-filter, "):
        check_pipeline("temporal-basic", {})
    with pytest.raises(InputError, match="setting acceleration: "):
        check_pipeline(PIPELINE, {"acceleration": 1.0})
    with pytest.raises(InputError, match="must be finite and above zero"):
        check_pipeline(PIPELINE, {"acceleration_walk": 0.0})
    assert check_pipeline(PIPELINE, {"acceleration_walk": 2.0})["acceleration_walk"] == 2.0
