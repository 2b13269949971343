"""Acceleration at the end of a brake: sharp where the encoder allows it; jolts come and die."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.plain_equations import jolts as plain_jolts

from floatref.estimators.road_slope.jolts import BESIDE, DECAY_S, jolts, sharpen
from floatref.estimators.road_slope.layout import SHARES, triples
from floatref.estimators.road_slope.readings import Readings
from floatref.values.arrays import FloatArray

STEP = 0.06
some = settings(deadline=None, max_examples=25)
SEEDS = st.integers(0, 2**32 - 1)
STEPS = st.lists(st.floats(-5.0, 5.0), min_size=8, max_size=40).map(np.array)


def at_nodes(along: FloatArray, cuts: tuple[int, ...] = (), **changed: FloatArray) -> Readings:
    """Return nodes with that acceleration, and a pause before each of ``cuts``."""
    pause, zero = np.full(along.size, STEP), np.zeros(along.size)
    pause[list(cuts)] = 9.0
    usual = {"place": zero, "speed": 0 * zero + 9.0} | changed
    return Readings(
        zero, zero, zero, along=along, missing=zero, pause_s=pause, interval_s=STEP, **usual
    )


def sharpened(seen: Readings) -> FloatArray:
    nodes, at = seen.along.size, seen.middles
    second = triples(at, nodes, (STEP**-2.0, -2 * STEP**-2.0, STEP**-2.0))
    return sharpen(seen, triples(at, nodes, SHARES), second)


def end_of_brake(count_m: float, braking: float = 3.0) -> tuple[Readings, FloatArray]:
    """Return a brake to 5 m/s that ends at once, and its acceleration as the mean over nodes.

    The encoder counts by ``count_m``, and the smooth acceleration takes 0.2 s for the end.
    """
    fine, nodes = 60, 80
    t = STEP / fine * (np.arange(fine * nodes) + 0.5)
    end = 0.75 * t[-1]
    x = 5.0 * (t - end) - 0.5 * braking * np.square(np.minimum(t - end, 0.0))
    counted = np.floor(x / count_m) * count_m if count_m else x
    place, exact = (v.reshape(nodes, fine).mean(axis=1) for v in (counted, x))
    bell = np.exp(-0.5 * np.square(np.arange(-8, 9) * STEP / 0.1))
    true = np.gradient(np.gradient(exact, STEP), STEP)
    smooth = np.convolve(np.pad(true, 8, "edge"), bell / bell.sum(), "valid")
    return at_nodes(smooth, place=place), np.diff(exact, 2) / STEP**2


@some
@given(braking=st.floats(1.0, 6.0))
def test_a_fine_encoder_keeps_the_end_of_a_brake_sharp(braking: float) -> None:
    seen, true = end_of_brake(0.0, braking)
    found, smooth = sharpened(seen), (seen.along[:-2] + 10 * seen.along[1:-1] + seen.along[2:]) / 12
    assert np.abs(found - true).max() < 0.02 * braking
    assert np.abs(smooth - true).max() > 0.2 * braking


@some
@given(braking=st.floats(1.0, 6.0), count_m=st.floats(0.15, 0.5))
def test_a_coarse_encoder_leaves_the_smooth_one(braking: float, count_m: float) -> None:
    seen, _ = end_of_brake(count_m, braking)
    found, smooth = sharpened(seen), (seen.along[:-2] + 10 * seen.along[1:-1] + seen.along[2:]) / 12
    noise = np.abs(np.diff(seen.place, 2) / STEP**2 - smooth).max()
    assert noise > 1.0
    assert np.abs(found - smooth).max() < 0.05 * noise


@some
@given(seed=SEEDS, more=st.floats(1.0, 5.0))
def test_a_noisier_encoder_has_a_smaller_part(seed: int, more: float) -> None:
    """One part for all middles; a half at a noise of 0.1 m/s², and none is more than whole."""
    off = np.random.default_rng(seed).normal(size=400)
    zero = np.zeros(off.size)
    place = np.zeros(off.size)
    for k in range(1, off.size - 1):
        place[k + 1] = 2 * place[k] - place[k - 1] + off[k] * STEP**2
    parts = []
    for size in (0.1, 0.1 * more):
        found, whole = sharpened(at_nodes(zero, place=size * place)), size * off[1:-1]
        parts.append(float(found @ whole / (whole @ whole)))
        np.testing.assert_allclose(found, parts[-1] * whole, rtol=1e-6, atol=1e-9)
    assert 0.35 < parts[0] < 0.65
    assert parts[1] <= parts[0] * (1 + 1e-9)


def test_the_noise_is_that_of_a_vehicle_that_moves() -> None:
    """Counts at a crawl say nothing; without a motion the difference of places is believed."""
    seen, true = end_of_brake(0.0)
    crawl = np.where(np.arange(80) < 60, 0.2, 9.0)
    counted = seen.place + np.where(np.arange(80) < 60, 0.01 * (-1.0) ** np.arange(80), 0.0)
    found = sharpened(at_nodes(seen.along, place=counted, speed=crawl))
    assert np.abs(found - true)[62:].max() < 0.1
    stood = sharpened(at_nodes(seen.along, place=seen.place, speed=np.zeros(80)))
    np.testing.assert_allclose(stood, true, atol=1e-9)


@some
@given(along=STEPS, factor=st.floats(-3.0, 3.0), level=st.floats(-5.0, 5.0))
def test_jolts_are_those_of_plain_sums_and_as_large_as_the_changes(
    along: FloatArray, factor: float, level: float
) -> None:
    found = jolts(at_nodes(along))
    np.testing.assert_allclose(found, plain_jolts(at_nodes(along)), atol=1e-12)
    scaled = jolts(at_nodes(level + factor * along))
    np.testing.assert_allclose(scaled, abs(factor) * found, atol=1e-9)
    assert found.max() <= np.abs(np.diff(along)).sum() + 1e-12
    assert found.min() >= 0.0


@some
@given(size=st.floats(-5.0, 5.0), at=st.integers(5, 30))
def test_a_jolt_begins_three_nodes_before_and_dies_in_half_a_second(size: float, at: int) -> None:
    places = np.arange(60)
    found = jolts(at_nodes(np.where(places >= at, size, 0.0)))
    behind = np.maximum(places - at - BESIDE, 0) * STEP
    expected = np.where(places < at - BESIDE, 0.0, abs(size) * np.exp(-behind / DECAY_S))
    np.testing.assert_allclose(found, expected, atol=1e-12)


@some
@given(along=STEPS, cut=st.integers(1, 7))
def test_jolts_restart_after_a_cut(along: FloatArray, cut: int) -> None:
    """What the body did before is over, and a change across the cut is none; but for nodes beside.

    So each side is as it would be alone.
    """
    whole = jolts(at_nodes(along, (cut,)))
    before, behind = jolts(at_nodes(along[:cut])), jolts(at_nodes(along[cut:]))
    np.testing.assert_allclose(whole[: max(0, cut - BESIDE)], before[: max(0, cut - BESIDE)])
    np.testing.assert_allclose(whole[cut + BESIDE :], behind[BESIDE:])


def test_a_steady_brake_has_no_jolts() -> None:
    assert not jolts(at_nodes(np.full(30, -3.0), (11,))).any()
