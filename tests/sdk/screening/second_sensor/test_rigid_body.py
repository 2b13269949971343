"""Accelerometers of a rigid body: whatever their places, one follows from the others."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.second_sensor.body_faults import body_doubts, find_suspect
from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.fast_series import STEP_S, FastGrid, band
from floatref.screening.second_sensor.rigid_body import BAND_HZ, Body
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId

COUNT = 4000
PLACES = {
    ChannelId("vertical_specific_force", "left"): (-1.0, 0.8),
    ChannelId("vertical_specific_force", "right"): (-1.0, -0.8),
    ChannelId("sprung_specific_force", "left"): (1.5, 0.7),
    ChannelId("sprung_specific_force", "right"): (1.5, -0.7),
}
LEFT = ChannelId("vertical_specific_force", "left")
NOISE = 0.01
GRID = FastGrid(0.0, COUNT)
scales = st.floats(-3.0, 3.0).filter(lambda k: abs(k - 1.0) > 0.12 and abs(k) > 0.1)


def motion(seed: int) -> FloatArray:
    """Return heave in m/s², pitch and roll in rad/s², shape (3, n), of a body on a road."""
    source = np.random.default_rng(seed)
    raw = source.standard_normal((3, COUNT))
    return np.stack(
        [2.0 * size * band(row, 0.8, 4.0) for size, row in zip((1.0, 0.5, 0.7), raw, strict=True)]
    )


def body(seed: int = 0, faulty: dict[ChannelId, FloatArray] | None = None, many: int = 4) -> Body:
    """Return ``many`` accelerometers of one body, with the samples of ``faulty`` in place."""
    heave, pitch, roll = motion(seed)
    source = np.random.default_rng(seed + 1)
    raw = {
        name: heave - x * pitch + y * roll + NOISE * source.standard_normal(COUNT)
        for name, (x, y) in list(PLACES.items())[:many]
    } | (faulty or {})
    forces = {name: band(row, *BAND_HZ) for name, row in raw.items()}
    known = np.ones(COUNT, np.bool_)
    known[:200] = known[-200:] = False
    turning = np.stack([band(row, *BAND_HZ) for row in (pitch, roll)])
    return Body(forces, turning, known)


def left(seed: int = 0) -> FloatArray:
    """Return what the left accelerometer of `body` measures, without noise."""
    heave, pitch, roll = motion(seed)
    x, y = PLACES[LEFT]
    return heave - x * pitch + y * roll


def doubts(faulty: FloatArray, seed: int = 0, many: int = 4) -> list[Doubt]:
    return list(body_doubts(body(seed, {LEFT: faulty}, many), GRID))


@pytest.mark.slow
@given(seed=st.integers(0, 10_000), many=st.sampled_from([2, 3, 4]))
@settings(max_examples=30, deadline=None)
def test_a_healthy_body_raises_no_doubt(seed: int, many: int) -> None:
    assert not list(body_doubts(body(seed, many=many), GRID))


@pytest.mark.slow
@given(scale=scales, seed=st.integers(0, 1000))
@settings(max_examples=30, deadline=None)
def test_a_scale_is_found_at_its_size_and_is_fatal_beyond_three_tenths(
    scale: float, seed: int
) -> None:
    (doubt,) = doubts(scale * left(seed), seed)
    assert doubt.suspects == (LEFT,)
    assert doubt.fatal == (abs(scale - 1.0) > 0.3) or abs(abs(scale - 1.0) - 0.3) < 0.02
    suspect = find_suspect(body(seed, {LEFT: scale * left(seed)}))
    assert suspect is not None
    assert suspect.own.gain == pytest.approx(scale, rel=0.02)


@pytest.mark.parametrize("steps", [-30, -4, 4, 10, 40])
def test_a_lag_is_found_at_its_size(steps: int) -> None:
    (doubt,) = doubts(np.roll(left(), steps))
    side = "later" if steps > 0 else "earlier"
    assert f"{1e3 * abs(steps) * STEP_S:.0f} ms {side}" in doubt.line
    assert not doubt.fatal


def test_noise_is_fatal() -> None:
    (doubt,) = doubts(np.random.default_rng(5).standard_normal(COUNT))
    assert doubt.fatal
    assert doubt.whole_run


def test_a_stretch_is_found_where_it_is_and_is_not_the_whole_run() -> None:
    faulty = left()
    begin, end = 1500, 1900
    faulty[begin:end] = 0.0
    (doubt,) = doubts(faulty)
    assert doubt.replaced
    assert not doubt.fatal
    ((first, last),) = doubt.spans
    assert begin * STEP_S - 1.5 <= first <= begin * STEP_S
    assert end * STEP_S <= last <= end * STEP_S + 1.5


def test_what_fails_midway_is_flagged_from_there_on() -> None:
    faulty = left()
    faulty[COUNT // 2 :] = 0.0
    (doubt,) = doubts(faulty)
    assert not doubt.whole_run
    assert doubt.spans[0][0] > 0.4 * COUNT * STEP_S


def test_of_two_accelerometers_either_may_be_faulty() -> None:
    (doubt,) = doubts(0.5 * left(), many=2)
    assert len(doubt.suspects) == 2
    assert doubt.fatal


@pytest.mark.parametrize("many", [2, 3, 4])
def test_a_body_that_moves_in_one_way_alone_tells_no_gain(many: int) -> None:
    """As in a bounce test: the left side moves by as much more as its place makes it."""
    heave = motion(0)[0]
    source = np.random.default_rng(3)
    rows = {
        name: heave * (1.0 + 0.05 * x + 0.1 * y) + NOISE * source.standard_normal(COUNT)
        for name, (x, y) in list(PLACES.items())[:many]
    }
    forces = {name: band(row, *BAND_HZ) for name, row in rows.items()}
    raw = (-0.05 * heave, 0.1 * heave)
    turning = np.stack([band(row + 1e-3 * source.standard_normal(COUNT), *BAND_HZ) for row in raw])
    swinging = Body(forces, turning, body().known)
    others = [name for name in forces if name != LEFT]
    relation = swinging.relate(LEFT, others)
    assert relation is not None
    assert relation.fit.explained > 0.99
    assert np.isnan(relation.gain)
    assert list(body_doubts(swinging, GRID)) == []


def test_the_leverage_is_what_an_error_of_the_series_does_to_the_gain() -> None:
    whole = body(many=2)
    right = next(name for name in whole.forces if name != LEFT)
    relation = whole.relate(LEFT, [right])
    assert relation is not None
    others = np.stack([whole.forces[right], *whole.turning])[:, whole.known]
    series = whole.forces[LEFT][whole.known]
    inverse = np.linalg.inv(others @ others.T)
    worst = np.sqrt(inverse[0, 0] * np.sum(series**2))
    assert relation.fit.leverage(1) == pytest.approx(worst, rel=0.02)
