import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import iri
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.measured import (
    SHIPPED_INTERVAL_M,
    measured_road,
    shipped_profile,
)
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import road_of

FIRST_M = 26.0


def profile(seed: int, points: int, interval: float) -> FloatArray:
    rng = np.random.default_rng(seed)
    x = interval * np.arange(points)
    waves = [(w, rng.uniform(0.0, 6.0)) for w in (3.0, 7.0, 19.0, 47.0)]
    return 580.0 + 0.02 * x + sum(0.001 * w * np.sin(2 * np.pi * x / w + p) for w, p in waves)


@given(st.integers(0, 1000), st.integers(200, 600), st.sampled_from([0.1, 0.15, 0.25]))
@settings(deadline=None, max_examples=20)
def test_the_road_is_the_measured_profile_less_a_line(
    seed: int, points: int, interval: float
) -> None:
    z = profile(seed, points, interval)
    road = measured_road(z, interval, spacing_m=0.01, tracks=("main",))
    x = FIRST_M + interval * np.arange(points)
    removed = z - road.at("main", x)
    assert np.abs(np.diff(removed, 2)).max() < 1e-6
    assert road.end_m == pytest.approx(x[-1] + 20.0, abs=0.02)


def test_between_the_points_the_road_is_smooth() -> None:
    z = profile(1, 400, 0.25)
    road = measured_road(z, 0.25, spacing_m=0.005, tracks=("main",))
    x = np.arange(FIRST_M + 5, FIRST_M + 90, 0.005)
    exact = np.interp(x, FIRST_M + 0.25 * np.arange(400), z)
    line = np.polyval(np.polyfit(x, exact - road.at("main", x), 1), x)
    assert np.abs(exact - line - road.at("main", x)).max() < 2e-4


@given(st.floats(50.0, 900.0))
@settings(deadline=None, max_examples=20)
def test_any_length_goes_on_without_a_step_or_a_kink(length: float) -> None:
    z = profile(2, 400, 0.25)
    road = measured_road(z, 0.25, length_m=length, spacing_m=0.05)
    assert road.end_m >= length + 20.0
    for path in road.elevation.values():
        beyond = path[road.distance_m >= FIRST_M]
        assert np.abs(np.diff(beyond)).max() / 0.05 < 0.1
        assert np.abs(np.diff(beyond, 2)).max() / 0.05**2 < 0.1


def test_a_derived_wheel_path_shares_long_waves_and_the_size_of_short_ones() -> None:
    x = 0.25 * np.arange(4000)
    for wave, shared in [(200.0, True), (1.25, False)]:
        z = 0.01 * np.sin(2 * np.pi * x / wave)
        road = measured_road(z, 0.25, spacing_m=0.05, seed=5)
        part = road.distance_m > FIRST_M
        left, right = (road.elevation[n][part] for n in ("left", "right"))
        assert np.std(right) == pytest.approx(np.std(left), rel=0.1)
        difference = np.std(left - right) / np.std(left)
        assert difference < 0.3 if shared else difference > 0.3


def test_two_measured_wheel_paths_stay_themselves() -> None:
    z = {"left": profile(3, 300, 0.25), "right": profile(4, 300, 0.25)}
    road = measured_road(z, 0.25, spacing_m=0.05)
    x = FIRST_M + 0.25 * np.arange(300)
    measured = z["left"] - z["right"]
    np.testing.assert_allclose(road.at("left", x) - road.at("right", x), measured, atol=1e-6)


def test_unusable_profiles_are_refused() -> None:
    good = profile(0, 50, 0.25)
    with pytest.raises(InputError, match="profile of left: needs four"):
        measured_road(np.append(good, np.nan), 0.25)
    with pytest.raises(InputError, match="interval_m is 0"):
        measured_road(good, 0.0)
    with pytest.raises(InputError, match="as many and as long"):
        measured_road({"left": good, "right": good[:-1]}, 0.25)


def test_the_shipped_profile_has_its_published_roughness() -> None:
    assert iri(shipped_profile(), SHIPPED_INTERVAL_M) == pytest.approx(3.334, rel=1e-3)


def test_a_scenario_can_take_the_shipped_road_as_it_is_or_scaled() -> None:
    asis = road_of(Scenario(road="measured", iri_m_per_km=0.0), 500.0)
    scaled = road_of(Scenario(road="measured", iri_m_per_km=1.8), 500.0)
    x = FIRST_M + SHIPPED_INTERVAL_M * np.arange(1600)
    found = iri(asis.at("left", x), SHIPPED_INTERVAL_M)
    assert found == pytest.approx(iri(shipped_profile()[:1600], SHIPPED_INTERVAL_M), rel=0.02)
    ratio = scaled.at("left", x[100:]) / asis.at("left", x[100:])
    assert np.ptp(ratio) < 1e-9
    assert ratio[0] == pytest.approx(1.8 / 3.3, rel=0.1)
