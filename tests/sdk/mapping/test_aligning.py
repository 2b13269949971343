"""Streams on clocks of their own come onto the time base of the accelerometer."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping import Reading, read_native
from floatref.values.native import Epoch

RATE = 500
SECONDS = 60
HEAD = 'format = "floatref-map/1"\n'
FORCE = '[[channels]]\nnative = "force"\nchannel = "vertical_specific_force"\nunit = "m/s^2"\n'
HEIGHT = '[[channels]]\nnative = "range"\nchannel = "height"\nunit = "m"\n'
GNSS = '[[files]]\nname = "gps"\npath = "gps.log"\n'
HGT = '[[channels]]\nfile = "gps"\nnative = "hgt"\nchannel = "gnss_height"\nunit = "m"\n'
drawn = settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@pytest.fixture
def read(put: Callable[..., Path], tmp_path: Path) -> Callable[..., Reading]:
    """Read files of streams by a map."""

    def of(chart: str, *streams: Any, **others: Any) -> Reading:
        for name, stream in others.items():
            put(stream, name=f"{name}.log")
        (tmp_path / "map.toml").write_text(HEAD + chart)
        return read_native(put(*streams), tmp_path / "map.toml")

    return of


def times_of(reading: Reading, name: str) -> np.ndarray:
    return reading.recording.channel(name).times_s


def adc(make_stream: Any, **more: Any) -> Any:
    """Return the stream of the time base, with further columns."""
    t = np.arange(RATE * SECONDS) / RATE
    columns = {"force": 9.8 + 0.1 * np.sin(t)}
    columns |= {name: make(t) for name, make in more.pop("columns", {}).items()}
    return make_stream("adc", columns, rate=Fraction(RATE), **more)


def pulsed(times: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return 5 V for 50 ms from each of ``at`` on, noise on it."""
    since = times - at[np.clip(np.searchsorted(at, times, "right") - 1, 0, None)]
    noise = np.random.default_rng(3).normal(size=times.size)
    return 5.0 * ((since >= 0) & (since < 0.05)) + 0.02 * noise


@drawn
@given(
    offset=st.floats(-50, 50),
    drift=st.floats(-150e-6, 150e-6),
    seed=st.integers(0, 99),
)
def test_common_pulses_give_offset_and_drift(
    make_stream: Any, read: Callable[..., Reading], offset: float, drift: float, seed: int
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
    source = adc(make_stream, columns={"pulse": lambda t: pulsed(t, at)})
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
    make_stream: Any, read: Callable[..., Reading], offset: float, drift: float
) -> None:
    laser = make_stream("laser", {"range": [0.3] * 100}, rate=Fraction(10), name="laser")
    clock = f'[[clocks]]\nstream = "laser"\nalign = "offset"\noffset_s = {offset}\n'
    clock += f"drift_ppm = {drift}\n"
    reading = read(clock + FORCE + HEIGHT, adc(make_stream), laser)
    found = times_of(reading, "height")
    expected = offset + (1 + 1e-6 * drift) * np.arange(100) / 10
    # One sample stays on either side of the accelerometer's time.
    first = max(0, int(np.searchsorted(expected, 0, "right")) - 1)
    np.testing.assert_allclose(found, expected[first:][: found.size], rtol=0, atol=1e-9)


def laser_of(make_stream: Any, start: float, drift: float, **more: Any) -> Any:
    """Return a laser that began ``start`` s later than the accelerometer, at a rate of its own."""
    own = np.arange(400 * SECONDS) / 400
    sync = pulsed(start + (1 + drift) * own, 1.5 + 4 * np.arange(20))
    columns = {"range": 0.3 + 0 * own, "sync": sync}
    return make_stream("laser", columns, rate=Fraction(400), **more)


SYNC = '[[clocks]]\nstream = "laser"\nalign = "pulses"\noffset_s = 0.5\n'
SYNC += 'pulses = "laser/sync"\nbase_pulses = "adc/pulse"\n'


