"""`distance` reads how far features lie from where the encoder has them."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.conformance.checks.benches import OneRecording, taken_of

import floatref
from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.distance.feature_places import DistanceCheck
from floatref_conformance.checks.distance.features import Feature, middles, place
from floatref_conformance.checks.encoder_axis import EncoderAxis, sensing_ahead_m
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description, visible
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.proving_ground.staging import drive_of

START, SCALE, STEP, REST, LOSS = DistanceCheck().limits
FIRST, SECOND = (DistanceCheck(edition=find_edition(name)) for name in ("2026.1", "2026.2"))
both = pytest.mark.parametrize("check", [FIRST, SECOND], ids=["2026.1", "2026.2"])


@pytest.fixture(scope="module")
def stopped():
    """A stop whose sensors have no errors: the encoder tells the true distance."""
    return taken_of(replace(DistanceCheck().simplest.scenario, sensors=0.0))


def known(taken, change=lambda z: z, stretched=1.0, start_m=0.0, interval_m=None):
    """Return the truth behind the profile's filter, changed, on a changed axis."""
    given = taken.truth.interval_m
    every = 1 if interval_m is None else round(interval_m / given)
    tracks = tuple(
        ProfileTrack.of(t.name, change(high_pass(t.elevation, given))[::every])
        for t in taken.truth.tracks
    )
    return Profile(stretched * given * every, tracks, start_m)


def judged(taken, check=SECOND, **spoiled):
    case = Case("distance", taken.scenario)
    return check.judge(case, OneRecording(taken, lambda t: known(t, **spoiled)))


def read(taken, **spoiled):
    measured = judged(taken, **spoiled)
    return {
        name: max(m.value for m in measured if m.quantity == name)
        for name in DistanceCheck().limits
    }


def failing(taken, device_class=DeviceClass.NOMINAL, check=SECOND, **spoiled):
    return {m.quantity for m in judged(taken, check, **spoiled) if not m.within(device_class)}


@pytest.mark.slow
def test_the_truth_keeps_every_limit_of_the_strictest_class(stopped):
    assert failing(stopped, DeviceClass.REFERENCE) == set()


def averaged(taken, length_m):
    window = round(length_m / taken.truth.interval_m) | 1
    return lambda z: np.convolve(z, np.full(window, 1 / window), "same")


@pytest.mark.slow
@pytest.mark.parametrize("interval_m", [0.05, 0.25])
def test_a_coarser_profile_that_is_averaged_first_has_its_features_in_place(stopped, interval_m):
    assert failing(stopped, change=averaged(stopped, interval_m), interval_m=interval_m) == set()


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(shift_m=st.floats(-2.0, 2.0))
def test_a_shifted_start_is_read_as_such_and_as_nothing_else(stopped, shift_m):
    values = read(stopped, start_m=shift_m)
    assert values[START] == pytest.approx(abs(shift_m), abs=0.006)
    assert max(values[SCALE], values[STEP], values[REST]) < 0.01


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(percent=st.floats(-0.25, 0.25))
def test_an_error_of_scale_is_read_in_percent(stopped, percent):
    values = read(stopped, stretched=1 + percent / 100)
    assert values[SCALE] == pytest.approx(abs(percent), abs=0.006)
    assert max(values[START], values[STEP], values[REST]) < 0.03


def test_a_scale_of_one_percent_fails(stopped):
    assert SCALE in failing(stopped, stretched=1.01)


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(metres=st.floats(0.06, 1.5))
def test_distance_that_is_lost_at_the_stop_is_read_as_a_step(stopped, metres):
    count = round(metres / stopped.truth.interval_m)
    at = round(stopped.scenario.event_at_m / stopped.truth.interval_m)

    def cut(z):
        return np.concatenate([z[:at], z[at + count :]])

    values = read(stopped, change=cut)
    assert values[STEP] == pytest.approx(count * stopped.truth.interval_m, abs=0.006)
    assert failing(stopped, change=cut) == {STEP}


