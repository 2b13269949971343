"""Native samples into SI units: missing values, counters, scale, unit, sign, speed to distance."""

import numpy as np

from floatref.errors import InputError
from floatref.mapping.channel_map.entries import ChannelEntry
from floatref.mapping.channel_map.units import MPS, Unit, known_unit, unit_of
from floatref.values.arrays import FloatArray
from floatref.values.channels import channel_spec
from floatref.values.native import Column

DISTANCE = "distance"


class Conversion:
    """Turns successive samples of one native column into those of our channel.

    ``warnings`` has one warning for each fault of units and samples.
    """

    def __init__(self, entry: ChannelEntry, column: Column) -> None:
        """Settle the unit; InputError if it is unknown, missing or not that of the channel."""
        self.entry = entry
        self._column = column
        self.warnings: list[str] = []
        unit = self._unit()
        self.integrates = entry.channel == DISTANCE and unit.si == MPS
        self._factor = unit.factor * entry.sign
        self._check(unit)
        self._counter = _Counter(entry.wrap) if entry.wrap else None
        self._travelled = _Travelled()
        self._infinite = 0

    @property
    def unit(self) -> str:
        """The unit of native samples after scaling."""
        return self._column.unit if self.entry.unit is None else self.entry.unit

    def __call__(self, values: FloatArray, times_s: FloatArray) -> FloatArray:
        """Return ``values``, shape (n,), taken at ``times_s``, in SI units.

        Raises InputError for a counter beyond its wrap.
        """
        found = np.asarray(values, np.float64)
        for code in self.entry.missing:
            found = np.where(found == code, np.nan, found)
        found = self._finite(found)
        if self._counter is not None:
            found = self._counter(found)
        found = self._finite(self._scale(found))
        return self._travelled(found, times_s) if self.integrates else found

    def _scale(self, values: FloatArray) -> FloatArray:
        entry = self.entry
        if entry.scale == self._factor == 1 and entry.offset == 0:
            return values
        with np.errstate(over="ignore", invalid="ignore"):
            return np.asarray(self._factor * (entry.scale * values + entry.offset))

    def _finite(self, values: FloatArray) -> FloatArray:
        """Return ``values`` without infinities, which are counted."""
        with np.errstate(over="ignore", invalid="ignore"):
            if np.isfinite(values.sum()):
                return values
        wild = np.isinf(values)
        self._infinite += int(wild.sum())
        return np.where(wild, np.nan, values) if wild.any() else values

    def finish(self) -> None:
        """Add the warnings about the samples."""
        if self._infinite:
            self.warnings.append(f"{self._infinite} samples are infinite; taken as missing")
        if self.integrates:
            self.warnings.append("a speed, integrated into the distance")

    def _unit(self) -> Unit:
        stated, given = self.entry.unit, self._column.unit.strip()
        if stated is None and given == "":
            if channel_spec(self.entry.channel).unit == "1":
                return unit_of("1")
            raise InputError('the file gives no unit; state it in the map, such as unit = "mm"')
        found = unit_of(given if stated is None else stated)
        if stated is not None:
            self._compare(found, given)
        return found

    def _compare(self, stated: Unit, given: str) -> None:
        """Compare the stated unit with the file's own, where samples are not scaled first."""
        own = known_unit(given)
        if given == "" or own is None or own == stated or self.entry.scale != 1:
            return
        if own.si != stated.si and own.si != "1":
            raise InputError(
                f"the map says {self.entry.unit}, the file {given}; correct the map, or scale"
            )
        self.warnings.append(
            f"the file says unit {given}, the map {self.entry.unit}; the map counts"
        )

    def _check(self, unit: Unit) -> None:
        wanted = channel_spec(self.entry.channel).unit
        if unit.si == wanted or self.integrates:
            return
        advice = f"expected one of {wanted}"
        if unit.si == "1":
            advice = f'give scale, how many {wanted} one is, and unit = "{wanted}"'
        raise InputError(f"unit {self.unit!r} is not a unit of {self.entry.channel}; {advice}")


class _Counter:
    """A counter that starts again at ``wrap``, counted on."""

    def __init__(self, wrap: float) -> None:
        self._wrap, self._last, self._turns = wrap, np.nan, 0.0

    def __call__(self, counts: FloatArray) -> FloatArray:
        good = ~np.isnan(counts)
        known = counts[good]
        if not known.size:
            return counts
        if np.abs(known).max() > self._wrap:
            worst = known[np.abs(known).argmax()]
            raise InputError(f"wrap is {self._wrap:g}, but a sample is {worst:g}; correct wrap")
        before = known[0] if np.isnan(self._last) else self._last
        turns = self._turns - np.cumsum(np.rint(np.diff(known, prepend=before) / self._wrap))
        self._last, self._turns = known[-1], turns[-1]
        found = counts.copy()
        found[good] = known + turns * self._wrap
        return found


class _Travelled:
    """The distance by integrating a speed with the trapezoidal rule, which bridges gaps."""

    def __init__(self) -> None:
        self._speed, self._time, self._distance = np.nan, np.nan, 0.0

    def __call__(self, speed: FloatArray, times_s: FloatArray) -> FloatArray:
        good = ~np.isnan(speed)
        v, t = speed[good], times_s[good]
        found = np.full(speed.size, np.nan)
        if not v.size:
            return found
        if np.isnan(self._time):
            self._speed, self._time = v[0], t[0]
        steps = np.diff(t, prepend=self._time) * (v + np.append(self._speed, v[:-1])) / 2
        steps[0] += self._distance
        found[good] = np.cumsum(steps)
        self._speed, self._time, self._distance = v[-1], t[-1], float(found[good][-1])
        return found
