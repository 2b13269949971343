"""The run's own road: second differences by plain loops, and drawn roads of known spectra."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.estimators.road_prior.spectrum import LAGS, LONG, SHORT, RoadSpectrum

INTERVAL_S = 0.002
laws = settings(deadline=None, max_examples=20)


def drawn(seed, q, g, metres, speed):
    """Return elevation at nodes of a constant ``speed``, of white slope and long waves.

    With the travel, and with what readings have changed: nothing.
    """
    rng, travel = np.random.default_rng(seed), speed * INTERVAL_S
    count = round(metres / travel)
    slope = np.cumsum(np.sqrt(g * travel) * rng.normal(size=count))
    rises = slope * travel + np.sqrt(q * travel) * rng.normal(size=count)
    return np.cumsum(rises), np.full(count, travel), np.zeros((2, count))


def mean_squares(points, lag, start, share):
    """Return the sliding mean of squared second differences over ``lag`` points."""
    found = start
    for k in range(2 * lag, len(points)):
        bend = points[k] - 2 * points[k - lag] + points[k - 2 * lag]
        found += share * (min(bend * bend, 9 * found) - found)
    return found


@pytest.mark.slow
@pytest.mark.cites("(2.4)")
@pytest.mark.parametrize(("q", "g"), [(1e-6, 2e-7), (1e-5, 1e-8), (5e-5, 5e-6), (4e-6, 0.0)])
def test_of_a_long_road_it_is_the_spectrum(q, g):
    constants = RoadPrior(road_memory_m=20e3)
    spectrum = RoadSpectrum.of(constants, INTERVAL_S)
    spectrum.add(*drawn(3, q, g, 100e3, 20.0))
    found = spectrum.road()
    expected = np.maximum((q, g), spectrum.least)
    squares = np.array([[2 * lag, 2 / 3 * lag**3] for lag in LAGS])
    kept = spectrum.squares
    np.testing.assert_allclose(kept, squares @ (q, g), rtol=0.15)
    assert (np.abs(found - expected) < 0.35 * expected + (0.0, 2e-8)).all()


@pytest.mark.slow
@laws
@given(seed=st.integers(0, 2**32 - 1), cuts=st.lists(st.integers(1, 9999), max_size=5))
def test_it_is_the_plain_mean_and_pieces_make_no_difference(seed, cuts):
    spectrum = RoadSpectrum.of(RoadPrior(), INTERVAL_S)
    elevation, travel, nothing = drawn(seed, 4e-6, 2e-7, 800.0, 40.0)
    for piece in np.split(np.arange(10000), sorted(cuts)):
        spectrum.add(elevation[piece], travel[piece], nothing[:, piece])
    # A point is taken as soon as a metre has been travelled: 12.5 nodes of 80 mm.
    gone, points = 0.0, []
    for k in range(10000):
        gone += travel[k]
        if gone >= 1.0:
            points.append(elevation[k])
            gone %= 1.0
    for place, lag in zip((SHORT, LONG), LAGS, strict=True):
        start = 2 * lag * 4e-6 + 2 / 3 * lag**3 * 2e-7
        expected = mean_squares(points, lag, start, 1 / 300)
        assert spectrum.squares[place] == pytest.approx(expected, rel=1e-9)


@laws
@given(seed=st.integers(0, 2**32 - 1), begin=st.integers(0, 4000))
def test_what_is_missing_tells_nothing(seed, begin):
    spectrum, constants = RoadSpectrum.of(RoadPrior(), INTERVAL_S), RoadPrior()
    elevation, travel, nothing = drawn(seed, 1e-4, 1e-5, 400.0, 20.0)
    elevation[:] = np.nan
    spectrum.add(elevation[begin:], travel[begin:], nothing[:, begin:])
    np.testing.assert_allclose(spectrum.road(), (constants.road, constants.long_waves), rtol=1e-6)


@pytest.mark.parametrize(
    ("speed", "tell"), [(0.9, ()), (1.1, (SHORT,)), (7.5, (SHORT,)), (8.5, (SHORT, LONG))]
)
def test_what_takes_longer_than_four_seconds_tells_nothing(speed, tell):
    """Second differences over 2 and over 16 m take 4 and 32 m: the accelerometer drifts."""
    spectrum = RoadSpectrum.of(RoadPrior(), INTERVAL_S)
    start = spectrum.squares.copy()
    spectrum.add(*drawn(4, 1e-4, 1e-5, 60.0, speed))
    for place in (SHORT, LONG):
        assert (spectrum.squares[place] != start[place]) == (place in tell)


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    begin=st.integers(500, 3000),
    gone_m=st.floats(3.1, 60.0),
    jump=st.floats(-1.0, 1.0),
)
def test_nothing_is_compared_across_a_hole(seed, begin, gone_m, jump):
    """Behind one of some metres the road may be a step higher: that is no road."""
    elevation, travel, nothing = drawn(seed, 4e-6, 2e-7, 300.0, 20.0)
    end = begin + round(gone_m / travel[0])
    elevation[begin:end] = np.nan
    roads = []
    for step in (0.0, jump):
        spectrum = RoadSpectrum.of(RoadPrior(), INTERVAL_S)
        spectrum.add(elevation + step * (np.arange(elevation.size) >= end), travel, nothing)
        roads.append(spectrum.squares)
    np.testing.assert_allclose(*roads, rtol=1e-6)


def test_a_bump_is_no_road_and_no_road_is_much_smoother_than_at_the_start():
    constants = RoadPrior()
    spectrum, flat = RoadSpectrum.of(constants, INTERVAL_S), np.zeros(400_000)
    spectrum.add(flat, np.full(flat.size, 0.04), np.zeros((2, flat.size)))
    least = np.array([constants.road, constants.long_waves]) / 8.0
    np.testing.assert_allclose(spectrum.road(), least)
    usual = RoadSpectrum.of(constants, INTERVAL_S)
    bump = np.where(np.arange(5000) * 0.04 > 100.0, 0.2, 0.0)
    usual.add(bump, np.full(bump.size, 0.04), np.zeros((2, bump.size)))
    # Twice sixteen points see it, each as three deviations.
    most = (1 + 8 / 300) ** 32
    assert (usual.road() < most * np.array([constants.road, 2 * constants.long_waves])).all()


def textured(seed, q, texture_m, travel, count):
    """Return the same as `drawn` at nodes ``travel`` apart, each with its own texture."""
    rng = np.random.default_rng(seed)
    rises = np.sqrt(q * travel) * rng.normal(size=count)
    elevation = np.cumsum(rises) + texture_m * rng.normal(size=count)
    return elevation, np.full(count, travel), np.zeros((2, count))


@pytest.mark.cites("(2.4)")
@pytest.mark.parametrize("travel", [0.006, 0.02])
@pytest.mark.parametrize(("q", "texture_m"), [(4e-6, 1e-3), (4e-6, 3e-4), (1e-4, 2e-3)])
def test_texture_is_what_no_distance_takes_away(q, texture_m, travel):
    spectrum = RoadSpectrum.of(RoadPrior(road_memory_m=6000.0), INTERVAL_S)
    spectrum.add(*textured(5, q, texture_m, travel, round(2000.0 / travel)))
    assert np.sqrt(spectrum.reading_m2()) == pytest.approx(texture_m, rel=0.1)


@pytest.mark.parametrize("q", [1e-6, 4e-6, 1e-4])
def test_a_rough_road_is_no_texture(q):
    spectrum = RoadSpectrum.of(RoadPrior(road_memory_m=6000.0), INTERVAL_S)
    spectrum.add(*textured(6, q, 0.0, 0.02, 100_000))
    # A tenth of what the road itself rises from node to node.
    assert np.sqrt(spectrum.reading_m2()) < 0.1 * np.sqrt(2 * q * 0.02)


@pytest.mark.slow
@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    cuts=st.lists(st.integers(1, 1999), max_size=5),
    lost=st.integers(5, 1990),
)
def test_texture_is_the_plain_mean_of_five_nodes_in_a_row(seed, cuts, lost):
    rng = np.random.default_rng(seed)
    elevation, _, nothing = textured(seed, 4e-6, 5e-4, 0.01, 2000)
    travel = rng.choice([0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.004, 0.04], 2000)
    elevation[lost] = np.nan
    spectrum = RoadSpectrum.of(RoadPrior(), INTERVAL_S)
    means = np.full(2, 6.0 * RoadPrior().reading_m ** 2)
    for piece in np.split(np.arange(2000), sorted(cuts)):
        spectrum.add(elevation[piece], travel[piece], nothing[:, piece])
    for k in range(4, 2000):
        five = slice(k - 4, k + 1)
        if np.isnan(elevation[five]).any() or (travel[five] != 0.01).any():
            continue
        for lag in (1, 2):
            bend = elevation[k] - 2 * elevation[k - lag] + elevation[k - 2 * lag]
            # Some 20 m are remembered, a fifteenth of the 300 m of the spectrum.
            means[lag - 1] += 0.01 / 20 * (min(bend**2, 9 * means[lag - 1]) - means[lag - 1])
    expected = max(2 * means[0] - means[1], 0.0) / 6.0
    assert spectrum.reading_m2() == pytest.approx(expected, rel=1e-9, abs=1e-18)


def of_changes(changed):
    """Return what a filter's height has been moved by at nodes, with the velocity it was turned."""
    moved, turned = changed
    return np.cumsum(moved) + INTERVAL_S * (np.cumsum(np.cumsum(turned)) - np.cumsum(turned))