def test_a_stream_that_the_file_puts_on_the_base_clock_can_have_its_own(
    make_stream: Any, read: Callable[..., Reading]
) -> None:
    """Groups of one file with rates and no start: devices that began when they did."""
    source = adc(make_stream, columns={"pulse": lambda t: pulsed(t, 1.5 + 4 * np.arange(20))})
    reading = read(SYNC + FORCE + HEIGHT, source, laser_of(make_stream, 0.37, 40e-6))
    expected = 0.37 + (1 + 40e-6) * np.arange(400 * SECONDS) / 400
    np.testing.assert_allclose(times_of(reading, "height"), expected, rtol=0, atol=2.5e-3)
    assert times_of(reading, "vertical_specific_force")[0] == 0
    (line,) = reading.told
    assert line.startswith("clock of the source, laser: the pulses repeat every 4 s")


def test_an_offset_to_a_stream_of_the_base_clock_counts_from_what_the_file_says(
    make_stream: Any, read: Callable[..., Reading]
) -> None:
    day = {"epoch": Epoch.UTC, "origin_ns": 20_000 * 86_400 * 10**9}
    laser = laser_of(make_stream, 0, 0, tick_s=Fraction(1, 100), first_tick=325, **day)
    clock = '[[clocks]]\nstream = "laser"\nalign = "offset"\noffset_s = 0.5\n'
    reading = read(clock + FORCE + HEIGHT, adc(make_stream, **day), laser)
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
    make_stream: Any, read: Callable[..., Reading], clock: str, rated: dict[str, int], lines: int
) -> None:
    laser = laser_of(make_stream, 0, 0, **rated)
    told = read(clock + FORCE + HEIGHT, adc(make_stream), laser).told
    assert len(told) == lines
    assert all("counted from zero by its rate" in line for line in told)


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
    make_stream: Any, read: Callable[..., Reading], clock: str, said: str
) -> None:
    source = adc(make_stream, columns={"pulse": lambda t: pulsed(t, 1.5 + 4 * np.arange(20))})
    other = make_stream("other", {"tick": [0.0, 5.0] * 50}, rate=Fraction(10), name="other")
    with pytest.raises(InputError) as caught:
        read(clock + FORCE + HEIGHT, source, laser_of(make_stream, 0.37, 0), other)
    assert said in str(caught.value)


def test_what_aligned_a_clock_names_it(make_stream: Any, read: Callable[..., Reading]) -> None:
    utc = {"epoch": Epoch.UTC, "origin_ns": 20_000 * 86_400 * 10**9}
    rows = make_stream("GGA", {"hgt": [5.0] * 20}, rate=Fraction(20), name="NMEA", **utc)
    reading = read(GNSS + FORCE + HGT, adc(make_stream, **utc), gps=rows)
    (line,) = reading.told
    assert line.startswith("clock of gps, GGA: aligned by the absolute times of both clocks")


def gps(make_stream: Any, first: int, step: int = 50, epoch: Epoch = Epoch.GPS) -> Any:
    ticks = first + step * np.arange(200)
    ticks[100:] += 1  # no uniform clock
    return make_stream(
        "BESTPOS", {"hgt": [5.0] * 200}, ticks=ticks, tick_s=Fraction(1, 1000), epoch=epoch
    )


GPS_2026 = 1_460_000_000
LEAPS, GPS_ZERO = 18, 315_964_800


def test_utc_and_gps_time_are_leap_seconds_apart(
    make_stream: Any, read: Callable[..., Reading]
) -> None:
    utc_ns = (GPS_2026 + GPS_ZERO - LEAPS) * 10**9
    source = adc(make_stream, epoch=Epoch.UTC, origin_ns=utc_ns)
    reading = read(GNSS + FORCE + HGT, source, gps=gps(make_stream, GPS_2026 * 1000 + 2500))
    assert times_of(reading, "gnss_height")[0] == pytest.approx(2.5, abs=1e-9)
    assert any("18 leap seconds" in line for line in reading.told)