def test_a_flat_and_a_smoothed_profile_lose_the_features(stopped):
    assert read(stopped, change=lambda z: 0.0 * z)[LOSS] == pytest.approx(1.0)
    assert LOSS in failing(stopped, change=averaged(stopped, 2.0))


def test_points_without_elevation_are_an_error_in_a_feature_alone(stopped):
    def without(start, end):
        x = stopped.truth.distance_m
        return lambda z: np.where((x >= start) & (x < end), np.nan, z)

    event = stopped.scenario.event_at_m
    assert failing(stopped, change=without(0.0, 106.0)) == set()
    assert failing(stopped, change=without(event - 47.0, event + 55.0)) == set()
    with pytest.raises(DeviceError, match="points without elevation"):
        read(stopped, change=without(event + 61.0, event + 62.0))


@pytest.mark.slow
@both
def test_an_encoder_that_is_wrong_by_a_known_share_has_the_features_there(check):
    scenario = check.cases(1, Effort.QUICK)[1].scenario
    assert scenario.encoder_error_percent == 1.0
    taken = taken_of(replace(scenario, sensors=0.0))
    assert failing(taken, DeviceClass.REFERENCE, check, stretched=1.01) == set()
    # Only the first edition has the encoder's axis alone; between both axes lies neither.
    assert (SCALE in failing(taken, check=check)) is (check is FIRST)
    assert SCALE in failing(taken, check=check, stretched=1.005)


@pytest.mark.slow
@both
def test_a_profile_along_the_true_distance_counts_where_the_edition_allows_it(check):
    scenario = check.cases(0, Effort.QUICK)[0].scenario
    taken = taken_of(replace(scenario, slip_percent_per_g=12.0, rate_hz=4000.0))
    along_encoder = check.judge(Case("distance", scenario), OneRecording(taken, make_perfect))
    assert all(m.within(DeviceClass.REFERENCE) for m in along_encoder)
    assert (STEP in failing(taken, check=check)) is (check is FIRST)
    assert (failing(taken, DeviceClass.REFERENCE, check) == set()) is (check is SECOND)


def test_the_text_says_how_much_the_editions_encoder_loses_and_which_axis_counts():
    # From 48 to 24 km/h: (13.33² - 6.67²) / (2·9.80665) m, times the slip per g.
    lost_m = (48**2 - 24**2) / 3.6**2 / (2 * 9.80665)
    for check, slip, words in ((FIRST, 0.03, "must use this axis"), (SECOND, 0.12, "may use the")):
        assert f"up to {100 * slip:g} % per g" in check.derivation
        assert f"loses {slip * lost_m:.2f} m" in check.derivation
        assert words in check.derivation
    assert "loses 0.20 m" in FIRST.derivation
    assert "loses 0.82 m" in SECOND.derivation


@pytest.mark.slow
def test_the_axis_of_an_encoder_that_slips_is_what_it_told():
    taken = taken_of(DistanceCheck().cases(1, Effort.QUICK)[0].scenario)
    channel = taken.recording.channel("distance")
    true = drive_of(taken.scenario).motion(channel.times_s).distance
    axis = EncoderAxis.of(taken)
    some = np.linspace(0, true.size - 1, 5000).astype(int)
    assert axis.to_encoder(true[some]) == pytest.approx(channel.values[some], abs=0.0004)
    assert axis.to_true(channel.values[some]) == pytest.approx(true[some], abs=0.001)
    assert np.abs(true - channel.values).max() > 0.2


