"""Aligning clocks (4.4): t_base = offset + (1 + drift)·t_own, from pulses or time readings.

Times are in s from each clock's own zero. Offsets between epochs that lie decades apart are kept
at the pulses, not at zero, so that a drift loses no precision.
"""

from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.measures.clocks.clock_line import ClockLine, clock_line, curve, lower_line
from floatref.measures.clocks.gnss_time import reading_edges
from floatref.measures.clocks.pulse_matching import match_pulses
from floatref.values.arrays import FloatArray

FAR_S = 30.0
"""Time in s beyond the first and the last pulse from which a warning is given."""
STRANGE_DRIFT = 5e-4
"""Largest drift of a recorder's clock, as a ratio."""
PPS_SHARE = 0.5
"""Least share of pulses per second that are a whole second apart."""
LONGEST_PPS_S = 1e6
"""Pulses per second are matched over this time at most."""


@dataclass(frozen=True, eq=False)
class Alignment:
    """How the times of one clock become those of the base clock.

    Attributes:
        offset_s: base time at the zero of the own clock, on the straight line.
        drift: the ratio of base to own time, less 1.
        drift_sigma: its standard deviation; NaN where it is unknown.
        residual_s: root mean square of the residuals, in s; NaN where it is unknown.
        pairs: how many pulses or readings the line goes through.
        dropped: how many had no partner or were outliers.
        warnings: warnings, one line each.
        about_s: an own time and the base time at that moment, on the line.
        between_s: own times of the first and the last pulse or reading.
        late_s: largest delay of base times in s that the pulses cannot show.
        knots_s: own and base times between which the alignment is linear, if drift is not constant.
    """

    offset_s: float
    drift: float = 0.0
    drift_sigma: float = np.nan
    residual_s: float = np.nan
    pairs: int = 0
    dropped: int = 0
    warnings: tuple[str, ...] = ()
    about_s: tuple[float, float] = (0.0, 0.0)
    between_s: tuple[float, float] = (-np.inf, np.inf)
    late_s: float = 0.0
    knots_s: tuple[FloatArray, FloatArray] | None = None

    @classmethod
    def from_offset(cls, offset_s: float, drift: float = 0.0) -> "Alignment":
        """Return the alignment stated by the user; InputError unless it is finite."""
        if not (np.isfinite(offset_s) and abs(drift) < 0.1):
            raise InputError(f"offset {offset_s} s with a drift of {drift}; state finite ones")
        return cls(offset_s, drift, about_s=(0.0, offset_s))

    @property
    def uniform(self) -> bool:
        """Whether evenly spaced samples stay evenly spaced."""
        return self.knots_s is None

    def to_base(self, times_s: FloatArray) -> FloatArray:
        """Return the base times of own ``times_s``, of any shape; order is kept."""
        own = np.asarray(times_s, dtype=np.float64)
        straight = self._straight(own)
        if self.knots_s is None:
            return straight
        at, to = self.knots_s
        # Beyond the knots the straight line goes on from where they end.
        return np.asarray(straight + np.interp(own, at, to - self._straight(at)))

    def inverse(self) -> "Alignment":
        """Return how base times become own ones."""
        speed = 1.0 + self.drift
        own, base = self.about_s
        ends = self.to_base(np.array(self.between_s))
        return replace(
            self,
            offset_s=-self.offset_s / speed,
            drift=-self.drift / speed,
            drift_sigma=self.drift_sigma / speed**2,
            residual_s=self.residual_s / speed,
            about_s=(base, own),
            between_s=(float(ends[0]), float(ends[1])),
            late_s=-self.late_s / speed,
            knots_s=None if self.knots_s is None else (self.knots_s[1], self.knots_s[0]),
        )

    def rate(self, rate_hz: float) -> float:
        """Return in base time the rate of samples that have ``rate_hz`` in own time, in Hz."""
        return rate_hz / (1.0 + self.drift)

    def beyond(self, begin_s: float, end_s: float) -> str | None:
        """Return a line if own times from ``begin_s`` to ``end_s`` reach far beyond the pulses."""
        before, after = self.between_s[0] - begin_s, end_s - self.between_s[1]
        if max(before, after) <= FAR_S:
            return None
        sides = [f"{x:.4g} s {w}" for x, w in ((before, "before"), (after, "behind")) if x > FAR_S]
        unsure = max(before, after) * self.drift_sigma
        by = f", to ± {1e3 * unsure:.2g} ms by its drift (1 σ)" if unsure > 0 else ""
        return f"the alignment is extrapolated to {' and '.join(sides)} the common pulses{by}"

    def _straight(self, own: FloatArray) -> FloatArray:
        since = own - self.about_s[0]
        return np.asarray(self.about_s[1] + since + self.drift * since)


