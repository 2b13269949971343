"""TDMS: what is written comes back on its own clock; what is damaged is refused in one line."""

import contextlib
import random
import struct
import sys
from collections.abc import Callable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from floatref import (
    Channel,
    Epoch,
    InputError,
    NativeFile,
    Recording,
    StampedClock,
    Stream,
    UniformClock,
)
from floatref.architectures.plugins import plugins
from floatref_adapters.tdms.adapter import Tdms
from floatref_adapters.testing.tdms import write_tdms

samples = st.none() | st.floats(-1e6, 1e6)
names = st.sampled_from(["height", "vertical_specific_force", "distance"])
tracks = st.text("aß中 .'/#2", min_size=1, max_size=4)
rates = st.builds(Fraction, st.integers(1, 50_000), st.integers(1, 40))
META, NEW, RAW, INTERLEAVED, BIG = 2, 4, 8, 32, 64
DOUBLE, STAMP = 10, 0x44


@st.composite
def recordings(draw: st.DrawFn, values: st.SearchStrategy[float | None] = samples) -> Recording:
    """Draw channels of several clocks, uniform and stamped, some on one clock."""
    channels = []
    for track in draw(st.lists(tracks, unique=True, min_size=1, max_size=3)):
        count = draw(st.integers(1, 9))
        clock: UniformClock | StampedClock
        clock = UniformClock(draw(rates), draw(st.floats(-1e6, 1e6)))
        if draw(st.booleans()):
            steps = draw(st.lists(st.floats(1e-3, 10), min_size=count, max_size=count))
            clock = StampedClock.of(np.cumsum(steps))
        for name in draw(st.sets(names, min_size=1)):
            drawn = draw(st.lists(values, min_size=count, max_size=count))
            channels.append(Channel.of(name, np.array(drawn, float), clock, track))
    return Recording(tuple(channels))


def whole(stream: Stream) -> tuple[dict[str, NDArray[np.float64]], NDArray[Any] | None]:
    """Return all numbers of ``stream`` by column, and its ticks."""
    numeric = [column.name for column in stream.columns if column.numeric]
    pieces = list(stream.read(numeric))
    values = {n: np.concatenate([p.values[n] for p in pieces] or [np.empty(0)]) for n in numeric}
    ticks = [piece.ticks for piece in pieces if piece.ticks is not None]
    return values, np.concatenate(ticks) if ticks else None


def read(path: Path) -> tuple[NativeFile, list[tuple[dict[str, Any], Any]]]:
    """Return what ``path`` holds, and the numbers and ticks of every stream."""
    with Tdms().streams(path, {}) as native:
        return native, [whole(stream) for stream in native.streams]


def check_round_trip(recording: Recording, path: Path, within: Callable[[Channel], float]) -> None:
    """Assert that ``path`` holds ``recording``, each value ``within`` so much."""
    native, numbers = read(path)
    pairs = list(zip(native.streams, numbers, strict=True))
    found = {column.name: (s, column, n) for s, n in pairs for column in s.columns}
    assert sum(len(s.columns) for s in native.streams) == len(recording.channels)
    for channel in recording.channels:
        stream, column, (values, ticks) = found[str(channel.id)]
        assert column.unit == channel.unit
        np.testing.assert_allclose(
            values[column.name], channel.values, rtol=0, atol=within(channel)
        )
        if isinstance(channel.clock, StampedClock):
            assert stream.clock.rate is None
            np.testing.assert_array_equal(ticks, channel.clock.times_s)
        else:
            assert stream.clock.rate == channel.clock.rate
            assert float(stream.clock.first_tick * stream.clock.tick_s) == channel.clock.start_s


@settings(deadline=None, max_examples=40)
@given(recording=recordings())
def test_a_recording_comes_back_to_the_last_bit(
    tmp_path_factory: pytest.TempPathFactory, recording: Recording
) -> None:
    path = tmp_path_factory.mktemp("tdms") / "run.dat"
    write_tdms(recording, path)
    assert Tdms().recognises(path)
    check_round_trip(recording, path, lambda _: 0.0)


