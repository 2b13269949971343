"""The main job from end to end: settings, warnings, validity, plug-ins."""

import numpy as np
import pytest

import floatref
from floatref.architectures import hookspecs, plugins, processing
from floatref.errors import InputError
from floatref.measures import iri
from floatref.stages.conditioning import RemoveGravity
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

RATE = UniformClock.of(1000.0)


REACH = {
    "temporal-basic": (47.0, 76.0),
    "temporal-mean-removal": (47.0, 76.0),
    "spatial-basic": (158.865, 158.865),
    "spatial-hpf": (158.865, 158.865),
}


def invalid_within(profile, run_in_m=53.0):
    """Distances of the invalid points away from the ends of the run."""
    x = profile.distance_m
    inner = (x > x[0] + run_in_m) & (x < x[-1] - run_in_m)
    return x[inner & ~profile.tracks[0].valid]


def with_gap(steady, name, begin, end):
    values = steady(seconds=30.0).channel(name).values.copy()
    values[begin:end] = np.nan
    return steady(seconds=30.0, **{name: Channel.of(name, values, RATE)})


def test_a_smooth_bouncing_drive_over_a_flat_road_is_flat(steady):
    times = np.arange(30_000) / 1000.0
    bounce = 0.02 * (1.0 - np.cos(2.0 * np.pi * 1.5 * times))
    force = 9.80665 + 0.02 * (2.0 * np.pi * 1.5) ** 2 * np.cos(2.0 * np.pi * 1.5 * times)
    recording = steady(
        seconds=30.0,
        vertical_specific_force=Channel.of("vertical_specific_force", force, RATE),
        height=Channel.of("height", 0.3 + bounce, RATE),
    )
    for pipeline in ("temporal-basic", "temporal-mean-removal", "spatial-basic"):
        profile = floatref.process(recording, pipeline)
        assert iri(profile.tracks[0].elevation, profile.interval_m) < 0.01


def test_the_profile_records_how_it_was_made(steady):
    profile = floatref.process(steady(), "spatial-basic", {"cutoff_wavelength_m": 50})
    assert profile.pipeline == "spatial-basic"
    assert dict(profile.settings) == {
        "interval_m": 0.05,
        "anti_alias_hz": 1000.0,
        "cutoff_wavelength_m": 50.0,
        "slow_mps": 4.444444,
        "braking_g": 0.16,
        "before_slow_m": 158.865,
        "after_slow_m": 158.865,
        "after_braking_m": 47.0,
    }
    assert profile.provenance["architecture"] == "spatial"
    assert profile.provenance["floatref"] == floatref.__version__
    again = floatref.process(steady(), "spatial-basic", profile.settings)
    np.testing.assert_array_equal(again.tracks[0].elevation, profile.tracks[0].elevation)


def test_the_interval_can_be_set(steady):
    assert floatref.process(steady(), settings={"interval_m": 0.1}).interval_m == 0.1


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"cut_off": 91.44}, "setting cut_off: pipeline temporal-basic has none such; it has int"),
        ({"interval_m": "5 mm"}, "setting interval_m: '5 mm' is not a number"),
        ({"interval_m": True}, "setting interval_m: True is not a number"),
        ({"cutoff_wavelength_m": -1}, "setting cutoff_wavelength_m: -1.0 must be finite and abo"),
        ({"cutoff_wavelength_m": float("nan")}, "setting cutoff_wavelength_m: nan must be finite"),
        ({"interval_m": 10**400}, "setting interval_m: inf must be finite and above zero"),
        ({"interval_m": 1e-320}, "setting interval_m is 9.99989e-321; give the profile interval"),
        ({"interval_m": 1e-7}, "setting interval_m is 1e-07; give the profile interval in m"),
        ({"cutoff_wavelength_m": 0.08}, "cut-off 12.5 cycles per unit of distance is outside"),
    ],
)
def test_a_setting_that_cannot_be_is_named(steady, settings, message):
    with pytest.raises(InputError) as error:
        floatref.process(steady(), settings=settings)
    assert message in str(error.value)


def test_numpy_numbers_are_numbers_and_none_keeps_the_default(steady):
    given = {"interval_m": np.float32(0.5), "cutoff_wavelength_m": None}
    profile = floatref.process(steady(), settings=given)
    assert profile.interval_m == 0.5
    assert profile.settings["cutoff_wavelength_m"] == 105.91


