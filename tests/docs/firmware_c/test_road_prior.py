"""The stage of the firmware that measures through stops gives the profile of the SDK's pipeline."""

import json
import warnings
from dataclasses import replace

import numpy as np
import pytest

import floatref
from floatref.files import read_profile, write_recording
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS

pytestmark = pytest.mark.slow

STAGE, PIPELINE = "STAGE=road_prior", "road-prior-smoother"
STOP = {"manoeuvre": "stop", "length_m": 450.0, "event_at_m": 230.0, "deceleration_g": 0.3}
SIGMAS = 0.5
"""Of the 1-σ of a point: C levels the next stretch from where the last one ended and smooths with a
lag, the SDK knows the whole run; less than half of what the profile itself is uncertain by."""
DIFFERENTLY_VALID = 0.01
"""Share of points. C knows the least bend of a road, the SDK that of the run."""


@pytest.fixture(scope="module")
def drives(simulated):
    """Return the recordings that the tests share."""
    twice = {"stops": 2, "stop_spacing_m": 120.0, "final_speed_kmh": 40.0, "length_m": 850.0}
    return {
        "a stop": simulated(**STOP, tracks=("main",)),
        "lasers ahead of two accelerometers": simulated(**STOP, laser_ahead_m=0.2),
        "two stops": simulated(manoeuvre="stop", tracks=("main",), **twice),
        "no stop at 1 kHz": simulated(rate_hz=1000.0),
        **with_wrong_counts(simulated(rate_hz=1000.0, length_m=450.0, laser_ahead_m=0.1)),
    }


def with_wrong_counts(recording):
    """Return ``recording`` with an encoder that leaps, and with one that loses counts, at 230 m."""
    faults = {
        "an encoder that leaps": ("encoder-leap", {"size_m": 2.7}),
        "an encoder that loses counts": ("encoder-lost-counts", {"length_s": 0.3}),
    }
    return {
        name: SENSOR_FAULTS[fault](recording, {"at_m": 230.0, **numbers}).recording
        for name, (fault, numbers) in faults.items()
    }


def with_gaps(recording):
    """Return ``recording`` with heights, forces and counts missing, some of them for long."""
    gone = {
        "height": [slice(None, None, 997), slice(30000, 30150)],
        "vertical_specific_force": [slice(20000, 20030), slice(40000, 40100)],
        "distance": [slice(15000, 15020)],
    }
    channels = []
    for each in recording.channels:
        x = np.array(each.values)
        for part in gone[each.id.name]:
            x[part] = np.nan
        channels.append(Channel.of(each.id.name, x, each.clock, each.id.track))
    return Recording(tuple(channels), recording.setup)


def by_sdk(recording):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        return floatref.process(recording, PIPELINE)


def assert_near(found, wanted):
    assert [t.name for t in found.tracks] == [t.name for t in wanted.tracks]
    for mine, theirs in zip(found.tracks, wanted.tracks, strict=True):
        both = np.asarray(mine.valid) & np.asarray(theirs.valid)
        assert both.any()
        assert np.mean(np.asarray(mine.valid) != np.asarray(theirs.valid)) <= DIFFERENTLY_VALID
        off = np.abs(mine.elevation - theirs.elevation)
        assert np.max((off / theirs.sigma)[both]) <= SIGMAS


@pytest.mark.parametrize(
    "drive",
    [
        *("a stop", "lasers ahead of two accelerometers"),
        *("two stops", "no stop at 1 kHz"),
        *("an encoder that leaps", "an encoder that loses counts"),
    ],
)
def test_a_profile_is_that_of_the_pipeline(start, drives, drive, tmp_path):
    found = start(STAGE).profile_of(drives[drive], tmp_path / "run")
    assert_near(found, by_sdk(drives[drive]))


