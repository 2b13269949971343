"""Suspension, bias, noise and copied samples: one fault each, and none on healthy sensors."""

import numpy as np
import pytest

from floatref.screening.second_sensor.fast_series import STEP_S, FastGrid
from floatref.screening.second_sensor.noisier_side import noise_doubts, noise_of
from floatref.screening.second_sensor.same_samples import same_doubts
from floatref.screening.second_sensor.slow_bias import CHANGED, bias_doubts
from floatref.screening.second_sensor.suspension_travel import (
    BODY,
    TRAVEL,
    WHEEL,
    fit_travel,
    is_consistent,
    travel_doubts,
)
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording

COUNT = 6000
GRID = FastGrid(0.0, COUNT)
TIMES = GRID.times


def swing(hertz: float, phase: float) -> tuple[FloatArray, FloatArray]:
    """Return a displacement in m and its second derivative."""
    omega = 2 * np.pi * hertz
    place = 0.01 * np.sin(omega * TIMES + phase)
    return place, -(omega**2) * place


def suspension() -> dict[str, FloatArray]:
    """Return deflection, and the accelerations of body and wheel, of several swings each."""
    rows = [swing(h, h) for h in (1.1, 1.7, 2.3)], [swing(h, 2 * h) for h in (1.3, 2.9, 3.7)]
    body, wheel = (np.sum(each, axis=0) for each in rows)
    return {TRAVEL: body[0] - wheel[0], BODY: body[1], WHEEL: wheel[1]}


@pytest.mark.parametrize("name", [TRAVEL, BODY, WHEEL])
@pytest.mark.parametrize("gain", [-1.0, 0.5, 2.0])
def test_a_wrong_sign_or_scale_of_the_suspension_is_named(name: str, gain: float) -> None:
    rows = suspension()
    rows[name] = gain * rows[name]
    known = np.abs(TIMES - 15.0) < 14.0
    found = fit_travel(rows[TRAVEL], rows[BODY], rows[WHEEL], known)
    (doubt,) = travel_doubts("left", found)
    assert doubt.suspects == (ChannelId(name, "left"),)
    assert doubt.fatal
    assert f"{gain:.3g} times" in doubt.line


def test_a_sound_suspension_is_consistent() -> None:
    rows = suspension()
    known = np.abs(TIMES - 15.0) < 14.0
    found = fit_travel(rows[TRAVEL], rows[BODY], rows[WHEEL], known)
    assert is_consistent(found)
    assert not list(travel_doubts("left", found))
    assert not is_consistent(None)


def forces(many: int = 3) -> dict[ChannelId, FloatArray]:
    source = np.random.default_rng(0)
    heave = 2.0 * source.standard_normal(COUNT)
    bias = {f"p{k}": 0.05 * k for k in range(many)}
    return {ChannelId("vertical_specific_force", t): heave + b for t, b in bias.items()}


def test_a_constant_bias_is_no_fault() -> None:
    assert not list(bias_doubts(forces(), GRID))


def test_sensors_of_which_nothing_is_known_are_no_second_ones() -> None:
    assert not list(bias_doubts({}, GRID))
    rows = forces()
    lost = next(iter(rows))
    rows[lost] = np.full_like(rows[lost], np.nan)
    assert not list(bias_doubts(rows, GRID))
    for name, row in rows.items():
        rows[name] = np.where(np.arange(row.size) % 1000 < 300, np.nan, row)
    assert not list(bias_doubts(rows, GRID))


@pytest.mark.parametrize("many", [2, 3, 4])
def test_a_bias_that_changes_is_flagged_where_it_does(many: int) -> None:
    rows = forces(many)
    first = next(iter(rows))
    rows[first] = rows[first] + np.where(TIMES > 22.0, 2.0 * CHANGED, 0.0)
    (doubt,) = bias_doubts(rows, GRID)
    assert doubt.suspects == ((first,) if many > 2 else tuple(rows))
    assert doubt.replaced == (many > 2)
    assert doubt.spans[0][0] == pytest.approx(22.0, abs=6.0)
    assert doubt.spans[-1][1] >= COUNT * STEP_S - 2.0


def heights(left: FloatArray, right: FloatArray, rate: float = 2000.0) -> Recording:
    clock = UniformClock.of(rate)
    sides = (("left", left), ("right", right))
    return Recording(tuple(Channel.of("height", v, clock, t) for t, v in sides))


def texture(sigma: float, seed: int) -> FloatArray:
    return 0.3 + sigma * np.random.default_rng(seed).standard_normal(20_000)


def test_noise_is_measured_and_a_much_noisier_side_is_named() -> None:
    found = heights(texture(3e-3, 0), texture(1e-4, 1))
    assert noise_of(found.channels[0]) == pytest.approx(3e-3, rel=0.05)
    (doubt,) = noise_doubts(found)
    assert doubt.suspects == (ChannelId("height", "left"),)
    assert not doubt.fatal


@pytest.mark.parametrize(("one", "other"), [(1e-4, 1e-4), (4e-4, 1e-4), (2e-3, 1e-3), (4e-4, 0.0)])
def test_textures_that_differ_little_or_do_not_matter_are_no_fault(
    one: float, other: float
) -> None:
    assert not list(noise_doubts(heights(texture(one, 0), texture(other, 1))))


def test_the_same_samples_on_both_sides_are_fatal() -> None:
    (doubt,) = same_doubts(heights(texture(1e-4, 0), texture(1e-4, 0)))
    assert doubt.fatal
    assert not list(same_doubts(heights(texture(1e-4, 0), texture(1e-4, 1))))


def test_two_sensors_that_never_change_are_another_fault() -> None:
    assert not list(same_doubts(heights(np.full(9, 0.3), np.full(9, 0.3))))
