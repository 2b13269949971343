"""What cannot be read through a map is one line that names file, channel and value."""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.errors import FloatrefError, InputError, PluginError
from floatref.mapping import read_native
from floatref.mapping import spool as spools
from floatref.mapping.entries import ChannelEntry, ChannelMap, ClockEntry
from floatref.values.native import Column, Epoch, NativeClock, NativeFile, Rows, Stream

Put = Callable[..., Path]
HEIGHT = ChannelEntry("laser", "height", unit="mm")


def chart(*channels: ChannelEntry, **more) -> ChannelMap:
    return ChannelMap(channels or (HEIGHT,), **more)


@pytest.fixture(autouse=True)
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """See that no folder of samples stays behind, whatever happens."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(spools.tempfile, "tempdir", str(folder))
    yield
    assert list(folder.iterdir()) == []


def refused(kind: type[FloatrefError], *args) -> str:
    with pytest.raises(FloatrefError) as caught:
        read_native(*args)
    assert isinstance(caught.value, kind)
    assert str(caught.value).isprintable()
    return str(caught.value)


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        (ChannelEntry("lasre", "height", unit="mm"), "'lasre' is not in the file; did you mean"),
        (ChannelEntry("laser", "height"), "s/laser as height: the file gives no unit"),
        (ChannelEntry("laser", "height", unit="deg"), "s/laser as height: unit 'deg' is none of"),
        (
            ChannelEntry("laser", "distance", unit="m", wrap=2, track="left"),
            "s/laser as left.distance: wrap is 2, but a sample is 300; correct wrap",
        ),
        (
            ChannelEntry("laser", "yaw_rate", unit="rad/s"),
            "s/laser as yaw_rate: a sample is 300 rad/s, which no vehicle reaches",
        ),
    ],
)
def test_a_refusal_names_file_and_channel_once(
    put: Put, make_stream, entry: ChannelEntry, message: str
) -> None:
    source = put(make_stream("s", {"laser": [250.0, 300.0]}, rate=Fraction(100)))
    line = refused(InputError, source, chart(entry))
    assert line.startswith(f"{source}: {message}")
    assert line.count(str(source)) == 1


def test_names_that_would_break_a_line_do_not(put: Put, make_stream) -> None:
    evil = "a\nb\x1b[31m\u2028"
    source = put(
        make_stream(evil, {evil: [1.0, 2.0]}, rate=Fraction(100), count=9),
        told=("bad\nline\x1b",),
    )
    assert "there are a\\nb" in refused(InputError, source, chart(ChannelEntry("a\nb", "height")))
    reading = read_native(source, chart(ChannelEntry(evil, "height", unit="m")))
    assert len(reading.told) == 2
    assert all(line.isprintable() for line in reading.told)


def test_time_that_goes_back_is_refused_with_its_stream(put: Put, make_stream) -> None:
    ticks = [*range(10), *range(10)]
    source = put(make_stream("s", {"laser": np.ones(20)}, ticks=ticks))
    line = refused(InputError, source, chart())
    assert line.startswith(f"{source}: ")
    assert "time goes back in 9 of 20 rows" in line


def test_a_clock_of_a_stream_that_is_not_there_is_refused(put: Put, make_stream) -> None:
    source = put(make_stream("laser", {"laser": [1.0, 2.0]}, rate=Fraction(100)))
    lost = chart(clocks=(ClockEntry(stream="lasre", rate=Fraction(5)),))
    line = refused(InputError, source, lost)
    assert "no stream is called 'lasre'; did you mean laser?" in line


def test_a_stated_rate_and_start_are_those_of_the_recording(put: Put, make_stream) -> None:
    source = put(
        make_stream("a", {"laser": np.ones(5)}, name="unknown"),
        make_stream("b", {"x": np.ones(5)}, ticks=[7, 7, 7, 7, 7]),
    )
    refused(InputError, source, chart())
    by_stream = (
        ClockEntry(stream="a", rate=Fraction(100, 3), start_s=2.5),
        ClockEntry(rate=Fraction(50)),
    )
    x = ChannelEntry("x", "gnss_height", unit="m")
    height, other = (
        read_native(source, chart(entry, clocks=by_stream)).recording.channels[0]
        for entry in (HEIGHT, x)
    )
    assert (height.clock.rate, height.clock.start_s) == (Fraction(100, 3), 2.5)
    assert (other.clock.rate, other.clock.start_s) == (50, 7.0)


class Odd:
    """A stream that yields three rows and fails."""

    def __init__(self, error: BaseException) -> None:
        self._error = error

    def __call__(self, names: Sequence[str]) -> Iterator[Rows]:
        yield Rows({name: np.ones(3) for name in names}, np.arange(3))
        raise self._error


ODD = [
    KeyError("x"),
    ZeroDivisionError("by zero"),
    AttributeError("a\nb"),
    RecursionError("deep"),
    StopIteration(5),
    UnicodeDecodeError("utf-8", b"\xff", 0, 1, "odd"),
    SystemExit(3),
    AssertionError(),
    EOFError(),
]


@pytest.mark.parametrize("error", ODD, ids=lambda e: type(e).__name__)
def test_what_an_adapter_raises_while_streaming_is_its_own_fault(
    put: Put, error: BaseException
) -> None:
    source = put(Stream("s", (Column("laser"),), 3, NativeClock(), Odd(error)))
    line = refused(PluginError, source, chart())
    assert line.startswith(f"adapter logger: {source}: ")


@pytest.mark.parametrize("error", ODD, ids=lambda e: type(e).__name__)
def test_what_an_adapter_raises_when_opening_or_closing_is_its_own_fault(
    put: Put, make_stream, logger, error: BaseException
) -> None:
    def close() -> None:
        raise error

    stream = make_stream("s", {"laser": [1.0, 2.0]}, rate=Fraction(100))
    source = put(stream, close=close)
    assert refused(PluginError, source, chart()).startswith(f"adapter logger: {source}: ")
    logger.streams = lambda path, options: close()
    assert refused(PluginError, source, chart()).startswith(f"adapter logger: {source}: ")


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (InputError("s: row 3 is torn"), "{0}: s: row 3 is torn"),
        (OSError(5, "Input/output error"), "{0}: Input/output error; copy the file again"),
        (OSError("bad"), "{0}: bad; copy the file again"),
        (FileNotFoundError(2, "gone", "/x/part2"), "/x/part2: gone; copy the file again"),
    ],
)
def test_what_a_user_can_act_on_stays_what_it_is(put: Put, error: Exception, message: str) -> None:
    source = put(Stream("s", (Column("laser"),), 3, NativeClock(), Odd(error)))
    assert message.format(source) in refused(InputError, source, chart())


def test_memory_that_is_not_there_is_no_fault_of_the_adapter(put: Put) -> None:
    source = put(Stream("s", (Column("laser"),), 3, NativeClock(), Odd(MemoryError())))
    with pytest.raises(MemoryError):
        read_native(source, chart())


@pytest.mark.parametrize("content", [None, 5, "text", object()])
def test_an_adapter_that_gives_no_file_is_named(put: Put, logger, content: object) -> None:
    source = put()
    logger.streams = lambda path, options: content
    assert "gave no native file" in refused(PluginError, source, chart())


def test_two_streams_of_one_name_are_the_fault_of_the_adapter(put: Put, make_stream) -> None:
    twice = [make_stream("s", {n: [1.0, 2.0]}, rate=Fraction(1)) for n in ("laser", "x")]
    assert "gave two streams called 's'" in refused(PluginError, put(*twice), chart())


def test_a_source_that_is_not_there_or_of_no_adapter_is_named(tmp_path: Path, logger) -> None:
    for name in ("no.log", "x" * 300):
        assert refused(InputError, tmp_path / name, chart()).endswith(": not found")
    (tmp_path / "run.xyz").write_bytes(b"")
    assert "no adapter recognises it" in refused(InputError, tmp_path / "run.xyz", chart())
    line = refused(InputError, tmp_path / "run.xyz", chart(), "logr")
    assert "adapter logr: unknown; there are recording" in line


def test_every_file_is_closed_whatever_happens(put: Put, make_stream) -> None:
    closed: list[int] = []
    stream = make_stream("s", {"laser": [1.0, 2.0]}, rate=Fraction(100))
    source = put(stream, close=lambda: closed.append(1))
    read_native(source, chart())
    refused(InputError, source, chart(ChannelEntry("x", "height")))
    refused(InputError, source)
    assert closed == [1, 1, 1]


def test_paths_may_be_text_and_the_public_name_is_the_same(
    put: Put, make_stream, tmp_path: Path
) -> None:
    assert floatref.read_native is read_native
    source = put(make_stream("s", {"laser": [250.0, 251.0]}, rate=Fraction(100)))
    text = 'format = "floatref-map/1"\n[[channels]]\nnative = "laser"\nchannel = "height"\n'
    (tmp_path / "map.toml").write_text(text + 'unit = "mm"\n')
    reading = floatref.read_native(str(source), str(tmp_path / "map.toml"))
    assert reading.recording.channel("height").values.tolist() == [0.25, 0.251]
    assert dict(reading.files) == {"": source}


def test_streams_of_one_absolute_clock_keep_their_distance_in_time(put: Put, make_stream) -> None:
    clock = {"epoch": Epoch.UTC, "origin_ns": 1_700_000_000 * 10**9 + 250}
    source = put(
        make_stream("a", {"laser": np.ones(5)}, rate=Fraction(10), **clock),
        make_stream("b", {"x": np.ones(3)}, ticks=[1, 15, 51], tick_s=Fraction(1, 10), **clock),
    )
    both = (HEIGHT, ChannelEntry("x", "gnss_height", unit="m"))
    height, other = read_native(source, chart(*both)).recording.channels
    np.testing.assert_allclose(other.times_s - height.times_s[0], [0.1, 1.5, 5.1], atol=1e-9)


def test_a_file_without_streams_is_refused(put: Put) -> None:
    assert "it has no columns" in refused(InputError, put(), chart())
    assert "none of its channels has one of our names" in refused(InputError, put())
    assert NativeFile(()).streams == ()
