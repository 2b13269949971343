"""The curve of noise coefficients: exact curves come back, drawn noise within its uncertainty."""

import allantools
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.allan.deviation import (
    AllanDeviation,
    AllanScatter,
    allan_deviation,
    cluster_sizes,
)
from floatref.measures.allan.noise_fit import NoiseCoefficients, fit_noise
from floatref_reference.chapter_6 import section_6_4_1_allan as reference
from floatref_reference.chapter_6.section_6_4_2_gyroscopes import spectral_density

FEW = settings(deadline=None, max_examples=10)
TERMS = NoiseCoefficients._fields
PRINTED = NoiseCoefficients(ramp=1.03e-7, random_walk=1.38e-6, white_noise=7.56e-4)
"""R_A, K_A and N_A of (6.54) and (6.55) in deg/s², deg/s^(3/2) and deg/√s."""


def exact(coefficients: NoiseCoefficients, count: int, interval_s: float = 0.01) -> AllanDeviation:
    """The deviation of ``count`` samples whose noise is just as (6.53) says."""
    sizes = cluster_sizes(count)
    deviation = coefficients.deviation(sizes * interval_s)
    return AllanDeviation(interval_s, count, sizes, deviation, float(deviation[0]))


def noise(
    rng: np.random.Generator,
    count: int,
    interval_s: float,
    white: float = 0.0,
    walk: float = 0.0,
    quantization: float = 0.0,
) -> np.ndarray:
    x = white / np.sqrt(interval_s) * rng.normal(size=count)
    x += walk * np.sqrt(interval_s) * np.cumsum(rng.normal(size=count))
    return x + quantization * np.diff(rng.normal(size=count + 1)) / interval_s


@pytest.mark.cites("(6.53)")
@FEW
@given(
    values=st.lists(st.floats(0.0, 10.0), min_size=5, max_size=5),
    times=st.lists(st.floats(1e-4, 1e5), min_size=1, max_size=5),
)
def test_the_curve_is_the_printed_one(values: list[float], times: list[float]) -> None:
    found = NoiseCoefficients(*values).deviation(np.array(times))
    expected = [float(reference.modelled_variance(t, *values)) for t in times]
    assert found**2 == pytest.approx(expected, rel=1e-12)


@pytest.mark.slow
@FEW
@given(
    logs=st.lists(st.floats(-1.0, 1.0), min_size=5, max_size=5),
    absent=st.sets(st.integers(0, 4), max_size=4),
)
def test_an_exact_curve_of_any_terms_is_fitted_back(logs: list[float], absent: set[int]) -> None:
    # At these the terms take turns over the six decades of cluster time.
    typical = np.array([1e-4, 3e-3, 0.3, 0.1, 1e-3])
    values = np.where([k in absent for k in range(5)], 0.0, typical * 10.0 ** np.array(logs))
    found = fit_noise(exact(NoiseCoefficients(*values), 10_000_000), confidence=0.0)
    curve = found.deviation / found.allan.deviation
    assert curve == pytest.approx(np.ones(curve.size), rel=1e-6)
    for term, value, coefficient in zip(TERMS, values, found.coefficients, strict=True):
        own = NoiseCoefficients(**{term: value}).deviation(found.allan.cluster_s)
        if (own**2 > 0.1 * found.allan.deviation**2).any():
            assert coefficient == pytest.approx(value, rel=1e-3), term


@pytest.mark.cites("(6.54)", "(6.55)")
def test_the_printed_gyroscope_is_fitted_back() -> None:
    hours = exact(PRINTED, int(21.5 * 3600 * 100))
    found = fit_noise(hours, confidence=0.0)
    assert found.coefficients == pytest.approx(PRINTED, rel=1e-4, abs=1e-12)
    assert found.coefficients.white_noise * 60.0 == pytest.approx(0.0454, abs=5e-5)
    assert found.dominates("white_noise") == pytest.approx((0.01, 450.0), rel=0.1)
    assert found.worst()[0] == pytest.approx(1.0, abs=1e-4)


def test_what_21_hours_can_tell_of_the_printed_gyroscope() -> None:
    found = fit_noise(exact(PRINTED, int(21.5 * 3600 * 100)))
    assert found.coefficients.white_noise == pytest.approx(PRINTED.white_noise, rel=0.01)
    assert found.coefficients.quantization == 0.0
    walk = found.coefficients.random_walk
    # The walk is a tenth of the variance at most: either it is seen, or bounded from above.
    assert walk > 0.0 or found.limits.random_walk > PRINTED.random_walk