def align_by_pulses(own_s: FloatArray, base_s: FloatArray, near_s: float = 0.0) -> Alignment:
    """Return the alignment by pulses that both clocks have timed, at ``own_s`` and ``base_s``.

    Pulses of either may be missing or false. ``near_s`` is about what base time less own time
    is, to within 0.4 of a period where the pulses are periodic. One common pulse gives the offset
    alone. Where the drift is not constant the alignment is linear between the pulses. Raises
    InputError if the trains are empty, have nothing in common, or fit equally well in two places.
    Source: section 4.4.
    """
    own, base = (np.asarray(x, dtype=np.float64) for x in (own_s, base_s))
    matched = match_pulses(own, base, near_s)
    at, to = own[matched.own], base[matched.base]
    line = clock_line(at, to)
    return _align(line, at, to, own.size - int(line.kept.sum()), matched.warnings)


def align_by_pps(pulses_s: FloatArray, near_s: float) -> Alignment:
    """Return the alignment to GNSS time of the clock that timed a receiver's pulses per second.

    ``pulses_s`` increase, in s of that clock; each is a whole GNSS second. ``near_s`` is about
    what GNSS time less the clock's time is when the pulses begin, to within 0.4 s. Raises
    InputError if it lies halfway between two seconds, or if the pulses are not a second apart.
    """
    pulses = np.asarray(pulses_s, dtype=np.float64)
    if pulses.size and not np.ptp(pulses) < LONGEST_PPS_S:
        raise InputError(f"pulses per second over {np.ptp(pulses):.4g} s; give times in s")
    seconds = pulses[:0]
    if pulses.size:
        first, last = np.floor(pulses[0] + near_s), np.ceil(pulses[-1] + near_s)
        seconds = np.arange(first - 3.0, last + 4.0 + 3e-4 * (last - first))
    found = align_by_pulses(pulses, seconds, near_s)
    if found.pairs < PPS_SHARE * pulses.size:
        raise InputError(
            f"of {pulses.size} pulses only {found.pairs} are whole seconds apart; "
            "name the channel of the receiver's pulse per second"
        )
    return replace(found, warnings=found.warnings[1:] if found.warnings else ())


def align_by_time_readings(base_s: FloatArray, gnss_s: FloatArray) -> Alignment:
    """Return the alignment of GNSS time to base time, from readings that the base clock stamped.

    ``gnss_s``, shape (n,), is the GNSS time in s of the day or of the week that was read at
    ``base_s``: repeated between updates, NaN where it is missing. It may roll over. The first
    sample of every new reading counts, and of these the least delayed ones determine the line. A
    delay that all readings share remains, up to ``late_s``. Raises InputError unless two readings
    or more advance as time does. Source: section 4.4.
    """
    edges = reading_edges(base_s, gnss_s)
    rough = clock_line(edges.gnss_s, edges.base_s)
    at, to = edges.gnss_s[rough.kept], edges.base_s[rough.kept]
    if at.size < 2:
        raise InputError("fewer than two readings of GNSS time advance with time; check its unit")
    base, drift = lower_line(at, to)
    middle = float(at.mean())
    warnings = (
        f"base times may be late by up to {edges.update_s:.3g} s: how old a reading of GNSS time "
        "is when it is recorded is not known; state a delay, or use pulses",
    )
    return Alignment(
        base - middle * (1 + drift),
        drift,
        rough.drift_sigma,
        rough.residual_s,
        int(at.size),
        edges.dropped + int((~rough.kept).sum()),
        warnings,
        (middle, base),
        (float(at[0]), float(at[-1])),
        edges.update_s,
    )


def _align(
    line: ClockLine, own: FloatArray, base: FloatArray, dropped: int, warnings: tuple[str, ...]
) -> Alignment:
    """Return the alignment by a line through the accepted pairs of ``own`` and ``base``."""
    at, to = own[line.kept], base[line.kept]
    lines = list(warnings)
    if at.size < 3 and abs(line.drift) > STRANGE_DRIFT:
        line = line._replace(drift=0.0, drift_sigma=np.nan)
    if at.size < 3:
        lines.append(f"{at.size} common pulse(s): the drift is {1e6 * line.drift:.3g} ppm unproved")
    bent = curve(line, at, to)
    if bent is not None:
        lines.append(
            "the drift is not constant: a straight line has residuals of "
            f"{1e3 * line.residual_s:.3g} ms, so the alignment is linear between the pulses"
        )
    return Alignment(
        line.base_s - line.own_s * (1 + line.drift),
        line.drift,
        line.drift_sigma,
        line.residual_s,
        int(at.size),
        dropped,
        tuple(lines),
        (line.own_s, line.base_s),
        (float(at[0]), float(at[-1])),
        knots_s=None if bent is None else (at, bent),
    )
