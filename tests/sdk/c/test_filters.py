"""Filters and integration in C: the numbers of the SDK's kernels, bit for bit in double."""

from math import pi, tan

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import memories
from floatref.values.arrays import new_record

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(max_examples=25, deadline=None)
KERNELS = {(1, 1): "high_pass_1", (2, 1): "high_pass_2", (1, 2): "low_pass_1", (2, 2): "low_pass_2"}


def samples(seed, gaps, length=120):
    """Return a signal around 5 and cut-offs from 0 to nearly half the rate, some missing."""
    rng = np.random.default_rng(seed)
    x, cutoff = 5.0 + rng.normal(size=length), rng.choice([0.0, 1e-6, 0.003, 0.2, 0.49], length)
    if gaps:
        x[rng.random(length) < 0.2] = np.nan
        cutoff[rng.random(length) < 0.2] = np.nan
        lead = rng.integers(0, 4, 2)
        x[: lead[0]], cutoff[: lead[1]] = np.nan, np.nan
    return x, cutoff


def same_bits(found, expected):
    assert np.asarray(found, np.float64).tobytes() == np.asarray(expected).tobytes()


@laws
@given(
    seed=SEEDS,
    order=st.sampled_from([1, 2]),
    passes=st.sampled_from([1, 2]),
    direction=st.sampled_from([1, 2]),
    cutoff=st.floats(1e-6, 0.499),
    gaps=st.booleans(),
)
def test_a_fixed_section_has_the_bits_of_the_kernel(
    double, plain, seed, order, passes, direction, cutoff, gaps
):
    x, _ = samples(seed, gaps)
    chosen = {"order": order, "passes": passes, "direction": direction, "missing": int(gaps)}
    status, found = double.make("filter", step=1.0, cutoff=cutoff, **chosen).push(x)
    expected = np.empty(x.size)
    kernel = getattr(plain("kernels.state_variable"), KERNELS[order, passes])
    memory = new_record(memories.STATE_VARIABLE)
    kernel(x, expected, memory, tan(pi * cutoff), direction == 2)
    assert status == 0
    same_bits(found, expected)


ORDERS = {1: "1", 2: "2", 3: "12", 4: "21"}


@laws
@given(
    seed=SEEDS,
    sections=st.sampled_from(sorted(ORDERS)),
    direction=st.sampled_from([1, 2]),
    gaps=st.booleans(),
    cut=st.integers(0, 120),
)
def test_a_varying_section_has_the_bits_of_the_kernel(
    double, plain, seed, sections, direction, gaps, cut
):
    x, cutoff = samples(seed, gaps)
    chosen = {"sections": sections, "direction": direction, "missing": int(gaps)}
    made = double.make("varying", step=1.0, **chosen)
    blocks = [slice(0, cut), slice(cut, x.size)]
    found = [made.push(x[b], cutoff[b])[1] for b in blocks[:: 1 if direction == 1 else -1]]
    c, expected = np.empty(x.size), np.empty(x.size)
    plain("kernels.schedule").tangents(cutoff, 1.0, c)
    states = [new_record(memories.VARYING) for _ in ORDERS[sections]]
    kernel = getattr(plain("kernels.varying"), f"high_pass_{ORDERS[sections]}")
    kernel(x, expected, c, *states, direction == 2)
    same_bits(np.concatenate(found[:: 1 if direction == 1 else -1]), expected)


@laws
@given(
    seed=SEEDS, order=st.sampled_from([1, 2]), direction=st.sampled_from([1, 2]), gaps=st.booleans()
)
def test_a_section_of_states_has_the_bits_of_the_kernel(
    double, plain, seed, order, direction, gaps
):
    x, cutoff = samples(seed, gaps)
    chosen = {"sections": order, "form": 1, "direction": direction, "missing": int(gaps)}
    _, found = double.make("varying", step=1.0, **chosen).push(x, cutoff)
    c, expected = np.empty(x.size), np.empty(x.size)
    plain("kernels.schedule").tangents(cutoff, 1.0, c)
    kernel = getattr(plain("kernels.varying_states"), f"high_pass_{order}")
    kernel(x, expected, c, new_record(memories.VARYING_STATES), direction == 2)
    same_bits(found, expected)


@laws
@given(
    seed=SEEDS, form=st.sampled_from(["push", "push_steps", "push_reflecting"]), gaps=st.booleans()
)
def test_an_integral_has_the_bits_of_the_kernel(double, plain, seed, form, gaps):
    x, _ = samples(seed, gaps)
    h, _ = samples(seed + 1, gaps)
    rng = np.random.default_rng(seed)
    dt = rng.choice([0.0, 0.003, 0.014, 0.2, 30.0], x.size)
    adjusted = np.minimum(dt, 0.01)
    motion, expected = plain("kernels.motion"), np.empty(x.size)
    memory = new_record(memories.INTEGRATOR)
    memory.total = 0.25
    given_to = {"push": (x,), "push_steps": (x, dt), "push_reflecting": (x, h, adjusted, dt)}[form]
    if form == "push":
        motion.integrate(x, expected, memory, 0.01 / 2.0)
    elif form == "push_steps":
        motion.integrate_steps(x, expected, memory, dt)
    else:
        motion.integrate_reflecting(x, h, expected, memory, adjusted, dt)
    made = double.make("integral", step_s=0.01, start=0.25, missing=int(gaps))
    _, found = made.push(*given_to, call=form)
    same_bits(found, expected)


def test_the_short_tangent_is_within_its_stated_error(double):
    # A first-order section that starts at x gives x (1 - c) / (1 + c) at its first sample.
    cutoff = np.linspace(1e-4, 0.1 / np.pi, 999)
    found = np.array(
        [
            double.make("varying", step=1.0, sections=1, tangent=1).push([1.0], [f])[1][0]
            for f in cutoff
        ]
    )
    c = (1.0 - found) / (1.0 + found)
    assert np.abs(c / np.tan(pi * cutoff) - 1.0).max() < 6e-8
    assert np.abs(c / np.tan(pi * cutoff) - 1.0).max() > 4e-8


EDGES = [0.0, -0.0, 5e-324, 0.49, np.nextafter(0.49, 1.0), np.nextafter(0.5, 0.0), 0.5, -1e-9]


@laws
@given(
    cutoff=st.lists(st.sampled_from(EDGES), min_size=1, max_size=3)
    | st.lists(st.sampled_from(EDGES) | st.floats(), min_size=1, max_size=9),
    bridged=st.booleans(),
)
def test_a_push_is_refused_for_each_cut_off_that_is_impossible(double, cutoff, bridged):
    made = double.make("varying", step=1.0, missing=int(bridged))
    before = made.memory.copy()
    status, _ = made.push(np.ones(len(cutoff)), cutoff)
    if any(np.isinf(f) or (np.isnan(f) and not bridged) for f in cutoff):
        expected = "FR_BAD_SAMPLE"
    elif any(f < 0.0 or f >= 0.5 for f in cutoff):
        expected = "FR_BAD_CUTOFF"
    else:
        expected = "FR_OK"
    assert double.status[status] == expected
    assert (made.memory == before).all() == (expected != "FR_OK")
