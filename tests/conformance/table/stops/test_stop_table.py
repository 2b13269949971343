"""Making a table of drawn stops: which are driven, by what, and who is at fault."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.files import read_recording, write_profile
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.devices import builtin
from floatref_conformance.errors import SuiteError
from floatref_conformance.table.stops import StopScores, StopSettings, make_stop_table, summary
from floatref_conformance.table.stops import stop_settings as settings_module

TOLD_SIGMA_M = 0.5
PIPELINES = ("temporal-basic", "spatial-basic")


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Let every drive be short and slowly sampled."""
    drawn = settings_module.draw_stop

    def short(*arguments):
        return replace(drawn(*arguments), dwell_s=0.5, rate_hz=1000.0, profile_interval_m=0.025)

    monkeypatch.setattr(settings_module, "draw_stop", short)


def flat(_device, recording, target):
    """Deliver a level road as long as the recording says, and a sigma of half a metre."""
    read = read_recording(recording)
    length_m = float(read.channel("distance").values[-1])
    z = np.zeros(int(length_m / read.setup.profile_interval_m))
    sigma = np.full(z.size, TOLD_SIGMA_M)
    tracks = tuple(ProfileTrack.of(name, z, sigma=sigma) for name in ("left", "right"))
    write_profile(Profile(read.setup.profile_interval_m, tracks), target)


@pytest.mark.slow
def test_every_drive_is_announced_and_every_wheel_path_counts():
    seen = []
    settings = StopSettings(seed=3, stops=1, vehicles=("minivan",), pipelines=PIPELINES)
    table = make_stop_table(settings, seen.append)
    assert seen == [f"minivan, {road} road: stop 1" for road in ("smooth", "fair", "rough")]
    for pipeline in PIPELINES:
        paths = table.of(pipeline)
        assert [path.track for path in paths] == ["left", "right"] * 3
        assert len({path.scores.cross_correlation for path in paths}) == len(paths)
        assert all(path.scores.within_two_sigma_percent is None for path in paths)
    narrow = make_stop_table(replace(settings, pipelines=PIPELINES[1:]))
    assert narrow.paths == table.of(PIPELINES[1])


@pytest.mark.slow
def test_sigma_gets_from_the_device_to_the_table(monkeypatch):
    monkeypatch.setattr(builtin.BuiltinDevice, "run", flat)
    settings = StopSettings(stops=1, vehicles=("pickup",), pipelines=PIPELINES[:1])
    for path in make_stop_table(settings).paths:
        assert path.scores.within_two_sigma_percent == 100.0
        assert path.scores.within_two_sigma_true_distance_percent == 100.0
        assert path.scores.iri_error_percent == pytest.approx(-100.0)


@pytest.mark.slow
def test_a_pipeline_that_fails_is_named_with_its_drive(monkeypatch):
    def broken(_device, _recording, _target):
        raise ZeroDivisionError("out\nof luck")

    monkeypatch.setattr(builtin.BuiltinDevice, "run", broken)
    said = r"^pipeline temporal-basic, trailer, smooth road: stop 1: out of luck$"
    with pytest.raises(SuiteError, match=said):
        make_stop_table(StopSettings(vehicles=("trailer",), pipelines=PIPELINES[:1]))


@pytest.mark.slow
def test_a_profile_that_ends_early_is_no_score(monkeypatch):
    def short(_device, _recording, target):
        tracks = tuple(ProfileTrack.of(name, np.zeros(10000)) for name in ("left", "right"))
        write_profile(Profile(0.025, tracks, 0.0), target)

    monkeypatch.setattr(builtin.BuiltinDevice, "run", short)
    said = r"stop 1: the profile covers 0.0 m to 250.0 m; 220.0 m to 380.9 m count$"
    with pytest.raises(SuiteError, match=said):
        make_stop_table(StopSettings(vehicles=("trailer",), pipelines=PIPELINES[:1]))


def test_a_summary_is_of_ranks_and_magnitudes(hand_stops):
    settings = StopSettings(stops=7, pipelines=PIPELINES[:1])
    scores = [StopScores(k / 104, 52.0 - k, 1.0, 90.0 + k / 52, 50.0) for k in range(105)]
    table = hand_stops(scores, settings)
    found = summary(table.of(PIPELINES[0]))
    assert found.wheel_paths == settings.passes == 105
    assert found.cross_correlation_median == pytest.approx(0.5)
    assert found.cross_correlation_percentile_1 == pytest.approx(0.01)
    assert found.cross_correlation_lowest == 0.0
    assert found.iri_error_median_percent == pytest.approx(26.0)
    assert found.iri_error_largest_percent == pytest.approx(52.0)
    ends = found.within_two_sigma_percent
    assert (ends.lowest, ends.median, ends.highest) == pytest.approx((90.0, 91.0, 92.0))
    assert table.lowest(PIPELINES[0]) == table.paths[0]
    with pytest.raises(InputError, match="no wheel path"):
        summary(())


def test_a_group_is_of_its_vehicle_or_its_road(hand_stops):
    settings = StopSettings(stops=2, pipelines=PIPELINES[:1])
    table = hand_stops([StopScores(0.5, 0.0, 1.0)], settings)
    trailers = table.of(PIPELINES[0], vehicle="trailer")
    assert len(trailers) == 6
    assert {path.scenario.vehicle for path in trailers} == {"trailer"}
    measured = table.of(PIPELINES[0], road="measured")
    assert len(measured) == 10
    assert {path.scenario.iri_m_per_km for path in measured} == {4.0}
    assert table.of(PIPELINES[1]) == ()
