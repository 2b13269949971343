"""What is damaged is bridged and flagged, and the user is told."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import floatref
from floatref.errors import InputError
from floatref.intake.blocks import Source
from floatref.screening.damage.damaged_samples import Runs, Usual, within
from floatref.screening.findings import Screening
from floatref.values import scanning
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

G, RATE, COUNT = 9.80665, 4000.0, 16_000
CLOCK = UniformClock.of(RATE)
FORCE, HEIGHT = "vertical_specific_force", "height"
laws = settings(deadline=None, max_examples=25)


def forces():
    values = G + 0.3 * np.random.default_rng(0).standard_normal(COUNT)
    return 0.0006 * np.round(values / 0.0006)


def heights():
    rng = np.random.default_rng(0)
    return 0.3 + 0.005 * np.sin(np.arange(COUNT) / 300.0) + 5e-5 * rng.standard_normal(COUNT)


@laws
@given(
    pieces=st.lists(
        st.tuples(st.sampled_from([0.0, 1.0, 2.0]), st.integers(1, 60)), min_size=1, max_size=12
    ),
    shortest=st.integers(2, 9),
)
def test_runs_are_the_same_however_long_a_piece_is(pieces, shortest):
    values = np.concatenate([np.full(length, value) for value, length in pieces])
    whole = Runs.of(values, shortest)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("floatref.screening.damage.damaged_samples.CHUNK", 11)
        patch.setattr(scanning, "CHUNK", 7)
        cut = Runs.of(values, shortest)
        usual = Usual.of(values)
    np.testing.assert_array_equal(cut.spans, whole.spans)
    np.testing.assert_array_equal(cut.value, whole.value)
    assert usual.samples == values.size


def test_what_is_damaged_does_not_tell_what_is_usual():
    usual = Usual.of(np.concatenate((np.repeat(np.arange(100.0), 2), np.full(900, 5.0))))
    assert usual.hold == 2.0
    assert usual.beside(0) == 900.0
    assert usual.beside(900) == 2.0


@laws
@given(
    spans=st.lists(st.tuples(st.integers(0, 60), st.integers(1, 9)), max_size=6),
    low=st.integers(0, 60),
    count=st.integers(1, 40),
)
def test_within_tells_which_samples_lie_in_a_stretch(spans, low, count):
    taken, apart = set(), []
    for first, length in sorted(spans):
        if not taken & set(range(first, first + length)):
            taken |= set(range(first, first + length))
            apart.append((first, first + length))
    mask = within(np.array(apart, dtype=np.int64).reshape(-1, 2), low, low + count)
    expected = [k in taken for k in range(low, low + count)]
    assert (mask is None and not any(expected)) or mask.tolist() == expected


@pytest.mark.parametrize("size", [97, 4096, COUNT])
def test_damage_is_bridged_and_flagged_in_any_blocks(steady, size):
    pinned, limited = heights(), forces()
    pinned[4000:4500], limited[9000:9020] = 0.5, 4.0 * G
    recording = steady(
        height=Channel.of(HEIGHT, pinned, CLOCK),
        vertical_specific_force=Channel.of(FORCE, limited, CLOCK),
    )
    source = Source(Screening.of(recording))
    assert len(source.warnings) == 2
    blocks = list(source.blocks(size))
    for name, at, values, kind in (
        (HEIGHT, slice(4000, 4500), pinned, Flag.MISSING),
        (FORCE, slice(9000, 9020), limited, Flag.MISSING | Flag.DRIFT),
    ):
        channel = ChannelId(name, "main")
        blank = [b.flags.get(channel, np.zeros(len(b), np.uint8)) for b in blocks]
        expected = np.zeros(sum(map(len, blocks)), np.uint8)
        expected[at] = kind
        np.testing.assert_array_equal(np.concatenate(blank), expected)
        ends = [at.start - 1, at.stop]
        line = np.interp(np.arange(at.start, at.stop), ends, values[ends])
        found = np.concatenate([b[channel] for b in blocks])
        np.testing.assert_allclose(found[at], line, atol=1e-12)


def test_the_user_is_told(steady):
    limited = forces()
    limited[9000:9020] = -2.0 * G
    recording = steady(vertical_specific_force=Channel.of(FORCE, limited, CLOCK))
    message = "vertical_specific_force: at the end of its range for 20 samples in 1 places, most"
    with pytest.warns(floatref.FloatrefWarning, match=message):
        floatref.process(recording)


@pytest.mark.parametrize("missing", [0, 7000])
def test_a_sensor_of_which_nothing_is_left_is_refused(steady, missing):
    stuck = np.full(COUNT, 0.3)
    stuck[:missing] = np.nan
    times = np.arange(COUNT) / RATE
    swung = G + 2.0 * np.sin(9.0 * times)
    recording = steady(
        height=Channel.of(HEIGHT, stuck, CLOCK),
        vertical_specific_force=Channel.of(FORCE, swung, CLOCK),
    )
    with pytest.raises(InputError, match="channel height: no sample measures anything"):
        Source(Screening.of(recording))
