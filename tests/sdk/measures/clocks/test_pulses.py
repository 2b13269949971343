"""Leading edges of pulses, whatever the signal that carries them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.clocks import pulses
from floatref.measures.clocks.pulses import pulse_levels, pulse_times, pulse_times_at_rate

FEW = settings(deadline=None, max_examples=25)
seeds = st.integers(0, 2**32 - 1)
RATE = 1000.0


def edges_at(seed: int, count: int = 12) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).uniform(0.5, 2.0, count))


def analog(times: np.ndarray, edges: np.ndarray, width: float, rise_s: float) -> np.ndarray:
    """Pulses from 0 to 1 whose ramps have their middle at the edge, ``width`` seconds long."""
    up = np.clip((times - edges[:, None]) / rise_s + 0.5, 0.0, 1.0)
    down = np.clip((times - edges[:, None] - width) / rise_s + 0.5, 0.0, 1.0)
    return (up - down).sum(axis=0)


@FEW
@given(
    seed=seeds,
    width=st.sampled_from([0.01, 0.1, 0.3]),
    noise=st.floats(0.0, 0.03),
    level=st.floats(-5.0, 5.0),
    height=st.sampled_from([-3.3, 0.02, 5.0, 400.0]),
)
def test_analog_pulses_with_noise(seed, width, noise, level, height) -> None:
    """On a ramp of 4 samples noise of σ moves an edge by about 4 σ samples."""
    edges = edges_at(seed)
    times = np.arange(int((edges[-1] + 1.0) * RATE)) / RATE
    signal = analog(times, edges, width, 4.0 / RATE)
    signal += noise * np.random.default_rng(seed + 1).normal(size=times.size)
    found = pulse_times(times, level + height * signal)
    assert found.size == edges.size
    assert np.abs(found - edges).max() <= (0.02 + 20 * noise) / RATE


@FEW
@given(seed=seeds, low=st.booleans(), start=st.floats(-1e5, 1e5))
def test_digital_pulses_lie_between_two_samples(seed: int, low: bool, start: float) -> None:
    edges = edges_at(seed)
    times = np.arange(int((edges[-1] + 1.0) * RATE)) / RATE
    on = ((times >= edges[:, None]) & (times < edges[:, None] + 0.1)).any(axis=0)
    found = pulse_times_at_rate(1.0 * (on != low), RATE, start) - start
    assert found.size == edges.size
    assert np.abs(found - edges).max() <= 0.51 / RATE


@pytest.mark.slow
@FEW
@given(seed=seeds)
def test_ringing_makes_no_further_edge(seed: int) -> None:
    edges = edges_at(seed)
    times = np.arange(int((edges[-1] + 1.0) * 10 * RATE)) / RATE / 10
    signal = analog(times, edges, 0.1, 5e-4)
    for edge, size in (*((e, 1.6) for e in edges), *((e, -1.6) for e in edges + 0.1)):
        since = np.clip(times - edge, 0.0, None)
        signal += size * np.exp(-since / 1e-3) * np.sin(2 * np.pi * 1500.0 * since)
    found = pulse_times(times, signal)
    assert found.size == edges.size
    assert np.abs(found - edges).max() < 3e-4


@pytest.mark.slow
@FEW
@given(seed=seeds, edges=st.integers(1, 40))
def test_a_bouncing_switch_makes_no_further_edge(seed: int, edges: int) -> None:
    rng = np.random.default_rng(seed)
    pulses = 0.5 + np.cumsum(rng.uniform(1.0, 4.0, 12))
    times = np.arange(int((pulses[-1] + 1.0) * 10 * RATE)) / RATE / 10
    since = times - pulses[np.searchsorted(pulses, times, side="right").clip(1) - 1]
    closed = (since >= 0) & (since < 0.1)
    opens = closed & (since < 1e-3 * edges / 4) & (since % 2.5e-4 > 1.25e-4)
    found = pulse_times(times, 5.0 * (closed & ~opens))
    assert found.size == pulses.size
    assert np.abs(found - pulses).max() < 1.1 / RATE / 10


def test_a_square_wave_rises_whatever_it_begins_with() -> None:
    times = np.arange(20_000) / RATE
    for phase in (0.0, 0.5):
        found = pulse_times(times, 1.0 * ((times + phase) % 1.0 < 0.5))
        assert np.allclose((found + phase) % 1.0, 0.9995, atol=1e-6)


def test_an_edge_in_a_gap_is_left_out_and_no_other() -> None:
    times = np.arange(10_000) / RATE
    values = 1.0 * (times % 1.0 > 0.9)
    values[(times > 2.85) & (times < 2.95)] = np.nan
    values[(times > 5.2) & (times < 5.4)] = np.nan
    found = pulse_times(times, values)
    assert np.round(found, 1).tolist() == [0.9, 1.9, 3.9, 4.9, 5.9, 6.9, 7.9, 8.9, 9.9]


def test_one_spike_is_one_pulse_and_no_other_level() -> None:
    times = np.arange(30_000) / RATE
    values = 1.0 * (times % 2.0 > 1.95)
    values[4321] = 12.0
    found = pulse_times(times, values)
    assert np.round(found[[0, 1, 3]], 2).tolist() == [1.95, 3.95, 5.95]
    assert pulse_levels(values) == pytest.approx((0.0, 1.0), abs=0.01)


@pytest.mark.slow
@FEW
@given(seed=seeds, chunk=st.sampled_from([7, 64, 1000, 4096]))
def test_the_size_of_the_pieces_changes_nothing(seed: int, chunk: int) -> None:
    edges = edges_at(seed)
    times = np.arange(int((edges[-1] + 1.0) * RATE)) / RATE
    signal = analog(times, edges, 0.1, 0.03)
    signal += 0.01 * np.random.default_rng(seed).normal(size=times.size)
    whole = pulse_times(times, signal)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("floatref.values.scanning.CHUNK", chunk)
        parted = pulse_times(times, signal)
    np.testing.assert_array_equal(parted, whole)
    assert whole.size == edges.size


@pytest.mark.parametrize("kind", [np.float32, np.int16, np.uint8])
@pytest.mark.parametrize("known", [1.0, 0.6])
def test_numbers_of_any_kind_are_those_in_double_precision(kind: type, known: float) -> None:
    """As a recorder of few bits writes them, with samples missing anywhere."""
    times, rng = np.arange(4000) / RATE, np.random.default_rng()
    signal = 20.0 + 200.0 * (times % 0.5 > 0.4) + 2.0 * rng.normal(size=times.size)
    signal, seen = np.rint(signal).astype(kind), rng.uniform(size=times.size) < known
    if np.issubdtype(kind, np.integer):
        seen[:] = True
    else:
        signal[~seen] = np.nan
    found, expected = pulse_times(times, signal), pulse_times(times, signal.astype(np.float64))
    # Single precision has 24 bits, of a step that takes a sample.
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-4 / RATE)
    assert pulse_levels(signal) == pytest.approx((20.0, 220.0), abs=3.0)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        (np.full(100, 3.0), "all samples are 3"),
        (np.full(100, np.nan), "all samples are missing"),
        (np.random.default_rng(0).normal(size=5000), "around one level"),
        (np.repeat([1.0, 0.0], [10, 500]), "is complete"),
    ],
)
def test_without_pulses_it_says_what_was_looked_for(values: np.ndarray, said: str) -> None:
    with pytest.raises(InputError, match=said) as caught:
        pulse_times_at_rate(values, RATE)
    assert "looked for pulses that rise" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_times_and_samples_have_to_go_together() -> None:
    with pytest.raises(InputError, match="5 samples of pulses but 4 times"):
        pulse_times(np.arange(4.0), np.zeros(5))


def test_a_channel_in_a_file_is_read_in_pieces(tmp_path) -> None:
    count = 5 * pulses.CHUNK
    values = np.memmap(tmp_path / "pulse.f64", np.float64, "w+", shape=(count,))
    values[:] = np.arange(count) % 64_000 < 160
    values.flush()
    found = pulse_times_at_rate(np.memmap(tmp_path / "pulse.f64", np.float64, "r"), 16_000.0)
    assert np.diff(found) == pytest.approx(np.full(found.size - 1, 4.0))
