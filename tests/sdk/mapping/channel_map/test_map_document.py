"""A channel map is read as it is meant, and whatever is in it, in one line or not at all."""

from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping import read_map
from floatref.mapping.channel_map.entries import ChannelEntry, ClockEntry
from floatref.values.recording import AxleSetup, TrackSetup, VehicleSetup

HEAD = 'format = "floatref-map/1"\n'
LASER = '[[channels]]\nnative = "laser"\nchannel = "height"\n'

Save = Callable[[str | bytes], Path]
Refusal = Callable[[Path], str]


FULL = """
[source]
adapter = "mdf"
dbc = "can/bus.dbc"
options = { group = "3" }
[[files]]
name = "gps"
path = "sub/../gps.log"
adapter = "novatel"
dbc = "bus.dbc"
[device]
vendor = "Acme"
model = "P1"
[setup]
profile_interval_m = 0.025
gnss_antenna_offset_m = [0, 0.5, 2]
tracks.left = { reference_point_m = [1, 2, 3], laser_offset_m = [0.0, 0.1, 0.2] }
axles = { wheelbase_m = 3, front_axle_m = -1.5 }
[setup.vehicle]
model = "quarter-car"
x_m = 1.75
parameters = { sprung_kg = 700, tyre_n_per_m = 3.2e5 }
[[clocks]]
file = "gps"
align = "gnss"
base_pps = "adc/pps"
offset_s = -0.5
[[clocks]]
stream = "can"
align = "offset"
offset_s = 1
drift_ppm = 3.5
[[clocks]]
stream = "dmi"
rate_hz = "48000/7"
start_s = 2.5
[[channels]]
native = "adc/ch1"
channel = "specific_force"
axis = "-z"
track = "left"
unit = "g"
scale = 2
offset = 0.25
sign = -1
delay_s = 0.002
wrap = 65536
missing = [-1, 65535.0]
sparse = true
[[channels]]
file = "gps"
native = "height"
channel = "gnss_height"
"""


def test_everything_that_a_map_can_say(save: Save) -> None:
    path = save(HEAD + FULL)
    chart = read_map(path)
    folder = path.parent.resolve()
    assert chart.channels == (
        ChannelEntry(
            *("adc/ch1", "vertical_specific_force", "", "left", "g"),
            *(2, 0.25, 1, 0.002, 65536, (-1.0, 65535.0), True),
        ),
        ChannelEntry("height", "gnss_height", "gps"),
    )
    assert chart.clocks == (
        ClockEntry("gps", align="gnss", base_pps="adc/pps", offset_s=-0.5),
        ClockEntry(stream="can", align="offset", offset_s=1, drift_ppm=3.5),
        ClockEntry(stream="dmi", rate=Fraction(48000, 7), start_s=2.5),
    )
    assert chart.source.adapter == "mdf"
    assert chart.source.options == {"group": "3", "dbc": str(folder / "can" / "bus.dbc")}
    assert list(chart.files) == ["gps"]
    assert chart.files["gps"].path == folder / "gps.log"
    assert chart.files["gps"].options == {"dbc": str(folder / "bus.dbc")}
    assert (chart.vendor, chart.model, chart.place) == ("Acme", "P1", path)
    assert chart.setup.profile_interval_m == 0.025
    assert chart.setup.gnss_antenna_offset_m == (0.0, 0.5, 2.0)
    assert chart.setup.tracks == {"left": TrackSetup((1.0, 2.0, 3.0), (0.0, 0.1, 0.2))}
    assert chart.setup.axles == AxleSetup(3.0, -1.5)
    parameters = {"sprung_kg": 700.0, "tyre_n_per_m": 320_000.0}
    assert chart.setup.vehicle == VehicleSetup("quarter-car", parameters, 1.75)


def test_what_is_not_said_is_left_alone(save: Save) -> None:
    chart = read_map(save(HEAD + LASER))
    assert chart.channels == (ChannelEntry("laser", "height"),)
    entry = chart.channels[0]
    assert (entry.scale, entry.offset, entry.sign, entry.delay_s) == (1.0, 0.0, 1, 0.0)
    assert (entry.unit, entry.wrap, entry.missing, entry.sparse) == (None, None, (), None)
    assert chart.clocks == ()


@pytest.mark.parametrize("ends", ["\n", "\r\n"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_line_ends_and_a_byte_order_mark_mean_nothing(save: Save, ends: str, mark: bytes) -> None:
    chart = read_map(save(mark + (HEAD + LASER).replace("\n", ends).encode()))
    assert chart.channels == (ChannelEntry("laser", "height"),)


@pytest.mark.slow
@settings(deadline=None, max_examples=150)
@given(data=st.data())
def test_whatever_is_in_a_map_it_is_read_or_refused_in_one_line(
    refusal: Refusal, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    whole = HEAD + FULL
    at = data.draw(st.integers(0, len(whole)))
    end = data.draw(st.integers(at, min(at + 40, len(whole))))
    odd = st.sampled_from(['"', "'", "\\", "[", "{", "=", "nan", "-", "\n", "\u2028", "\0", "[["])
    put = data.draw(st.one_of(st.just(""), st.text(max_size=8), odd))
    path = tmp_path_factory.mktemp("map") / "map.toml"
    path.write_bytes((whole[:at] + put + whole[end:]).encode("utf-8", "surrogatepass"))
    with suppress(InputError):
        read_map(path)
        return
    assert refusal(path)