def seen_by_wheels(taken):
    """Return ``taken`` for a device without a height sensor, and what it can know at best.

    The road under the front wheel, where the encoder tells the wheel to be by the setup.
    """
    said = Description("fake", "1", "response", ("response",))
    recording = visible(taken.recording, said.channels)
    place, encoder = recording.setup.tracks["left"], recording.channel("distance")
    ahead = recording.setup.vehicle.x_m - place.reference_point_m[0]
    true = drive_of(taken.scenario).motion(encoder.times_s).distance + ahead
    points = 0.05 * np.arange(int((encoder.values[-1] + ahead) / 0.05))
    under = np.interp(points, encoder.values + ahead, true)
    truth = known(taken)
    tracks = tuple(
        ProfileTrack.of(t.name, np.interp(under, truth.distance_m, t.elevation))
        for t in truth.tracks
    )
    return replace(taken, recording=recording), Profile(0.05, tracks)


@pytest.mark.slow
@pytest.mark.parametrize("percent", [-1.0, 1.0])
def test_what_the_encoder_tells_wrong_between_wheel_and_laser_is_no_fault_of_a_device(percent):
    case = DistanceCheck().cases(1, Effort.QUICK)[2]
    scenario = replace(case.scenario, encoder_error_percent=percent, vehicle="pickup")
    taken, best = seen_by_wheels(taken_of(scenario))
    measured = DistanceCheck().judge(case, OneRecording(taken, lambda _: best))
    assert all(m.within(DeviceClass.REFERENCE) for m in measured)
    displaced = replace(best, start_m=-taken.recording.setup.vehicle.x_m)
    forgetful = DistanceCheck().judge(case, OneRecording(taken, lambda _: displaced))
    assert {m.quantity for m in forgetful if not m.within(DeviceClass.NOMINAL)} >= {START}


def test_a_device_with_a_height_sensor_sees_the_road_at_its_laser(stopped):
    assert stopped.recording.setup.vehicle is not None
    assert sensing_ahead_m(stopped.recording) == 0.0
    taken, _ = seen_by_wheels(stopped)
    assert sensing_ahead_m(taken.recording) == pytest.approx(1.72 + 2.91 - 0.105)


@settings(deadline=None, max_examples=20)
@given(
    line=st.tuples(st.floats(-1, 1), st.floats(-0.01, 0.01), st.floats(-1, 1)),
    odd=st.floats(0.0, 1e-3),
)
def test_line_and_step_are_found(line, odd):
    start, scale, step = line
    at = middles(540.0, 270.0)
    lags = start + scale * at + step * (at > 270.0)
    features = [Feature(float(x), float(lag), 0.0) for x, lag in zip(at, lags, strict=True)]
    placed = place(features, 270.0)
    assert (placed.start_m, placed.scale, placed.step_m) == pytest.approx(line, abs=1e-9)
    assert placed.rest_m < 1e-9
    features[0] = replace(features[0], lag_m=features[0].lag_m + odd)
    assert place(features, 270.0).rest_m <= odd + 1e-9


@pytest.mark.parametrize("event_m", [None, 270.0])
def test_features_keep_clear_of_ends_and_event(event_m):
    at = middles(540.0, event_m)
    assert at.min() - 12.5 >= 110.0
    assert at.max() + 12.5 <= 430.0
    if event_m is not None:
        assert np.abs(at - event_m).min() - 12.5 >= 60.0
        assert np.sum(at < event_m) == np.sum(at > event_m) == 4


def test_cases_follow_the_seed_and_survive_as_parameters():
    cases = DistanceCheck().cases(5, Effort.CERTIFICATION)
    assert cases == DistanceCheck().cases(5, Effort.CERTIFICATION)
    assert [Case.of("distance", c.parameters, c.name) for c in cases] == list(cases)
    for case in cases:
        assert drive_of(case.scenario).length_m >= case.scenario.length_m - 1e-6


@pytest.mark.slow
def test_the_recommended_pipeline_passes_braking_with_slip():
    case = DistanceCheck().cases(0, Effort.QUICK)[2]
    name = "spatial-hpf-timer-distortion-reflection"
    bench = OneRecording(taken_of(case.scenario), lambda t: floatref.process(t.recording, name))
    assert all(m.ratio(DeviceClass.NOMINAL) <= 0.7 for m in DistanceCheck().judge(case, bench))
