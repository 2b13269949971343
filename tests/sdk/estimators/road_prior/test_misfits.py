"""Normalized innovations of the road prior: the literal ones, and one for a road it draws."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.measures.consistency import bound_mean_nis
from floatref_reference.beyond.innovations import innovation, normalized
from floatref_reference.road_prior import model
from floatref_reference.road_prior.smoother import forward

C = RoadPrior(
    acceleration=2e-3,
    acceleration_walk=1e-4,
    walk_along=5e-3,
    reading_m=1e-3,
    road=1e-5,
    long_waves=3e-6,
    road_memory_m=1e15,
    edge_sigmas=1e6,
    lean_sigma_rad=0.02,
)
"""The road is the same all the way, and has no edges."""
PRIORS = (C.lean_sigma_rad, C.tilt_sigma)
SEEDS = st.integers(0, 2**32 - 1)
STOPS = st.tuples(st.floats(0.4, 1.2), st.floats(0.1, 1.0))
CHANCE = 1e-9
laws = settings(deadline=None, max_examples=4, phases=[Phase.explicit, Phase.generate])


def innovations(constants, drawn, cuts=()):
    stage = RoadPriorSmoother(constants)
    stage.keep_innovations()
    stage.start(drawn.header)
    for block in drawn.blocks(cuts):
        stage.push(block)
    stage.finish()
    return stage.list_innovations()["left"]


def literally(drawn):
    a_x, response = drawn.excitation(C)
    return drawn.literally(C, (a_x, a_x * response), a_x, PRIORS)


@laws
@given(seed=SEEDS, rate=st.sampled_from([150, 300, 500]), stop=STOPS, share=st.floats(0.3, 1.0))
def test_they_are_those_of_the_literal_filter(drive, seed, rate, stop, share):
    """A reading at a standstill is one to which the encoder brings no travel.

    The first of all, from which the height begins, does not count.
    """
    drawn = drive(seed, 2.4, rate, (stop[0], sum(stop)), share=share)
    run, constants = literally(drawn)
    filtered, H = forward(run, constants), model.observation(run)
    R = np.array([[C.reading_m**2]])
    moved = np.diff(drawn.distance, prepend=drawn.distance[0]) > 0.0
    expected = {True: [], False: []}
    for k, seen in enumerate(run.h[0]):
        x, P = filtered.x_prior[k], filtered.P_prior[k]
        if not np.isnan(seen):
            z = normalized(*innovation(P, np.array([seen]), H @ x, H, R))
            expected[bool(moved[k])].append(float(z[0]))
    expected[False].pop(0)
    found = innovations(C, drawn)
    for moving, name in ((True, "height"), (False, "height_at_standstill")):
        assert found[name].count == len(expected[moving])
        own = expected[moving][:: found[name].every]
        np.testing.assert_allclose(found[name].sample, own, rtol=0, atol=1e-4)


def with_drawn_heights(drawn, seed, factor):
    """Return the drive with heights that the model draws, ``factor`` times from their mean."""
    run, constants = literally(drawn)
    rng, H = np.random.default_rng(seed), model.observation(run)
    mean = np.zeros(model.states(run))
    off = rng.multivariate_normal(mean, model.prior(run, constants), method="svd")
    heights = []
    for k in range(drawn.a.size):
        if k > 0:
            F, g = model.transition(run, k - 1, constants), model.known_input(run, k - 1)
            Q = model.process_noise(run, k - 1, constants)
            mean = F @ mean + g
            off = F @ off + rng.multivariate_normal(0.0 * off, Q, method="svd")
        heights.append((H @ (mean + factor * off))[0] + factor * C.reading_m * rng.normal())
    return replace(drawn, h=np.array(heights))


@pytest.mark.slow
@laws
@given(seed=SEEDS, stop=STOPS)
def test_the_mean_is_one_on_a_drawn_road_and_four_if_all_noise_is_double(drive, seed, stop):
    drawn = drive(seed, 5.0, 200, (stop[0], sum(stop)))
    for factor in (1.0, 2.0):
        found = innovations(C, with_drawn_heights(drawn, seed, factor))
        for each in found.values():
            low, high = bound_mean_nis(each.count, 1.0 - CHANCE)
            assert low <= each.mean_nis / factor**2 <= high


@laws
@given(seed=SEEDS, cuts=st.lists(st.integers(0, 1200), max_size=4))
def test_no_split_changes_them(drive, seed, cuts):
    drawn = drive(seed, 2.4, 500, (0.8, 1.6))
    whole, parts = innovations(RoadPrior(), drawn), innovations(RoadPrior(), drawn, cuts)
    assert list(whole) == list(parts) == ["height", "height_at_standstill"]
    for name, each in whole.items():
        np.testing.assert_array_equal(each.sample, parts[name].sample)
        assert (each.count, each.squares) == (parts[name].count, parts[name].squares)


def test_an_edge_at_a_standstill_is_left_out(drive):
    """A leap of 30 mm, six deviations and more; the road is another from there on."""
    drawn = drive(4, 3.0, 500, (0.5, 2.5))
    quiet = replace(drawn, h=np.full(drawn.h.size, 0.3), a=np.zeros(drawn.a.size))
    before = innovations(RoadPrior(), quiet)
    quiet.h[700:] += 0.03
    found = innovations(RoadPrior(), quiet)
    assert before["height_at_standstill"].left_out == 0
    assert found["height_at_standstill"].left_out == 1
    assert np.abs(found["height_at_standstill"].sample).max() < 3.0
    assert found["height_at_standstill"].count == before["height_at_standstill"].count - 1


def test_nothing_is_kept_unless_it_is_asked(drive):
    drawn = drive(4, 1.0, 500)
    stage = RoadPriorSmoother(C)
    stage.start(drawn.header)
    for block in drawn.blocks():
        stage.push(block)
    stage.finish()
    assert stage.list_innovations() == {}
