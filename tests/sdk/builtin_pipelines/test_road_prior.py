"""The road-prior pipeline: its settings act, it takes nominal sensors, and it forgets nothing."""

from dataclasses import fields, replace
from functools import cache

import numpy as np
import pytest

from floatref.builtin_pipelines.road_prior import CONSTANTS, ROAD_PRIOR
from floatref.engine.run import run
from floatref.errors import InputError
from floatref.estimators.road_prior import RoadPrior
from floatref.measures import iri
from floatref.values.profile import Profile
from floatref.values.recording import Recording
from floatref_conformance.proving_ground import Scenario, simulate

(PIPELINE,) = ROAD_PRIOR


@cache
def driven() -> Recording:
    """A stop of 2 s, behind it lost counts, before it a twentieth of a second without force."""
    scenario = Scenario(
        manoeuvre="stop",
        event_at_m=130.0,
        dwell_s=2.0,
        length_m=290.0,
        tracks=("left",),
        rate_hz=5000.0,
        profile_interval_m=0.05,
        slip_percent_per_g=0.3,
        imu=False,
        gnss=False,
    )
    channels, whole = [], simulate(scenario).recording
    (distance,) = (c.values for c in whole.channels if c.id.name == "distance")
    standing = int(np.searchsorted(distance, 129.5)) + 7500
    assert distance[standing - 500] == distance[standing + 500]
    for channel in whole.channels:
        values = channel.values.copy()
        if channel.id.name == "vertical_specific_force":
            values[20000:20250] = np.nan
        if channel.id.name == "height":
            # The laser sways over an edge of a millimetre at the stop.
            values[standing : standing + 200] += 1e-3
        if channel.id.name == "distance":
            begin = int(np.searchsorted(values, 200.0))
            values[begin + 500 :] -= values[begin + 500] - values[begin]
            values[begin : begin + 500] = values[begin]
        channels.append(replace(channel, values=values))
    return replace(whole, channels=tuple(channels))


def profile(**settings: float) -> Profile:
    # So short a run is unsure all the way; what else makes it invalid shall be seen.
    return run(driven(), PIPELINE.name, {"most_sigma_share": 1.0, **settings}).profile


@cache
def usual() -> Profile:
    return profile()


@pytest.mark.slow
@pytest.mark.parametrize("setting", PIPELINE.settings)
def test_every_setting_changes_the_profile(setting: str, assert_other) -> None:
    # What is vouched for is set above; there is less of it with less.
    factor = 0.1 if setting == "most_sigma_share" else 2.0
    other = profile(**{setting: factor * (PIPELINE.settings[setting] or 0.05)})
    assert_other(other, usual())


def test_every_constant_is_a_setting_and_has_its_value() -> None:
    assert sorted(CONSTANTS.values()) == sorted(field.name for field in fields(RoadPrior))
    for setting, field in CONSTANTS.items():
        assert PIPELINE.settings[setting] == getattr(RoadPrior(), field)


def test_it_takes_nominal_sensors_alone() -> None:
    assert (PIPELINE.channels, PIPELINE.readings, PIPELINE.capabilities) == ((), (), ())


def test_all_points_have_elevation_and_sigma_whatever_is_missing(assert_all_known) -> None:
    assert_all_known(usual())


def test_a_memory_of_less_than_one_second_difference_is_refused() -> None:
    with pytest.raises(InputError, match="setting road_memory_m: 31 m; give 32 m or more"):
        profile(road_memory_m=31.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("speed_kmh", "road", "iri_m_per_km"),
    [(97.0, "measured", 1.2), (50.0, "sayers-asphalt-long-waves", 1.5), (20.0, "iso-B", 1.8)],
)
def test_its_iri_is_that_of_the_basic_profiler_and_it_vouches_for_it(
    speed_kmh: float, road: str, iri_m_per_km: float
) -> None:
    """Over 240 m, within a thousandth."""
    scenario = Scenario(
        seed=5,
        road=road,
        iri_m_per_km=iri_m_per_km,
        speed_kmh=speed_kmh,
        length_m=480.0,
        tracks=("left",),
        rate_hz=2000.0,
        profile_interval_m=0.05,
        imu=False,
        gnss=False,
    )
    recording, found = simulate(scenario).recording, []
    for pipeline in ("temporal-basic", "road-prior-smoother"):
        (track,) = run(recording, pipeline).profile.tracks
        inside = slice(2400, 7200)
        assert np.mean(track.valid[inside]) == 1.0
        found.append(iri(track.elevation[inside], 0.05))
    basic, ours = found
    assert ours == pytest.approx(basic, rel=1e-3)
