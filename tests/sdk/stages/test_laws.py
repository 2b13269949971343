"""The laws of the stage protocol, for every stage that is registered."""

import itertools

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from floatref.engine.plugins import plugins
from floatref.errors import InputError, StageError
from floatref.values.arrays import Flag
from floatref.values.block import Header
from floatref.values.channels import ChannelId

BY_STAGE_LAWS = {
    "Advance",
    "CompareTravel",
    "Denoise",
    "EstimateRoad",
    "JoinTyres",
    "KalmanFilter",
    "KalmanSmoother",
    "Level",
    "RestoreContact",
    "RoadPriorSmoother",
    "Seams",
    "ShiftAlong",
    "ToRate",
    "ToTime",
}
"""Stages that are held to the laws in tests of their own."""
STAGES = sorted(set(plugins().stages()) - BY_STAGE_LAWS)
CUTS = st.lists(st.integers(0, 240), max_size=6)
STEERED = ("VaryingHighPass", "StateHighPass", "MatchedHighPass", "SuppressLocally")
SEEDS = st.integers(0, 2**32 - 1)
every_stage = pytest.mark.parametrize("name", STAGES)
laws = settings(
    deadline=None, max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


LOST = st.lists(st.tuples(st.integers(0, 239), st.integers(1, 60)), max_size=3)


@every_stage
@laws
@given(seed=SEEDS, cuts=CUTS, lost=LOST)
@example(seed=0, cuts=[1, 90], lost=[(0, 100)])
@example(seed=0, cuts=[150], lost=[(140, 100)])
def test_1_any_split_gives_the_same_output(bench, identical, name, seed, cuts, lost):
    stream = bench(name, seed, lost=lost)
    identical(stream.run(stream.blocks()), stream.run(stream.blocks(cuts)))


@every_stage
@laws
@given(seed=SEEDS, cuts=CUTS)
def test_2_indices_are_contiguous_within_the_declared_delay(bench, name, seed, cuts):
    stream = bench(name, seed)
    blocks = stream.blocks(cuts)
    stage = stream.begin(blocks)
    out, held = [], 0
    for block in reversed(blocks) if stream.backward else blocks:
        out.append(stage.push(block))
        held += len(block) - len(out[-1])
        if name != "ToDistance":
            assert 0 <= held <= stage.declared.delay
    out = sorted((b for b in [*out, *stage.finish()] if len(b)), key=lambda b: b.first)
    assert out[0].first == 0
    for before, after in itertools.pairwise(out):
        assert after.first == before.first + len(before)
    if name != "ToDistance":
        assert sum(map(len, out)) == 240


@every_stage
def test_3_the_input_is_left_as_it_was(bench, name):
    stream = bench(name)
    before = {c: x.copy() for c, x in stream.values.items()}
    for values in stream.values.values():
        values.flags.writeable = False
    out = stream.run(stream.blocks())
    for channel, values in before.items():
        np.testing.assert_array_equal(values, stream.values[channel])
    assert out.values.keys() == stream.out_header.channels


@every_stage
@laws
@given(seed=SEEDS, at=st.integers(1, 5), lost=LOST)
def test_4_saving_and_restoring_changes_nothing(bench, identical, join, name, seed, at, lost):
    stream = bench(name, seed, lost=lost)
    blocks = stream.blocks([40, 80, 120, 160, 200])
    order = list(reversed(blocks)) if stream.backward else blocks
    stage = stream.begin(blocks)
    out = [stage.push(block) for block in order[:at]]
    saved = stage.state()
    for block in order[at:]:
        stage.push(block)
    other = stream.make()
    other.start(stream.header)
    other.restore(saved)
    out += [other.push(block) for block in order[at:]]
    identical(join([*out, *other.finish()]), stream.run(blocks))


@every_stage
@laws
@given(seed=SEEDS, at=st.integers(1, 238), flag=st.booleans())
def test_5_a_missing_or_flagged_sample_is_flagged_on_the_way_out(bench, name, seed, at, flag):
    stream = bench(name, seed)
    used = {c for c in stream.values if stream.may_be_missing(c)}
    values, flags = dict(stream.values), {}
    for channel in used:
        if flag:
            flags[channel] = np.zeros(240, np.uint8)
            flags[channel][at] = Flag.DRIFT
        else:
            values[channel] = values[channel].copy()
            values[channel][at] = np.nan
    out = stream.run(stream.blocks(values=values, flags=flags))
    if name == "ToDistance":
        hit, affected = _points_hit(out[ChannelId("time")], at / 100.0, flag)
    else:
        hit = affected = np.arange(240) == at
    for channel, samples in out.values.items():
        if not stream.is_target(channel):
            continue
        marks = out.flags.get(channel, np.zeros(len(out), np.uint8))
        missing = np.isnan(samples)
        assert ((marks != 0) | missing)[hit].all()
        assert not missing[~affected].any()
        assert not marks[~affected].any()


@pytest.mark.parametrize("name", [n for n in STAGES if n.startswith(STEERED)])
def test_5_a_missing_speed_or_cut_off_flags_what_it_steers(bench, name):
    steering = "travel_speed" if name == "SuppressLocally" else "high_pass_cutoff"
    stream = bench(name)
    stream.values[ChannelId(steering)][100] = np.nan
    out = stream.run(stream.blocks())
    flagged = {c for c, flags in out.flags.items() if c.track and flags.any()}
    assert {channel.track for channel in flagged} == set(stream.header.tracks)
    for channel in flagged:
        assert set(np.flatnonzero(out.flags[channel])) == {100}
        assert not np.array_equal(out[channel], stream.values.get(channel))


def _points_hit(times, when, drift):
    """Points that must be flagged, and those that may be: the ones read from the sample.

    A drift between two points has to reach the later one.
    """
    read = np.abs(times - when) < 0.01
    after = np.arange(times.size) == np.searchsorted(times, when - 0.01 + 1e-9)
    if drift:
        return after, read | after
    return times == when, read


@every_stage
def test_6_after_finish_nothing_is_taken(bench, name):
    stream = bench(name)
    blocks = stream.blocks()
    stage = stream.begin(blocks)
    stage.push(blocks[0])
    stage.finish()
    with pytest.raises(StageError, match="push after finish"):
        stage.push(blocks[0])
    with pytest.raises(StageError, match="finish after finish"):
        stage.finish()
    with pytest.raises(StageError, match="started twice"):
        stage.start(stream.header)


@every_stage
@laws
@given(seed=SEEDS, factor=st.floats(-3.0, 3.0), other=SEEDS)
def test_7_declared_linear(bench, name, seed, factor, other):
    if not bench(name).make().declared.linear:
        with pytest.raises(AssertionError):
            _check_linear(bench, name, seed, 2.0, other)
        return
    _check_linear(bench, name, seed, factor, other)


def _check_linear(bench, name, seed, factor, other):
    one, two = bench(name, seed), bench(name, other)
    fixed = {c for c in one.values if not one.is_source(c)}
    added = {c: x if c in fixed else x + factor * two.values[c] for c, x in one.values.items()}
    second = {**two.values, **{c: one.values[c] for c in fixed}}
    out = one.run(one.blocks(values=added))
    first, scaled = one.run(one.blocks()), one.run(one.blocks(values=second))
    for channel, values in out.values.items():
        if not one.is_target(channel):
            continue
        expected = first[channel] + factor * scaled[channel]
        np.testing.assert_allclose(values, expected, atol=1e-9, rtol=1e-9)


@every_stage
def test_7_declared_zero_in_zero_out(bench, name):
    stream = bench(name)
    zeros = {c: np.zeros(x.size) if stream.is_source(c) else x for c, x in stream.values.items()}
    out = stream.run(stream.blocks(values=zeros))
    kept = [c for c in out.values if stream.is_target(c)]
    silent = not any(out[c].any() for c in kept)
    assert silent == stream.make().declared.zero_in_zero_out


@every_stage
@laws
@given(seed=SEEDS, later=st.integers(1, 10**9))
def test_7_declared_shift_invariant(bench, name, seed, later):
    stream = bench(name, seed)
    if not stream.make().declared.shift_invariant:
        return
    out, moved = stream.run(stream.blocks()), stream.run(stream.blocks(first=later))
    assert moved.first == out.first + later
    for channel, values in out.values.items():
        np.testing.assert_array_equal(values, moved[channel])


@every_stage
def test_blocks_out_of_order_are_refused(bench, name):
    stream = bench(name)
    blocks = stream.blocks([100, 200])
    stage = stream.begin(blocks)
    stage.push(blocks[1])
    with pytest.raises(StageError, match="expected"):
        stage.push(blocks[1])


@every_stage
def test_a_stream_without_the_channel_is_refused_by_name(bench, name):
    header = bench(name).header
    bare = Header(header.axis, header.step, 0.0, header.rate, frozenset(), header.tracks)
    with pytest.raises(InputError, match=f"stage {name} needs channel"):
        bench(name).make().start(bare)