def test_the_time_of_day_is_of_the_nearest_day(
    make_stream: Any, read: Callable[..., Reading]
) -> None:
    midnight = 20_000 * 86_400
    source = adc(make_stream, epoch=Epoch.UTC, origin_ns=(midnight - 1) * 10**9)
    reading = read(GNSS + FORCE + HGT, source, gps=gps(make_stream, 2500, epoch=Epoch.DAY))
    assert times_of(reading, "gnss_height")[0] == pytest.approx(3.5, abs=1e-9)


def test_gnss_time_that_the_base_recorded_aligns_the_receiver(
    make_stream: Any, read: Callable[..., Reading]
) -> None:
    week = GPS_2026 % 604_800
    columns = {"gpstime": lambda t: week + np.floor((t + 0.4) * 20) / 20}
    clock = '[[clocks]]\nfile = "gps"\nalign = "gnss"\nbase_time = "gpstime"\n'
    reading = read(
        GNSS + clock + FORCE + HGT,
        adc(make_stream, columns=columns),
        gps=gps(make_stream, GPS_2026 * 1000 + 2500),
    )
    assert times_of(reading, "gnss_height")[0] == pytest.approx(2.1, abs=4e-3)


@pytest.mark.parametrize("known", [True, False])
def test_pulses_per_second_make_a_rough_offset_sharp(
    make_stream: Any, read: Callable[..., Reading], known: bool
) -> None:
    late = 0.217
    utc_ns = (GPS_2026 + GPS_ZERO - LEAPS) * 10**9
    columns = {"pps": lambda t: pulsed(t, np.arange(SECONDS) + late)}
    about = {"epoch": Epoch.UTC, "origin_ns": utc_ns} if known else {}
    clock = '[[clocks]]\nfile = "gps"\nalign = "gnss"\nbase_pps = "pps"\n'
    clock += "" if known else "offset_s = 2.4\n"
    reading = read(
        GNSS + clock + FORCE + HGT,
        adc(make_stream, columns=columns, **about),
        gps=gps(make_stream, GPS_2026 * 1000 + 2500),
    )
    # The receiver's own zero is the whole second before its first row.
    expected = 2.5 + late if known else 2.0 + late + 0.5
    assert times_of(reading, "gnss_height")[0] == pytest.approx(expected, abs=2e-3)
    lines = [line for line in reading.told if "from where the absolute times" in line]
    assert len(lines) == known
    assert all(line.startswith("clock of gps, BESTPOS: the pulses put it +0.21") for line in lines)


@pytest.mark.parametrize(
    ("chart", "said"),
    [
        (
            GNSS + FORCE + HGT,
            "clock of gps, BESTPOS: nothing aligns its gps time with the local",
        ),
        (
            '[[clocks]]\nalign = "offset"\n' + FORCE,
            "clock of the source, adc: is the clock of the accelerometer",
        ),
        (
            GNSS + '[[clocks]]\nfile = "gps"\nalign = "gnss"\n' + FORCE + HGT,
            "nothing aligns its gps time",
        ),
        (
            GNSS + '[[clocks]]\nfile = "gps"\nalign = "gnss"\nbase_pps = "force"\n' + FORCE + HGT,
            "clock of gps, BESTPOS",
        ),
        (
            GNSS + '[[clocks]]\nfile = "gps"\nalign = "gnss"\nbase_pps = "pps"\n' + FORCE + HGT,
            "'pps' is not in the file",
        ),
    ],
)
def test_what_aligns_nothing_is_said(
    make_stream: Any, read: Callable[..., Reading], chart: str, said: str
) -> None:
    with pytest.raises(InputError) as caught:
        read(chart, adc(make_stream), gps=gps(make_stream, GPS_2026 * 1000))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
