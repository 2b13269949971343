"""Blocks in memory are those of the tape on disk, and nothing of a window is on disk."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.engine.axis_place import Place
from floatref.engine.run import run
from floatref.intake import tape
from floatref.intake.kept_blocks import KeptBlocks
from floatref.stages.signals import ELEVATION
from floatref.values.block import Block
from floatref.values.channels import ChannelId

NAME = ChannelId(ELEVATION, "main")


@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.integers(1, 30), min_size=1, max_size=6), st.integers(0, 2**31))
def test_they_give_back_what_a_tape_gives_back(monkeypatch, sizes, seed):
    monkeypatch.setattr(tape, "IN_MEMORY", 64)
    rng, first = np.random.default_rng(seed), 0
    with tape.Tape() as other, KeptBlocks() as kept:
        for size in sizes:
            values = rng.standard_normal(2 * size)[::2]
            flags = rng.integers(0, 4, size).astype(np.uint8)
            for each in (other, kept):
                each.append(Block(first, {NAME: values}, flags={NAME: flags}))
            first += size
        number = int(rng.integers(len(sizes)))
        for each in (other, kept):
            block = each.read(number)
            each.rewrite(number, block.setting({NAME: -block[NAME]}))
        assert len(other) == len(kept)
        for one, two in zip(other.forward(), kept.forward(), strict=True):
            assert one.first == two.first
            np.testing.assert_array_equal(one[NAME], two[NAME])
            np.testing.assert_array_equal(one.flags[NAME], two.flags[NAME])
            # Compiled stages see one layout.
            assert one[NAME].flags.c_contiguous == two[NAME].flags.c_contiguous
            assert one[NAME].flags.writeable == two[NAME].flags.writeable
        with pytest.raises(ValueError, match="block 0 holds"):
            kept.rewrite(0, Block(0, {NAME: np.zeros(sizes[0] + 1)}))


@pytest.mark.parametrize("pipeline", ["temporal-adaptive-hpf", "temporal-hpf"])
def test_no_sample_of_a_window_is_written_to_disk(steady, monkeypatch, pipeline):
    def refuse(*_):
        raise AssertionError("a file was opened")

    whole = run(steady(), pipeline)
    monkeypatch.setattr(tape, "_open", refuse)
    monkeypatch.setattr(tape, "IN_MEMORY", 0)
    window = run(steady(), pipeline, place=Place(-np.inf))
    assert window.profile.length_m == pytest.approx(whole.profile.length_m, abs=0.1)