def test_terms_that_take_turns_are_told_apart_in_a_day() -> None:
    true = NoiseCoefficients(ramp=1e-4, random_walk=3e-3, white_noise=0.1, quantization=0.02)
    found = fit_noise(exact(true, 24 * 3600 * 100))
    assert found.coefficients == pytest.approx(true, rel=0.02)
    reach = {term: found.dominates(term) for term in TERMS}
    assert reach["bias_instability"] is None
    # Neighbours are equal at 3 Q²/N², √3 N/K and 2 K²/(3 R²).
    assert reach["quantization"] == pytest.approx((0.01, 0.12), rel=0.15)
    assert reach["white_noise"] == pytest.approx((0.12, 57.7), rel=0.15)
    assert reach["random_walk"] == pytest.approx((57.7, 600.0), rel=0.15)
    assert reach["ramp"] == pytest.approx((600.0, 28_800.0), rel=0.15)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("term", "values", "count"),
    [
        ("white_noise", {"white": 0.02}, 8000),
        ("white_noise", {"white": 0.02, "walk": 0.006}, 8000),
        ("random_walk", {"white": 0.02, "walk": 0.06}, 8000),
        ("quantization", {"white": 0.002, "quantization": 0.001}, 8000),
    ],
)
def test_drawn_noise_is_recovered_within_its_uncertainty(
    term: str, values: dict[str, float], count: int
) -> None:
    true = {"white_noise": "white", "random_walk": "walk", "quantization": "quantization"}
    scores = []
    for seed in range(20):
        x = noise(np.random.default_rng(seed), count, 0.01, **values)
        found = fit_noise(allan_deviation(x, 0.01))
        value, spread = (getattr(c, term) for c in (found.coefficients, found.uncertainties))
        scores.append((value - values[true[term]]) / spread)
    assert np.abs(scores).max() < 4.0
    assert abs(np.mean(scores)) < 0.5
    # The model error is part of the uncertainty, and not of drawn noise.
    assert 0.2 < np.sqrt(np.mean(np.square(scores))) < 1.3


@pytest.mark.slow
def test_a_ramp_is_recovered_within_its_uncertainty() -> None:
    scores = []
    for seed in range(20):
        x = noise(np.random.default_rng(seed), 8000, 0.01, white=1.0)
        found = fit_noise(allan_deviation(x + 0.05 * 0.01 * np.arange(x.size), 0.01))
        scores.append((found.coefficients.ramp - 0.05) / found.uncertainties.ramp)
    assert 0.3 < np.sqrt(np.mean(np.square(scores))) < 1.5


@pytest.mark.slow
def test_white_noise_supports_no_other_term() -> None:
    alone = 0
    for seed in range(40):
        x = noise(np.random.default_rng(seed), 5000, 0.01, white=1.0)
        found = fit_noise(allan_deviation(x, 0.01))
        alone += np.count_nonzero(found.coefficients) == 1
        for term, value, limit in zip(TERMS, found.coefficients, found.limits, strict=True):
            assert np.isnan(limit) if value > 0 else limit > 0, term
    assert alone >= 38


@pytest.mark.slow
def test_a_walk_too_small_to_be_seen_stays_below_its_limit() -> None:
    below, seen = 0, 0
    for seed in range(40):
        x = noise(np.random.default_rng(seed), 5000, 0.01, white=1.0, walk=0.05)
        found = fit_noise(allan_deviation(x, 0.01))
        seen += found.coefficients.random_walk > 0
        below += found.limits.random_walk > 0.05
    assert seen <= 4
    assert below >= 34


@pytest.mark.slow
@FEW
@given(seed=st.integers(0, 2**32 - 1), exponent=st.integers(-15, 90), slower=st.floats(1e-3, 1e3))
def test_units_of_signal_and_time_change_no_more_than_the_units(
    seed: int, exponent: int, slower: float
) -> None:
    x = noise(np.random.default_rng(seed), 5000, 0.01, white=1.0, walk=0.8)
    plain, factor = fit_noise(allan_deviation(x, 0.01)), 10.0**exponent
    other = fit_noise(allan_deviation(factor * x, 0.01 * slower))
    powers = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
    for ours, theirs in (
        (plain.coefficients, other.coefficients),
        (plain.uncertainties, other.uncertainties),
    ):
        expected = np.array(ours) * factor * slower**powers
        assert np.array(theirs) == pytest.approx(expected, rel=1e-4)
    assert other.scatter == pytest.approx(plain.scatter, rel=1e-4)


