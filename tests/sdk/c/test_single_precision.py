"""Single precision over a long run: what the float build may be off, beside the double build."""

import numpy as np
import pytest

from floatref.measures import iri

RATE, COUNT_M, INTERVAL, SPEED, GRAVITY = 4000.0, 0.001, 0.05, 25.0, 9.80665
WAVELENGTH_M = 105.91
LIMIT_M = 1e-4
"""Of an elevation in float over 10 km: what the work order of the library asks for."""


def signals(metres):
    """Return force, height and counts: a rough road, a body that swings, noise of a laser."""
    rng = np.random.default_rng(7)
    t = np.arange(round(metres / SPEED * RATE)) / RATE
    x = SPEED * t
    road = sum(
        a * np.sin(2 * np.pi * x / length + phase)
        for length, a, phase in ((60, 0.05, 0), (15, 0.01, 1), (3, 0.002, 2), (0.7, 3e-4, 3))
    )
    body = 0.01 * np.sin(2 * np.pi * 1.3 * t)
    force = GRAVITY - (2 * np.pi * 1.3) ** 2 * body + rng.normal(0.0, 0.02, t.size)
    height = 0.3 + body - road + rng.normal(0.0, 5e-5, t.size)
    return force, height, np.rint(x / COUNT_M).astype(np.int64)


@pytest.fixture(scope="module")
def ten_kilometres():
    """Return 10 km as floats: the rounding of the input is not the library's."""
    force, height, counts = signals(10_000.0)
    return force.astype(np.float32), height.astype(np.float32), counts


def profile(library, force, height, counts):
    encoder = {"travel__rate_hz": RATE, "travel__metres_per_count": COUNT_M}
    made = library.make("adaptive", interval_m=INTERVAL, gravity_mps2=GRAVITY, **encoder)
    room = 1 + round(counts[-1] * COUNT_M / INTERVAL) + 9
    _, *points = made.push(force, height, counts, outputs=2, capacity=room)
    return made.push(*points, call="finish")[1].astype(float)


def given(made, *signals, call="push"):
    """Return the output of a call that has to work."""
    status, y = made.push(*signals, call=call)
    assert status == 0, made.library.text(status)
    return y


def acceleration_of(force):
    return (force.astype(float) - GRAVITY).astype(np.float32)


def through(library, made, force, height, *speed):
    """Return the profile of samples by a set with the integrals of the library."""
    first, second = (library.make("integral", step_s=1.0 / RATE) for _ in range(2))
    velocity = given(first, given(made, acceleration_of(force), *speed, call="acceleration"))
    body = given(second, given(made, velocity, *speed, call="velocity"))
    elevation = body - given(made, height, *speed, call="height")
    return given(made, elevation, *speed, call="reverse")


def by_high_pass_set(library, force, height):
    made = library.make("high_pass_set", step=1.0 / RATE, cutoff=SPEED / WAVELENGTH_M)
    return through(library, made, force, height)


def by_adaptive_set(library, force, height):
    made = library.make("adaptive_set", rate_hz=RATE)
    return through(library, made, force, height, np.full(height.size, SPEED))


def by_matched_high_pass(library, force, height):
    made = library.make("matched_high_pass", rate_hz=RATE)
    cutoff = np.full(height.size, SPEED / WAVELENGTH_M).astype(np.float32)
    return given(made, acceleration_of(force), height, cutoff) - library.array(height)


def by_high_pass_profile(library, force, height):
    config = library.config("high_pass_profile", interval_m=SPEED / RATE)
    status, y = library.array_call("fr_high_pass_profile", config, -height)
    assert status == 0, library.text(status)
    return y


ENGINES = (by_high_pass_set, by_adaptive_set, by_matched_high_pass, by_high_pass_profile)


@pytest.mark.slow
def test_ten_kilometres_in_float_are_those_in_double(double, single, ten_kilometres):
    counts = ten_kilometres[2]
    mine, theirs = (profile(library, *ten_kilometres) for library in (single, double))
    assert mine.size == theirs.size == 1 + np.floor(counts[-1] * COUNT_M / INTERVAL + 1e-6)
    assert np.abs(mine - theirs).max() < 1e-5
    assert iri(mine - theirs, INTERVAL) < 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_ten_kilometres_of_an_engine_in_float_are_those_in_double(
    double, single, ten_kilometres, engine
):
    force, height, _ = ten_kilometres
    mine, theirs = (engine(library, force, height).astype(float) for library in (single, double))
    # A profile in float has steps of 4e-9 m at 0.05 m; the road has 0.05 m and more.
    assert np.ptp(theirs) > 0.05
    assert np.abs(mine - theirs).max() <= LIMIT_M
