"""The road without a height sensor, on drives of a quarter car that are known exactly."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.engine.run import run
from floatref.errors import InputError
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup, TrackSetup

pytestmark = pytest.mark.slow

JOINT, OBSERVER = "response-joint-input-state", "response-observer"
PIPELINES = pytest.mark.parametrize("pipeline", [JOINT, OBSERVER])
NOISE = {
    "unsprung_specific_force": 0.03,
    "sprung_specific_force": 0.03,
    "suspension_deflection": 5e-4,
}
"""White, of one sample at 1 kHz: the density of the pipelines' own settings."""
laws = settings(
    deadline=None, max_examples=4, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@PIPELINES
@pytest.mark.parametrize("mps", [12.0, 25.0])
def test_the_road_is_recovered_from_ideal_sensors(drive, pipeline, mps):
    track, road = drive(mps=mps, wheel_m=1.7, laser_m=-0.4).compared(pipeline)
    error = (track.elevation - road)[track.valid]
    assert track.valid.mean() > 0.7
    assert np.sqrt(np.mean(error**2)) < 0.03 * road[track.valid].std()


@PIPELINES
@laws
@given(wheel_m=st.floats(-3.0, 3.0), laser_m=st.floats(-3.0, 3.0))
def test_a_bump_lies_where_a_laser_would_see_it(drive, pipeline, wheel_m, laser_m):
    bump = drive(wheel_m=wheel_m, laser_m=laser_m, bump_m=200.0, length_m=320.0)
    profile = run(bump.recording(), pipeline).profile
    track, s = profile.tracks[0], profile.distance_m
    top = s[np.nanargmax(track.elevation)]
    assert top == pytest.approx(200.0 - laser_m, abs=0.11)
    assert np.nanmax(track.elevation) == pytest.approx(0.02, rel=0.1)


@PIPELINES
def test_what_no_wheel_saw_is_no_elevation(drive, pipeline):
    ahead = drive(wheel_m=2.0, length_m=200.0)
    profile = run(ahead.recording(), pipeline).profile
    assert profile.length_m == pytest.approx(200.0, abs=0.1)
    assert np.isnan(profile.tracks[0].elevation[profile.distance_m < 1.99]).all()
    behind = replace(ahead, wheel_m=0.0, laser_m=2.0)
    profile = run(behind.recording(), pipeline).profile
    unseen = profile.distance_m > profile.distance_m[-1] - 1.99
    assert np.isnan(profile.tracks[0].elevation[unseen]).all()
    assert not profile.tracks[0].valid[unseen].any()


@PIPELINES
@pytest.mark.parametrize("seed", range(3))
def test_the_error_is_within_two_sigma(drive, quarter_car, pipeline, seed):
    rng = np.random.default_rng(seed)
    stated = {name: x * (1.0 + 0.03 * rng.standard_normal()) for name, x in quarter_car.items()}
    noisy = drive(mps=20.0, noise=NOISE, stated=stated, seed=seed)
    track, road = noisy.compared(pipeline)
    error = np.abs(track.elevation - road)[track.valid]
    sigma = track.sigma[track.valid]
    assert np.mean(error < 2.0 * sigma) > 0.9
    assert np.median(sigma) < 4.0 * np.sqrt(np.mean(error**2))


@PIPELINES
def test_a_long_gap_of_an_accelerometer_spoils_what_is_around(drive, pipeline):
    known = drive(length_m=400.0).recording()
    force = known.channel("unsprung_specific_force", "left")
    holed = force.values.copy()
    holed[10_000:10_050] = np.nan
    lost = Channel.of("unsprung_specific_force", holed, force.clock, "left")
    result = run(drive(length_m=400.0).recording(unsprung_specific_force=lost), pipeline)
    track, s = result.profile.tracks[0], result.profile.distance_m
    assert "left.unsprung_specific_force: 50 of 20000 samples missing" in " ".join(result.warnings)
    assert not track.valid[np.abs(s - 200.0) < 100.0].any()
    assert run(known, pipeline).profile.tracks[0].valid[np.abs(s - 200.0) < 100.0].all()


def test_the_flags_of_a_missing_deflection_come_out(drive):
    known = drive(length_m=300.0).recording().channel("suspension_deflection", "left")
    holed = known.values.copy()
    holed[7_500:7_504] = np.nan
    lost = Channel.of("suspension_deflection", holed, known.clock, "left")
    profile = run(drive(length_m=300.0).recording(suspension_deflection=lost), JOINT).profile
    invalid = profile.distance_m[~profile.tracks[0].valid]
    assert np.any(np.abs(invalid - 150.0) < 0.2)
    assert not np.any((np.abs(invalid - 150.0) > 1.0) & (np.abs(invalid - 150.0) < 60.0))


@PIPELINES
def test_denoising_keeps_what_its_components_hold(drive, pipeline):
    short = drive(length_m=150.0, interval_m=0.25)
    plain = run(short.recording(), pipeline).profile.tracks[0]
    known = ~np.isnan(plain.elevation)
    window = 200.0
    every = run(short.recording(), pipeline, {"denoise_components": window}).profile.tracks[0]
    few = run(short.recording(), pipeline, {"denoise_components": 3.0}).profile.tracks[0]
    spread = plain.elevation[known].std()
    np.testing.assert_allclose(every.elevation, plain.elevation, atol=1e-6 * spread)
    lost = np.std((few.elevation - plain.elevation)[known])
    assert 0.01 * spread < lost < 0.9 * spread


def test_without_a_deflection_the_accelerometers_are_enough(drive):
    track, road = drive().compared(JOINT, suspension_deflection=None)
    error = (track.elevation - road)[track.valid]
    assert np.sqrt(np.mean(error**2)) < 0.03 * road[track.valid].std()


def test_a_measured_displacement_takes_the_place_of_the_integrals(drive):
    known = drive(length_m=300.0)
    height = 1e-3 * np.sin(np.arange(15_000) / 50.0)
    wheel = Channel.of("unsprung_displacement", height, UniformClock.of(1000.0), "left")
    moved = run(known.recording(unsprung_displacement=wheel), JOINT).profile.tracks[0]
    assert (
        np.nanmax(
            np.abs(moved.elevation - run(known.recording(), JOINT).profile.tracks[0].elevation)
        )
        > 1e-3
    )


def refusal(recording: Recording, pipeline: str = JOINT) -> str:
    with pytest.raises(InputError) as caught:
        run(recording, pipeline)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_recording_without_a_vehicle_is_told_what_to_add(drive):
    known = drive(length_m=60.0).recording()
    bare = replace(known, setup=Setup(profile_interval_m=0.05))
    assert "setup.vehicle: missing" in refusal(bare)
    assert 'add "vehicle": {"model": "quarter-car"' in refusal(bare)


def test_missing_channels_are_named(drive):
    known = drive(length_m=60.0)
    said = refusal(known.recording(unsprung_specific_force=None))
    assert said.startswith("channel unsprung_specific_force: missing")
    assert "channel left.distance: missing" in refusal(known.recording(distance=None))


WRONG = [
    ("unsprung_specific_force", lambda x: x / 9.80665, "looks like g"),
    ("sprung_specific_force", lambda x: x - 9.80665, "1 g has been removed"),
    ("sprung_specific_force", lambda x: -x, "the sign is inverted"),
    ("suspension_deflection", lambda x: 1e3 * x + 2.0, "if it is in mm, multiply by 0.001"),
    ("suspension_deflection", lambda x: 0.0 * x, "so it measures nothing"),
    (
        "suspension_deflection",
        lambda x: np.where(np.arange(x.size) == 7, 99.0, x),
        "sample 7 is 99 m",
    ),
    ("suspension_deflection", lambda x: x[: x.size // 2], "the file is truncated"),
    ("sprung_specific_force", lambda x: np.where(np.arange(x.size) % 3, np.nan, x), "are missing"),
    ("distance", lambda x: 0.0 * x, "never leaves"),
]


@pytest.mark.parametrize(("name", "change", "said"), WRONG)
def test_what_cannot_be_is_refused_in_one_line(drive, name, change, said):
    known = drive(length_m=60.0)
    channel = known.recording().channel(name, "left")
    spoilt = Channel.of(name, change(channel.values.copy()), channel.clock, channel.id.track)
    line = refusal(known.recording(**{name: spoilt}))
    assert line.startswith(f"channel {channel.id}")
    assert said in line


def test_each_wheel_path_goes_its_own_way(drive):
    left, right = drive(length_m=200.0, seed=3), drive(length_m=200.0, seed=4, wheel_m=1.0)
    known = left.recording()
    other = [
        Channel.of(c.id.name, c.values, c.clock, "right")
        for c in replace(right, wheel_m=0.0).recording().channels
        if c.id.track
    ]
    tracks = {"left": TrackSetup(), "right": TrackSetup((0.5, 0.0, 0.0))}
    setup = replace(known.setup, tracks=tracks)
    profile = run(Recording((*known.channels, *other), setup), JOINT).profile
    alone = run(replace(known, setup=replace(known.setup, tracks={})), JOINT).profile
    setup = replace(known.setup, tracks={"right": tracks["right"]})
    own = run(Recording((known.channel("distance"), *other), setup), JOINT).profile
    assert [t.name for t in profile.tracks] == ["left", "right"]
    np.testing.assert_array_equal(profile.tracks[0].elevation, alone.tracks[0].elevation)
    # Alone it lies on the axis of its own laser, 0.5 m ahead; beside the left one on that one's.
    assert np.isnan(own.tracks[0].elevation[-10:]).all()
    right = profile.tracks[1].elevation
    assert np.isnan(right[:10]).all()
    np.testing.assert_array_equal(right[10:], own.tracks[0].elevation[:-10])


def test_slow_travel_is_not_vouched_for(drive):
    crawl = run(drive(mps=2.0, length_m=30.0).recording(), JOINT).profile
    assert not crawl.tracks[0].valid.any()
