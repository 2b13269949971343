"""The laws of the stage protocol, for any stage."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import ClassVar

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import StageError
from floatref.stages.protocol import Stage
from floatref.values.arrays import BoolArray, Flag, FloatArray
from floatref.values.block import Axis, Block
from floatref.values.channels import ChannelId
from floatref_conformance.testing.streams import LENGTH, Stream, find_flagged, join, marks_of

SEEDS = st.integers(0, 2**32 - 1)
CUTS = st.lists(st.integers(0, LENGTH), max_size=6)
laws = settings(
    deadline=None,
    max_examples=15,
    suppress_health_check=[HealthCheck.differing_executors, HealthCheck.too_slow],
)


class StageLaws:
    """Subclass it under a name that pytest collects, and write `make`.

    Attributes:
        reads: names of the channels of each wheel path from which the stage computes.
        shared: names of the channels that belong to no wheel path and control the stage.
        ranges: smallest and largest sample by channel name; others are standard normal.
        tracks: the wheel paths.
        axis: of the stream.
        keeps_index: whether an output sample has the index of an input sample.
        reach: largest distance, in samples, from a flagged result to an unflagged one that
            differs because of a missing input sample; None for an unlimited memory, such as
            that of an integral or a recursive filter.
        tolerance: largest error of linearity, and largest unflagged change by a missing sample,
            relative to the largest output.
    """

    reads: ClassVar[tuple[str, ...]] = ()
    shared: ClassVar[tuple[str, ...]] = ()
    ranges: ClassVar[Mapping[str, tuple[float, float]]] = {}
    tracks: ClassVar[tuple[str, ...]] = ("left", "right")
    axis: ClassVar[Axis] = Axis.TIME
    keeps_index: ClassVar[bool] = True
    reach: ClassVar[int | None] = 0
    tolerance: ClassVar[float] = 1e-9

    def make(self) -> Stage:
        """Return a new stage."""
        raise NotImplementedError(f"{type(self).__name__}: write make(), which returns a stage")

    def stream(self, seed: int = 0) -> Stream:
        """Return a drawn stream for the stage."""
        rng = np.random.default_rng(seed)
        channels = [ChannelId(name, track) for name in self.reads for track in self.tracks]
        channels += [ChannelId(name) for name in self.shared]
        samples = {channel: self._draw(rng, channel.name) for channel in channels}
        return Stream(self.make, samples, self.tracks, self.axis)

    def _draw(self, rng: np.random.Generator, name: str) -> FloatArray:
        if name in self.ranges:
            return rng.uniform(*self.ranges[name], LENGTH)
        return rng.standard_normal(LENGTH)

    @laws
    @given(seed=SEEDS, cuts=CUTS)
    def test_1_any_split_gives_the_same_output(self, seed: int, cuts: list[int]) -> None:
        """Law 1: bit for bit."""
        stream = self.stream(seed)
        assert_same(stream.run(), stream.run(cuts))

    @laws
    @given(seed=SEEDS, cuts=CUTS)
    def test_2_indices_are_contiguous_and_totals_equal(self, seed: int, cuts: list[int]) -> None:
        """Law 2: samples are held back no longer than declared; after finish all are output."""
        stream = self.stream(seed)
        blocks = stream.blocks(cuts)
        stage = stream.begin(blocks)
        out, held = [], 0
        for block in stream.order(blocks):
            out.append(stage.push(block))
            held += len(block) - len(out[-1])
            if self.keeps_index:
                assert 0 <= held <= stage.declared.delay, f"{held} samples held back"
        filled = sorted((b for b in [*out, *stage.finish()] if len(b)), key=lambda b: b.first)
        for before, after in pairwise(filled):
            assert after.first == before.first + len(before), f"a gap at {after.first}"
        if self.keeps_index:
            assert sum(map(len, filled)) == LENGTH, "not all samples came out"

    def test_3_the_input_is_left_as_it_was(self) -> None:
        """Law 3."""
        stream = self.stream()
        before = {channel: values.copy() for channel, values in stream.samples.items()}
        stream.run()
        for channel, values in before.items():
            assert np.array_equal(values, stream.samples[channel]), f"{channel} was changed"

    @laws
    @given(seed=SEEDS, at=st.integers(1, 3))
    def test_4_saving_and_restoring_changes_nothing(self, seed: int, at: int) -> None:
        """Law 4: another stage continues from a state that was saved in the middle."""
        stream = self.stream(seed)
        assert_same(resume(stream, [60, 120, 180], at), stream.run())

    @laws
    @given(seed=SEEDS, at=st.integers(1, LENGTH - 2))
    def test_5_a_missing_sample_is_flagged_on_the_way_out(self, seed: int, at: int) -> None:
        """Law 5: results that differ because of it are NaN or flagged, except within ``reach``."""
        stream = self.stream(seed)
        whole = stream.run()
        for lost in (c for c in stream.samples if c.track is not None):
            out = stream.change(partial(_without, lost, at)).run()
            for channel in out.values:
                wrong = _find_wrong(out, whole, channel, self.tolerance)
                assert not _find_unflagged(wrong, find_flagged(out, channel), self.reach).any(), (
                    f"{channel}: differs without a sample of {lost}, and is not flagged there; "
                    "flag it, or declare the reach"
                )

    @laws
    @given(seed=SEEDS, at=st.integers(LENGTH // 4, 3 * LENGTH // 4))
    def test_5_a_flag_comes_out_again(self, seed: int, at: int) -> None:
        """Law 5: an invalid input sample makes an invalid output sample; tested away from the ends.

        A flag of a channel must be on each output of its wheel path that is computed from it.
        """
        stream, other = self.stream(seed), self.stream(seed + 1)
        whole = stream.run()
        marks = np.zeros(LENGTH, np.uint8)
        marks[at] = Flag.DRIFT
        for marked in (c for c in stream.samples if c.track is not None):
            out = replace(stream, flags={marked: marks}).run()
            drawn = other.samples[marked]
            moved = stream.change(partial(_replace_one, marked, drawn)).run()
            for channel in (c for c in out.values if c.track == marked.track):
                used = not np.array_equal(moved[channel], whole[channel], equal_nan=True)
                assert not used or find_flagged(out, channel).any(), (
                    f"{channel}: flag of {marked} lost"
                )

    def test_6_after_finish_nothing_is_taken(self) -> None:
        """Law 6."""
        stream = self.stream()
        blocks = stream.blocks()
        stage = stream.begin(blocks)
        stage.push(blocks[0])
        stage.finish()
        try:
            stage.push(blocks[0])
        except StageError:
            return
        raise AssertionError("push after finish raises no StageError")

    @laws
    @given(seed=SEEDS, other=SEEDS, factor=st.floats(-3.0, 3.0))
    def test_7_it_is_linear_if_it_says_so(self, seed: int, other: int, factor: float) -> None:
        """Law 7: the output of a sum is the sum of the outputs, with fixed control channels."""
        if not self.make().declared.linear:
            return
        one, two = self.stream(seed), self.stream(other)
        steady = two.change(lambda c, x: one.samples[c] if c.track is None else x)
        summed = one.change(lambda c, x: x if c.track is None else x + factor * two.samples[c])
        first, second, out = one.run(), steady.run(), summed.run()
        for channel in (c for c in out.values if c.track is not None):
            expected = first[channel] + factor * second[channel]
            scale = max(1.0, float(np.abs(expected).max()))
            error = float(np.abs(out[channel] - expected).max())
            assert error <= self.tolerance * scale, f"{channel}: off by {error:.3g}"

    def test_7_zero_in_is_zero_out_if_it_says_so(self) -> None:
        """Law 7."""
        if not self.make().declared.zero_in_zero_out:
            return
        zeros = self.stream().change(lambda c, x: x if c.track is None else np.zeros(x.size))
        out = zeros.run()
        for channel in (c for c in out.values if c.track is not None):
            assert not out[channel].any(), f"{channel}: not zero"

    @laws
    @given(seed=SEEDS, later=st.integers(1, 10**9))
    def test_7_the_index_does_not_matter_if_it_says_so(self, seed: int, later: int) -> None:
        """Law 7: the same samples at other indices give the same output there."""
        if not self.make().declared.shift_invariant:
            return
        stream = self.stream(seed)
        moved = Stream(stream.make, stream.samples, self.tracks, self.axis, first=later).run()
        out = stream.run()
        assert moved.first == out.first + later, f"begins at {moved.first}"
        assert_same(moved, out, at=later)


def resume(stream: Stream, cuts: list[int], at: int) -> Block:
    """Return the output if a restored stage processes block ``at`` and those after it."""
    blocks = stream.blocks(cuts)
    order, stage = stream.order(blocks), stream.begin(blocks)
    out = [stage.push(block) for block in order[:at]]
    saved = stage.state()
    for block in order[at:]:
        stage.push(block)
    other = stream.make()
    other.start(stream.header)
    other.restore(saved)
    return join([*out, *(other.push(block) for block in order[at:]), *other.finish()])


def _without(lost: ChannelId, at: int, channel: ChannelId, values: FloatArray) -> FloatArray:
    """Return ``values`` without sample ``at``, if they are those of ``lost``."""
    return np.where(np.arange(values.size) == at, np.nan, values) if channel == lost else values


def _replace_one(
    moved: ChannelId, drawn: FloatArray, channel: ChannelId, values: FloatArray
) -> FloatArray:
    return drawn if channel == moved else values


def _find_wrong(out: Block, whole: Block, channel: ChannelId, tolerance: float) -> BoolArray:
    """Return where ``out`` differs from ``whole`` by more than rounding."""
    largest = float(np.abs(whole[channel]).max(initial=1.0, where=~np.isnan(whole[channel])))
    close = np.isclose(
        out[channel], whole[channel], rtol=0, atol=tolerance * largest, equal_nan=True
    )
    return ~close


def _find_unflagged(wrong: BoolArray, flagged: BoolArray, reach: int | None) -> BoolArray:
    """Return where ``wrong`` is neither ``flagged`` nor within ``reach`` of a flagged sample."""
    if not flagged.any():
        return wrong
    if reach is None:
        return np.zeros_like(wrong)
    near = np.convolve(flagged, np.ones(2 * reach + 1))[reach : reach + flagged.size] > 0
    return wrong & ~near


def assert_same(one: Block, two: Block, at: int = 0) -> None:
    """Raise AssertionError unless both blocks are equal, the first ``at`` samples later."""
    assert one.first == two.first + at, f"one begins at {one.first}, the other at {two.first}"
    assert one.values.keys() == two.values.keys(), "the channels differ"
    for channel, values in one.values.items():
        assert np.array_equal(values, two[channel], equal_nan=True), f"{channel} differs"
        assert np.array_equal(marks_of(one, channel), marks_of(two, channel)), (
            f"flags of {channel} differ"
        )