@pytest.mark.parametrize(
    ("alpha", "values", "within"),
    [
        (2, {"quantization": 1.0}, 0.3),
        (0, {"white_noise": 1.0}, 0.1),
        (-1, {"bias_instability": 1.0}, 0.1),
        (-2, {"random_walk": 1.0}, 0.1),
    ],
)
def test_degrees_of_freedom_are_those_of_allantools(
    alpha: int, values: dict[str, float], within: float
) -> None:
    count = 100_000
    found = fit_noise(exact(NoiseCoefficients(**values), count), confidence=0.0)
    inner = (found.allan.clusters >= 10) & (found.allan.clusters <= count // 10)
    expected = [
        allantools.edf_simple(count + 1, int(n), alpha) for n in found.allan.clusters[inner]
    ]
    assert 0.5 / found.scatter[inner] ** 2 == pytest.approx(expected, rel=within)


@pytest.mark.cites("(6.56)")
def test_the_scatter_is_the_integral_over_the_printed_spectrum() -> None:
    values = {"n_a": 0.1, "k_a": 0.4, "r_a": 0.0}
    count, interval_s, sizes = 2000, 0.01, np.array([1, 3, 10, 40, 200])
    f = (np.arange(20_000) + 0.5) / (20_000 * 2.0 * interval_s)
    density = np.array([float(spectral_density(x, **values)) for x in f])
    tau = sizes[:, None] * interval_s
    gain = np.sin(np.pi * f * tau) ** 4 / (sizes[:, None] * np.sin(np.pi * f * interval_s)) ** 2
    shares = 2.0 * density * 2.0 * gain
    moved = (count - 2 * sizes[:, None] + 1) * interval_s
    expected = (shares / np.sqrt(moved)) @ (shares / np.sqrt(moved)).T * (f[1] - f[0])
    allan = AllanDeviation(interval_s, count, sizes, np.ones(5), 1.0)
    squares = np.array([0.0, 0.4**2, 0.0, 0.1**2, 0.0])
    scatter = AllanScatter(allan)
    root = scatter.root(squares)
    assert root @ root.T == pytest.approx(expected, rel=0.03)
    assert scatter.variance(squares) == pytest.approx(np.diag(expected), rel=0.03)


def test_drawn_deviations_scatter_as_they_are_said_to() -> None:
    drawn = []
    for seed in range(120):
        x = noise(np.random.default_rng(seed), 4000, 0.01, white=1.0, walk=1.0)
        drawn.append(allan_deviation(x, 0.01).deviation)
    true = NoiseCoefficients(white_noise=1.0, random_walk=1.0)
    said = fit_noise(exact(true, 4000), confidence=0.0).scatter
    spread = np.std(np.square(drawn), axis=0) / (2.0 * np.mean(np.square(drawn), axis=0))
    assert spread == pytest.approx(said, rel=0.3)


def test_the_worst_place_is_where_curve_and_data_part() -> None:
    plain = exact(NoiseCoefficients(white_noise=1.0), 1_000_000)
    bump = np.where(np.abs(plain.clusters - 300) < 60, 3.0, 1.0)
    bumpy = AllanDeviation(0.01, plain.count, plain.clusters, bump * plain.deviation, 1.0)
    factor, at_s = fit_noise(bumpy).worst()
    assert factor > 2.0
    assert 2.4 <= at_s <= 3.6
    late = np.where(plain.clusters > 200_000, 3.0, 1.0)
    tail = AllanDeviation(0.01, plain.count, plain.clusters, late * plain.deviation, 1.0)
    assert fit_noise(tail).worst()[0] < 1.5


def test_too_few_cluster_times_are_refused() -> None:
    allan = exact(NoiseCoefficients(white_noise=1.0), 1000)
    with pytest.raises(InputError, match="5 cluster times; a fit takes 8 or more"):
        fit_noise(allan.between(0.0, 0.05))


def test_a_deviation_of_zero_is_refused() -> None:
    allan = allan_deviation(np.tile([1.0, -1.0], 500), 0.01)
    with pytest.raises(InputError, match="not above zero"):
        fit_noise(allan)
