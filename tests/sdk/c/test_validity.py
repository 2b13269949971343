"""Validity in C: marks of the drive, causes of points and valid points are those of the SDK."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.engine.validity_and_sigma import Reach, replace_by_validity
from floatref.kernels import motion
from floatref.measures.roughness.agreement import cross_correlation
from floatref.measures.roughness.zero_phase import high_pass_b3x2
from floatref.stages.marks import SLOW_MPS, STOPPING_TIME_S, WINDOW_S
from floatref.values.arrays import LASTING

RATE, COUNT_M, INTERVAL_M, LENGTH = 256.0, 2.0**-10, 0.125, 2000
NO_COUNT = -(2**63)


def drive(seed, missing):
    """Return counts of a drive with brakes and stops, and causes of some samples."""
    rng = np.random.default_rng(seed)
    knots = rng.choice([0.0, 2.0, 6.0, 15.0, 25.0], 7)
    speed = np.interp(np.arange(LENGTH), np.linspace(0, LENGTH, 7), knots)
    counts = np.floor(np.cumsum(speed) / RATE / COUNT_M).astype(np.int64)
    for first, length in missing:
        counts[first : first + length] = NO_COUNT
    causes = np.where(rng.random(LENGTH) < 0.01, rng.integers(0, 16, LENGTH), 0)
    return counts, causes.astype(np.uint8)


def marks_of(counts, every):
    """Return the marks of the SDK at every N-th sample, held in between."""
    metres = np.where(counts == NO_COUNT, np.nan, counts * COUNT_M)[::every]
    window = max(1, round(WINDOW_S * RATE / every))
    window_s = window * every / RATE
    flags = np.empty(metres.size, np.uint8)
    wide = np.concatenate((np.full(2 * window, np.nan), metres))
    limits = SLOW_MPS * 2 * window_s, 2 * STOPPING_TIME_S / window_s
    motion.mark_drive(wide, window, *limits, (4, 8), flags)
    return np.repeat(flags, every)[: counts.size]


def of_points(counts, causes):
    """Return the causes of points, each asked for the samples that are its own."""
    known = np.where(counts == NO_COUNT, -1, counts - counts[0]) * COUNT_M
    farthest = np.maximum.accumulate(known)
    made, used = [], 0
    for k in range(int((farthest[-1] + 1e-6 * INTERVAL_M) / INTERVAL_M) + 1):
        place = k * INTERVAL_M
        i = int(np.argmax(farthest + 1e-6 * INTERVAL_M >= place))
        step = farthest[i] - (farthest[i - 1] if i else 0.0)
        cause = int(causes[i])
        if step > INTERVAL_M * (1 + 1e-6) and place < farthest[i] - 1e-6 * INTERVAL_M:
            cause |= int(causes[i - 1])
        cause |= int(np.bitwise_or.reduce(causes[used : i + 1], initial=0)) & int(LASTING)
        made, used = [*made, cause], i + 1
    made[-1] |= int(np.bitwise_or.reduce(causes[used:], initial=0)) & int(LASTING)
    return made


def bytes_at(library, x):
    return library.ffi.cast("uint8_t *", x.ctypes.data)


def in_c(library, counts, causes, edges, every):
    config = {"rate_hz": RATE, "metres_per_count": COUNT_M, "interval_m": INTERVAL_M}
    made = library.make("causes", every=every, **config)
    room, written, found = np.zeros(9000, np.uint8), library.ffi.new("size_t *"), []
    for begin, end in pairwise(edges):
        part, own = library.array(counts[begin:end]), causes[begin:end].copy()
        arguments = library.at(part), bytes_at(library, own), end - begin, bytes_at(library, room)
        assert made.call("push", *arguments, 9000, written) == 0
        found += room[: written[0]].tolist()
    points = np.array(found, np.uint8)
    assert made.call("finish", bytes_at(library, points), points.size) == 0
    return points.tolist()


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    missing=st.lists(st.tuples(st.integers(1, LENGTH), st.integers(1, 300)), max_size=2),
    cut=st.integers(0, LENGTH),
    every=st.sampled_from([1, 4]),
)
@example(seed=1, missing=[(500, 40)], cut=520, every=1)
def test_causes_of_points_are_those_of_their_samples(double, seed, missing, cut, every):
    counts, causes = drive(seed, missing)
    expected = of_points(counts, causes | marks_of(counts, every))
    assert in_c(double, counts, causes, [0, cut, LENGTH], every) == expected


def test_a_drive_of_the_law_crawls_and_brakes():
    counts, _ = drive(1, [])
    assert set(np.unique(marks_of(counts, 1))) == {0, 4, 8}


LENGTHS = st.floats(0.0, 300.0)


@settings(max_examples=80, deadline=None)
@given(
    flags=st.lists(st.sampled_from([0] * 30 + [1, 2, 3, 4, 8, 12, 16]), max_size=400),
    interval_m=st.sampled_from([0.025, 0.5, 2.0, 7.0]),
    reaches=st.tuples(LENGTHS, LENGTHS, LENGTHS, LENGTHS, LENGTHS),
)
def test_valid_points_are_those_of_the_sdk(build, flags, interval_m, reaches):
    names = "drift_m", "run_in_m", "before_slow_m", "after_slow_m", "after_braking_m"
    reach = dict(zip(names, reaches, strict=True))
    causes = np.array(flags, np.uint8)
    expected = replace_by_validity(causes.copy(), interval_m, Reach(**reach))
    for library in (build("double"), build("float")):
        config = library.config("validity", interval_m=interval_m, **reach)
        place, written = bytes_at(library, causes), library.ffi.new("size_t *")
        made = causes.copy()
        for one in (place, bytes_at(library, made)):  # In place, too.
            to = bytes_at(library, made)
            assert library.lib.fr_validity(config, one, causes.size, to, made.size, written) == 0
            np.testing.assert_array_equal(made, expected)
            made[:] = causes


def test_causes_that_cannot_be_and_calls_out_of_order_are_refused(double):
    config = {"rate_hz": RATE, "metres_per_count": COUNT_M, "interval_m": INTERVAL_M}
    made, written = double.make("causes", **config), double.ffi.new("size_t *")
    counts, points = double.array(np.array([NO_COUNT, 5, 900])), np.zeros(99, np.uint8)
    to = bytes_at(double, points), 99, written
    status = made.call("push", double.at(counts), double.ffi.NULL, 3, *to)
    assert double.status[status] == "FR_BAD_SAMPLE"
    assert made.call("push", double.at(counts[1:]), double.ffi.NULL, 2, *to) == 0
    assert double.status[made.call("finish", to[0], written[0] + 1)] == "FR_INCOMPLETE_SET"
    assert made.call("finish", to[0], written[0]) == 0
    points[3] = 128
    config = double.config("validity", interval_m=1.0)
    status = double.lib.fr_validity(config, to[0], 9, to[0], 9, written)
    assert double.status[status] == "FR_BAD_SAMPLE"


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(8, 300),
    lag=st.integers(-9, 9),
    max_offset_m=st.sampled_from([0.0, 0.25, 1.0]),
)
def test_agreement_is_that_of_the_sdk(build, seed, count, lag, max_offset_m):
    rng = np.random.default_rng(seed)
    p = np.cumsum(rng.normal(size=count))
    q = 0.8 * np.roll(p, lag) + 0.1 * rng.normal(size=count)
    for library in (build("double"), build("float")):
        one, two = library.array(p), library.array(q)
        config = library.config("cross_correlation", interval_m=0.125, max_offset_m=max_offset_m)
        found = library.ffi.new("fr_agreement *")
        pointers = library.at(one), library.at(two)
        status = library.lib.fr_cross_correlation(config, *pointers, count, found)
        if count < 4 * max_offset_m / 0.125:
            assert library.status[status] == "FR_BAD_CONFIG"
            continue
        assert status == 0
        expected = cross_correlation(one.astype(float), two.astype(float), 0.125, max_offset_m)
        assert found.offset_m == expected.offset_m
        for name in ("cross_correlation", "correlation", "amplitude_factor"):
            assert getattr(found, name) == pytest.approx(getattr(expected, name), abs=1e-12)


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 400))
def test_a_profile_without_long_waves_is_that_of_the_sdk(double, seed, count):
    z = 37.0 + np.cumsum(np.random.default_rng(seed).normal(size=count))
    config = double.config("high_pass_profile", interval_m=0.5, wavelength_m=20.0)
    status, made = double.array_call("fr_high_pass_profile", config, z)
    setting = double.lib.fr_high_pass_wavelength_setting(20.0)
    assert status == 0
    expected = high_pass_b3x2(z - z[0], 0.5, setting)
    np.testing.assert_allclose(made, expected, rtol=0, atol=1e-12 * np.abs(z - z[0]).max())


@pytest.mark.parametrize("wavelength_m", [0.0, -1.0, float("nan"), float("inf")])
def test_an_impossible_wavelength_has_a_status(double, wavelength_m):
    config = double.config("high_pass_profile", interval_m=0.5, wavelength_m=wavelength_m)
    status, _ = double.array_call("fr_high_pass_profile", config, np.zeros(3))
    assert status == 6