def test_a_huge_cut_off_is_no_more_than_the_whole_run(steady):
    recording = with_gap(steady, "vertical_specific_force", 15_000, 15_050)
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(recording, settings={"cutoff_wavelength_m": 1e308})
    assert not profile.tracks[0].valid.any()


def test_an_unknown_pipeline_is_named(steady):
    with pytest.raises(InputError, match="pipeline spatial-basics: unknown; there are temporal"):
        floatref.process(steady(), "spatial-basics")


@pytest.mark.parametrize("pipeline", ["temporal-basic", "temporal-mean-removal", "spatial-basic"])
def test_a_laser_drop_out_is_flagged_where_it_is(steady, pipeline):
    recording = with_gap(steady, "height", 15_000, 15_500)
    with pytest.warns(floatref.FloatrefWarning, match=r"height: 500 of 30000 samples missing"):
        profile = floatref.process(recording, pipeline)
    lost = invalid_within(profile)
    assert 299.9 <= lost.min() <= 300.1
    assert 309.8 <= lost.max() <= 310.1
    assert np.isfinite(profile.tracks[0].elevation).all()


def test_an_accelerometer_drop_out_is_flagged_a_cut_off_wavelength_to_either_side(steady):
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(with_gap(steady, "vertical_specific_force", 15_000, 15_011))
    lost = invalid_within(profile)
    assert lost.min() == pytest.approx(300.0 - 105.91, abs=0.2)
    assert lost.max() == pytest.approx(300.2 + 105.91, abs=0.2)


def test_a_drop_out_too_short_to_drift_is_flagged_where_it_is(steady):
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(with_gap(steady, "vertical_specific_force", 15_000, 15_010))
    lost = invalid_within(profile)
    assert 299.9 <= lost.min() <= lost.max() <= 300.3


@pytest.mark.parametrize("pipeline", floatref.pipelines())
def test_filter_run_in_and_run_out_are_half_a_cut_off_wavelength(steady, pipeline):
    valid = floatref.process(steady(seconds=30.0), pipeline).tracks[0].valid
    points = round(105.91 / 2 / 0.05)
    assert not valid[:points].any()
    assert not valid[-points:].any()
    assert valid[points:-points].all()


@pytest.mark.parametrize("pipeline", floatref.pipelines())
def test_a_stop_is_flagged_with_what_its_pipeline_spreads(steady, pipeline):
    times = np.arange(60_000) / 1000.0
    slowing = np.clip(20.0 - 1.5 * np.clip(times - 20.0, 0.0, None), 0.0, None)
    speed = slowing + np.clip(times - 36.0, 0.0, 10.0)
    distance = np.cumsum(speed) / 1000.0
    recording = steady(seconds=60.0, distance=Channel.of("distance", distance, RATE))
    profile = floatref.process(recording, pipeline)
    lost = invalid_within(profile, 100.0)
    before, after = REACH.get(pipeline, (15.0, 30.0))
    slow = distance[speed < 16 / 3.6]
    assert lost.min() == pytest.approx(slow.min() - before, abs=2.0)
    assert lost.max() == pytest.approx(min(slow.max() + after, distance[-1] - 100.0), abs=2.0)


@pytest.mark.parametrize("pipeline", ["temporal-basic", "spatial-hpf-timer-distortion"])
@pytest.mark.parametrize("lost", [slice(15_000, 16_250), slice(15_007, 15_018)])
def test_an_accelerometer_drop_out_in_a_stop_is_flagged(steady, pipeline, lost):
    times = np.arange(30_000) / 1000.0
    distance = 20.0 * np.clip(times, None, 14.0) + 20.0 * np.clip(times - 17.0, 0.0, None)
    forces = steady(seconds=30.0).channel("vertical_specific_force").values.copy()
    forces[lost] = np.nan
    recording = steady(
        seconds=30.0,
        vertical_specific_force=Channel.of("vertical_specific_force", forces, RATE),
        distance=Channel.of("distance", distance, RATE),
    )
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(recording, pipeline)
    invalid = invalid_within(profile)
    assert invalid.min() == pytest.approx(280.0 - 105.91, abs=0.2)
    assert invalid.max() == pytest.approx(280.0 + 105.91, abs=0.2)


