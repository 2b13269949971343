"""Normalized innovations: those of the literal filter, and of size one if the noise is right."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref.errors import StageError
from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref.measures.consistency import bound_mean_nis
from floatref.values.innovations import NEAR
from floatref_reference.appendix_c.measurement_model import matrix_h
from floatref_reference.beyond.innovations import innovation, normalized
from floatref_reference.chapter_6.section_6_3_6_system import h
from floatref_reference.chapter_6.section_6_6_2_gps import gps_observations

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(deadline=None, max_examples=4, phases=[Phase.explicit, Phase.generate])
GNSS = ("gnss_height", "gnss_vertical_velocity", "gnss_pitch", "gnss_roll")
LITERAL = Noise(lean_rad=0.0, gnss_height_walk=0.0)
RIGHT = Noise(
    acceleration=4e-5,
    acceleration_walk=1e-9,
    roll_rate=3e-6,
    pitch_rate=3e-6,
    yaw_rate=3e-6,
    roll_rate_walk=1e-9,
    pitch_rate_walk=1e-9,
    lean_rad=1e-9,
    gnss_height_walk=1e-9,
    gnss_height_m=0.004,
    gnss_velocity_mps=0.02,
    gnss_pitch_rad=0.001,
    gnss_roll_rad=0.002,
)
"""What the drives of `conftest` are made with."""
CHANCE = 1e-9
"""Of a test's failure where all is right."""


def innovations(stage, drawn, cuts=()):
    stage.keep_innovations()
    stage.start(drawn.header)
    for block in drawn.blocks(cuts):
        stage.push(block)
    stage.finish()
    return stage.list_innovations()["left"]


@pytest.mark.slow
@pytest.mark.cites("(6.13)", "(C.8)")
@laws
@given(seed=SEEDS, rate=st.sampled_from([400, 700]), share=st.floats(0.0, 0.5))
def test_they_are_those_of_the_literal_filter(drive, seed, rate, share):
    """But for the first height, which sets the datum."""
    drawn = drive(seed, 7.0, rate)
    drawn.y[:, 1:][np.random.default_rng(seed).uniform(size=(drawn.at.size, 3)) < share] = np.nan
    datum = drawn.y[0, 0] - drawn.lever[2] - drawn.height[0]
    y = drawn.y - [datum, 0.0, 0.0, 0.0]
    deviations = np.sqrt(LITERAL.readings())
    run = drawn.literal(LITERAL, gps_observations(drawn.at, y, deviations))
    expected = {name: [] for name in GNSS}
    for m, k in enumerate(drawn.at):
        x, u = run.x_prior[k], drawn.u[k]
        h_x, H = h(x, u, drawn.lever), matrix_h(x, u, drawn.lever)
        z = normalized(*innovation(run.P_prior[k], y[m], h_x, H, np.diag(deviations**2)))
        for kind, value in zip(np.flatnonzero(~np.isnan(y[m])), z, strict=True):
            expected[GNSS[kind]].append(value)
    expected["gnss_height"].pop(0)
    found = innovations(KalmanFilter(Plan(reflects=False), LITERAL), drawn)
    assert list(found) == list(GNSS)
    for name in GNSS:
        assert found[name].count == len(expected[name])
        np.testing.assert_allclose(found[name].sample, expected[name], rtol=0, atol=1e-5)


def pooled(drive, seed, quiet):
    """Return the innovations of all kinds of a drive whose errors are ``quiet`` times the right."""
    found = innovations(
        KalmanSmoother(Plan(reflects=False), RIGHT), drive(seed, 12.0, 300, quiet=quiet)
    )
    return [found[name] for name in GNSS]


def assert_mean(each, factor):
    low, high = bound_mean_nis(each.count, 1.0 - CHANCE)
    assert low * factor <= each.mean_nis <= high * factor


@laws
@given(seed=SEEDS)
def test_the_mean_is_one_if_the_noise_is_right_and_four_if_it_is_double(drive, seed):
    for each in pooled(drive, seed, 1.0):
        assert_mean(each, 1.0)
    for each in pooled(drive, seed, 2.0):
        assert_mean(each, 4.0)


@pytest.mark.slow
def test_stated_bounds_hold_as_often_as_stated(drive):
    """Of 160 kinds of runs 95 %; 10 more or less is three deviations and more."""
    kinds = [each for seed in range(40) for each in pooled(drive, seed, 1.0)]
    bounds = [bound_mean_nis(each.count) for each in kinds]
    inside = [low <= k.mean_nis <= high for k, (low, high) in zip(kinds, bounds, strict=True)]
    assert abs(sum(inside) - 152) <= 10
    share = sum(each.near for each in kinds) / sum(each.count for each in kinds)
    assert share == pytest.approx(0.9545, abs=0.01)
    assert NEAR == 2.0


@laws
@given(seed=SEEDS, cuts=st.lists(st.integers(0, 2400), max_size=4))
def test_no_split_changes_them(drive, seed, cuts):
    drawn = drive(seed, 8.0, 300, stop=(4.0, 6.0))
    whole = innovations(KalmanSmoother(Plan(), Noise()), drawn)
    parts = innovations(KalmanSmoother(Plan(), Noise()), drawn, cuts)
    assert list(whole) == list(parts) == [*GNSS, "reflection"]
    for name, each in whole.items():
        assert each.count == parts[name].count > 0
        np.testing.assert_array_equal(each.sample, parts[name].sample)
        assert each.squares == parts[name].squares


@pytest.mark.parametrize(
    ("plan", "kinds"),
    [
        (Plan(), {*GNSS, "reflection"}),
        (Plan(reflects=False), {*GNSS}),
        (
            Plan(attitude=False),
            {*GNSS[:2], "constant_pitch", "constant_roll", "reflection"},
        ),
        (
            Plan(gnss=False, attitude=False),
            {*(f"constant_{n}" for n in ("height", "velocity", "pitch", "roll")), "reflection"},
        ),
    ],
)
def test_every_plan_has_its_kinds(drive, plan, kinds):
    """GNSS begins within half a second here, so that no constant takes its place before."""
    drawn = drive(3, 9.0, 200, stop=(4.0, 7.0))
    drawn.at[:] -= drawn.at[0] - 20
    found = innovations(KalmanSmoother(plan, Noise()), drawn)
    assert set(found) == kinds
    standing = int(np.count_nonzero((drawn.speed < 0.16 / 3.6)[::2]))
    if "reflection" in found:
        assert found["reflection"].count == standing - 1
    if "constant_velocity" in found:
        assert found["constant_velocity"].count == drawn.speed[::2].size
        assert found["constant_height"].count == drawn.speed[::2].size - standing - 1


def test_readings_left_out_are_counted_apart(drive):
    drawn = drive(5, 8.0, 300)
    drawn.y[60, 1] += 50.0
    found = innovations(KalmanSmoother(Plan(), Noise()), drawn)
    assert {name: each.left_out for name, each in found.items()} == dict.fromkeys(GNSS, 0) | {
        "gnss_vertical_velocity": 1
    }
    assert found["gnss_vertical_velocity"].count == drawn.at.size - 1
    assert np.abs(found["gnss_vertical_velocity"].sample).max() < 10.0


def test_a_stage_keeps_nothing_unless_it_is_asked_before_the_start(drive):
    drawn = drive(5, 2.0, 300)
    stage = KalmanSmoother(Plan(), Noise())
    stage.start(drawn.header)
    stage.push(drawn.blocks()[0])
    assert stage.list_innovations() == {}
    with pytest.raises(StageError, match="before the start"):
        stage.keep_innovations()
