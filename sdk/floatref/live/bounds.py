"""How long the windows of a stream are, and so how late its final points: in metres and seconds.

A high-pass filter of third order at the wavelength λ forgets its start by exp(-π) in every λ, and
so does its backward pass the end of the run. After `SETTLED` = 3 of them 8e-5 is left: of a filter
that began 1 m off, 0.1 mm in waves as long as λ.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

TICK_S = 0.5
"""Time in s between two decisions, at whole multiples on the channels' time base."""
SETTLED = 3.0
"""Cut-off wavelengths, or periods, after which a filter has forgotten where it began."""
WAVELENGTH_M = 105.91
"""Cut-off wavelength in m of a pipeline without such a setting."""
CORE_M = 1609.344
"""Length in m from one joint to the next: a mile, ten sections of 0.1 mile."""
CORE_S = 180.0
"""Longest time in s from one joint to the next, for a vehicle that hardly moves."""
RUN_IN_S = RUN_OUT_S = 120.0
"""Longest run-in and run-out in s; a vehicle so slow does not go the metres."""
OVERDUE = 1.25
"""Share of the core after which a window ends where it is, though the vehicle is not steady."""
STANDS_S = 30.0
"""Standstill in s that ends a window."""
MOVES_M = 0.1
"""Travel in m that is no standstill."""
BEFORE_S = 10.0
"""Time in s before the vehicle moves again, at which the next window begins."""
LATE_S = 5.0
"""A channel this much behind another, in s, counts as missing for that time."""


@dataclass(frozen=True)
class Bounds:
    """Lengths of the windows of a stream.

    Attributes:
        core_m: from one joint to the next, in m.
        settle_m, settle_s: run-in before a core and run-out behind it, in m and s: both have to
            pass, but no more than `RUN_IN_S` and `RUN_OUT_S`.
        fade_m: length behind a joint over which one window passes into the next, in m.
        late_s: a channel this much behind another is missing, in s.
    """

    core_m: float = CORE_M
    settle_m: float = SETTLED * WAVELENGTH_M
    settle_s: float = 0.0
    fade_m: float = WAVELENGTH_M / 2.0
    late_s: float = LATE_S

    @classmethod
    def of(cls, settings: Mapping[str, Any], late_s: float = LATE_S) -> "Bounds":
        """Return the bounds of a pipeline with these ``settings``.

        A filter with a wavelength settles over distance, one with `collective_cutoff_hz` in time.
        """
        cutoff_hz = settings.get("collective_cutoff_hz")
        wavelength_m = settings.get("cutoff_wavelength_m") or WAVELENGTH_M
        return cls(
            settle_m=SETTLED * wavelength_m,
            settle_s=SETTLED / cutoff_hz if cutoff_hz else 0.0,
            fade_m=wavelength_m / 2.0,
            late_s=late_s,
        )

    @property
    def latency(self) -> "Latency":
        """When a point is final, counted from when the vehicle passed it."""
        after_m = OVERDUE * self.core_m + self.fade_m + self.settle_m
        waits_s = TICK_S + self.late_s
        longest_s = OVERDUE * CORE_S + RUN_OUT_S + waits_s
        return Latency(after_m, self.settle_s + waits_s, STANDS_S + waits_s, longest_s)

    @property
    def longest_s(self) -> float:
        """Longest time in s of which samples are held: a whole window, and channels in wait."""
        return RUN_IN_S + OVERDUE * CORE_S + RUN_OUT_S + TICK_S + self.late_s


@dataclass(frozen=True)
class Latency:
    """When a point is final: the first of three cases, and then the time that the engine takes.

    Attributes:
        travelled_m, then_s: the vehicle has gone so many metres, and then so many seconds passed.
        standing_s: the vehicle has been stationary for so many seconds.
        longest_s: so many seconds have passed, whatever the vehicle does.
        provisional_s: a provisional point is there after so many seconds; None without any.
    """

    travelled_m: float
    then_s: float
    standing_s: float
    longest_s: float
    provisional_s: float | None = None
