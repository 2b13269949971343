"""Streams on clocks of their own come onto the time base of the accelerometer."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping import Reading
from floatref.values.native import Epoch

RATE = 500
SECONDS = 60
FORCE = '[[channels]]\nnative = "force"\nchannel = "vertical_specific_force"\nunit = "m/s^2"\n'
HEIGHT = '[[channels]]\nnative = "range"\nchannel = "height"\nunit = "m"\n'
drawn = settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def times_of(reading: Reading, name: str) -> np.ndarray:
    return reading.recording.channel(name).times_s


@pytest.mark.slow
@drawn
@given(
    offset=st.floats(-50, 50),
    drift=st.floats(-150e-6, 150e-6),
    seed=st.integers(0, 99),
)
def test_common_pulses_give_offset_and_drift(
    make_stream: Any,
    adc: Any,
    pulsed: Any,
    read: Callable[..., Reading],
    offset: float,
    drift: float,
    seed: int,
) -> None:
    draw = np.random.default_rng(seed)
    at = np.cumsum(draw.uniform(1.0, 6.0, 12))
    own = np.arange(RATE * SECONDS) / RATE
    own += -offset / (1 + drift)
    base = offset + (1 + drift) * own
    laser = make_stream(
        "laser",
        {"range": 0.3 + 0 * own, "sync": pulsed(base, at)},
        rate=Fraction(RATE),
        tick_s=Fraction(1, 10**9),
        first_tick=round(own[0] * 1e9),
        name="laser",
    )
    clock = '[[clocks]]\nstream = "laser"\nalign = "pulses"\n'
    clock += 'pulses = "laser/sync"\nbase_pulses = "adc/pulse"\n'
    source = adc(columns={"pulse": lambda t: pulsed(t, at)})
    reading = read(clock + FORCE + HEIGHT, source, laser)
    np.testing.assert_allclose(
        times_of(reading, "height"), base, rtol=0, atol=3e-3
    )  # steps are 2 ms
    (report,) = reading.clocks
    assert report["align"] == "pulses"
    assert abs(report["drift_ppm"] - 1e6 * drift) < 4 * report["drift_sigma_ppm"]


@drawn
@given(offset=st.floats(-9, 59), drift=st.floats(-100, 100))
def test_a_stated_offset_and_drift_count_from_the_own_zero(
    make_stream: Any, adc: Any, read: Callable[..., Reading], offset: float, drift: float
) -> None:
    laser = make_stream("laser", {"range": [0.3] * 100}, rate=Fraction(10), name="laser")
    clock = f'[[clocks]]\nstream = "laser"\nalign = "offset"\noffset_s = {offset}\n'
    clock += f"drift_ppm = {drift}\n"
    reading = read(clock + FORCE + HEIGHT, adc(), laser)
    found = times_of(reading, "height")
    expected = offset + (1 + 1e-6 * drift) * np.arange(100) / 10
    # One sample stays on either side of the accelerometer's time.
    first = max(0, int(np.searchsorted(expected, 0, "right")) - 1)
    np.testing.assert_allclose(found, expected[first:][: found.size], rtol=0, atol=1e-9)


@pytest.fixture
def laser_of(make_stream: Any, pulsed: Any) -> Callable[..., Any]:
    """Make a laser that began so many s later than the accelerometer, at a rate of its own."""

    def of(start: float, drift: float, **more: Any) -> Any:
        own = np.arange(400 * SECONDS) / 400
        sync = pulsed(start + (1 + drift) * own, 1.5 + 4 * np.arange(20))
        columns = {"range": 0.3 + 0 * own, "sync": sync}
        return make_stream("laser", columns, rate=Fraction(400), **more)

    return of


SYNC = '[[clocks]]\nstream = "laser"\nalign = "pulses"\noffset_s = 0.5\n'
SYNC += 'pulses = "laser/sync"\nbase_pulses = "adc/pulse"\n'


def test_a_stream_that_the_file_puts_on_the_base_clock_can_have_its_own(
    laser_of: Any, adc: Any, pulsed: Any, read: Callable[..., Reading]
) -> None:
    """Groups of one file with rates and no start: devices that began when they did."""
    source = adc(columns={"pulse": lambda t: pulsed(t, 1.5 + 4 * np.arange(20))})
    reading = read(SYNC + FORCE + HEIGHT, source, laser_of(0.37, 40e-6))
    expected = 0.37 + (1 + 40e-6) * np.arange(400 * SECONDS) / 400
    np.testing.assert_allclose(times_of(reading, "height"), expected, rtol=0, atol=2.5e-3)
    assert times_of(reading, "vertical_specific_force")[0] == 0
    (line,) = reading.warnings
    assert line.startswith("clock of the source, laser: the pulses repeat every 4 s")


def test_an_offset_to_a_stream_of_the_base_clock_counts_from_what_the_file_says(
    laser_of: Any, adc: Any, read: Callable[..., Reading]
) -> None:
    day = {"epoch": Epoch.UTC, "origin_ns": 20_000 * 86_400 * 10**9}
    laser = laser_of(0, 0, tick_s=Fraction(1, 100), first_tick=325, **day)
    clock = '[[clocks]]\nstream = "laser"\nalign = "offset"\noffset_s = 0.5\n'
    reading = read(clock + FORCE + HEIGHT, adc(**day), laser)
    assert times_of(reading, "height")[0] == pytest.approx(3.75, abs=1e-9)


@pytest.mark.parametrize(
    ("clock", "rated", "lines"),
    [
        ("", {}, 1),
        ('[[clocks]]\nstream = "laser"\nalign = "offset"\n', {}, 0),
        ("", {"first_tick": 1}, 0),
    ],
)
def test_that_streams_begin_together_is_told_unless_file_or_map_says_so(
    laser_of: Any,
    adc: Any,
    read: Callable[..., Reading],
    clock: str,
    rated: dict[str, int],
    lines: int,
) -> None:
    laser = laser_of(0, 0, **rated)
    warnings = read(clock + FORCE + HEIGHT, adc(), laser).warnings
    assert len(warnings) == lines
    assert all("counted from zero by its rate" in line for line in warnings)


@pytest.mark.parametrize(
    ("clock", "said"),
    [
        (SYNC.replace("laser/sync", "adc/pulse"), "adc/pulse is not on this clock"),
        (SYNC.replace("laser/sync", "other/tick"), "other/tick is not on this clock"),
        (SYNC.replace("adc/pulse", "laser/sync"), "laser/sync is not on the clock of the accel"),
        (SYNC.replace("adc/pulse", "other/tick"), "other/tick is not on the clock of the accel"),
        (SYNC.replace('stream = "laser"', 'stream = "adc"'), "is the clock of the accelerometer"),
        (SYNC.replace('stream = "laser"\n', ""), "is the clock of the accelerometer"),
    ],
)
def test_pulses_are_those_of_the_clock_that_they_are_given_for(
    make_stream: Any,
    laser_of: Any,
    adc: Any,
    pulsed: Any,
    read: Callable[..., Reading],
    clock: str,
    said: str,
) -> None:
    source = adc(columns={"pulse": lambda t: pulsed(t, 1.5 + 4 * np.arange(20))})
    other = make_stream("other", {"tick": [0.0, 5.0] * 50}, rate=Fraction(10), name="other")
    with pytest.raises(InputError) as caught:
        read(clock + FORCE + HEIGHT, source, laser_of(0.37, 0), other)
    assert said in str(caught.value)
