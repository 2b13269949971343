"""Sensors that measure nothing are found where they do, and nowhere else."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import floatref
from floatref.architectures.damage import damaged_force, damaged_height, within
from floatref.architectures.source import Source
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

G, RATE, COUNT = 9.80665, 4000.0, 16_000
CLOCK = UniformClock.of(RATE)
FORCE, HEIGHT = "vertical_specific_force", "height"
laws = settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def forces(seed=0, noise=0.3, quantum=0.0006):
    values = G + noise * np.random.default_rng(seed).standard_normal(COUNT)
    return quantum * np.round(values / quantum)


def heights(seed=0, quantum=4e-6, hold=1):
    rng = np.random.default_rng(seed)
    values = 0.3 + 0.005 * np.sin(np.arange(COUNT) / 300.0) + 5e-5 * rng.standard_normal(COUNT)
    return np.repeat(quantum * np.round(values[::hold] / quantum), hold)[:COUNT]


def of_force(values):
    return damaged_force(Channel.of(FORCE, values, CLOCK))


def of_height(values, force=None):
    beside = Channel.of(FORCE, forces() if force is None else force, CLOCK)
    return damaged_height(Channel.of(HEIGHT, values, CLOCK), beside)


@laws
@given(
    seed=st.integers(0, 99),
    at=st.integers(1, COUNT - 400),
    length=st.integers(3, 300),
    full_scale=st.sampled_from([-5.0, -2.0, 2.0, 4.0]),
)
def test_an_accelerometer_at_the_end_of_its_range_is_found(seed, at, length, full_scale):
    values = forces(seed)
    values[at : at + length] = full_scale * G
    found = of_force(values)
    np.testing.assert_array_equal(found.gone, [[at, at + length]])
    np.testing.assert_array_equal(found.lasting, found.gone)
    (line,) = found.warnings
    assert f"at the end of its range for {length} samples in 1 places" in line


@laws
@given(
    seed=st.integers(0, 99),
    quantum=st.sampled_from([6e-4, 0.0106, 0.1]),
    peak=st.floats(0.8, 3.0),
    hertz=st.floats(1.0, 30.0),
)
def test_a_smooth_peak_is_no_end_of_a_range(seed, quantum, peak, hertz):
    times = np.arange(COUNT) / RATE
    values = G + peak * G * np.sin(2 * np.pi * hertz * times) * np.hanning(COUNT)
    assert of_force(quantum * np.round(values / quantum)).gone.size == 0
    assert of_force(values).gone.size == 0
    assert of_force(forces(seed, quantum=quantum)).gone.size == 0


@laws
@given(
    seed=st.integers(0, 99),
    level=st.integers(2, 9),
    length=st.integers(3, 5),
    way=st.sampled_from([-1, 1]),
)
def test_equal_samples_on_a_noisy_peak_are_no_end_of_a_range(seed, level, length, way):
    """Noise of a few quanta makes them now and then; beyond them the swing does not go on."""
    quantum, noise = 0.0006, 0.004
    swing = 0.9 * G * np.cos((np.arange(COUNT) - COUNT // 2) / 250.0)
    values = G + way * swing + noise * np.random.default_rng(seed).standard_normal(COUNT)
    values = quantum * np.round(values / quantum)
    outermost = values.max() if way > 0 else values.min()
    values[COUNT // 2 : COUNT // 2 + length] = outermost + way * level * quantum
    assert of_force(values).gone.size == 0


@pytest.mark.parametrize("hold", [4, 10])
def test_the_holds_of_a_slow_accelerometer_are_no_end_of_a_range(hold):
    assert of_force(np.repeat(forces(noise=3.0)[::hold], hold)).gone.size == 0


def test_a_clipped_swing_is_an_end_of_a_range():
    swing = 1.3 * G * np.sin(np.arange(COUNT) / 80.0)
    values = np.minimum(G + swing, 2.0 * G)
    spans = of_force(values).gone
    clipped = within(spans, 0, COUNT)
    np.testing.assert_array_equal(clipped, values == 2.0 * G)


@laws
@given(
    seed=st.integers(0, 99),
    at=st.integers(1, 8000),
    length=st.integers(220, 4000),
    hold=st.sampled_from([1, 2, 5]),
)
def test_a_stuck_laser_is_found(seed, at, length, hold):
    values = heights(seed, hold=hold)
    values[at : at + length] = 0.2987654
    np.testing.assert_array_equal(of_height(values).gone, [[at, at + length]])


@laws
@given(
    seed=st.integers(0, 99),
    at=st.integers(1, 8000),
    length=st.integers(40, 4000),
    far=st.sampled_from([-0.1, 0.15]),
)
def test_a_laser_out_of_its_range_is_found(seed, at, length, far):
    values = heights(seed, hold=2)
    values[at : at + length] = 0.3 + far
    np.testing.assert_array_equal(of_height(values).gone, [[at, at + length]])


@pytest.mark.parametrize(
    "values",
    [
        heights(hold=5),
        heights(quantum=5e-4),
        np.full(COUNT, 0.3),
        np.where(np.arange(COUNT) % 4000 < 2000, 0.3, 0.295),
        heights(quantum=4e-6, hold=400),
    ],
    ids=["held", "coarse", "flat", "plate", "slow"],
)
def test_a_laser_that_repeats_itself_anyway_is_not_suspected(values):
    assert of_height(values).gone.size == 0


def test_a_laser_is_not_stuck_while_nothing_moves():
    values, still = heights(), forces()
    values[6000:9000] = values[6000]
    still[5990:9010] = G
    assert of_height(values).gone.size == 2
    assert of_height(values, still).gone.size == 0


def test_an_accelerometer_of_its_own_clock_is_looked_at_in_the_same_time():
    values, moved = heights(), forces()
    values[6000:9000] = values[6000]
    times = 100.0 + np.arange(COUNT) / RATE
    late = Channel.of(HEIGHT, values, StampedClock.of(times))
    for clock in (UniformClock.of(RATE, 100.0), StampedClock.of(times)):
        assert damaged_height(late, Channel.of(FORCE, moved, clock)).gone.size == 2
        still = np.where((times > 101.4) & (times < 102.3), G, moved)
        assert damaged_height(late, Channel.of(FORCE, still, clock)).gone.size == 0


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
    source = Source(recording)
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
