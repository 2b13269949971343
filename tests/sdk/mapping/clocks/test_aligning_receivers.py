"""A receiver comes onto the time base of the accelerometer by absolute times and by pulses."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.mapping import Reading
from floatref.values.native import Epoch

SECONDS = 60
FORCE = '[[channels]]\nnative = "force"\nchannel = "vertical_specific_force"\nunit = "m/s^2"\n'
GNSS = '[[files]]\nname = "gps"\npath = "gps.log"\n'
HGT = '[[channels]]\nfile = "gps"\nnative = "hgt"\nchannel = "gnss_height"\nunit = "m"\n'


def times_of(reading: Reading, name: str) -> np.ndarray:
    return reading.recording.channel(name).times_s


def test_what_aligned_a_clock_names_it(
    make_stream: Any, adc: Any, read: Callable[..., Reading]
) -> None:
    utc = {"epoch": Epoch.UTC, "origin_ns": 20_000 * 86_400 * 10**9}
    rows = make_stream("GGA", {"hgt": [5.0] * 20}, rate=Fraction(20), name="NMEA", **utc)
    reading = read(GNSS + FORCE + HGT, adc(**utc), gps=rows)
    (line,) = reading.warnings
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
    make_stream: Any, adc: Any, read: Callable[..., Reading]
) -> None:
    utc_ns = (GPS_2026 + GPS_ZERO - LEAPS) * 10**9
    source = adc(epoch=Epoch.UTC, origin_ns=utc_ns)
    reading = read(GNSS + FORCE + HGT, source, gps=gps(make_stream, GPS_2026 * 1000 + 2500))
    assert times_of(reading, "gnss_height")[0] == pytest.approx(2.5, abs=1e-9)
    assert any("18 leap seconds" in line for line in reading.warnings)


def test_the_time_of_day_is_of_the_nearest_day(
    make_stream: Any, adc: Any, read: Callable[..., Reading]
) -> None:
    midnight = 20_000 * 86_400
    source = adc(epoch=Epoch.UTC, origin_ns=(midnight - 1) * 10**9)
    reading = read(GNSS + FORCE + HGT, source, gps=gps(make_stream, 2500, epoch=Epoch.DAY))
    assert times_of(reading, "gnss_height")[0] == pytest.approx(3.5, abs=1e-9)


def test_gnss_time_that_the_base_recorded_aligns_the_receiver(
    make_stream: Any, adc: Any, read: Callable[..., Reading]
) -> None:
    week = GPS_2026 % 604_800
    columns = {"gpstime": lambda t: week + np.floor((t + 0.4) * 20) / 20}
    clock = '[[clocks]]\nfile = "gps"\nalign = "gnss"\nbase_time = "gpstime"\n'
    reading = read(
        GNSS + clock + FORCE + HGT,
        adc(columns=columns),
        gps=gps(make_stream, GPS_2026 * 1000 + 2500),
    )
    assert times_of(reading, "gnss_height")[0] == pytest.approx(2.1, abs=4e-3)


@pytest.mark.parametrize("known", [True, False])
def test_pulses_per_second_make_a_rough_offset_sharp(
    make_stream: Any, adc: Any, pulsed: Any, read: Callable[..., Reading], known: bool
) -> None:
    late = 0.217
    utc_ns = (GPS_2026 + GPS_ZERO - LEAPS) * 10**9
    columns = {"pps": lambda t: pulsed(t, np.arange(SECONDS) + late)}
    about = {"epoch": Epoch.UTC, "origin_ns": utc_ns} if known else {}
    clock = '[[clocks]]\nfile = "gps"\nalign = "gnss"\nbase_pps = "pps"\n'
    clock += "" if known else "offset_s = 2.4\n"
    reading = read(
        GNSS + clock + FORCE + HGT,
        adc(columns=columns, **about),
        gps=gps(make_stream, GPS_2026 * 1000 + 2500),
    )
    # The receiver's own zero is the whole second before its first row.
    expected = 2.5 + late if known else 2.0 + late + 0.5
    assert times_of(reading, "gnss_height")[0] == pytest.approx(expected, abs=2e-3)
    lines = [line for line in reading.warnings if "from where the absolute times" in line]
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
    make_stream: Any, adc: Any, read: Callable[..., Reading], chart: str, said: str
) -> None:
    with pytest.raises(InputError) as caught:
        read(chart, adc(), gps=gps(make_stream, GPS_2026 * 1000))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
