"""How the clocks of a run's streams are aligned with that of its accelerometer."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from math import hypot, sqrt
from typing import Any

from floatref.errors import InputError
from floatref.mapping.aligned import Aligned
from floatref.mapping.entries import SOURCE, ChannelEntry, ClockEntry
from floatref.mapping.epochs import between_epochs
from floatref.mapping.naming import find
from floatref.mapping.spool import Spool
from floatref.mapping.taking import UNKNOWN, Taken
from floatref.mapping.timed import Timed
from floatref.measures.clock_alignment import (
    Alignment,
    align_by_pps,
    align_by_pulses,
    align_by_time_readings,
)
from floatref.values.arrays import FloatArray
from floatref.values.native import Epoch, NativeFile, Stream

Key = tuple[str, str]
"""Label of a file, and name of a stream in it."""
Token = ChannelEntry | str
"""What a column was taken for: an entry of the map, or an alignment, by its own name."""
Places = Mapping[tuple[Key, Token], int]
"""Where in what was taken of a stream the samples for a token are."""
ClockKey = tuple[str, str, Epoch]
"""Label of a file, name of a clock in it, and its epoch."""
DAY_S, WEEK_S = 86_400, 604_800
OWN, BASE = ("pulses",), ("base_pulses", "base_time", "base_pps")


def auxiliaries(
    entries: Sequence[ClockEntry], base: str, file: Callable[[str], NativeFile]
) -> Iterator[tuple[Key, Stream, str]]:
    """Yield stream and column of every channel that ``entries`` align by.

    Those of the base clock are in the file labelled ``base``. Raises InputError for a name that
    is not there.
    """
    for entry in entries:
        for keys, label in ((OWN, entry.file), (BASE, base)):
            for key in keys:
                name = getattr(entry, key)
                if name is not None:
                    stream, column = find(file(label), name)
                    yield (label, stream.name), stream, column.name


def aligned_clocks(
    taken: Mapping[Key, Taken],
    places: Places,
    entries: Sequence[ClockEntry],
    base: Key,
    spool: Spool,
) -> dict[Key, Aligned]:
    """Return the clock of every stream in ``taken`` on the time base of stream ``base``.

    Raises InputError for a clock that nothing aligns, and where pulses or readings do not.
    """
    return _Aligning(taken, places, entries, base, spool).all()


class _Aligning:
    """The clocks of one run."""

    def __init__(
        self,
        taken: Mapping[Key, Taken],
        places: Places,
        entries: Sequence[ClockEntry],
        base: Key,
        spool: Spool,
    ) -> None:
        self._taken, self._places, self._entries = taken, places, entries
        self._base, self._spool = base, spool
        self._zeros: dict[ClockKey, Fraction] = {}
        for key, stream in taken.items():
            clock = _clock_key(key, stream)
            zero = Fraction(0) if clock[2] is Epoch.LOCAL else Fraction(stream.start_s // 1)
            self._zeros[clock] = min(self._zeros.get(clock, zero), zero)

    def all(self) -> dict[Key, Aligned]:
        found: dict[Key, Aligned] = {}
        known: dict[tuple[ClockKey, ClockEntry | None], Alignment | None] = {}
        for key, stream in self._taken.items():
            entry, clock = self._entry(key), _clock_key(key, stream)
            new = (clock, entry) not in known
            if new:
                known[clock, entry] = self._alignment(key, entry)
            alignment = known[clock, entry]
            report = _report(key, entry, alignment) if new and alignment is not None else None
            found[key] = Aligned(stream, self._start(key), alignment, self._spool, report)
        return found

    def _entry(self, key: Key) -> ClockEntry | None:
        named = {(e.file, e.stream): e for e in self._entries if e.align is not None}
        return named.get(key) or named.get((key[0], None))

    def _start(self, key: Key) -> Fraction:
        return self._taken[key].start_s - self._zeros[_clock_key(key, self._taken[key])]

    def _alignment(self, key: Key, entry: ClockEntry | None) -> Alignment | None:
        clock, base = (_clock_key(k, self._taken[k]) for k in (key, self._base))
        if entry is None:
            return None if clock == base else self._by_epochs(clock, base)
        if clock == base:
            raise InputError(
                f"clock of {_said(key)}: is the clock of the accelerometer, the time base; "
                "align the others with it"
            )
        try:
            return self._by_entry(key, entry, clock, base)
        except InputError as error:
            raise InputError(f"clock of {_said(key)}: {error}") from error

    def _by_entry(self, key: Key, entry: ClockEntry, clock: ClockKey, base: ClockKey) -> Alignment:
        if entry.align == "offset":
            return Alignment.stated(entry.offset_s, 1e-6 * entry.drift_ppm)
        if entry.align == "pulses":
            own, common = self._signal(key, entry.pulses), self._signal(None, entry.base_pulses)
            found = align_by_pulses(own.pulses(), common.pulses(), entry.offset_s)
            return _no_surer(found, hypot(own.step_s, common.step_s))
        if entry.base_time is not None:
            times, readings = self._signal(None, entry.base_time).readings()
            return align_by_time_readings(times, self._unrolled(readings, clock))
        if entry.base_pps is not None:
            near = entry.offset_s
            if _absolute(clock) and _absolute(base):
                near += self._by_epochs(clock, base).offset_s
            seconds = self._signal(None, entry.base_pps)
            found = align_by_pps(seconds.pulses(), -near).inverse()
            return _no_surer(found, seconds.step_s)
        return self._by_epochs(clock, base)

    def _by_epochs(self, clock: ClockKey, base: ClockKey) -> Alignment:
        """Align two clocks that both know the time of day."""
        if Epoch.LOCAL in (clock[2], base[2]):
            raise InputError(
                f"clock of {_said((clock[0], clock[1]))}: nothing aligns its {clock[2].value} "
                f"time with the {base[2].value} time of the accelerometer; state how under "
                '[[clocks]] in the map, such as align = "offset"'
            )
        offset, told = between_epochs((self._zeros[clock], clock[2]), (self._zeros[base], base[2]))
        return replace(Alignment.stated(float(offset)), told=told)

    def _signal(self, key: Key | None, name: str | None) -> Timed:
        """Return the channel called ``name``, of the base clock if ``key`` is None."""
        label = self._base[0] if key is None else key[0]
        place, at = next(
            (place, at)
            for (place, token), at in self._places.items()
            if place[0] == label and isinstance(token, str) and name in _names(place, token)
        )
        if key is None:
            self._check_base(place, str(name))
        taken = self._taken[place]
        return Timed(taken.columns[at], Aligned(taken, self._start(place), None, self._spool))

    def _check_base(self, place: Key, name: str) -> None:
        ours = _clock_key(self._base, self._taken[self._base])
        if _clock_key(place, self._taken[place]) != ours:
            raise InputError(f"{name} is not on the clock of the accelerometer; map one that is")

    def _unrolled(self, readings: FloatArray, clock: ClockKey) -> FloatArray:
        """Return time readings as s after the zero of ``clock``: of the day, the week, or whole."""
        if clock[2] is Epoch.LOCAL:
            return readings
        zero = float(self._zeros[clock])
        period = WEEK_S if clock[2] is Epoch.GPS else DAY_S
        if not readings.size or abs(readings[0] - zero) <= WEEK_S / 2:
            return readings - zero
        turns = round((zero - float(readings[0])) / period)
        return readings + turns * period - zero


def _no_surer(alignment: Alignment, step_s: float) -> Alignment:
    """Return ``alignment`` with a drift no surer than edges between samples ``step_s`` apart are.

    An edge lies anywhere within its step, and the pulses anywhere between the first and the last.
    """
    begin, end = alignment.between_s
    if alignment.pairs < 2 or not end > begin:
        return alignment
    floor = step_s / ((end - begin) * sqrt(alignment.pairs))
    return replace(alignment, drift_sigma=hypot(alignment.drift_sigma, floor))


def _clock_key(key: Key, taken: Taken) -> ClockKey:
    clock = taken.stream.clock
    name = f"{UNKNOWN} {key[1]}" if clock.name == UNKNOWN else clock.name
    return key[0], name, clock.epoch


def _names(place: Key, column: str) -> tuple[str, str]:
    return column, f"{place[1]}/{column}"


def _absolute(clock: ClockKey) -> bool:
    return clock[2] is not Epoch.LOCAL


def _said(key: Key) -> str:
    file = "the source" if key[0] == SOURCE else key[0]
    return f"{file}, {key[1]}" if key[1] else file


def _report(key: Key, entry: ClockEntry | None, alignment: Alignment) -> dict[str, Any]:
    return {
        "file": key[0],
        "stream": key[1],
        "align": entry.align if entry is not None else "epoch",
        "offset_s": alignment.offset_s,
        "drift_ppm": 1e6 * alignment.drift,
        "drift_sigma_ppm": 1e6 * alignment.drift_sigma,
        "residual_s": alignment.residual_s,
        "pairs": alignment.pairs,
    }
