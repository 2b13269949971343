"""The engine's order of passes does not change the result."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.engine import flow
from floatref.errors import StageError
from floatref.measures.roughness.zero_phase import high_pass_b3x2
from floatref.stages.filters.butterworth import high_pass_b3x2 as high_pass_stages
from floatref.stages.integration import RemoveMean
from floatref.stages.protocol import Direction, Stage
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

ELEVATION = ChannelId("elevation", "main")
HEADER = Header(Axis.DISTANCE, 0.05, 0.0, Fraction(1000), frozenset({ELEVATION}), ("main",))


def blocks_of(x, sizes, flags=None):
    first, out = 0, []
    for size in sizes:
        part = slice(first, first + size)
        out.append(
            Block(
                first,
                {ELEVATION: x[part]},
                flags={ELEVATION: flags[part]} if flags is not None else {},
            )
        )
        first += size
    return out


@settings(deadline=None, max_examples=20)
@given(sizes=st.lists(st.integers(1, 90), min_size=1, max_size=8), seed=st.integers(0, 2**32 - 1))
def test_stages_over_the_tape_are_the_filter_on_the_whole(sizes, seed):
    x = np.random.default_rng(seed).standard_normal(sum(sizes)).cumsum()
    stages = [RemoveMean("elevation"), *high_pass_stages("elevation", 1.0 / 20.0)]
    _, out = flow.run(stages, HEADER, blocks_of(x, sizes))
    joined = np.concatenate([block[ELEVATION] for block in out])
    expected = high_pass_b3x2(x - x.mean(), 0.05, 20.0)
    assert np.abs(joined - expected).max() <= 1e-11 * (1.0 + np.abs(x).max())


def test_a_backward_stage_that_changes_the_length_is_refused():
    class Shortening(Stage):
        direction = Direction.BACKWARD

        def open(self, header):
            return header

        def advance(self, block):
            return Block(block.first, {ELEVATION: block[ELEVATION][1:]})

    _, out = flow.run([Shortening()], HEADER, blocks_of(np.zeros(9), [4, 5]))
    with pytest.raises(StageError, match="Shortening: a backward stage must keep"):
        list(out)


@pytest.mark.parametrize("kind", [KeyError, SystemExit])
@pytest.mark.parametrize("where", ["open", "advance", "close"])
def test_whatever_a_stage_raises_is_one_error_that_names_it(where, kind):
    class Cracked(Stage):
        def open(self, header):
            return self._maybe("open", header)

        def advance(self, block):
            return self._maybe("advance", block)

        def close(self):
            return self._maybe("close", ())

        def _maybe(self, point, value):
            if point == where:
                raise kind("of a vendor")
            return value

    with pytest.raises(StageError, match=f"stage Cracked: {kind.__name__}: '?of a vendor"):
        list(flow.run([Cracked()], HEADER, blocks_of(np.zeros(9), [4, 5]))[1])


def test_what_stages_tell_is_told_in_their_order_and_once():
    class Telling(RemoveMean):
        def __init__(self, *lines):
            super().__init__("elevation")
            self.lines = lines

        def warnings(self):
            return tuple(line.upper() for line in self.lines)

    assert flow.collect_warnings([Telling("b", "a"), Telling(), Telling("a", "c")]) == (
        "B",
        "A",
        "C",
    )
    with pytest.raises(StageError, match="stage Telling: AttributeError"):
        flow.collect_warnings([Telling(1.0)])


class Refused:
    """A tape that nothing may be put on."""

    def __init__(self):
        raise AssertionError("a tape was begun")


def test_blocks_that_can_be_asked_for_again_are_not_taped():
    x = np.random.default_rng(4).standard_normal(50)
    blocks = blocks_of(x, [20, 30])
    _, again = flow.run([RemoveMean("elevation")], HEADER, blocks, Refused)
    _, taped = flow.run([RemoveMean("elevation")], HEADER, iter(blocks))
    both = [np.concatenate([block[ELEVATION] for block in out]) for out in (again, taped)]
    np.testing.assert_array_equal(*both)
    np.testing.assert_allclose(both[0], x - x.mean(), rtol=0, atol=1e-15)
    with pytest.raises(AssertionError, match="a tape was begun"):
        flow.run([RemoveMean("elevation")], HEADER, iter(blocks), Refused)
