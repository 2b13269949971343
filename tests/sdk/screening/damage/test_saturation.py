"""An accelerometer at the end of its range is found, and a peak is not."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.damage.damaged_samples import within
from floatref.screening.damage.saturation import find_saturation
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

G, RATE, COUNT = 9.80665, 4000.0, 16_000
FORCE = "vertical_specific_force"
QUANTA = [6e-4, 0.0024, 0.0192, 0.0383]
laws = settings(deadline=None, max_examples=40)


def rounded(values, quantum):
    return quantum * np.round(values / quantum)


def forces(seed=0, noise=0.3, quantum=0.0006):
    return rounded(G + noise * np.random.default_rng(seed).standard_normal(COUNT), quantum)


def of_force(values, rate=RATE):
    return find_saturation(Channel.of(FORCE, values, UniformClock.of(rate)))


def found_share(values, at_end):
    """Which share of the samples ``at_end`` is found, and how many others are."""
    mask = within(of_force(values).gone, 0, values.size)
    if mask is None:
        return 0.0, 0
    return np.mean(mask[at_end]), np.sum(mask & ~at_end)


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
    seed=st.integers(0, 2**32 - 1),
    rate=st.sampled_from([1000.0, 4000.0, 16_000.0]),
    noise=st.sampled_from([0.0, 0.005, 0.05, 0.3, 1.0]),
    quantum=st.sampled_from(QUANTA),
    lasts_s=st.floats(0.008, 0.04),
    over=st.floats(5.0, 20.0),
    way=st.sampled_from([-1.0, 1.0]),
)
def test_a_clipped_pulse_is_found_under_any_noise(seed, rate, noise, quantum, lasts_s, over, way):
    """Half a sine to ``over`` m/s² beyond the end of the range, which it is beyond for so long."""
    times, end = np.arange(int(rate)) / rate - 0.5, 3.0 * G
    phase = times * 2.0 * np.arccos(end / (end + over)) / lasts_s
    pulse = np.where(np.abs(phase) < np.pi / 2, (end + over) * np.cos(phase), 0.0)
    pulse += 0.3 * np.sin(40.0 * times) + noise * np.random.default_rng(seed).standard_normal(
        times.size
    )
    ends = rounded(np.array([G - end, G + end]), quantum)
    values = np.clip(rounded(G + way * pulse, quantum), *ends)
    share, others = found_share(values, np.isin(values, ends))
    assert share > 0.5
    assert others == 0


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    rate=st.sampled_from([1000.0, 4000.0, 16_000.0]),
    noise=st.sampled_from([0.0, 0.005, 0.02, 0.1]),
    quantum=st.sampled_from(QUANTA),
    hertz=st.floats(1.5, 10.0),
    swing=st.floats(1.15, 2.0),
    full_scale=st.sampled_from([2.0, 4.0]),
)
def test_a_clipped_swing_is_found_under_any_noise(
    seed, rate, noise, quantum, hertz, swing, full_scale
):
    """Where noise alone takes it back from the end, what it reads is as good as any sample."""
    times, reach = np.arange(int(4 * rate)) / rate, (full_scale - 1.0) * G
    body = swing * reach * np.sin(2 * np.pi * hertz * times) * np.hanning(times.size)
    ends = rounded(np.array([G - reach, G + reach]), quantum)
    noisy = body + noise * np.random.default_rng(seed).standard_normal(times.size)
    values = np.clip(rounded(G + noisy, quantum), *ends)
    assert found_share(values, np.abs(body) > reach + 5.0 * noise + quantum)[0] > 0.95
    assert found_share(values, np.isin(values, ends))[1] == 0


@pytest.mark.slow
@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    noise=st.sampled_from([0.005, 0.05, 0.3]),
    period=st.integers(40, 2000),
)
def test_what_is_clipped_for_half_the_time_is_found(seed, noise, period):
    square = np.sign(np.sin(2 * np.pi * np.arange(COUNT) / period))
    values = forces(seed, noise) + 1.5 * G * np.maximum(square, 0.0)
    values = rounded(np.minimum(values, 2.0 * G), 0.0006)
    share, others = found_share(values, values == values.max())
    assert share > 0.9
    assert others == 0


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
    assert of_force(rounded(values, quantum)).gone.size == 0
    assert of_force(values).gone.size == 0
    assert of_force(forces(seed, quantum=quantum)).gone.size == 0


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    rate=st.sampled_from([1000.0, 4000.0, 16_000.0]),
    quantum=st.sampled_from(QUANTA),
    noise=st.floats(0.2, 8.0),
    hold=st.sampled_from([1, 2, 4, 8]),
    hertz=st.floats(1.0, 12.0),
)
def test_a_noisy_peak_is_no_end_of_a_range(seed, rate, quantum, noise, hold, hertz):
    """Noise of so many quanta, of an accelerometer that holds its readings."""
    times = np.arange(0, int(4 * rate), hold) / rate
    values = G + 1.2 * G * np.sin(2 * np.pi * hertz * times) * np.hanning(times.size)
    values += noise * quantum * np.random.default_rng(seed).standard_normal(times.size)
    assert of_force(np.repeat(rounded(values, quantum), hold), rate).gone.size == 0


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
    values = rounded(values, quantum)
    outermost = values.max() if way > 0 else values.min()
    values[COUNT // 2 : COUNT // 2 + length] = outermost + way * level * quantum
    assert of_force(values).gone.size == 0


@pytest.mark.parametrize("hold", [4, 10])
def test_the_holds_of_a_slow_accelerometer_are_no_end_of_a_range(hold):
    values = np.repeat(forces(noise=3.0)[::hold], hold)
    assert of_force(values).gone.size == 0
    values[8000 : 8000 + 6 * hold] = 4.0 * G
    np.testing.assert_array_equal(of_force(values).gone, [[8000, 8000 + 6 * hold]])


@pytest.mark.parametrize("ends", [slice(0, 40), slice(COUNT - 40, COUNT), slice(800, 840)])
def test_an_end_of_a_range_beside_missing_samples_is_one(ends):
    values = forces()
    values[780:800] = np.nan
    values[ends] = -3.0 * G
    np.testing.assert_array_equal(of_force(values).gone, [[ends.start, ends.stop]])
