"""The main job from end to end: settings, warnings, validity, plug-ins."""

import numpy as np
import pytest

import floatref
from floatref import answers
from floatref.engine import plugins, run
from floatref.errors import InputError
from floatref.measures import iri
from floatref.stages.conditioning import RemoveGravity


def test_a_smooth_bouncing_drive_over_a_flat_road_is_flat(steady):
    times = np.arange(30_000) / 1000.0
    bounce = 0.02 * (1.0 - np.cos(2.0 * np.pi * 1.5 * times))
    force = 9.80665 + 0.02 * (2.0 * np.pi * 1.5) ** 2 * np.cos(2.0 * np.pi * 1.5 * times)
    recording = steady(seconds=30.0, vertical_specific_force=force, height=0.3 + bounce)
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
        "slow_mps": 4.4704,
        "stopping_time_s": 5.0,
        "before_slow_m": 158.865,
        "after_slow_m": 158.865,
        "after_braking_m": 47.0,
    }
    assert profile.provenance["architecture"] == "spatial"
    assert profile.provenance["floatref"] == floatref.__version__
    again = floatref.process(steady(), "spatial-basic", profile.settings)
    np.testing.assert_array_equal(again.tracks[0].elevation, profile.tracks[0].elevation)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (
            {"cut_off": 91.44},
            "setting cut_off: pipeline temporal-basic has no such setting; it has",
        ),
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
        floatref.process(steady(), "temporal-basic", settings)
    assert message in str(error.value)


def test_numpy_numbers_are_numbers_and_none_keeps_the_default(steady):
    given = {"interval_m": np.float32(0.5), "cutoff_wavelength_m": None}
    profile = floatref.process(steady(), settings=given)
    assert profile.interval_m == 0.5
    assert profile.settings["cutoff_wavelength_m"] == 105.91


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


@pytest.mark.parametrize("pipeline", ["temporal-basic", "road-prior-smoother"])
def test_progress_ends_at_one(steady, pipeline):
    done = []
    run.run(steady(seconds=200.0), pipeline, progress=done.append)
    assert done == sorted(done)
    assert len(done) > 1
    assert done[-1] == 1.0


class Doubling(RemoveGravity):
    def advance(self, block):
        out = super().advance(block)
        return out.setting({c: 2.0 * x for c, x in out.values.items() if c.name.endswith("ion")})


class Vendor:
    @answers("temporal-basic")
    def temporal_condition(self, context):
        return (Doubling(),)


def test_a_plugged_in_stage_takes_the_place_of_ours(steady, monkeypatch):
    recording = steady(height=0.3 + 1e-13 * np.cos(np.arange(4000.0)))
    plain = floatref.process(recording, "temporal-basic")
    loaded = plugins.Plugins()
    loaded.add(Vendor(), "vendor")
    monkeypatch.setattr(run, "plugins", lambda: loaded)
    doubled = floatref.process(recording, "temporal-basic")
    np.testing.assert_allclose(
        doubled.tracks[0].elevation, 2.0 * plain.tracks[0].elevation, atol=1e-12
    )
