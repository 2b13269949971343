"""What holds of every class alone: any chunks, nothing else touched, gaps bridged and counted."""

import copy
import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from floatref.retrofit import alone

laws = settings(
    deadline=None, max_examples=10, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
SEEDS = st.integers(0, 2**32 - 1)
CUTS = st.lists(st.integers(0, 240), max_size=8)
ALL = list(range(241))
"""Cuts that leave one sample in each chunk."""


def in_chunks(stage, call, drive, cuts):
    edges = sorted({0, 240, *cuts})
    parts = [call(stage, drive.cut(a, b)) for a, b in itertools.pairwise(edges)]
    return np.concatenate(parts, axis=-1)


@pytest.mark.slow
@laws
@given(seed=SEEDS, cuts=CUTS, lost=st.lists(st.integers(0, 239), unique=True, max_size=30))
@example(seed=0, cuts=ALL, lost=[])
@example(seed=0, cuts=ALL, lost=[0, 1, 2, 3])
@example(seed=1, cuts=[], lost=list(range(240)))
def test_chunks_of_any_length_are_one_and_their_gaps_are_bridged_and_counted(
    every, drive, seed, cuts, lost
):
    make, call = every
    run, stage = drive(seed), make()
    for signal in (run.a, run.v, run.h, run.distance):
        signal[lost] = np.nan
    found = in_chunks(stage, call, run, cuts)
    np.testing.assert_array_equal(found, call(make(), run))
    assert np.isfinite(found).all()
    if hasattr(stage, "bridged"):
        rows = found.size // 240
        assert stage.bridged == rows * len(lost)


def test_an_empty_chunk_changes_nothing(every, drive):
    make, call = every
    run, stage = drive(), make()
    assert call(stage, run.cut(0, 0)).size == 0
    first = call(stage, run.cut(0, 100))
    assert call(stage, run.cut(100, 100)).size == 0
    found = np.concatenate((first, call(stage, run.cut(100, 240))), axis=-1)
    np.testing.assert_array_equal(found, call(make(), run))


def test_what_is_passed_in_stays_and_what_comes_out_is_the_callers(every, drive):
    make, call = every
    run, before, stage = drive(), drive(), make()
    for name in run.names:
        getattr(run, name).flags.writeable = False
    expected = call(make(), run)
    first = call(stage, run.cut(0, 120))
    for name in run.names:
        np.testing.assert_array_equal(getattr(run, name), getattr(before, name))
    kept = first.copy()
    first *= 0.0
    rest = call(stage, run.cut(120, 240))
    np.testing.assert_array_equal(np.concatenate((kept, rest), axis=-1), expected)


def test_a_buffer_stays_its_owners(every, drive):
    make, call = every
    run = drive()
    call(make(), run)
    for name in run.names:
        assert getattr(run, name).flags.writeable
        getattr(run, name)[:] = 0.0


@pytest.mark.parametrize("name", ["HighPass", "AdaptiveHighPass", "MatchedHighPass"])
def test_a_profile_is_bridged_and_counted_and_stays_its_owners(name, drive):
    import floatref

    run, stage = drive(), getattr(floatref, name)(200.0)
    speed = () if name == "HighPass" else (run.speed,)
    if name == "MatchedHighPass":
        stage.reference_height(run.a, run.h, *speed)
    else:
        for signal, values in (("acceleration", run.a), ("velocity", run.v), ("height", run.h)):
            getattr(stage, signal)(values, *speed)
    other, profile = copy.deepcopy(stage), run.v.copy()
    profile[[0, 7, 8, 239]] = np.nan
    assert np.isfinite(stage.reverse(profile, *speed)).all()
    assert stage.bridged == 4
    assert profile.flags.writeable
    if speed:
        assert np.isfinite(other.reverse_over_distance(profile, *speed, 0.05)).all()
        assert other.bridged == 4


def test_a_copy_goes_on_from_where_it_was_made(every, drive):
    make, call = every
    run, stage = drive(), make()
    call(stage, run.cut(0, 77))
    saved = copy.deepcopy(stage)
    expected = call(stage, run.cut(77, 240))
    np.testing.assert_array_equal(call(saved, run.cut(77, 240)), expected)


def test_lists_and_single_precision_are_taken(every, drive):
    make, call = every
    run, lists, single = drive(), drive(), drive()
    for name in run.names:
        rounded = getattr(run, name).astype(np.float32)
        setattr(run, name, rounded.astype(np.float64))
        setattr(single, name, rounded)
        setattr(lists, name, rounded.tolist())
    expected = call(make(), run)
    np.testing.assert_array_equal(call(make(), single), expected)
    np.testing.assert_array_equal(call(make(), lists), expected)


def test_any_layout_is_the_same_to_a_filter(every, drive):
    make, call = every
    run = drive()
    expected = call(make(), run)
    for layout in (strided, big_endian, unaligned, frozen, objects):
        other = drive()
        for name in run.names:
            setattr(other, name, layout(getattr(run, name)))
        np.testing.assert_array_equal(call(make(), other), expected)


def strided(x):
    return np.repeat(x, 2)[::2]


def big_endian(x):
    return x.astype(">f8")


def unaligned(x):
    return np.frombuffer(b"." + x.tobytes(), np.uint8)[1:].view(np.float64)


def frozen(x):
    x = x.copy()
    x.flags.writeable = False
    return x


def objects(x):
    return np.array([Fraction(value) for value in x], dtype=object)


def test_chunks_of_any_layout_come_out_as_one():
    made = [alone.chunks("call", x=of(np.ones(9)))[0] for of in (strided, unaligned, frozen, list)]
    assert len({str(x.flags) for x in map(np.ndarray.view, made)}) == 1
    assert made[0].flags.c_contiguous
    assert made[0].flags.aligned
    assert not made[0].flags.writeable


def test_a_masked_sample_is_a_missing_one(every, drive):
    make, call = every
    missing, masked = drive(), drive()
    for name in ("a", "v", "h", "distance"):
        getattr(missing, name)[[3, 50]] = np.nan
        hidden = np.ma.array(getattr(masked, name), mask=np.isin(np.arange(240), [3, 50]))
        setattr(masked, name, hidden)
    np.testing.assert_array_equal(call(make(), masked), call(make(), missing))


@pytest.mark.parametrize("shape", [(), (240, 1), (1, 240)])
def test_another_shape_is_refused(every, drive, shape):
    import floatref

    make, call = every
    run = drive()
    for name in run.names:
        setattr(run, name, np.resize(getattr(run, name), shape))
    with pytest.raises(floatref.InputError, match=r"has shape .*give one wheel path"):
        call(make(), run)