@pytest.mark.parametrize("pipeline", ["temporal-hpf", "spatial-hpf-timer-distortion-reflection"])
def test_what_happens_behind_the_last_point_reaches_back_from_there(steady, pipeline):
    times = np.arange(40_000) / 1000.0
    forces = steady(seconds=40.0).channel("vertical_specific_force").values.copy()
    forces[30_000:35_000] = np.nan
    recording = steady(
        seconds=40.0,
        vertical_specific_force=Channel.of("vertical_specific_force", forces, RATE),
        distance=Channel.of("distance", 20.0 * np.clip(times, None, 25.0), RATE),
    )
    with pytest.warns(floatref.FloatrefWarning, match="vertical_specific_force"):
        profile = floatref.process(recording, pipeline)
    assert invalid_within(profile).min() == pytest.approx(500.0 - 105.91, abs=0.2)


@pytest.mark.parametrize("pipeline", ["temporal-basic", "spatial-hpf"])
@pytest.mark.parametrize("clock", ["common", "own"])
def test_a_lost_encoder_can_hide_a_stop(steady, pipeline, clock):
    before, after = REACH[pipeline]
    every = 1 if clock == "common" else 4
    distance = 20.0 * np.arange(0, 30_000, every) / 1000.0
    distance[14_000 // every : 15_200 // every] = np.nan
    channel = Channel.of("distance", distance, UniformClock.of(1000.0 / every))
    with pytest.warns(floatref.FloatrefWarning, match="distance"):
        profile = floatref.process(steady(seconds=30.0, distance=channel), pipeline)
    lost = invalid_within(profile)
    assert lost.min() == pytest.approx(280.0 - before, abs=0.3)
    assert lost.max() == pytest.approx(304.0 + after, abs=0.3)


@pytest.mark.parametrize(
    ("pipeline", "settings"),
    [
        ("temporal-hpf-local-suppression", {"suppression_speed_mps": 15.0}),
        ("temporal-adaptive-hpf", {"transition_speed_mps": 15.0}),
        ("temporal-matched-hpf", {"transition_speed_mps": 10.0, "transition_steepness": 0.5}),
        ("spatial-hpf-timer-distortion", {"timer_speed_mps": 11.0}),
        ("temporal-basic", {"slow_mps": 13.0}),
    ],
)
def test_travel_below_the_limit_of_a_stage_is_not_valid(steady, pipeline, settings):
    times = np.arange(40_000) / 1000.0
    recording = steady(seconds=40.0, distance=Channel.of("distance", 12.0 * times, RATE))
    assert floatref.process(recording, pipeline).tracks[0].valid.any()
    assert not floatref.process(recording, pipeline, settings).tracks[0].valid.any()


@pytest.mark.parametrize(
    ("pipeline", "setting"),
    [
        ("temporal-hpf", "collective_cutoff_hz"),
        ("temporal-adaptive-hpf", "low_speed_cutoff_hz"),
        ("temporal-matched-hpf", "low_speed_cutoff_hz"),
    ],
)
def test_a_cut_off_beyond_half_the_rate_is_named_as_it_was_given(steady, pipeline, setting):
    message = f"setting {setting}: 700 Hz; give it below 500 Hz, half the sampling rate"
    with pytest.raises(InputError, match=message):
        floatref.process(steady(), pipeline, {setting: 700.0})


def test_progress_ends_at_one(steady):
    done = []
    processing.run(steady(seconds=200.0), "temporal-basic", progress=done.append)
    assert done == sorted(done)
    assert len(done) > 1
    assert done[-1] == 1.0


class Doubling(RemoveGravity):
    """Reads twice the acceleration."""

    def advance(self, block):
        out = super().advance(block)
        return out.setting({c: 2.0 * x for c, x in out.values.items() if c.name.endswith("ion")})


class Vendor:
    @hookspecs.hookimpl
    def temporal_condition(self, context):
        return (Doubling(),)


def test_a_plugged_in_stage_takes_the_place_of_ours(steady, monkeypatch):
    recording = steady(height=Channel.of("height", np.full(4000, 0.3), RATE))
    plain = floatref.process(recording)
    loaded = plugins.Plugins()
    loaded.add(Vendor(), "vendor")
    monkeypatch.setattr(processing, "plugins", lambda: loaded)
    doubled = floatref.process(recording)
    np.testing.assert_allclose(
        doubled.tracks[0].elevation, 2.0 * plain.tracks[0].elevation, atol=1e-12
    )
