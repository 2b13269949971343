"""How the clocks of a run's streams are aligned with that of its accelerometer."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from math import hypot, sqrt

from floatref.errors import InputError
from floatref.files.sources import name_errors
from floatref.mapping.channel_map.column_names import find
from floatref.mapping.channel_map.entries import ChannelEntry, ClockEntry
from floatref.mapping.clocks.clock_keys import (
    ClockKey,
    Key,
    absolute,
    clock_key,
    name_clock,
    warn_of_beginning,
)
from floatref.mapping.clocks.columns import Taken
from floatref.mapping.clocks.epochs import between_epochs, passed, since_zero
from floatref.mapping.clocks.stream_clock import Aligned, Timed, alignment_report
from floatref.mapping.spool import Spool
from floatref.measures.clocks.clock_alignment import (
    Alignment,
    align_by_pps,
    align_by_pulses,
    align_by_time_readings,
)
from floatref.values.native import Epoch, NativeFile, Stream

Token = ChannelEntry | str
"""Purpose of a column: an entry of the map, or an alignment, by its own name."""
Places = Mapping[tuple[Key, Token], int]
"""Index of the column of a stream that was read for a token."""
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


def align_clocks(
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
            clock = clock_key(key, stream)
            zero = Fraction(0) if clock[2] is Epoch.LOCAL else Fraction(stream.start_s // 1)
            self._zeros[clock] = min(self._zeros.get(clock, zero), zero)

    def all(self) -> dict[Key, Aligned]:
        found: dict[Key, Aligned] = {}
        known: dict[tuple[ClockKey, ClockEntry | None], Alignment | None] = {}
        for key, stream in self._taken.items():
            entry, clock = self._entry(key), clock_key(key, stream)
            report, warnings = (
                None,
                warn_of_beginning(key, stream.stream) if self._has_no_entry(key, entry) else (),
            )
            if (clock, entry) not in known:
                with name_errors(f"clock of {name_clock(key)}"):
                    known[clock, entry] = alignment = self._alignment(key, entry)
                if alignment is not None:
                    report = alignment_report(key, entry, alignment)
                    warnings = tuple(
                        f"clock of {name_clock(key)}: {line}" for line in alignment.warnings
                    )
            found[key] = Aligned(
                stream, self._start(key), known[clock, entry], self._spool, report, warnings
            )
        return found

    def _has_no_entry(self, key: Key, entry: ClockEntry | None) -> bool:
        """Tell whether ``key`` is on the clock of the base and has no entry in the map."""
        same = clock_key(key, self._taken[key]) == clock_key(self._base, self._taken[self._base])
        return entry is None and same and key != self._base

    def _entry(self, key: Key) -> ClockEntry | None:
        named = {(e.file, e.stream): e for e in self._entries if e.align is not None}
        return named.get(key) or named.get((key[0], None))

    def _start(self, key: Key) -> Fraction:
        taken = self._taken[key]
        clock = clock_key(key, taken)
        if taken.stream.clock.rate is not None:
            return taken.start_s - self._zeros[clock]
        return passed(self._zeros[clock], taken.start_s, clock[2])

    def _alignment(self, key: Key, entry: ClockEntry | None) -> Alignment | None:
        clock, base = (clock_key(k, self._taken[k]) for k in (key, self._base))
        if entry is None:
            return None if clock == base else self._by_epochs(clock, base)
        if key == self._base or (clock == base and entry.stream is None):
            raise InputError(
                "is the clock of the accelerometer, the time base; align the others with it, "
                "each stream by its name"
            )
        return self._by_entry(key, entry, clock, base)

    def _by_entry(self, key: Key, entry: ClockEntry, clock: ClockKey, base: ClockKey) -> Alignment:
        if entry.align == "offset":
            return Alignment.from_offset(entry.offset_s, 1e-6 * entry.drift_ppm)
        if entry.align == "pulses":
            own = self._signal(key[0], entry.pulses, key)
            common = self._signal(self._base[0], entry.base_pulses)
            found = align_by_pulses(own.pulses(), common.pulses(), entry.offset_s)
            return _no_surer(found, hypot(own.step_s, common.step_s))
        if entry.base_time is not None:
            times, readings = self._signal(self._base[0], entry.base_time).readings()
            since, lines = since_zero(readings, float(self._zeros[clock]), clock[2])
            found = align_by_time_readings(times, since)
            return replace(found, warnings=(*lines, *found.warnings))
        if entry.base_pps is not None:
            dated = absolute(clock) and absolute(base)
            near = entry.offset_s + (self._by_epochs(clock, base).offset_s if dated else 0.0)
            seconds = self._signal(self._base[0], entry.base_pps)
            found = align_by_pps(seconds.pulses(), -near).inverse()
            line = (
                f"the pulses put it {found.offset_s - near:+.3f} s from where the absolute times "
                "of both clocks do; check that those are not a whole second apart"
            )
            found = replace(found, warnings=(*found.warnings, line) if dated else found.warnings)
            return _no_surer(found, seconds.step_s)
        return self._by_epochs(clock, base)

    def _by_epochs(self, clock: ClockKey, base: ClockKey) -> Alignment:
        """Align two clocks that both know the time of day."""
        if Epoch.LOCAL in (clock[2], base[2]):
            raise InputError(
                f"nothing aligns its {clock[2].value} time with the {base[2].value} time of the "
                'accelerometer; state how under [[clocks]] in the map, such as align = "offset"'
            )
        offset, warnings = between_epochs(
            (self._zeros[clock], clock[2]), (self._zeros[base], base[2])
        )
        return replace(Alignment.from_offset(float(offset)), warnings=warnings)

    def _signal(self, label: str, name: str | None, of: Key | None = None) -> Timed:
        """Return the channel ``name`` of a file, on the clock of stream ``of`` or the base."""
        place, at = next(
            (place, at)
            for (place, token), at in self._places.items()
            if place[0] == label and isinstance(token, str) and name in _names(place, token)
        )
        self._check_clock(place, str(name), of)
        taken = self._taken[place]
        return Timed(taken.columns[at], Aligned(taken, self._start(place), None, self._spool))

    def _check_clock(self, place: Key, name: str, of: Key | None) -> None:
        """Refuse pulses and readings that are not on the clock that they align."""
        owner = self._base if of is None else of
        fits = clock_key(place, self._taken[place]) == clock_key(owner, self._taken[owner])
        if of is None and (not fits or self._entry(place) is not None):
            raise InputError(f"{name} is not on the clock of the accelerometer; map one that is")
        if of is not None and (not fits or place == self._base):
            raise InputError(f"{name} is not on this clock; give the pulses that it timed")


def _no_surer(alignment: Alignment, step_s: float) -> Alignment:
    """Return ``alignment`` with at least the drift's uncertainty of edges ``step_s`` apart.

    An edge lies anywhere within its step, and the pulses anywhere between the first and the last.
    """
    begin, end = alignment.between_s
    if alignment.pairs < 2 or not end > begin:
        return alignment
    floor = step_s / ((end - begin) * sqrt(alignment.pairs))
    return replace(alignment, drift_sigma=hypot(alignment.drift_sigma, floor))


def _names(place: Key, column: str) -> tuple[str, str]:
    return column, f"{place[1]}/{column}"
