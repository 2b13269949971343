"""The sentences in a text log, with the fault of those that cannot be used.

By hand but for the checksum, for `NMEAStreamReader` of pynmea2 takes a line for one sentence, and a
receiver that is interrupted writes the next one behind it.
"""

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from floatref import read_start
from floatref_adapters.formats.nmea.day_count import read_time_of_day_ns
from floatref_adapters.formats.nmea.sentence_fields import LAYOUTS, Fields
from floatref_adapters.shared.refusals import library
from floatref_adapters.shared.text_lines import text_lines

SENTENCE = re.compile(r"[$!]([A-Za-z][A-Za-z0-9]{3,9})(,[^*$!]*)(?:(\*[0-9A-Fa-f]{2})(?!\w))?")
LONGEST = 1024
"""Characters of a sentence; the standard allows 82, makers write more."""
HEAD = 1 << 16
MOST_KINDS = 500


class Sentence(NamedTuple):
    """A sound sentence: its kind, which is its name without the talker, and its fields."""

    kind: str
    fields: Fields


class Sentences:
    """The sound sentences of ``source``.

    A wrong checksum drops a sentence. So does a missing one, unless the log has no checksums.
    ``InputError`` if pynmea2 is not installed.
    """

    def __init__(self, source: Path) -> None:
        self._source = source
        self._sum = library("pynmea2", f"{source}: reading NMEA 0183").NMEASentence.checksum
        head = read_start(source, HEAD).decode("latin-1")
        self.checked = any(self._sound(found) for found in SENTENCE.finditer(head))

    def read(self, faults: Counter[str]) -> Iterator[Sentence]:
        """Yield the sentences; ``faults`` counts what is dropped."""
        for line in text_lines(self._source):
            text = line.decode("latin-1")
            seen = False
            for found in SENTENCE.finditer(text):
                seen = True
                sentence = self._check(found, faults)
                if sentence is not None:
                    yield sentence
            if not seen:
                faults["broken" if "$" in text else "lines"] += 1

    def _check(self, found: re.Match[str], faults: Counter[str]) -> Sentence | None:
        kind = _kind(found)
        fields = found[2][1:].split(",")
        if found[3] is None and (self.checked or not _complete(kind, fields)):
            faults["unsummed" if self.checked else "broken"] += 1
        elif len(found[0]) > LONGEST:
            faults["broken"] += 1
        elif not self._sound(found, bare=True):
            faults["sum"] += 1
        else:
            if found[3] is None:
                faults["bare"] += 1
            return Sentence(kind, fields)
        return None

    def _sound(self, found: re.Match[str], bare: bool = False) -> bool:
        """Tell whether the checksum is right; without one, ``bare``."""
        if found[3] is None:
            return bare
        return int(found[3][1:], 16) == int(self._sum(found[1] + found[2]))


def _kind(found: re.Match[str]) -> str:
    name = found[1].upper()
    if name == "PASHR":
        first = found[2][1:].partition(",")[0]
        return (
            name if not first or read_time_of_day_ns(first) is not None else f"{name},{first[:8]}"
        )
    return name[2:] if len(name) == 5 and name[0] != "P" else name


def _complete(kind: str, fields: Fields) -> bool:
    return kind not in LAYOUTS or len(fields) >= LAYOUTS[kind].fewest