@pytest.mark.xfail(
    reason="the SDK's high-pass begins with a step from 0 to the first elevation, 18 mm where the "
    "smoother has moved it; C counts from the first point: 0.14 mm are left where points are valid",
    strict=True,
)
def test_between_brakes_the_height_is_carried_as_by_the_sdk(start, simulated, tmp_path):
    """Within a tenth of what carrying it changes; the joints of two parts are moved by less."""
    drive = simulated(rate_hz=1000.0, laser_ahead_m=0.3)
    tracks = {t: replace(p, laser_offset_m=(0.0, 0.0, 0.0)) for t, p in drive.setup.tracks.items()}
    ignored = by_sdk(Recording(drive.channels, replace(drive.setup, tracks=tracks)))
    found, wanted = start(STAGE).profile_of(drive, tmp_path / "run"), by_sdk(drive)
    for mine, theirs, other in zip(found.tracks, wanted.tracks, ignored.tracks, strict=True):
        both = np.asarray(mine.valid) & np.asarray(theirs.valid)
        carried = np.max(np.abs(other.elevation - theirs.elevation)[both])
        assert carried > 1e-4
        assert np.max(np.abs(mine.elevation - theirs.elevation)[both]) <= 0.1 * carried


def test_samples_that_are_missing_are_missing_for_the_smoother_too(start, drives, tmp_path):
    recording = with_gaps(drives["a stop"])
    assert_near(start(STAGE).profile_of(recording, tmp_path / "run"), by_sdk(recording))


def test_a_stop_is_valid_where_a_filter_has_no_road(start, drives, tmp_path):
    stop = drives["a stop"]
    (measured,) = start(STAGE).profile_of(stop, tmp_path / "through").tracks
    (filtered,) = start().profile_of(stop, tmp_path / "filtered").tracks
    assert not np.any(filtered.valid & ~np.asarray(measured.valid))
    assert np.mean(measured.valid) > np.mean(filtered.valid) + 0.1


def test_single_precision_is_within_the_same_bound(start, drives, tmp_path):
    found = start(STAGE, "REAL=float").profile_of(drives["a stop"], tmp_path / "run")
    assert_near(found, by_sdk(drives["a stop"]))


def test_the_profile_says_its_1_sigma(start, drives, tmp_path):
    write_recording(drives["a stop"], tmp_path / "run")
    answer, profile = start(STAGE).run(tmp_path / "run")
    assert answer == {"ok": True}
    (track,) = read_profile(profile).tracks
    (expected,) = by_sdk(drives["a stop"]).tracks
    both = np.asarray(track.valid) & np.asarray(expected.valid)
    # At either end of a standstill C has marks of the 1-sigma that the SDK has not: 15 %.
    assert np.median(track.sigma[both] / expected.sigma[both]) == pytest.approx(1.0, abs=0.15)


def test_more_wheel_paths_than_can_be_levelled_are_refused(start, drives, tmp_path):
    (force, height, distance) = drives["a stop"].channels
    paths = [
        Channel.of(each.id.name, np.array(each.values), each.clock, track)
        for each in (force, height)
        for track in ("a", "b", "c", "d", "e")
    ]
    write_recording(Recording((*paths, distance), drives["a stop"].setup), tmp_path / "run")
    answer, profile = start(STAGE).run(tmp_path / "run")
    assert "track a: " in answer["error"]
    assert not profile.exists()


@pytest.mark.parametrize(
    ("setup", "words"),
    [
        ({"axles": {"wheelbase_m": "3.4"}}, "wheelbase_m"),
        ({"tracks": {"main": {"laser_offset_m": 0.1}}}, "laser_offset_m"),
        ({"tracks": {"main": {"reference_point_m": [1e9, 0, 0]}}}, "reference_point_m"),
    ],
)
def test_places_that_are_not_numbers_are_refused(start, drives, setup, words, tmp_path):
    write_recording(drives["a stop"], tmp_path / "run")
    file = tmp_path / "run" / "recording.json"
    document = json.loads(file.read_text(encoding="utf-8"))
    document["setup"] |= setup
    file.write_text(json.dumps(document), encoding="utf-8")
    answer, profile = start(STAGE).run(tmp_path / "run")
    assert words in answer["error"]
    assert not profile.exists()