@settings(deadline=None, max_examples=25)
@given(recording=recordings(st.floats(-1e6, 1e6)), quantum=st.sampled_from([1e-6, 0.01, 0.3]))
def test_integers_are_within_half_a_quantum(
    tmp_path_factory: pytest.TempPathFactory, recording: Recording, quantum: float
) -> None:
    path = tmp_path_factory.mktemp("tdms") / "run.tdms"
    write_tdms(recording, path, {"height": quantum})
    stored = {"height": quantum / 2 + 4 * np.spacing(1e6)}
    check_round_trip(recording, path, lambda channel: stored.get(channel.id.name, 0.0))


def test_missing_samples_are_not_written_as_integers(tmp_path: Path) -> None:
    channel = Channel.of("height", np.array([1.0, np.nan]), UniformClock.of(10.0))
    with pytest.raises(ValueError, match="missing samples cannot be stored in integers"):
        write_tdms(Recording((channel,)), tmp_path / "a.tdms", {"height": 0.001})


def text(value: str) -> bytes:
    encoded = value.encode()
    return struct.pack("<I", len(encoded)) + encoded


Properties = dict[str, float | int | str | tuple[int, int]]


def stored(properties: Properties) -> bytes:
    """Return the count of ``properties`` and each with its type; a pair is a time stamp."""
    out = struct.pack("<I", len(properties))
    for name, value in properties.items():
        out += text(name)
        if isinstance(value, str):
            out += struct.pack("<I", 0x20) + text(value)
        elif isinstance(value, tuple):
            out += struct.pack("<IQq", STAMP, value[1], value[0])
        else:
            code, layout = (DOUBLE, "d") if isinstance(value, float) else (3, "i")
            out += struct.pack(f"<I{layout}", code, value)
    return out


def described(name: str, kind: int, count: int, properties: Properties) -> bytes:
    """Return the metadata of channel ``name`` of group `g`, of ``count`` values a chunk."""
    path = text(f"/'g'/'{name}'")
    return path + struct.pack("<IIIQ", 20, kind, 1, count) + stored(properties)


def segment(flags: int, metadata: bytes, raw: bytes) -> bytes:
    """Return a segment with its lead-in."""
    lengths = len(metadata) + len(raw), len(metadata)
    order = ">" if flags & BIG else "<"
    head = struct.pack("<4si", b"TDSm", flags) + struct.pack(f"{order}iQQ", 4713, *lengths)
    return head + metadata + raw


def laid(columns: Sequence[NDArray[Any]], chunk: int, interleaved: bool) -> bytes:
    """Return the bytes of ``columns`` of float64 in chunks of so many values."""
    out = b""
    for first in range(0, len(columns[0]), chunk):
        part = np.array([column[first : first + chunk] for column in columns])
        out += (part.T if interleaved else part).tobytes()
    return out


def doubles(count: int, chunk: int, wave: Properties | None = None) -> bytes:
    """Return the metadata of ``count`` channels of float64, called `c0` and on."""
    wave = {"wf_increment": 0.001} if wave is None else wave
    channels = [described(f"c{k}", DOUBLE, chunk, wave) for k in range(count)]
    return struct.pack("<I", count) + b"".join(channels)


@settings(deadline=None, max_examples=60)
@given(
    channels=st.integers(1, 4),
    chunk=st.integers(1, 5),
    chunks=st.lists(st.integers(1, 4), min_size=2, max_size=5),
    interleaved=st.booleans(),
    repeated=st.booleans(),
    cut=st.integers(0, 60),
)
def test_values_are_found_however_they_are_laid(
    tmp_path_factory: pytest.TempPathFactory,
    channels: int,
    chunk: int,
    chunks: list[int],
    interleaved: bool,
    repeated: bool,
    cut: int,
) -> None:
    path = tmp_path_factory.mktemp("tdms") / "laid.tdms"
    rng = np.random.default_rng(chunk)
    columns = rng.normal(size=(channels, chunk * sum(chunks)))
    flags, data, first = RAW | INTERLEAVED * interleaved, b"", 0
    for number, count in enumerate(chunks):
        part = columns[:, first : first + chunk * count]
        told = not number or repeated
        metadata = doubles(channels, chunk) if told else b""
        raw = laid(part, chunk, interleaved)
        data += segment(flags | (META | NEW if told else 0), metadata, raw)
        first += chunk * count
    cut = min(cut, len(raw) - 1)
    path.write_bytes(data[: len(data) - cut])
    native, [(values, _)] = read(path)
    assert bool(cut) == any("cut off" in line for line in native.told)
    size, row = 8 * channels * chunk, 8 * channels
    complete, rest = divmod(len(raw) - cut, size)
    rows = rest // row if interleaved else max(rest - (channels - 1) * 8 * chunk, 0) // 8
    expected = columns[:, : (sum(chunks[:-1]) + complete) * chunk + rows]
    assert native.streams[0].count == expected.shape[1]
    for k in range(channels):
        np.testing.assert_array_equal(values[f"c{k}"], expected[k])