@laws
@given(seed=st.integers(0, 2**32 - 1), cuts=st.lists(st.integers(1, 9999), max_size=5))
def test_what_readings_change_in_the_height_is_no_road(seed, cuts):
    rng = np.random.default_rng(seed)
    elevation, travel, nothing = drawn(seed, 4e-6, 2e-7, 800.0, 40.0)
    changed = rng.normal(size=(2, 10000)) * [[1e-3], [1e-2]]
    plain, ours = (RoadSpectrum.of(RoadPrior(), INTERVAL_S) for _ in range(2))
    plain.add(elevation, travel, nothing)
    for piece in np.split(np.arange(10000), sorted(cuts)):
        filtered = (elevation + of_changes(changed))[piece]
        ours.add(filtered, travel[piece], changed[:, piece])
    expected = plain.squares
    np.testing.assert_allclose(ours.squares, expected, rtol=1e-6)


@laws
@given(seed=st.integers(0, 2**32 - 1), turned=st.floats(-0.5, 0.5))
def test_a_velocity_that_was_turned_before_is_the_one_to_believe(seed, turned):
    """At a speed that is not constant a wrong velocity bends the elevation over distance."""
    elevation, _, nothing = drawn(seed, 4e-6, 2e-7, 800.0, 40.0)
    travel = 0.04 * (1.0 + 1e-5 * np.arange(10000))
    plain, ours = (RoadSpectrum.of(RoadPrior(), INTERVAL_S) for _ in range(2))
    plain.add(elevation, travel, nothing)
    changed = nothing.copy()
    changed[1, 0] = turned
    ours.add(elevation, travel, changed)
    expected = plain.squares
    np.testing.assert_allclose(ours.squares, expected, rtol=1e-6)


