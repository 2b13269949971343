"""The data frames of a CAN log, read by python-can; everything else is counted.

Times of text logs are taken from the text itself, in whole ns; python-can has them as floats.
"""

import logging
import re
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from floatref_adapters.formats.can_log.blf import SoundBlf
from floatref_adapters.formats.can_log.log_formats import LATEST_NS, Format, require_format
from floatref_adapters.shared.refusals import library
from floatref_adapters.shared.text_lines import text_lines

STANDARD = 0x7FF
EXTENDED = 0x1FFFFFFF
LONGEST = 64
NEUTRAL = "no internal events logged\n"
"""A line that a reader may take for the end of a header; else it would take a frame."""
RELATIVE = re.compile(r"\s*base\s+\w+\s+timestamps\s+relative", re.IGNORECASE)
NOT_READ_BY_PYTHON_CAN = NotImplementedError
"""What python-can raises at a version of a log that it does not read: a name of Python, no task."""
TROUBLE: tuple[type[Exception], ...] = (
    ValueError,
    IndexError,
    TypeError,
    KeyError,
    AttributeError,
    ArithmeticError,
    NOT_READ_BY_PYTHON_CAN,
)
"""What python-can raises at a line that it cannot read."""


class Frame(NamedTuple):
    """A data frame: its time in ns, the name of its bus, "" if not in the log, id and data."""

    tick: int
    bus: str
    number: int
    extended: bool
    data: bytes


class Frames:
    """The data frames of ``source``.

    Raises InputError in one line if the log is of no format that is read, or python-can is not
    installed.
    """

    def __init__(self, source: Path) -> None:
        self._source = source
        self._format = require_format(source)
        self._make = getattr(_readers(source), self._format.reader)
        self.dated = self._format.dated

    def read(self, faults: Counter[str]) -> Iterator[Frame]:
        """Yield the frames; ``faults`` counts everything else."""
        for tick, message in self._messages(faults):
            fault = _fault(tick, message)
            if fault is not None:
                faults[fault] += 1
                continue
            bus = "" if message.channel is None else self._format.bus(message.channel)
            number, extended = message.arbitration_id, bool(message.is_extended_id)
            yield Frame(tick, bus, number, extended, bytes(message.data))

    def _messages(self, faults: Counter[str]) -> Iterator[tuple[int, Any]]:
        if self._format.reader == "BLFReader":
            return _of_blf(self._make, SoundBlf(self._source, faults))
        return _of_text(self._make, Lines(self._source, self._format), faults)


def _readers(source: Path) -> Any:
    readers = library("can.io", f"{source}: reading CAN logs")
    logging.getLogger("can").addHandler(logging.NullHandler())
    return readers


def _of_blf(make: Callable[[Any], Any], stream: SoundBlf) -> Iterator[tuple[int, Any]]:
    reader = make(stream)
    # Seconds since 1970 as a float would lose the ns.
    reader.start_timestamp = 0.0
    for message in reader:
        yield round(message.timestamp * 1e9), message


def _of_text(
    make: Callable[[Any], Any], lines: "Lines", faults: Counter[str]
) -> Iterator[tuple[int, Any]]:
    reader = lines.reader = make(lines)
    events = 0
    while not lines.ended:
        try:
            for message in reader:
                events += 1
                yield lines.tick if lines.timed else LATEST_NS, message
        except TROUBLE:
            faults["line"] += 1
            events += lines.timed
            lines.again()
    faults["overload"] += lines.overloads
    faults["event"] += max(lines.events - lines.overloads - events, 0)


class Lines:
    """The lines of a text log as the file that python-can reads, and the time of the last one."""

    def __init__(self, source: Path, form: Format) -> None:
        self._lines = text_lines(source)
        self._form = form
        self._waiting: str | None = None
        self._relative = False
        self._headed = form.reader != "ASCReader"
        self.reader: Any = None
        self.tick = 0
        self.timed = False
        self.ended = False
        self.events = 0
        self.overloads = 0

    def __iter__(self) -> "Lines":
        """Return itself."""
        return self

    def __next__(self) -> str:
        """Return the next line."""
        line, self._waiting = self._waiting, None
        if line is None:
            line = self._next()
        if line == NEUTRAL:
            return line
        time = self._form.time(line, self.reader)
        if time is not None and not self._headed:
            self._headed, self._waiting = True, line
            return NEUTRAL
        self._take(line, time)
        return line

    def _next(self) -> str:
        try:
            return next(self._lines).decode("latin-1") + "\n"
        except StopIteration:
            self.ended = True
            raise

    def _take(self, line: str, time: int | None) -> None:
        self.timed = time is not None
        if time is None:
            self._relative = self._relative or RELATIVE.match(line) is not None
            return
        self.events += 1
        self.overloads += "overload" in line[:60].lower()
        self.tick = self.tick + time if self._relative else time

    def close(self) -> None:
        """Close nothing: the lines close themselves."""

    def again(self) -> None:
        """Go on behind a line that python-can stumbled over."""
        self._waiting = NEUTRAL if self._form.headed else None


def _fault(tick: int, message: Any) -> str | None:
    """Return why a message is no sound data frame, None if it is one."""
    if message.is_error_frame:
        return "error"
    if message.is_remote_frame:
        return "remote"
    expected = message.dlc if message.is_fd else min(message.dlc, 8)
    if not expected <= len(message.data) <= LONGEST:
        return "cut"
    last = EXTENDED if message.is_extended_id else STANDARD
    sound = 0 <= message.arbitration_id <= last and abs(tick) < LATEST_NS
    return None if sound else "range"
