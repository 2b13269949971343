"""A native file and its map give the recording that was measured."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from floatref.mapping import read_native
from floatref.mapping.channel_map.entries import ChannelEntry, ChannelMap, ClockEntry
from floatref.values.clock import UniformClock

Put = Callable[..., Path]


def test_names_that_are_ours_need_no_map(put: Put, make_stream, a_drive) -> None:
    run = a_drive()
    reading = read_native(put(make_stream("", run, rate=Fraction(1000))))
    recording = reading.recording
    assert reading.warnings == ()
    for name, values in run.items():
        np.testing.assert_array_equal(recording.channel(name).values, values)
        assert recording.channel(name).clock == UniformClock(Fraction(1000), 0.0)


MAP = """
format = "floatref-map/1"
[[channels]]
native = "adc/ch1"
channel = "specific_force"
axis = "-z"
track = "left"
unit = "g"
scale = 2.0
offset = 0.25
delay_s = 0.002
[[channels]]
native = "laser"
channel = "height"
track = "left"
unit = "mm"
missing = [-1]
[[channels]]
native = "wheel"
channel = "distance"
unit = "m"
scale = 0.01
wrap = 100
"""


def test_a_map_says_unit_scale_offset_axis_delay_and_wrap(
    put: Put, make_stream, a_drive, tmp_path: Path
) -> None:
    run = a_drive()
    laser = 1000.0 * run["height"]
    laser[17] = -1.0
    counts = np.floor(100.0 * run["distance"])
    native = {
        "ch1": -(run["vertical_specific_force"] / 9.80665 + 0.25) / 2.0,
        "laser": laser,
        "wheel": np.mod(counts, 100),
    }
    # SI = sign * unit * (scale * native + offset)
    source = put(make_stream("adc", native, rate=Fraction(1000)))
    chart = tmp_path / "map.toml"
    chart.write_text(MAP)
    recording = read_native(source, chart).recording
    force = recording.channel("vertical_specific_force", "left")
    np.testing.assert_allclose(force.values, -9.80665 * (2.0 * native["ch1"] + 0.25), rtol=1e-14)
    assert force.clock == UniformClock(Fraction(1000), -0.002)
    height = recording.channel("height", "left").values
    assert np.isnan(height[17])
    np.testing.assert_allclose(np.delete(height, 17), np.delete(run["height"], 17), rtol=1e-14)
    np.testing.assert_allclose(recording.channel("distance").values, 0.01 * counts, rtol=1e-14)


@pytest.mark.parametrize("stated", ["", "sparse = true\n"])
def test_rows_between_the_samples_of_a_slower_channel_are_none(
    put: Put, make_stream, a_drive, tmp_path: Path, stated: str
) -> None:
    # A table with a row for every sample of the fastest channel has empty fields elsewhere.
    run = a_drive()
    slow = np.full(run["height"].size, np.nan)
    slow[3::10] = np.arange(slow[3::10].size)
    name = "pitch_rate" if stated else "gnss_height"
    unit = "rad/s" if stated else "m"
    source = put(make_stream("", {**run, "slow": 1e-3 * slow}, rate=Fraction(1000)))
    entries = [(n, n, "") for n in run] + [("slow", name, stated)]
    chart = tmp_path / "map.toml"
    units = {"vertical_specific_force": "m/s^2", name: unit}
    chart.write_text(
        'format = "floatref-map/1"\n'
        + "".join(
            f'[[channels]]\nnative = "{native}"\nchannel = "{channel}"\n'
            f'unit = "{units.get(channel, "m")}"\n{more}'
            for native, channel, more in entries
        )
    )
    channel = read_native(source, chart).recording.channel(name)
    np.testing.assert_array_equal(channel.values, 1e-3 * np.arange(channel.values.size))
    assert channel.clock == UniformClock(Fraction(100), 0.003)


@pytest.mark.parametrize("place", ["unsprung", "rear_unsprung", "sprung", "equipment"])
def test_without_a_profiler_the_clock_of_an_accelerometer_of_the_vehicle_is_the_base(
    put: Put, make_stream, place: str
) -> None:
    slow = make_stream("can", {"distance": np.arange(50.0)}, rate=Fraction(10), name="can")
    name = f"{place}_specific_force"
    fast = make_stream("adc", {name: 9.8 + 0.1 * np.sin(np.arange(500.0))}, rate=Fraction(100))
    offset = ClockEntry(stream="can", align="offset", offset_s=0.25)
    entries = (
        ChannelEntry("distance", "distance", unit="m"),
        ChannelEntry(name, name, unit="m/s^2"),
    )
    chart = ChannelMap(entries, clocks=(offset,))
    found = read_native(put(slow, fast), chart).recording
    assert found.channel("distance").times_s[0] == 0.25
    assert found.channel(name).times_s[0] == 0.0
