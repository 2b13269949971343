"""The draft of any native file is a map that can be read, and maps what it says."""

import tomllib
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping import read_map
from floatref.mapping.channel_map.column_names import find
from floatref.mapping.channel_map.conversion import Conversion
from floatref.mapping.clocks.columns import UNKNOWN
from floatref.mapping.draft.drafting import draft_map
from floatref.values.native import Column, Epoch, NativeClock, NativeFile, Stream

NASTY = [*"\"'\\\n\r\t\0\x1b\x7f\x85\u2028\udc80#]./\ufeff\u202e\U0001f600é", "'''", '"""', "a.b"]
NAMES = ["Acc_Z_left", "Laser LWP", "DMI", "GGA", "altitude", "left.height", "distance", "speed"]
NAMES += ["gyro x", "lat", "a/b.height", "height", "Encoder"]
UNITS = ["", "g", "mm", "m", "km/h", "deg", "deg/s", "counts", "V", " mm ", "[g]"]
parts = st.one_of(st.sampled_from(NASTY), st.sampled_from(NAMES), st.text(max_size=3))
names = st.one_of(
    st.sampled_from(NAMES),
    st.lists(parts, max_size=4).map("".join),
    st.integers(30, 300).map(lambda n: "a." * n + "height"),
    st.integers(30, 300).map(lambda n: n * "x" + "Laser"),
)
columns = st.builds(
    Column,
    name=names,
    unit=st.one_of(st.sampled_from(UNITS), st.lists(parts, max_size=3).map("".join)),
    note=st.lists(parts, max_size=3).map("".join),
    numeric=st.sampled_from([True, True, True, False]),
)
clocks = st.sampled_from(
    [
        NativeClock(),
        NativeClock(name=UNKNOWN),
        NativeClock(rate=Fraction(100), name="b"),
        NativeClock(epoch=Epoch.GPS, name="gps"),
    ]
)


def stream_of(name: str, *columns: Column, clock: NativeClock | None = None) -> Stream:
    return Stream(name, columns, 3, clock or NativeClock(), lambda names: iter(()))


@st.composite
def natives(draw: st.DrawFn) -> NativeFile:
    named = draw(st.lists(names, max_size=3, unique=True))
    held = st.lists(columns, max_size=6, unique_by=lambda column: column.name)
    return NativeFile(tuple(stream_of(n, *draw(held), clock=draw(clocks)) for n in named))


def holds(text: str) -> bool:
    return len(text) <= 256 and not any("\ud800" <= c <= "\udfff" for c in text)


