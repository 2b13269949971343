"""A recording as a stream has it: close to the whole run, and no joint that one could find."""

import numpy as np
import pytest

from floatref import InputError
from floatref.engine.axis_place import Place
from floatref.engine.run import run
from floatref.live.as_live import run_as_live
from floatref.live.bounds import SETTLED, WAVELENGTH_M
from floatref.measures import iri

PIPELINES = [
    "temporal-basic",
    "temporal-hpf",
    "temporal-adaptive-hpf-spatial-backward",
    "temporal-matched-hpf",
    "road-prior-smoother",
    "road-prior-smoother-spatial",
]
PIECE_M, STEP_M = 7.62, 0.1
SETTLES_M = SETTLED * WAVELENGTH_M


@pytest.fixture(scope="module")
def steady(drive):
    """Return a drive of 6 km without a stop."""
    return drive([(20.0, 200.0), (25.0, 80.0)], rate_hz=250.0)


def both(recording, pipeline):
    """Return the tracks of the windows and of the whole run on the same points, and the record."""
    live, whole = run_as_live(recording, pipeline), run(recording, pipeline, place=Place(-np.inf))
    assert live.profile.start_m == whole.profile.start_m
    return live.profile.tracks[0], whole.profile.tracks[0], live.profile.provenance["live"]


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", PIPELINES)
def test_windows_give_what_the_whole_run_gives(steady, pipeline):
    live, whole, record = both(steady, pipeline)
    assert len(record["windows"]) >= 3
    assert live.elevation.size == whole.elevation.size
    # Where the 1-sigma passes its limit, single points may differ.
    assert np.count_nonzero(live.valid != whole.valid) <= (0 if live.sigma is None else 10)
    # At its end the backward pass of a whole run meets the drift of the whole run.
    apart = np.abs(live.elevation - whole.elevation)[live.valid & whole.valid][
        : -round(SETTLES_M / STEP_M)
    ]
    # Both passes of a filter that began 1 m off; of an estimator, three of its own 1-sigma.
    sigma = 0.0 if live.sigma is None else np.median(whole.sigma)
    limit = max(2.0 * np.exp(-SETTLED * np.pi), 3.0 * sigma)
    assert apart.max() < limit


@pytest.mark.slow
def test_no_joint_is_rougher_than_the_sigma_permits(steady):
    live, whole, _ = both(steady, "road-prior-smoother")
    piece = round(PIECE_M / STEP_M)
    valid = np.flatnonzero(live.valid & whole.valid)
    inside = slice(valid[0], valid[-1] + 1)
    off = live.elevation[inside] - whole.elevation[inside]
    # The car feels waves of up to 30 m: there an error of 1 sigma has this slope, in m/km.
    allowed = 1000.0 * 2.0 * np.pi / 30.0 * np.median(whole.sigma[inside])
    found = [iri(off[k : k + 2 * piece], STEP_M) for k in range(0, off.size - 2 * piece, piece)]
    assert max(found) < 0.1 * allowed


@pytest.mark.slow
def test_stops_of_any_length_give_the_same_points(drive):
    sizes = []
    for stood_s in (1.0, 60.0, 10_800.0):
        recording = drive([(20.0, 40.0), (0.0, 14.0 + stood_s), (20.0, 40.0)], rate_hz=100.0)
        result = run_as_live(recording, "temporal-adaptive-hpf-spatial-backward")
        track = result.profile.tracks[0]
        sizes.append(track.elevation.size)
        # Braking takes 133 m; around a window's end, half a wavelength is not valid.
        off_m = np.abs(result.profile.distance_m - 40.0 * 20.0 - 20.0**2 / 2.0 / 1.5)
        assert not track.valid[off_m < (5.0 if stood_s == 1.0 else 52.0)].any()
        assert np.isfinite(track.elevation).all()
        ends = [window["end"] for window in result.profile.provenance["live"]["windows"]]
        assert ends == [*(["standstill"] if stood_s > 1.0 else []), "end of the stream"]
    assert max(sizes) - min(sizes) <= 1


@pytest.mark.parametrize("distance", ["times", "rate"])
def test_a_standstill_loses_nothing_before_it(drive, distance):
    recording = drive([(20.0, 30.0), (0.0, 60.0), (20.0, 30.0)], rate_hz=100.0, distance=distance)
    profile = run_as_live(recording, "temporal-basic").profile
    ends = [window["end"] for window in profile.provenance["live"]["windows"]]
    assert ends == ["standstill", "end of the stream"]
    assert profile.start_m < 0.5
    assert np.isfinite(profile["left"].elevation).all()


def test_a_counter_that_is_set_back_leaves_the_axis_as_it_is(drive):
    recording = drive([(20.0, 60.0)], rate_hz=200.0)
    values = np.array(recording.channel("distance").values)
    back = values.size // 2
    values[back:] -= values[back]
    channels = [
        c if c.id.name != "distance" else type(c)(c.id, values, c.clock) for c in recording.channels
    ]
    broken = type(recording)(tuple(channels), recording.setup)
    result = run_as_live(broken, "temporal-basic")
    whole = run_as_live(recording, "temporal-basic")
    # Half a second at most, between two ticks, is not measured.
    assert 0.0 <= whole.profile.length_m - result.profile.length_m <= 11.0
    ends = [window["end"] for window in result.profile.provenance["live"]["windows"]]
    assert ends == ["distance set back", "end of the stream"]


def test_a_vehicle_that_does_not_move_has_no_profile(drive):
    with pytest.raises(InputError, match="the stream has no final point"):
        run_as_live(drive([(0.0, 40.0)]), "temporal-basic")


def test_a_window_that_the_pipeline_refuses_has_no_elevation_and_a_reason(drive):
    recording = drive([(20.0, 250.0)], rate_hz=200.0)
    height = recording.channel("height", "left")
    values = np.array(height.values)
    values[int(120 * 200.0) :] = np.nan
    channels = [
        c if c.id != height.id else type(c)(c.id, values, c.clock) for c in recording.channels
    ]
    result = run_as_live(type(recording)(tuple(channels), recording.setup), "temporal-basic")
    track = result.profile["left"]
    where = result.profile.distance_m
    assert np.isfinite(track.elevation[where < 1000.0]).all()
    assert not track.valid[where > 2500.0].any()
    assert any("no elevation; channel left.height: " in line for line in result.warnings)


def test_slip_goes_on_from_window_to_window(drive):
    recording = drive([(20.0, 100.0), (5.0, 20.0), (20.0, 120.0)], rate_hz=200.0)
    order = "temporal-matched-hpf", {"slip_per_g": 0.1}
    result, whole = run_as_live(recording, *order), run(recording, *order, place=Place(-np.inf))
    assert len(result.profile.provenance["live"]["windows"]) >= 2
    assert result.profile.length_m == pytest.approx(whole.profile.length_m, abs=0.15)
    valid = result.profile["left"].valid & whole.profile["left"].valid
    apart = result.profile["left"].elevation - whole.profile["left"].elevation
    assert np.abs(apart[valid]).max() < 1e-3
