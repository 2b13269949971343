"""Overlapping Allan deviation against the equations, allantools, and closed forms."""

import importlib

import allantools
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.allan.deviation import allan_deviation, cluster_sizes
from floatref_reference.chapter_6 import section_6_4_1_allan as reference

FEW = settings(deadline=None, max_examples=20)
seeds = st.integers(0, 2**32 - 1)
KINDS = ("white", "walk", "steps", "ramp")


def drawn(seed: int, count: int, kind: str = "white") -> np.ndarray:
    rng = np.random.default_rng(seed)
    x = rng.normal(size=count)
    if kind == "walk":
        x = np.cumsum(x)
    if kind == "steps":
        x = np.round(3.0 * x) + (np.arange(count) > count // 3)
    if kind == "ramp":
        x = x + 0.01 * np.arange(count)
    return x


@pytest.mark.cites("(6.49) to (6.52)")
@settings(deadline=None, max_examples=8)
@given(seed=seeds, count=st.integers(64, 90), kind=st.sampled_from(KINDS))
def test_every_cluster_size_has_the_printed_variance(seed: int, count: int, kind: str) -> None:
    x = drawn(seed, count, kind)
    found = allan_deviation(x, 0.02)
    expected = [float(reference.allan_variance(x, n)) for n in found.clusters.tolist()]
    assert found.deviation**2 == pytest.approx(expected, rel=1e-11)
    theta = reference.integrated(x, 0.02)
    printed = reference.allan_variance_of_integral(theta, int(found.clusters[-1]), 0.02)
    assert found.deviation[-1] ** 2 == pytest.approx(float(printed), rel=1e-11)


@FEW
@given(
    seed=seeds,
    count=st.integers(64, 5000),
    kind=st.sampled_from(KINDS),
    offset=st.floats(-1e3, 1e3),
    rate=st.sampled_from([1.0, 20.0, 100.0, 16000.0]),
)
def test_allantools_finds_the_same(
    seed: int, count: int, kind: str, offset: float, rate: float
) -> None:
    x = offset + drawn(seed, count, kind)
    found = allan_deviation(x, 1.0 / rate)
    taus, deviation, _, pairs = allantools.oadev(
        x, rate=rate, data_type="freq", taus=found.cluster_s
    )
    assert found.cluster_s == pytest.approx(taus)
    assert found.deviation == pytest.approx(deviation, rel=1e-9)
    assert found.count - 2 * found.clusters + 1 == pytest.approx(pairs)


@FEW
@given(
    seed=seeds,
    exponent=st.integers(-12, 12),
    offset=st.floats(-1e4, 1e4),
    kind=st.sampled_from(KINDS),
)
def test_scale_scales_and_an_offset_is_not_seen(
    seed: int, exponent: int, offset: float, kind: str
) -> None:
    x = drawn(seed, 500, kind)
    plain, factor = allan_deviation(x, 0.01), 10.0**exponent
    other = allan_deviation(factor * (x + offset), 0.01)
    assert other.deviation == pytest.approx(factor * plain.deviation, rel=1e-8)
    assert other.standard_deviation == pytest.approx(factor * x.std(), rel=1e-8)


def test_single_samples_of_white_noise_have_their_standard_deviation() -> None:
    x = drawn(1, 200_000)
    found = allan_deviation(x, 0.01)
    assert found.standard_deviation == pytest.approx(x.std(), rel=1e-12)
    assert found.deviation[0] == pytest.approx(found.standard_deviation, rel=0.01)


def test_a_long_signal_far_from_zero_loses_nothing_to_rounding() -> None:
    x = 9.8e3 + np.cumsum(drawn(2, 600_000)) * 1e-4 + drawn(3, 600_000)
    found = allan_deviation(x, 1.0)
    sums = np.concatenate([[0.0], np.cumsum(x.astype(np.longdouble) - np.longdouble(9.8e3))])
    for k in (0, 10, 50, found.clusters.size - 1):
        n = int(found.clusters[k])
        second = sums[2 * n :] - 2.0 * sums[n:-n] + sums[: -2 * n]
        expected = np.sqrt(float(np.mean(second**2)) / 2.0) / n
        assert found.deviation[k] == pytest.approx(expected, rel=1e-11)


@pytest.mark.slow
@settings(deadline=None, max_examples=10)
@given(seed=seeds, stride=st.integers(2, 7), spare=st.integers(0, 6))
def test_a_signal_too_long_for_all_sums_counts_by_blocks(
    seed: int, stride: int, spare: int
) -> None:
    blocks = 70
    x = drawn(seed, blocks * stride + spare % stride, "walk")
    module = importlib.import_module("floatref.measures.allan.deviation")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "MOST_SUMS", blocks + 1)
        patch.setattr(importlib.import_module("floatref.values.scanning"), "CHUNK", 37)
        found = allan_deviation(x, 0.5)
    size = -(-x.size // (blocks + 1))
    means = x[: x.size // size * size].reshape(-1, size).mean(axis=1)
    assert (found.clusters % size == 0).all()
    for n, deviation in zip(found.clusters.tolist(), found.deviation, strict=True):
        expected = float(reference.allan_variance(means, n // size))
        assert deviation**2 == pytest.approx(expected, rel=1e-9)


def test_a_signal_in_a_file_and_in_memory_are_the_same(tmp_path) -> None:
    x = drawn(5, 700_000, "walk")
    x.tofile(tmp_path / "x.f64")
    mapped = np.memmap(tmp_path / "x.f64", dtype=np.float64, mode="r")
    assert (allan_deviation(mapped, 1.0).deviation == allan_deviation(x, 1.0).deviation).all()


@given(count=st.integers(64, 10**9))
@FEW
def test_cluster_sizes_rise_from_one_to_a_third_and_stay_dense(count: int) -> None:
    sizes = cluster_sizes(count)
    assert sizes[0] == 1
    assert sizes[-1] == count // 3
    assert (np.diff(sizes) > 0).all()
    steps = sizes[1:] / sizes[:-1]
    assert steps[sizes[:-1] > 20].max(initial=1.0) < 10.0 ** (1.5 / 20.0)


def test_progress_goes_up_to_one() -> None:
    shares: list[float] = []
    allan_deviation(drawn(0, 1000), 1.0, shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0


@pytest.mark.slow
@given(seed=seeds, held=st.integers(2, 60))
@FEW
def test_a_held_sensor_settles_where_its_holds_are_not_seen(seed: int, held: int) -> None:
    """The deviation is that of white noise within 20 %, which is more than 6 σ of its estimate.

    Of N white readings, clusters of k readings have 3 N / 2 k degrees of freedom, so that their
    deviation scatters by √(k / 3 N): 2.8 % for k = 24, the longest (three times the 8 below), and
    N = 10,000. Holds lower it by 1 / 4 k: 1 % there. For k = 3, the shortest, it is 8 %, and
    the scatter 1 %.
    """
    readings = drawn(seed, max(100_000 // held, 10_000))
    found = allan_deviation(np.repeat(readings, held), 0.001)
    settled = found.settled_s
    assert 3.0 * held * 0.001 <= settled <= 8.0 * held * 0.001
    rest = found.between(settled, 3.0 * settled)
    white = np.sqrt(held * 0.001 / rest.cluster_s)
    assert rest.deviation == pytest.approx(white, rel=0.2)


@pytest.mark.parametrize("kind", ["white", "walk", "ramp"])
def test_a_sensor_without_band_limit_is_settled_at_once(kind: str) -> None:
    for seed in range(10):
        assert allan_deviation(drawn(seed, 20_000, kind), 0.01).settled_s == 0.0


@pytest.mark.parametrize(
    ("values", "interval_s", "text"),
    [
        (np.arange(63.0), 0.1, "63 samples"),
        (np.ones((100, 2)), 0.1, r"shape \(100, 2\)"),
        (np.arange(100.0), 0.0, "interval is 0.0 s"),
        (np.arange(100.0), np.nan, "interval is nan s"),
        (np.where(np.arange(100) == 7, np.nan, 1.0), 0.1, "1 of 100 samples are missing"),
        (np.full(100, 0.25), 0.1, "every sample is 0.25"),
        (np.where(np.arange(100) == 7, np.inf, 1.0), 0.1, "a sample is inf in size"),
        (np.where(np.arange(100) == 7, -1e200, 1.0), 0.1, r"a sample is 1e\+200 in size"),
    ],
)
def test_what_has_no_allan_deviation_is_refused(
    values: np.ndarray, interval_s: float, text: str
) -> None:
    with pytest.raises(InputError, match=text):
        allan_deviation(values, interval_s)