def test_high_byte_first_is_read_too(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    little = segment(META | NEW | RAW, doubles(2, 3), laid(np.arange(6.0).reshape(2, 3), 3, False))
    big = np.arange(6.0, 12).reshape(2, 3).astype(">f8").tobytes()
    path.write_bytes(little + segment(RAW | BIG, b"", big))
    _, [(values, _)] = read(path)
    np.testing.assert_array_equal(values["c0"], [0, 1, 2, 6, 7, 8])
    np.testing.assert_array_equal(values["c1"], [3, 4, 5, 9, 10, 11])


@pytest.mark.parametrize("chunk", [1000, 75_000])
def test_chunks_of_any_size_are_read_in_pieces(tmp_path: Path, chunk: int) -> None:
    path = tmp_path / "a.tdms"
    columns = np.random.default_rng(1).normal(size=(3, 150_000))
    raw = segment(META | NEW | RAW, doubles(3, chunk), laid(columns, chunk, False))
    path.write_bytes(raw)
    with Tdms().streams(path, {}) as native:
        pieces = [rows.values["c1"] for rows in native.streams[0].read(["c1"])]
    assert max(map(len, pieces)) <= 65_536
    np.testing.assert_array_equal(np.concatenate(pieces), columns[1])


UNIX_S = 2_082_844_800


def test_a_waveform_gives_the_rate_the_start_and_the_offset(tmp_path: Path) -> None:
    wave: Properties = {
        "wf_increment": 6.25e-05,
        "wf_start_offset": 0.25,
        "wf_start_time": (UNIX_S + 1_700_000_000, 1 << 63),
    }
    (tmp_path / "a.tdms").write_bytes(segment(META | NEW | RAW, doubles(1, 2, wave), bytes(16)))
    native, _ = read(tmp_path / "a.tdms")
    clock = native.streams[0].clock
    assert clock.rate == 16_000
    assert clock.first_tick * clock.tick_s == Fraction(1, 4)
    assert (clock.epoch, clock.origin_ns) == (Epoch.UTC, 1_700_000_000_500_000_000)


def test_the_zero_of_labview_is_no_start_and_a_spectrum_has_no_time(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    wave: Properties = {"wf_increment": 0.5, "wf_start_time": (0, 0)}
    path.write_bytes(segment(META | NEW | RAW, doubles(1, 2, wave), bytes(16)))
    assert read(path)[0].streams[0].clock.epoch is Epoch.LOCAL
    wave = {"wf_increment": 0.5, "wf_xunit_string": "Hz"}
    path.write_bytes(segment(META | NEW | RAW, doubles(1, 2, wave), bytes(16)))
    assert read(path)[0].streams[0].clock.name == "unknown"


def waves(parts: Sequence[tuple[int, Properties]]) -> bytes:
    """Return a segment of one channel for each of ``parts``: so many values, its properties."""
    return b"".join(
        segment(META | NEW | RAW, doubles(1, count, wave), bytes(8 * count))
        for count, wave in parts
    )


def starting(ns: int, step_s: float) -> Properties:
    """Return a waveform that begins so many ns after 1.7e9 s since 1970."""
    seconds, rest = divmod(ns, 10**9)
    start = (UNIX_S + 1_700_000_000 + seconds, (rest << 64) // 10**9)
    return {"wf_increment": step_s, "wf_start_time": start}


@settings(deadline=None, max_examples=60)
@given(
    parts=st.lists(
        st.tuples(st.integers(1, 5), st.integers(1, 10**6), st.integers(0, 10**10)),
        min_size=2,
        max_size=5,
    )
)
def test_every_row_has_the_time_of_its_own_waveform(
    tmp_path_factory: pytest.TempPathFactory, parts: list[tuple[int, int, int]]
) -> None:
    """Each is some values, a step of so many us, and a pause of so many ns before it."""
    now, expected, written = 0, [], []
    for count, step_us, pause_ns in parts:
        now += pause_ns
        written.append((count, starting(now, step_us / 1e6)))
        expected += [now + k * step_us * 1000 for k in range(count)]
        now += count * step_us * 1000
    path = tmp_path_factory.mktemp("tdms") / "a.tdms"
    path.write_bytes(waves(written))
    native, [(values, ticks)] = read(path)
    clock = native.streams[0].clock
    if ticks is None:
        assert clock.rate is not None
        ticks = np.array([round(k / clock.rate * 10**9) for k in range(len(values["c0"]))])
    within = max(step for _, step, _ in parts) * 500 + 1
    assert np.abs(ticks + clock.origin_ns - 1_700_000_000 * 10**9 - expected).max() <= within
    alone = [rows.ticks for rows in native.streams[0].read([])]
    assert sum(len(part) for part in alone) == (len(expected) if clock.rate is None else 0)


def test_a_start_that_is_stated_again_as_recording_goes_on_is_no_new_waveform(
    tmp_path: Path,
) -> None:
    path = tmp_path / "a.tdms"
    path.write_bytes(waves([(4, starting(k * 4_000_000, 0.001)) for k in range(5)]))
    native, [(values, ticks)] = read(path)
    clock = native.streams[0].clock
    assert (clock.rate, clock.origin_ns, ticks) == (1000, 1_700_000_000 * 10**9, None)
    assert (len(values["c0"]), native.told) == (20, ())


def test_a_pause_between_waveforms_is_kept_and_told(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    path.write_bytes(waves([(2, starting(0, 0.001)), (2, starting(10**9, 0.001))]))
    native, [(_, ticks)] = read(path)
    assert ticks.tolist() == [0, 1_000_000, 1_000_000_000, 1_001_000_000]
    assert native.told == ("g: 2 waveforms one after the other",)
    path.write_bytes(waves([(2, {"wf_increment": 0.5}), (2, {"wf_increment": 0.25})]))
    assert read(path)[1][0][1].tolist() == [0, 500_000_000, 1_000_000_000, 1_250_000_000]
    path.write_bytes(waves([(2, {"wf_increment": 0.5}), (2, {"wf_increment": 0.0})]))
    assert read(path)[0].streams[0].clock.name == "unknown"


def test_time_stamps_are_whole_ns(tmp_path: Path) -> None:
    ns = np.array([1_700_000_000_123_456_789, 1_700_000_001_999_999_999])
    seconds, rest = ns // 10**9 + UNIX_S, ns % 10**9
    raw = b"".join(
        struct.pack("<Qq", (int(r) << 64) // 10**9, int(s))
        for s, r in zip(seconds, rest, strict=True)
    )
    channels = described("when", STAMP, 2, {}) + described("x", DOUBLE, 2, {})
    metadata = struct.pack("<I", 2) + channels
    path = tmp_path / "a.tdms"
    path.write_bytes(segment(META | NEW | RAW, metadata, raw + np.arange(2.0).tobytes()))
    native, [(values, ticks)] = read(path)
    stream = native.streams[0]
    assert [column.name for column in stream.columns] == ["x"]
    assert (stream.clock.tick_s, stream.clock.epoch) == (Fraction(1, 10**9), Epoch.UTC)
    assert ticks.dtype == np.int64
    np.testing.assert_array_equal(ticks, ns)
    np.testing.assert_array_equal(values["x"], [0, 1])


@pytest.mark.parametrize(
    ("name", "unit", "tick_s"),
    [
        ("time", "s", Fraction(1)),
        ("Timestamp", "ms", Fraction(1, 1000)),
        ("time_us", "", Fraction(1, 10**6)),
        ("t", "", Fraction(1)),
        ("Zeit", "s", Fraction(1)),
        ("Time [ms]", "", Fraction(1, 1000)),
        ("Temp", "s", None),
        ("time", "m", None),
    ],
)
def test_a_column_that_is_called_so_and_has_a_unit_of_time_is_the_clock(
    tmp_path: Path, name: str, unit: str, tick_s: Fraction | None
) -> None:
    unit_of: Properties = {"unit_string": unit} if unit else {}
    channels = described("x", DOUBLE, 2, {}) + described(name, DOUBLE, 2, unit_of)
    raw = np.array([5.0, 6.0, 0.5, 1.5]).tobytes()
    path = tmp_path / "a.tdms"
    path.write_bytes(segment(META | NEW | RAW, struct.pack("<I", 2) + channels, raw))
    native, [(values, ticks)] = read(path)
    clock = native.streams[0].clock
    if tick_s is None:
        assert (clock.name, clock.rate, ticks) == ("unknown", 1, None)
        assert "give its rate in the map" in native.told[0]
        np.testing.assert_array_equal(values[name], [0.5, 1.5])
    else:
        assert (clock.name, clock.rate, clock.tick_s) == ("", None, tick_s)
        np.testing.assert_array_equal(ticks, [0.5, 1.5])
        assert list(values) == ["x"]


def test_an_index_of_another_file_changes_nothing(tmp_path: Path) -> None:
    from nptdms import ChannelObject, TdmsWriter

    path = tmp_path / "a.tdms"
    with TdmsWriter(str(path), index_file=True) as writer:
        writer.write_segment([ChannelObject("g", "old", np.arange(30.0))])
    assert path.with_suffix(".tdms_index").is_file()
    assert not Tdms().recognises(path.with_suffix(".tdms_index"))
    columns = np.arange(8.0).reshape(2, 4)
    path.write_bytes(segment(META | NEW | RAW, doubles(2, 4), laid(columns, 4, False)))
    _, [(values, _)] = read(path)
    np.testing.assert_array_equal(values["c1"], columns[1])


def scaled(kind: str, count: int = 1) -> Properties:
    return {
        "wf_increment": 0.1,
        "NI_Number_Of_Scales": count,
        "NI_Scale[0]_Scale_Type": kind,
        "NI_Scale[0]_Linear_Slope": 2.0,
        "NI_Scale[0]_Linear_Y_Intercept": 1.0,
    }


def test_scales_are_applied_and_those_that_are_not_known_are_told(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    raw = np.arange(3.0).tobytes()
    path.write_bytes(segment(META | NEW | RAW, doubles(1, 3, scaled("Linear")), raw))
    np.testing.assert_array_equal(read(path)[1][0][0]["c0"], [1, 3, 5])
    for properties, why in (
        (scaled("Magic"), "numbers with a scale of unknown kind Magic"),
        (scaled("Linear", 2**30), f"numbers with {2**30} scales"),
        (scaled("Table"), "numbers with a scale that cannot be computed"),
    ):
        path.write_bytes(segment(META | NEW | RAW, doubles(1, 3, properties), raw))
        native, [(values, _)] = read(path)
        assert native.told == (f"g: 1 channels are {why}",)
        assert values == {}


@pytest.mark.parametrize(
    ("name", "values"), [("NI_Scale[0]_Linear_Slope", (2.0, 4.0)), ("unit_string", ("V", "mV"))]
)
def test_a_scale_or_unit_that_changes_on_the_way_is_not_applied_to_what_came_before(
    tmp_path: Path, name: str, values: tuple[float | str, float | str]
) -> None:
    path = tmp_path / "a.tdms"
    before, after = ({"wf_increment": 1.0, **scaled("Linear"), name: value} for value in values)
    path.write_bytes(waves([(2, before), (2, after)]))
    native, _ = read(path)
    assert not native.streams[0].columns[0].numeric
    assert "whose scale or unit changes" in native.told[0]
    for same in (waves([(2, before), (2, before)]), waves([(4, before)]) + waves([(0, after)])):
        path.write_bytes(same)
        native, _ = read(path)
        assert native.streams[0].columns[0].numeric
        assert native.told == ()


def test_buffers_of_a_device_are_read(tmp_path: Path) -> None:
    """Two channels of int16 side by side in records of 4 bytes, as DAQmx logs them."""
    rows = np.arange(10, dtype="<i2").reshape(5, 2)
    channels = b""
    for k in range(2):
        scaler = struct.pack("<IIIII", 3, 0, 2 * k, 0, 0)
        layout = struct.pack("<IIIQI", 0x1269, 0xFFFFFFFF, 1, 5, 1) + scaler
        widths = struct.pack("<II", 1, 4)
        scale = scaled("Linear", 2) | {"NI_Scale[1]_Scale_Type": "Linear"}
        del scale["NI_Scale[0]_Scale_Type"]
        scale |= {"NI_Scale[1]_Linear_Slope": 0.5, "NI_Scale[1]_Linear_Y_Intercept": 1.0}
        scale |= {"NI_Scale[1]_Linear_Input_Source": 0}
        channels += text(f"/'g'/'c{k}'") + layout + widths + stored(scale)
    data = segment(META | NEW | RAW | 128, struct.pack("<I", 2) + channels, rows.tobytes())
    (tmp_path / "a.tdms").write_bytes(data + segment(RAW | 128, b"", rows.tobytes()))
    native, [(values, _)] = read(tmp_path / "a.tdms")
    assert native.streams[0].count == 10
    for k in range(2):
        np.testing.assert_array_equal(values[f"c{k}"], np.tile(rows[:, k] * 0.5 + 1, 2))


def test_texts_and_empty_channels_are_told(tmp_path: Path) -> None:
    from nptdms import ChannelObject, TdmsWriter

    with TdmsWriter(str(tmp_path / "a.tdms")) as writer:
        words = ChannelObject("g", "words", ["a", "b"])
        writer.write_segment([words, ChannelObject("g", "none", np.empty(0))])
    native, _ = read(tmp_path / "a.tdms")
    assert native.told[0] == "g: 1 channels hold no values"
    assert native.told[-1] == "g: 1 channels are text"
    assert not native.streams[0].columns[0].numeric


def refused(path: Path) -> str:
    """Return why ``path`` is refused, in one line that names it."""
    with pytest.raises(InputError) as caught:
        read(path)
    assert "\n" not in str(caught.value)
    assert path.name in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("interleaved", [False, True])
def test_a_damaged_file_is_refused_or_read_and_nothing_else(
    tmp_path: Path, interleaved: bool
) -> None:
    path, draw = tmp_path / "a.tdms", random.Random(interleaved)
    raw = laid(np.arange(18.0).reshape(3, 6), 3, interleaved)
    wave = scaled("Linear")
    sound = segment(META | NEW | RAW | INTERLEAVED * interleaved, doubles(3, 3, wave), raw)
    sound += segment(RAW | INTERLEAVED * interleaved, b"", raw)
    for _ in range(250):
        damaged = bytearray(sound)
        if draw.random() < 0.15:
            del damaged[draw.randrange(4, len(damaged)) :]
        for _ in range(draw.choice([1, 1, 2, 6]) if len(damaged) == len(sound) else 0):
            place, size = draw.randrange(4, len(sound) - 8), draw.choice([1, 1, 4, 8])
            number = draw.choice([0, 1, 64, 2**63, 2**64 - 1, draw.randrange(2**64)])
            damaged[place : place + size] = (number % 2 ** (8 * size)).to_bytes(size, "little")
        path.write_bytes(damaged)
        with contextlib.suppress(InputError):
            _, numbers = read(path)
            held = sum(len(v) for values, _ in numbers for v in values.values())
            assert held <= len(sound)


def test_a_text_longer_than_any_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    metadata = struct.pack("<II", 1, 2**31) + bytes(100)
    path.write_bytes(segment(META | NEW, metadata, b""))
    assert "a text of 2147483648 bytes" in refused(path)


def test_what_is_no_tdms_is_refused_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    for start in (b"", b"TDSm", b"MDF     4.10" + bytes(80), b"TDSm" + bytes(24) + b"x" * 40):
        path.write_bytes(start)
        assert Tdms().recognises(path) == (start[:4] == b"TDSm")
        refused(path)
    assert not Tdms().recognises(tmp_path / "none.tdms")
    assert "make it readable" in refused(tmp_path / "none.tdms")


def test_without_nptdms_one_line_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.tdms"
    path.write_bytes(segment(META | NEW | RAW, doubles(1, 2), bytes(16)))
    monkeypatch.setitem(sys.modules, "nptdms", None)
    assert "needs nptdms; install floatref[adapters]" in refused(path)


def test_floatref_finds_the_adapter_through_its_entry_point() -> None:
    assert plugins().adapters()["tdms"].summary == Tdms.summary