@pytest.mark.slow
@settings(deadline=None, max_examples=300)
@given(native=natives(), source=names, adapter=names.filter(holds))
def test_the_draft_of_any_file_is_toml_and_what_is_active_in_it_maps(
    native: NativeFile, source: str, adapter: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    text = draft_map(native, Path(source.replace("/", "") or "x"), adapter, "can.dbc")
    assert all(line.isprintable() for line in text.split("\n"))
    text = text.replace("\nrate_hz = 0 ", "\nrate_hz = 5 ")
    document = tomllib.loads(text)
    assert document["source"] == {"adapter": adapter, "dbc": "can.dbc"}
    if "channels" not in document:
        return
    path = tmp_path_factory.mktemp("draft") / "map.toml"
    path.write_bytes(text.encode())
    chart = read_map(path)
    stated = {clock.stream for clock in chart.clocks if clock.rate}
    for entry in chart.channels:
        stream, column = find(native, entry.native)
        assert Conversion(entry, column)(np.ones(2), np.arange(2.0)).shape == (2,)
        assert stream.clock.name != UNKNOWN or stream.name in stated


def drafted(*columns: Column) -> str:
    return draft_map(NativeFile((stream_of("adc", *columns),)), Path("run.log"), "logger")


def test_what_is_sure_is_active_and_the_rest_is_there_to_be_completed() -> None:
    text = drafted(
        *(Column("Acc_Z_left", "g"), Column("Acc left 2", "g"), Column("Laser L")),
        *(Column("Temp", "degC", "not used"), Column("Encoder", "counts"), Column("DMI", "m")),
    )
    active = tomllib.loads(text)["channels"]
    assert [entry["native"] for entry in active] == ["adc/Acc_Z_left", "adc/DMI"]
    assert active[0] == {
        "native": "adc/Acc_Z_left",
        "channel": "vertical_specific_force",
        "track": "left",
        "unit": "g",
    }
    for line in (
        *('# native = "adc/Acc left 2"', '# native = "adc/Laser L"', '# native = "adc/Encoder"'),
        "# not mapped: adc/Temp, in degC (not used)",
        '# unit = "m"  # not given by the file: check it',
    ):
        assert line in text.splitlines()


def test_a_pitch_that_its_note_has_nose_up_is_turned(tmp_path: Path) -> None:
    up = Column("pitch", "deg", note="nose up positive")
    for column, sign in ((up, -1), (Column("pitch", "deg"), 1)):
        native = NativeFile((stream_of("INSPVA", column),))
        (tmp_path / "map.toml").write_text(draft_map(native, Path("run.gps"), "x"))
        (entry,) = read_map(tmp_path / "map.toml").channels
        assert (entry.channel, entry.sign) == ("gnss_pitch", sign)


def test_an_entry_that_stands_as_a_comment_is_toml_too() -> None:
    lines = drafted(Column("Laser L"), Column("Laser R", "volts"), Column("Acc z")).splitlines()
    at = lines.index("# [[channels]]")
    opened = tomllib.loads("\n".join(line.removeprefix("# ") for line in lines[at:]))["channels"]
    assert [(e["channel"], e.get("track"), e["unit"]) for e in opened] == [
        ("height", "left", "m"),
        ("height", "right", "volts"),
        ("vertical_specific_force", None, "m/s^2"),
    ]


def test_a_map_that_is_still_all_comments_is_called_that(tmp_path: Path) -> None:
    (tmp_path / "map.toml").write_text(drafted(Column("Laser L"), Column("Acc z")))
    with pytest.raises(InputError, match=r"map\.toml: its channels, 2, are all comments.* the # "):
        read_map(tmp_path / "map.toml")
    (tmp_path / "map.toml").write_text('format = "floatref-map/1"\n')
    with pytest.raises(InputError, match="has no channels"):
        read_map(tmp_path / "map.toml")


@pytest.mark.parametrize(("column", "mark"), [("Laser", ""), ("spare", "# ")])
def test_a_stream_without_time_asks_for_its_rate_where_it_is_used(column: str, mark: str) -> None:
    stream = stream_of("a", Column(column, "mm"), clock=NativeClock(name=UNKNOWN))
    lines = draft_map(NativeFile((stream,)), Path("x"), "logger").splitlines()
    assert f'{mark}stream = "a"' in lines
    assert any(line.startswith(f"{mark}rate_hz = 0") for line in lines)


def test_of_very_many_channels_as_many_are_active_as_a_map_may_have(tmp_path: Path) -> None:
    text = drafted(*(Column(f"t{n}.height") for n in range(400)))
    (tmp_path / "map.toml").write_text(text, "utf-8")
    assert len(read_map(tmp_path / "map.toml").channels) == 256


def test_rows_are_not_read_for_a_draft() -> None:
    def read(names):
        raise AssertionError

    stream = Stream("s", (Column("Laser", "mm"),), 3, NativeClock(), read)
    assert 'channel = "height"' in draft_map(NativeFile((stream,)), Path("x"), "logger")


@pytest.mark.parametrize(
    ("streams", "clock", "hinted"),
    [
        (1, NativeClock(Fraction(100)), False),
        (2, NativeClock(Fraction(100)), True),
        (2, NativeClock(Fraction(100), first_tick=3), False),
        (2, NativeClock(), False),
    ],
)
def test_streams_that_nothing_says_to_begin_together_get_a_word_on_clocks(
    streams: int, clock: NativeClock, hinted: bool
) -> None:
    held = [stream_of(f"s{k}", Column("x"), clock=clock) for k in range(streams)]
    text = draft_map(NativeFile(tuple(held)), Path("x"), "tdms")
    assert ("counted from zero" in text) is ("# [[clocks]]" in text) is hinted


def gga(*names: str) -> NativeFile:
    """Return what a receiver's log of heights holds."""
    columns = tuple(Column(name, "m") for name in names)
    return NativeFile((Stream("GGA", columns, 2, NativeClock(), lambda _: iter(())),))


def test_the_height_over_the_ellipsoid_goes_before_that_over_a_geoid(tmp_path: Path) -> None:
    for names in (("altitude", "ellipsoidal_height"), ("altitude",)):
        lines = draft_map(gga(*names), tmp_path / "a.nmea", "nmea").splitlines()
        active = [line for line in lines if line.startswith("native")]
        assert active == [f'native = "GGA/{names[-1]}"']


def test_counts_ask_for_their_scale() -> None:
    native = NativeFile((stream_of("adc", Column("DMI", "counts")),))
    text = draft_map(native, Path("x"), "mdf4")
    entry = '# channel = "distance"\n# scale = 0  # m per count: state it; and wrap'
    assert entry in text
    assert '# unit = "m"' in text


@pytest.mark.parametrize("speed", ["VehicleSpeed", "WheelSpd_RL", "spd"])
def test_a_length_goes_before_a_speed_that_stands_before_it(speed: str) -> None:
    odometer, wheel = Column("DMI", "m"), Column(speed, "km/h")
    for held, active in (((wheel, odometer), "DMI"), ((wheel,), speed)):
        text = draft_map(NativeFile((stream_of("adc", *held),)), Path("x"), "mdf4")
        (entry,) = tomllib.loads(text)["channels"]
        assert entry["native"] == f"adc/{active}"
