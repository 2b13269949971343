"""Our own tests: data written is read, damage gives a warning, the stage obeys its laws."""

import zlib
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from acme_roadlogger import layout
from acme_roadlogger.adapter import RoadLogger
from acme_roadlogger.layout import Header, LoggedChannel
from acme_roadlogger.spikes import HALF, RemoveSpikes
from acme_roadlogger.writer import packed_block, packed_header, write_blocks, write_recording
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import (
    Channel,
    ChannelId,
    Flag,
    InputError,
    NativeFile,
    Recording,
    Stream,
    UniformClock,
)
from floatref_conformance.testing import StageLaws

BLOCKS = st.lists(
    st.tuples(st.integers(0, 2), st.integers(0, 10**6), st.integers(1, 300)), max_size=12
)
CHANNELS = st.tuples(
    st.sampled_from(layout.UNITS),
    st.sampled_from(layout.WIDTHS),
    st.fractions(1, 50_000, max_denominator=1000),
    st.floats(1e-9, 1e3),
    st.floats(-1e6, 1e6),
    st.none() | st.integers(-(1 << 15), (1 << 15) - 1),
)


def content(native: NativeFile) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return ticks and values of every stream, read twice."""
    twice = [[_all(stream) for stream in native.streams] for _ in range(2)]
    for one, two in zip(*twice, strict=True):
        np.testing.assert_equal(one, two)
    return twice[0]


def _all(stream: Stream) -> tuple[np.ndarray, np.ndarray]:
    name = stream.columns[0].name
    rows = list(stream.read([name]))
    values = [part.values[name] for part in rows]
    assert sum(v.size for v in values) == stream.count
    return (
        np.concatenate([part.ticks for part in rows] or [np.empty(0, np.int64)]),
        np.concatenate(values or [np.empty(0)]),
    )


def logged(name: str, drawn: tuple) -> LoggedChannel:
    """Return the channel called ``name`` with what was ``drawn`` for the rest."""
    return LoggedChannel(name, *drawn)


@settings(deadline=None, max_examples=60)
@given(drawn=st.lists(CHANNELS, min_size=3, max_size=3), blocks=BLOCKS, seed=st.integers(0, 99))
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory, drawn: list[tuple], blocks: list[tuple], seed: int
) -> None:
    """Ticks within one, counts exactly, dropouts as NaN."""
    path = tmp_path_factory.mktemp("files") / "run.arl"
    header = Header(tuple(logged(f"C{n}", d) for n, d in enumerate(drawn)), 10**7, seed, "RL-7")
    rng, tick, written = np.random.default_rng(seed), 0, []
    for channel, gap, size in blocks:
        limit = 1 << (8 * header.channels[channel].width - 1)
        written.append((channel, tick, rng.integers(-limit, limit, size)))
        tick += gap
    write_blocks(path, header, written)
    native = RoadLogger().streams(path, {})
    assert native.warnings == ()
    assert native.model == "RoadLogger RL-7"
    for n, (stream, (ticks, values)) in enumerate(
        zip(native.streams, content(native), strict=True)
    ):
        channel = header.channels[n]
        assert (stream.columns[0].name, stream.columns[0].unit) == (channel.name, channel.unit)
        assert stream.clock.origin_ns == seed
        own = [(tick, counts) for number, tick, counts in written if number == n]
        counts = np.concatenate([c for _, c in own] or [np.empty(0)])
        lost = counts == channel.dropout if channel.dropout is not None else np.zeros(counts.size)
        np.testing.assert_array_equal(np.isnan(values), lost)
        expected = np.where(lost, np.nan, channel.scale * counts + channel.offset)
        np.testing.assert_allclose(values, expected, rtol=1e-12)
        exact = [t + Fraction(10**7) * k / channel.rate for t, c in own for k in range(c.size)]
        assert all(0 <= e - t < 1 for e, t in zip(exact, ticks.tolist(), strict=True))


def a_file(path: Path, blocks: int = 40) -> tuple[Header, list[int]]:
    """Write a file of equal blocks; return its header and where each block begins."""
    header = Header((LoggedChannel("A", "g", 4, Fraction(1000), 1e-6),))
    counts = np.arange(100)
    write_blocks(path, header, ((0, 10**6 * k, counts + 100 * k) for k in range(blocks)))
    size = len(packed_block(0, 4, 0, counts))
    begin = len(packed_header(header))
    return header, [begin + k * size for k in range(blocks)]


@settings(deadline=None, max_examples=150)
@given(data=st.data())
def test_damage_gives_a_warning_and_affects_only_the_blocks_it_hits(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    """Flipped bits, and a truncated end."""
    path = tmp_path_factory.mktemp("files") / "run.arl"
    _, begins = a_file(path)
    whole = bytearray(path.read_bytes())
    hits = data.draw(st.sets(st.integers(begins[0], len(whole) - 1), min_size=1, max_size=6))
    for at in hits:
        whole[at] ^= data.draw(st.integers(1, 255))
    cut = data.draw(st.integers(begins[0], len(whole)))
    path.write_bytes(whole[:cut])
    native = RoadLogger().streams(path, {})
    size = begins[1] - begins[0]
    hit = {(at - begins[0]) // size for at in hits}
    sound = [k for k, at in enumerate(begins) if k not in hit and at + size <= cut]
    ((_, values),) = content(native)
    expected = [np.arange(100) + 100 * k for k in sound]
    np.testing.assert_allclose(values, 1e-6 * np.concatenate(expected or [np.empty(0)]))
    if len(sound) * size < cut - begins[0]:
        assert native.warnings


@settings(deadline=None, max_examples=150)
@given(at=st.integers(0, 400), flip=st.integers(1, 255), cut=st.integers(0, 500))
def test_any_byte_of_the_header_may_be_wrong(
    tmp_path_factory: pytest.TempPathFactory, at: int, flip: int, cut: int
) -> None:
    """Then the file is refused in one line."""
    path = tmp_path_factory.mktemp("files") / "run.arl"
    _, begins = a_file(path, blocks=1)
    damaged = bytearray(path.read_bytes())
    damaged[at] ^= flip
    path.write_bytes(damaged[:cut] if at >= begins[0] else damaged)
    if at >= begins[0] and cut >= begins[0]:
        assert len(RoadLogger().streams(path, {}).streams) == 1
        return
    with pytest.raises(InputError) as refused:
        RoadLogger().streams(path, {})
    assert "\n" not in str(refused.value)
    assert str(path) in str(refused.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"width": 3}, "samples of 3 bytes"),
        ({"rate": Fraction(10**9)}, "no sensor's"),
        ({"scale": 0.0}, "scale 0.0"),
        ({"scale": 1e300}, "scale 1e\\+300"),
        ({"offset": float("nan")}, "offset nan"),
    ],
)
def test_a_sound_header_may_have_wrong_values(tmp_path: Path, change: dict, message: str) -> None:
    """Its check is right, and it is refused."""
    entry = {"name": "A", "unit": "g", "width": 2, "rate": Fraction(1), **change}
    (tmp_path / "run.arl").write_bytes(packed_header(Header((LoggedChannel(**entry),))))
    with pytest.raises(InputError, match=message):
        RoadLogger().streams(tmp_path / "run.arl", {})


def test_a_file_of_syncs_ends_soon(tmp_path: Path) -> None:
    """It would be gigabytes of checks."""
    path = tmp_path / "run.arl"
    header, _ = a_file(path)
    block = layout.BLOCK.pack(layout.SYNC, 0, layout.MOST_SAMPLES, 0)
    path.write_bytes(packed_header(header) + block * 200_000)
    with pytest.raises(InputError, match="damaged blocks"):
        RoadLogger().streams(path, {})


def test_the_bytes_of_a_file_are_those_of_the_layout() -> None:
    """Written by hand, from the table in layout.py."""
    packed = packed_header(Header((LoggedChannel("A", "mm", 2, Fraction(3, 2), 0.5, -1, 7),), 9, 5))
    words = "41434d45524c0d0a 0100 0100 09000000 0500000000000000" + " 00" * 16
    words += " 41" + " 00" * 15 + " 03 02 0100 03000000 02000000"
    words += " 000000000000e03f 000000000000f0bf 07000000"
    by_hand = bytes.fromhex(words)
    assert packed == by_hand + zlib.crc32(by_hand).to_bytes(4, "little")
    block = bytes.fromhex("f5a00a5f 0000 0200 0300000000000000 0100 ffff")
    assert packed_block(0, 2, 3, np.array([1, -1])) == block + zlib.crc32(block).to_bytes(
        4, "little"
    )


def test_a_recording_becomes_a_file_with_gaps_and_dropouts(tmp_path: Path) -> None:
    """And its counter starts again."""
    clock, missing = UniformClock.of(1000.0, 2.0), np.arange(3000) // 100 == 7
    height = np.where(missing, np.nan, 0.3 + 1e-5 * np.arange(3000))
    distance = np.where(missing, np.nan, 0.02 * np.arange(3000))
    run = Recording(
        (
            Channel.of("height", height, clock, "left"),
            Channel.of("distance", distance, clock),
        )
    )
    write_recording(run, tmp_path / "run.arl")
    (ticks, heights), (stamps, counts) = content(RoadLogger().streams(tmp_path / "run.arl", {}))
    np.testing.assert_array_equal(ticks, 20_000_000 + 10_000 * np.arange(3000))
    np.testing.assert_allclose(heights, 1000 * height, atol=0.0051)
    np.testing.assert_array_equal(stamps, ticks[~missing])
    assert counts.max() > 2**31 - 20_000
    assert counts.min() == -(2**31)
    turned = (counts - counts[0]) % 2.0**32
    np.testing.assert_allclose(0.0005 * turned, distance[~missing], atol=0.0003)


class TestRemoveSpikes(StageLaws):
    """All laws of the stage protocol."""

    reads = ("height",)
    reach = HALF

    def make(self) -> RemoveSpikes:
        """Return the stage with a limit that half of the drawn samples exceed."""
        return RemoveSpikes(0.7)

    def test_a_spike_goes_and_a_step_stays(self) -> None:
        """Five samples that leap are replaced by what is around them; a kerb is not."""
        left = ChannelId("height", "left")
        road = np.where(np.arange(240) < 120, 0.30, 0.35)
        spiked = road.copy()
        spiked[50:55] += 0.03
        stream = self.stream().change(lambda c, _: spiked if c == left else road)
        stage = RemoveSpikes(0.01)
        stage.start(stream.header)
        out = [*map(stage.push, stream.blocks([53])), *stage.finish()]
        np.testing.assert_array_equal(np.concatenate([b[left] for b in out]), road)
        marks = np.concatenate([b.flags.get(left, np.zeros(len(b), np.uint8)) for b in out])
        np.testing.assert_array_equal(np.flatnonzero(marks == Flag.MISSING), np.arange(50, 55))
        assert stage.warnings() == ("5 samples of laser spikes removed and flagged",)
