"""GNSS logs of NMEA 0183 sentences: one stream per kind of sentence, whatever the talker.

Angles come in degrees with the sign of their hemisphere, heights in m. The clock is that of UTC,
from the date of RMC (while its status is A) or ZDA and the time of the day of each sentence; with
no date at all the day is unknown. A sentence without a time of its own (VTG, HDT) has that of
the last sentence before it that has one. Every other kind of sentence is listed with its count.
"""

import re
from array import array
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path

from floatref import Epoch, InputError, NativeClock, NativeFile, Rows, Stream, read_start
from floatref_adapters.formats.nmea.day_count import DAY_NS, DayCount, read_day, read_time_of_day_ns
from floatref_adapters.formats.nmea.sentence_fields import LAYOUTS, MOST, NotANumber, Quantity
from floatref_adapters.formats.nmea.sentences import MOST_KINDS, Sentence, Sentences
from floatref_adapters.shared.record_spool import Spool
from floatref_adapters.shared.row_pieces import pile_rows

HEAD = 1 << 13
TALKED = re.compile(rb"[$!][A-Z]{2}(?:GGA|GNS|RMC|VTG|GLL|ZDA|GST|GSA|GSV|HDT|VDM),|\$PASHR,")
NOVATEL = re.compile(rb"\xaaD[\x12\x13]|[#%][A-Z][A-Z0-9_]{2,31},[^;\r\n]{8,120};")
NAN = float("nan")
PADDING = ("",) * MOST
COARSEST = 10**6
"""ns of a tick, unless the times have more decimals."""
WARNINGS = {
    "sum": "sentences with a wrong checksum: dropped",
    "unsummed": "sentences without a checksum, which others have: dropped",
    "bare": "sentences without a checksum: taken as they are",
    "broken": "lines or sentences that are cut off or not valid: dropped",
    "lines": "lines without a sentence",
    "kinds": f"sentences of more than {MOST_KINDS} kinds: not listed",
    "leap": "times the date leaps; sentences in between have the day before",
}


class Nmea:
    """The adapter of such a log."""

    name = "nmea"
    summary = "GNSS log of NMEA 0183 sentences (GGA, RMC, VTG, GST, PASHR, ...)"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` begins with sentences, and has no NovAtel logs between them."""
        head = read_start(source, HEAD)
        return TALKED.search(head) is not None and NOVATEL.search(head) is None

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return what ``source`` holds, one stream per kind of sentence.

        Raises InputError in one line if there is no sound sentence, the file cannot be read or
        pynmea2 is not installed.
        """
        sentences = Sentences(source)
        survey = Survey(sentences)
        if not survey.counts:
            survey.close()
            raise InputError(f"{source}: no NMEA 0183 sentence that is sound; copy the log again")
        streams = (survey.stream(kind) for kind in sorted(survey.counts))
        return NativeFile(tuple(streams), warnings=survey.list_warnings(), close=survey.close)


class Survey:
    """What one pass over a log finds: the count of rows of each kind, the clock, the faults."""

    def __init__(self, sentences: Sentences) -> None:
        self.counts: Counter[str] = Counter()
        self._faults: Counter[str] = Counter()
        self._unit = COARSEST
        self._spool = Spool()
        self.close = self._spool.close
        days = DayCount(self._faults)
        for sentence in sentences.read(self._faults):
            self._count(sentence, _moment(sentence, days))
        self._first_day = days.first_day

    def _count(self, sentence: Sentence, moment: int | None) -> None:
        kind = sentence.kind
        if kind not in self.counts and len(self.counts) >= MOST_KINDS:
            self._faults["kinds"] += 1
            return
        self.counts[kind] += moment is not None
        if moment is None:
            self._faults[f"untimed {kind}"] += 1
            return
        self._spool.add(kind, moment, self._pack(sentence))
        while moment % self._unit:
            self._unit //= 10

    def _pack(self, sentence: Sentence) -> bytes:
        """Return the values of a sentence as float64, NaN where a field is no number."""
        values = array("d")
        fields = [*sentence.fields, *PADDING]
        for quantity in _quantities(sentence.kind):
            try:
                values.append(quantity.value(fields))
            except NotANumber:
                values.append(NAN)
                self._faults[f"text {sentence.kind}"] += 1
        return values.tobytes()

    def stream(self, kind: str) -> Stream:
        """Return the stream of the sentences of one kind."""
        columns = tuple(quantity.column for quantity in _quantities(kind))
        places = {column.name: place for place, column in enumerate(columns)}

        def read(names: Sequence[str]) -> Iterator[Rows]:
            return pile_rows(self._rows(kind, [places[name] for name in names]), names)

        return Stream(kind, columns, self.counts[kind], self._clock(), read)

    def _clock(self) -> NativeClock:
        tick = Fraction(self._unit, 10**9)
        if self._first_day is None:
            return NativeClock(tick_s=tick, epoch=Epoch.DAY, name="NMEA")
        origin = self._first_day * DAY_NS
        return NativeClock(tick_s=tick, epoch=Epoch.UTC, origin_ns=origin, name="NMEA")

    def _rows(self, kind: str, places: Sequence[int]) -> Iterator[tuple[int, Sequence[float]]]:
        for moment, packed in self._spool.records(kind):
            values = array("d", packed)
            yield moment // self._unit, [values[place] for place in places]

    def list_warnings(self) -> tuple[str, ...]:
        """Return one line for each kind of fault."""
        lines = [
            f"{n} {WARNINGS[what]}" for what, n in self._faults.items() if n and what in WARNINGS
        ]
        for what, n in self._faults.items():
            about, _, kind = what.partition(" ")
            if n and about == "untimed":
                lines.append(f"{kind}: {n} sentences without a time: dropped")
            elif n and about == "text":
                lines.append(f"{kind}: {n} values that are no number: missing")
            elif n and about == "back":
                lines.append(f"{kind}: time goes back {n} times")
        return tuple(lines)


def _moment(sentence: Sentence, days: DayCount) -> int | None:
    """Return the ns of a sentence; those without a time have the last one's, if there is one."""
    layout = LAYOUTS.get(sentence.kind)
    if layout is None or layout.time is None:
        return days.now_ns
    fields = sentence.fields
    time = read_time_of_day_ns(fields[layout.time]) if layout.time < len(fields) else None
    return None if time is None else days.moment(sentence.kind, time, _day(sentence))


def _day(sentence: Sentence) -> int | None:
    fields = sentence.fields
    if sentence.kind == "ZDA" and len(fields) >= 4:
        return read_day(*fields[1:4])
    if sentence.kind == "RMC" and len(fields) >= 9 and fields[1] == "A" and len(fields[8]) == 6:
        return read_day(fields[8][:2], fields[8][2:4], fields[8][4:])
    return None


def _quantities(kind: str) -> tuple[Quantity, ...]:
    return LAYOUTS[kind].quantities if kind in LAYOUTS else ()


__all__ = ["Nmea"]
