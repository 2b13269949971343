"""MDF 4: what is written comes back on its own clock; what is damaged is refused in one line."""

import contextlib
import random
import struct
import sys
import tracemalloc
import warnings
import zlib
from collections.abc import Callable
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
from floatref_adapters.mdf4.adapter import Mdf4
from floatref_adapters.testing.mdf4 import write_mdf4
from floatref_adapters.testing.mdf4_blocks import (
    MASTER,
    VALUE,
    VIRTUAL_MASTER,
    Stored,
    StoredGroup,
    write,
)

NS = (1e-9, 0.0)
samples = st.none() | st.floats(-1e6, 1e6)
names = st.sampled_from(["height", "vertical_specific_force", "distance"])
tracks = st.text("aß中 .#2", min_size=1, max_size=4).filter(lambda name: name == name.strip())
rates = st.builds(Fraction, st.integers(1, 50_000), st.integers(1, 40))


@st.composite
def recordings(draw: st.DrawFn) -> Recording:
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
            values = draw(st.lists(samples, min_size=count, max_size=count))
            channels.append(Channel.of(name, np.array(values, float), clock, track))
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
    with Mdf4().streams(path, {}) as native:
        return native, [whole(stream) for stream in native.streams]


def check_round_trip(recording: Recording, path: Path, within: Callable[[Channel], float]) -> None:
    """Assert that ``path`` holds ``recording``, each value ``within`` so much."""
    native, numbers = read(path)
    found = {
        c.name: (s, c, n) for s, n in zip(native.streams, numbers, strict=True) for c in s.columns
    }
    assert sum(len(s.columns) for s in native.streams) == len(recording.channels)
    for channel in recording.channels:
        stream, column, (values, ticks) = found[str(channel.id)]
        assert column.unit == channel.unit
        assert stream.count == channel.values.size
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
    path = tmp_path_factory.mktemp("mdf4") / "run.dat"
    write_mdf4(recording, path)
    assert Mdf4().recognises(path)
    check_round_trip(recording, path, lambda _: 0.0)


@settings(deadline=None, max_examples=25)
@given(recording=recordings(), quantum=st.sampled_from([1e-6, 0.01, 0.3]))
def test_integers_are_within_half_a_quantum_and_missing_samples_stay_missing(
    tmp_path_factory: pytest.TempPathFactory, recording: Recording, quantum: float
) -> None:
    path = tmp_path_factory.mktemp("mdf4") / "run.mf4"
    write_mdf4(recording, path, {"height": quantum})
    rounding = 4 * np.spacing(1e6)
    stored = {"height": quantum / 2 + rounding}
    check_round_trip(recording, path, lambda channel: stored.get(channel.id.name, 0.0))