def test_in_a_brake_the_tilt_is_not_taken_for_road():
    """0.2 g from 20 m/s: the elevation errs by a tilt of 3 degrees per g."""
    times = INTERVAL_S * np.arange(4000)
    speed = 20.0 - 2.0 * np.maximum(times - 1.0, 0.0)
    error = 0.1 * 0.5 * np.maximum(times - 1.0, 0.0) ** 2
    spectrum = RoadSpectrum.of(RoadPrior(), INTERVAL_S)
    flat = RoadSpectrum.of(RoadPrior(), INTERVAL_S)
    nothing = np.zeros((2, times.size))
    spectrum.add(error, speed * INTERVAL_S, nothing)
    flat.add(np.zeros(times.size), speed * INTERVAL_S, nothing)
    assert spectrum.squares[LONG] < 1.1 * flat.squares[LONG]


def driven(seed, q, g, kilometres):
    """Return a drive at 20 m/s over a road of this spectrum, by a body that sways."""
    rng, rate, speed = np.random.default_rng(seed), 500, 20.0
    road, travel, _ = drawn(seed, q, g, 1e3 * kilometres, speed)
    times = np.arange(road.size) / rate
    hz, phases = rng.uniform(0.5, 2.0, (3, 1)), rng.uniform(0.0, 6.28, (3, 1))
    sways = 0.01 * np.sin(2 * np.pi * hz * times + phases)
    force = -((2 * np.pi * hz) ** 2 * sways).sum(axis=0) + 1e-3 * rng.normal(size=times.size)
    height = 0.3 + sways.sum(axis=0) - road
    return rate, force, height, np.cumsum(travel) - travel[0]


@pytest.mark.slow
@pytest.mark.parametrize(("q", "g"), [(2e-6, 5e-7), (4e-6, 2.5e-8), (1e-5, 2e-6)])
def test_a_run_learns_the_spectrum_of_its_road_and_goes_on_believing_it(drive, through, q, g):
    """The filter follows the road that it expects: that shall not make it expect more of it."""
    stage = RoadPriorSmoother()
    drawn_run = type(drive(1, 1.0, 500))(*driven(4, q, g, 4.0))
    through(stage, drawn_run, range(500, drawn_run.a.size, 500))
    spectrum = stage.memory["filters"]["left"].spectrum
    squares = np.array([[2 * lag, 2 / 3 * lag**3] for lag in LAGS]) @ (q, g)
    found = spectrum.squares
    assert (np.abs(np.sqrt(found / squares) - 1.0) < (0.2, 0.4)).all()
