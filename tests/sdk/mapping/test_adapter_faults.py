"""What goes wrong inside an adapter is told as its own fault, in one line that names the file."""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from floatref.errors import InputError, PluginError
from floatref.mapping import read_native
from floatref.mapping.channel_map.entries import ChannelEntry
from floatref.values.native import Column, NativeClock, Rows, Stream

Put = Callable[..., Path]
pytestmark = pytest.mark.usefixtures("nothing_left")


class Odd:
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
    put: Put, error: BaseException, chart, refused
) -> None:
    source = put(Stream("s", (Column("laser"),), 3, NativeClock(), Odd(error)))
    line = refused(PluginError, source, chart())
    assert line.startswith(f"adapter logger: {source}: ")


@pytest.mark.parametrize("error", ODD, ids=lambda e: type(e).__name__)
def test_what_an_adapter_raises_when_opening_or_closing_is_its_own_fault(
    put: Put, make_stream, logger, error: BaseException, chart, refused
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
def test_what_a_user_can_act_on_stays_what_it_is(
    put: Put, error: Exception, message: str, chart, refused
) -> None:
    source = put(Stream("s", (Column("laser"),), 3, NativeClock(), Odd(error)))
    assert message.format(source) in refused(InputError, source, chart())


def test_memory_that_is_not_there_is_no_fault_of_the_adapter(put: Put, chart) -> None:
    source = put(Stream("s", (Column("laser"),), 3, NativeClock(), Odd(MemoryError())))
    with pytest.raises(MemoryError):
        read_native(source, chart())


@pytest.mark.parametrize("content", [None, 5, "text", object()])
def test_an_adapter_that_gives_no_file_is_named(
    put: Put, logger, content: object, chart, refused
) -> None:
    source = put()
    logger.streams = lambda path, options: content
    assert "gave no native file" in refused(PluginError, source, chart())


def test_two_streams_of_one_name_are_the_fault_of_the_adapter(
    put: Put, make_stream, chart, refused
) -> None:
    twice = [make_stream("s", {n: [1.0, 2.0]}, rate=Fraction(1)) for n in ("laser", "x")]
    assert "gave two streams called 's'" in refused(PluginError, put(*twice), chart())


def test_every_file_is_closed_whatever_happens(put: Put, make_stream, chart, refused) -> None:
    closed: list[int] = []
    stream = make_stream("s", {"laser": [1.0, 2.0]}, rate=Fraction(100))
    source = put(stream, close=lambda: closed.append(1))
    read_native(source, chart())
    refused(InputError, source, chart(ChannelEntry("x", "height")))
    refused(InputError, source)
    assert closed == [1, 1, 1]