@settings(deadline=None, max_examples=40)
@given(
    numbers=st.lists(st.integers(0, 2**64 - 1), min_size=1, max_size=9),
    first=st.integers(0, 7),
    count=st.integers(1, 57),
    size=st.sampled_from([1, 2, 4, 8]),
    order=st.sampled_from("<>"),
    signed=st.booleans(),
)
def test_a_value_of_any_bits_is_taken_from_among_its_neighbours(
    tmp_path_factory: pytest.TempPathFactory,
    numbers: list[int],
    first: int,
    count: int,
    size: int,
    order: str,
    signed: bool,
) -> None:
    path = tmp_path_factory.mktemp("mdf4") / "bits.mf4"
    count = min(count, 8 * size - first)
    whole_bits = [number % 2 ** (8 * size) for number in numbers]
    stored = np.array(whole_bits, f"u{size}").astype(f"{order}u{size}")
    if signed:
        stored = stored.view(f"{order}i{size}")
    # What is stored high byte first is as many bytes as the bits take, from the first byte on.
    taken = -(-(first + count) // 8)
    if order == ">":
        whole_bits = [bits >> 8 * (size - taken) for bits in whole_bits]
    master = Stored("t", np.arange(len(numbers)), "s", NS, MASTER)
    write([StoredGroup("g", [master, Stored("x", stored, bits=(first, count))])], path)
    expected = [bits >> first & (1 << count) - 1 for bits in whole_bits]
    if signed:
        expected = [v - (1 << count) if v >> (count - 1) else v for v in expected]
    _, [(values, _)] = read(path)
    np.testing.assert_array_equal(values["x"], np.array(expected, float))


@pytest.mark.parametrize("mixed", [False, True])
def test_an_integer_master_keeps_its_ticks(tmp_path: Path, mixed: bool) -> None:
    path = tmp_path / "run.mf4"
    ticks = np.array([2**53 + 1, 2**53 + 2, 2**53 + 4])
    start_ns = 1_795_324_988_374_539_008
    groups = [
        StoredGroup("g", [Stored("t", ticks, "s", NS, MASTER), Stored("x", np.arange(3.0))]),
        StoredGroup(
            "g", [Stored("t", ticks[:2], "s", (1e-9, 0.5), MASTER), Stored("x", ticks[:2])]
        ),
    ]
    write(groups, path, start_ns, mixed=mixed)
    native, numbers = read(path)
    assert [stream.name for stream in native.streams] == ["g", "g #2"]
    assert [stream.clock.tick_s for stream in native.streams] == [Fraction(1, 10**9)] * 2
    origins = [stream.clock.origin_ns for stream in native.streams]
    assert origins == [start_ns, start_ns + 500_000_000]
    assert {stream.clock.epoch for stream in native.streams} == {Epoch.UTC}
    for (_, found), expected in zip(numbers, (ticks, ticks[:2]), strict=True):
        assert found.dtype == np.int64
        np.testing.assert_array_equal(found, expected)


def test_a_local_start_time_is_no_utc_and_is_told(tmp_path: Path) -> None:
    master = Stored("t", np.arange(3.0), "s", kind=MASTER)
    write([StoredGroup("g", [master])], tmp_path / "a.mf4", 10**18, time_flags=1)
    native, _ = read(tmp_path / "a.mf4")
    assert native.streams[0].clock.epoch is Epoch.LOCAL
    assert "local time" in native.told[0]


def test_a_master_of_distance_is_a_column_and_the_clock_unknown(tmp_path: Path) -> None:
    metres = Stored("s", np.arange(4.0), "m", kind=MASTER, sync=3)
    write([StoredGroup("g", [metres])], tmp_path / "a.mf4")
    native, [(values, ticks)] = read(tmp_path / "a.mf4")
    assert native.streams[0].clock.name == "unknown"
    assert ticks is None
    np.testing.assert_array_equal(values["s"], np.arange(4.0))
    assert native.told == ("g: no time; its clock is called unknown, give its rate in the map",)


def test_names_given_twice_are_numbered_and_noted(tmp_path: Path) -> None:
    columns = [Stored(name, np.arange(2.0) + k) for k, name in enumerate(["x", "x #2", "x", ""])]
    master = Stored("t", np.arange(2.0), "s", kind=MASTER)
    write([StoredGroup("", [master, *columns])], tmp_path / "a.mf4")
    native, [(values, _)] = read(tmp_path / "a.mf4")
    assert native.streams[0].name == "group 0"
    assert list(values) == ["x", "x #2", "x #3", ""]
    assert [values[name][0] for name in values] == [0, 1, 2, 3]
    assert "more than once" in native.streams[0].columns[2].note


def asammdf_file(path: Path, version: str, compression: int) -> dict[str, NDArray[np.float64]]:
    """Write channels of many kinds with asammdf; return the numbers to be read."""
    from asammdf import MDF, Signal

    rng = np.random.default_rng(5)
    n = 70_000
    t = np.arange(n) / 128
    ints, floats = rng.integers(-(2**15), 2**15, n), rng.normal(size=n)
    invalid = rng.random(n) < 0.1
    texts = {"val_0": 0, "text_0": b"off", "val_1": 1, "text_1": b"on"}
    pair = np.rec.fromarrays([ints, floats], names=["first", "second"])
    signals = [
        Signal(ints.astype("i2"), t, name="linear", unit="m", conversion={"a": 0.5, "b": 1.0}),
        Signal(ints.astype(">i2"), t, name="big"),
        Signal(floats.astype("f4"), t, name="short"),
        Signal(floats, t, name="marked", invalidation_bits=invalid),
        Signal(ints, t, name="formula", conversion={"formula": "X * X + 1"}),
        Signal((ints % 2).astype("u1"), t, name="state", conversion=texts),
        Signal(np.array([b"word"] * n), t, name="word", encoding="utf-8"),
        Signal(pair, t, name="pair"),
    ]
    with warnings.catch_warnings(), MDF(version=version) as mdf:
        warnings.simplefilter("ignore")
        mdf.append(signals, acq_name="bench", common_timebase=True)
        mdf.save(path, compression=compression)
    return {
        "linear": ints * 0.5 + 1,
        "big": ints.astype(float),
        "short": floats.astype("f4").astype(float),
        "marked": np.where(invalid, np.nan, floats),
        "formula": ints.astype(float) ** 2 + 1,
        "first": ints.astype(float),
        "second": floats,
    }


@pytest.mark.parametrize(
    ("version", "compression"),
    [("4.10", 0), ("4.10", 1), ("4.10", 2), ("4.30", 3), ("4.30", 4), ("4.30", 5), ("4.30", 6)],
)
def test_files_of_asammdf_are_read_as_written(
    tmp_path: Path, version: str, compression: int
) -> None:
    expected = asammdf_file(tmp_path / "a.mf4", version, compression)
    native, [(values, ticks)] = read(tmp_path / "a.mf4")
    assert list(values) == list(expected)
    for name, column in values.items():
        np.testing.assert_array_equal(column, expected[name])
    np.testing.assert_array_equal(ticks, np.arange(70_000) / 128)
    assert native.streams[0].columns[0].unit == "m"
    assert native.told == (
        "bench: 1 channels are text by a table",
        "bench: 1 channels are values of varying length",
        "bench: 1 channels are an array or a structure",
    )


def test_asammdf_reads_what_is_written(tmp_path: Path) -> None:
    from asammdf import MDF

    values = np.array([0.25, np.nan, 1.5])
    clock = UniformClock.of(8.0, 2.0)
    recording = Recording(
        (Channel.of("height", values, clock), Channel.of("distance", values, clock))
    )
    write_mdf4(recording, tmp_path / "a.mf4", {"distance": 0.25})
    with MDF(tmp_path / "a.mf4") as mdf:
        height, distance = mdf.get("height"), mdf.get("distance")
    np.testing.assert_array_equal(height.samples, values)
    np.testing.assert_array_equal(height.timestamps, [2.0, 2.125, 2.25])
    np.testing.assert_array_equal(distance.samples, [0.25, 1.5])


def small(path: Path, compressed: bool = False) -> bytes:
    """Write a small file of two groups to ``path`` and return its bytes."""
    n = 6
    master = Stored("t", np.arange(n), "s", NS, MASTER)
    virtual = Stored("t", np.empty(n, "V0"), "s", (0.1, 0.0), VIRTUAL_MASTER)
    x = Stored("x", np.arange(n, dtype="i2"), "m", (0.5, 1.0), VALUE, np.arange(n) % 2 == 0)
    groups = [StoredGroup("a", [master, x], 0, compressed), StoredGroup("b", [virtual, x])]
    write(groups, path)
    return path.read_bytes()


def refused(path: Path) -> str:
    """Return why ``path`` is refused, in one line that names it."""
    with pytest.raises(InputError) as caught:
        read(path)
    assert "\n" not in str(caught.value)
    assert path.name in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("compressed", [False, True])
def test_a_damaged_file_is_refused_or_read_and_nothing_else(
    tmp_path: Path, compressed: bool
) -> None:
    path, draw = tmp_path / "a.mf4", random.Random(compressed)
    sound = small(path, compressed)
    for _ in range(150):
        damaged = bytearray(sound)
        if draw.random() < 0.1:
            del damaged[draw.randrange(len(damaged)) :]
        for _ in range(draw.choice([1, 1, 2, 6]) if len(damaged) == len(sound) else 0):
            place, size = draw.randrange(8, len(sound) - 8), draw.choice([1, 1, 4, 8])
            number = draw.choice([0, 1, 64, 2**63, 2**64 - 1, draw.randrange(2**64)])
            damaged[place : place + size] = (number % 2 ** (8 * size)).to_bytes(size, "little")
        path.write_bytes(damaged)
        with contextlib.suppress(InputError):
            _, numbers = read(path)
            assert all(len(v) <= 6 for values, _ in numbers for v in values.values())


def patched(path: Path, sound: bytes, kind: bytes, offset: int, layout: str, *values: int) -> None:
    """Write ``sound`` to ``path`` with ``values`` at ``offset`` of its first block of ``kind``."""
    damaged = bytearray(sound)
    struct.pack_into(layout, damaged, sound.index(b"##" + kind) + offset, *values)
    path.write_bytes(damaged)


def test_more_rows_than_there_are_is_told_and_those_there_are_delivered(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    sound = small(path)
    patched(path, sound, b"CG", 24 + 48 + 8, "<Q", 2**60)
    native, numbers = read(path)
    assert sorted(stream.count for stream in native.streams) == [6, 6]
    assert {len(values["x"]) for values, _ in numbers} == {6}
    assert f"{2**60 - 6} of {2**60} rows are missing" in native.told[0]


def test_an_unfinished_recording_is_read_as_far_as_it_goes(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    master = Stored("t", np.arange(5), "s", NS, MASTER)
    write([StoredGroup("g", [master, Stored("x", np.arange(5.0))])], path)
    unfinished = bytearray(path.read_bytes())
    struct.pack_into("<8s", unfinished, 0, b"UnFinMF ")
    struct.pack_into("<H", unfinished, 60, 0b101)
    struct.pack_into("<Q", unfinished, unfinished.index(b"##CG") + 24 + 48 + 8, 0)
    struct.pack_into("<Q", unfinished, unfinished.index(b"##DT") + 8, 24)
    path.write_bytes(unfinished)
    assert Mdf4().recognises(path)
    _, [(values, ticks)] = read(path)
    np.testing.assert_array_equal(values["x"], np.arange(5.0))
    np.testing.assert_array_equal(ticks, np.arange(5))
    assert path.read_bytes() == unfinished


def test_links_that_lead_in_a_ring_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    sound = small(path)
    for kind in (b"CN", b"CG", b"DG", b"FH"):
        patched(path, sound, kind, 24, "<Q", sound.index(b"##" + kind))
        assert "is linked to by mistake" in refused(path)
    patched(path, sound, b"CC", 24 + 24, "<Q", sound.index(b"##CC"))
    read(path)
    conversion = bytearray(sound)
    start = sound.index(b"##CC")
    struct.pack_into("<QQ", conversion, start + 8, 24 + 5 * 8 + 40, 5)
    struct.pack_into("<Q", conversion, start + 24 + 32, start)
    path.write_bytes(conversion)
    assert "called in a loop" in refused(path)


def test_a_data_list_that_leads_to_itself_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    sound = small(path, compressed=True)
    patched(path, sound, b"DL", 24, "<Q", sound.index(b"##DL"))
    refused(path)


def test_a_compressed_block_gives_what_it_says_or_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    sound = small(path, compressed=True)
    patched(path, sound, b"DZ", 32, "<Q", 2**40)
    assert "says it holds 1099511627776 bytes" in refused(path)
    bomb = zlib.compress(bytes(1 << 26))
    head = struct.pack("<4s4xQQ2sBxIQQ", b"##DZ", 48 + len(bomb), 0, b"DT", 0, 0, 60, len(bomb))
    bombed = bytearray(sound) + head + bomb
    struct.pack_into("<Q", bombed, sound.index(b"##DL") + 32, len(sound))
    path.write_bytes(bombed)
    tracemalloc.start()
    why = refused(path)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert "does not hold 60 bytes" in why
    assert most < 1 << 24


def test_what_is_no_mdf_4_is_refused_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    for start in (b"", b"MDF     ", b"TDSm" + bytes(80)):
        path.write_bytes(start)
        assert Mdf4().recognises(path) == (start[:3] == b"MDF")
        assert "not an MDF file" in refused(path)
    assert not Mdf4().recognises(tmp_path / "none.mf4")
    assert "make it readable" in refused(tmp_path / "none.mf4")


def test_without_asammdf_one_line_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    small(tmp_path / "a.mf4")
    monkeypatch.setitem(sys.modules, "asammdf", None)
    assert "needs asammdf; install floatref[adapters]" in refused(tmp_path / "a.mf4")


def test_reading_begins_anew_and_two_streams_can_be_read_in_turn(tmp_path: Path) -> None:
    path = tmp_path / "a.mf4"
    n = 200_000
    groups = [
        StoredGroup(
            name, [Stored("t", np.arange(n), "s", NS, MASTER), Stored("x", np.arange(n) * k)]
        )
        for k, name in ((2.0, "a"), (3.0, "b"))
    ]
    write(groups, path)
    with Mdf4().streams(path, {}) as native:
        a, b = native.streams
        for one, other in zip(a.read(["x"]), b.read(["x"]), strict=True):
            assert len(one.values["x"]) <= 65_536
            np.testing.assert_array_equal(one.values["x"] * 3, other.values["x"] * 2)
        assert sum(len(rows.values["x"]) for rows in a.read(["x"])) == n
        assert sum(len(rows.ticks) for rows in a.read([]) if rows.ticks is not None) == n


def test_floatref_finds_the_adapter_through_its_entry_point() -> None:
    assert plugins().adapters()["mdf4"].summary == Mdf4.summary
