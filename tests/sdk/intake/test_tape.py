"""The tape gives back what it took, from memory and from disk."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.engine import flow
from floatref.errors import InputError
from floatref.intake import tape
from floatref.stages.filters.butterworth import HighPassB3S1R
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

ELEVATION, HEIGHT = ChannelId("elevation", "main"), ChannelId("height", "main")
HEADER = Header(Axis.DISTANCE, 0.05, 0.0, Fraction(1000), frozenset({ELEVATION}), ("main",))
X = np.arange(10.0)


def blocks_of(x, sizes, flags):
    ends = np.cumsum([0, *sizes])
    return [
        Block(int(low), {ELEVATION: x[low:high]}, flags={ELEVATION: flags[low:high]})
        for low, high in pairwise(ends)
    ]


def watched(monkeypatch):
    """Return a list to which the sizes of all writes are added."""
    written, opened = [], tape._open

    class Watched:
        def __init__(self):
            self.file = opened()

        def write(self, data):
            written.append(data.nbytes // 8)
            return self.file.write(data)

        def __getattr__(self, name):
            return getattr(self.file, name)

    monkeypatch.setattr(tape, "_open", Watched)
    return written


@settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(sizes=st.lists(st.integers(1, 50), min_size=1, max_size=8), seed=st.integers(0, 2**32 - 1))
def test_the_tape_returns_what_was_written_on_disk_too(monkeypatch, sizes, seed):
    monkeypatch.setattr(tape, "IN_MEMORY", 64)
    rng = np.random.default_rng(seed)
    x, flags = rng.standard_normal(sum(sizes)), rng.integers(0, 4, sum(sizes)).astype(np.uint8)
    with tape.Tape() as written:
        for block in blocks_of(x, sizes, flags):
            written.append(block)
        assert len(written) == len(sizes)
        last = written.read(len(written) - 1)
        written.rewrite(len(written) - 1, last.setting({ELEVATION: -last[ELEVATION]}))
        read = list(written.forward())
    joined = np.concatenate([block[ELEVATION] for block in read])
    np.testing.assert_array_equal(joined[: -sizes[-1]], x[: -sizes[-1]])
    np.testing.assert_array_equal(joined[-sizes[-1] :], -x[-sizes[-1] :])
    np.testing.assert_array_equal(np.concatenate([b.flags[ELEVATION] for b in read]), flags)


def test_a_channel_that_has_not_changed_is_not_written_again(monkeypatch):
    monkeypatch.setattr(tape, "IN_MEMORY", 0)
    written = watched(monkeypatch)
    with tape.Tape() as both:
        for first in (0, 10):
            both.append(Block(first, {ELEVATION: np.full(10, float(first)), HEIGHT: np.ones(10)}))
        written.clear()
        both.rewrite(1, both.read(1).setting({HEIGHT: np.zeros(10)}))
        assert written == [10]
        # The same arrays in another block are a change.
        both.rewrite(0, Block(0, both.read(1).values))
        assert written == [10, 10, 10]
        for block in both.forward():
            assert (block[ELEVATION] == 10.0).all()
            assert (block[HEIGHT] == 0.0).all()


def test_nothing_is_copied_up_to_a_length_and_all_is_on_disk_beyond(monkeypatch):
    written = watched(monkeypatch)
    monkeypatch.setattr(tape, "IN_MEMORY", 3 * 8 * 10)
    with tape.Tape() as both:
        ramp = np.arange(10.0)
        both.append(Block(0, {ELEVATION: ramp, HEIGHT: -ramp}))
        assert np.shares_memory(both.read(0)[ELEVATION], ramp)
        assert written == []
        both.append(Block(10, {ELEVATION: 10 + ramp, HEIGHT: -10 - ramp}))
        assert written == [10, 10, 10, 10]
        assert not np.shares_memory(both.read(0)[ELEVATION], ramp)
        read = list(both.forward())
    for channel, sign in ((ELEVATION, 1.0), (HEIGHT, -1.0)):
        joined = np.concatenate([block[channel] for block in read])
        np.testing.assert_array_equal(joined, sign * np.arange(20.0))


@pytest.mark.parametrize("says", ["error", "fewer bytes"])
def test_a_full_disk_names_the_folder(monkeypatch, says):
    class Full:
        def seek(self, at):
            pass

        def write(self, data):
            if says == "error":
                raise OSError(28, "No space left on device")
            return data.nbytes - 1

        def close(self):
            pass

    monkeypatch.setattr(tape, "IN_MEMORY", 0)
    monkeypatch.setattr(tape, "_open", Full)
    with tape.Tape() as written, pytest.raises(InputError, match=r"does not fit \(No space left"):
        written.append(Block(0, {ELEVATION: np.zeros(3)}))


@pytest.mark.parametrize(("in_memory", "calls"), [(0, 1), (1000, 0)])
def test_where_a_long_run_turns_its_memory_goes_back(monkeypatch, in_memory, calls):
    called = []
    monkeypatch.setattr(tape, "IN_MEMORY", in_memory)
    monkeypatch.setattr(tape, "return_freed", lambda: called.append(True))
    _, out = flow.run([HighPassB3S1R("elevation", 1.0)], HEADER, [Block(0, {ELEVATION: X})])
    assert len(list(out)) == 1
    assert len(called) == calls
