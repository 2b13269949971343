"""3.3.5.3 Effects on Short-Interval Roughness Profiles: altered passes (Tables 3.7 to 3.9)."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_3_roughness_profiles import (
    BASE_LENGTH,
    short_interval_roughness,
)
from floatref_reference.signals import Real, Signal, samples, signal

INCREASE = 1.0
"""Rise of the short-interval roughness above which it is a localized increase, m/km."""
SPEEDS_3_7, SPEEDS_3_8 = (48.0, 24.0), (72.0, 32.0)
"""From and to which speed the passes of Table 3.7, and of Tables 3.8 and 3.9, braked, km/h."""


class Group(NamedTuple):
    """A row of Tables 3.7 to 3.9.

    Args:
        low: lowest deceleration of the group, g.
        high: highest, g.
        passes: number of passes.
        altered: how many of them altered the short-interval roughness profile.
        localized: how many increased it by 1 m/km or more.
    """

    low: float
    high: float
    passes: int
    altered: int
    localized: int


TABLE_3_7_PEAK = (
    Group(0.09, 0.16, 23, 4, 1),
    Group(0.18, 0.25, 16, 12, 5),
    Group(0.26, 0.43, 25, 23, 16),
)
"""Table 3.7, by peak deceleration."""
TABLE_3_7_AVERAGE = (
    Group(0.05, 0.13, 23, 4, 1),
    Group(0.16, 0.20, 16, 12, 5),
    Group(0.22, 0.40, 25, 23, 16),
)
"""Table 3.7, the same passes by average deceleration."""
TABLE_3_8 = (
    Group(0.04, 0.16, 26, 5, 0),
    Group(0.17, 0.23, 26, 11, 4),
    Group(0.24, 0.35, 23, 16, 12),
)
"""Table 3.8, by average deceleration."""
TABLE_3_9 = (
    Group(0.07, 0.21, 30, 6, 0),
    Group(0.22, 0.28, 21, 11, 4),
    Group(0.29, 0.48, 24, 15, 12),
)
"""Table 3.9, by peak deceleration."""


class Alteration(NamedTuple):
    """What a pass changed, places counted from the end of braking and positive past it.

    Args:
        case: 1 to 4 of section 3.3.5.3: additional, moved, decreased or unchanged roughness.
        increase: greatest rise of the short-interval roughness, m/km.
        peak: where that is, m.
        begin: first place of a change, m; NaN if there is no change.
        end: last place of a change, m; NaN if there is no change.
    """

    case: int
    increase: np.longdouble
    peak: np.longdouble
    begin: np.longdouble
    end: np.longdouble

    @property
    def altered(self) -> bool:
        """Whether the pass counts as altered: cases 1, 2 and 3 (Tables 3.7 to 3.9)."""
        return self.case < 4

    @property
    def localized(self) -> bool:
        """Whether it counts as a localized increase (Tables 3.7 to 3.9)."""
        return bool(self.increase >= INCREASE)


def change(z: npt.ArrayLike, z_ref: npt.ArrayLike, dx: float) -> Signal:
    """Compare the short-interval roughness of a pass with that of a pass at constant speed.

    Equation:
        Section 3.3.5.3: difference of both short-interval roughness profiles (2.1.3).

    Args:
        z: elevation measured with a brake or stop, m, shape (N,).
        z_ref: elevation measured at constant speed at the same places, m, shape (N,).
        dx: constant interval Δx, m.

    Returns:
        Change of roughness, m/km, shape (N-1,).
    """
    return short_interval_roughness(z, dx) - short_interval_roughness(z_ref, dx)


def alteration(
    delta: npt.ArrayLike, dx: float, release: Real, threshold: float, base: float = BASE_LENGTH
) -> Alteration:
    """Sort a pass into one of four cases, and find where it changed.

    Equation:
        Section 3.3.5.3, where passes were "inspected". What counts as a change is a threshold here.
        Rises and falls together are case 2 if their areas differ by less than the threshold over
        one base length; if by more, the larger one decides.

    Args:
        delta: change of roughness, m/km, shape (N,).
        dx: constant interval Δx, m.
        release: where the brake was released, m from the first sample.
        threshold: smallest change that counts, m/km; print has no figure for it.
        base: base length of the roughness profile, m.

    Returns:
        Case, increase and places.
    """
    d_k = signal(samples(delta))
    rises, falls = d_k > threshold, d_k < -threshold
    net = np.sum(d_k[rises | falls]) * np.longdouble(dx)
    at = (np.arange(len(d_k)) * np.longdouble(dx)) - np.longdouble(release)
    places = at[rises | falls]
    ends = (places[0], places[-1]) if len(places) else (np.longdouble(np.nan),) * 2
    case = _case(bool(rises.any()), bool(falls.any()), float(net) / base / threshold)
    return Alteration(case, max(d_k.max(), np.longdouble(0)), at[d_k.argmax()], *ends)


def _case(rises: bool, falls: bool, net: float) -> int:
    """Return the case, ``net`` in thresholds over a base length."""
    if not (rises or falls):
        return 4
    if rises and falls and abs(net) < 1:
        return 2
    return 1 if net > 0 else 3


def grouped(
    decelerations: Sequence[float],
    passes: Sequence[Alteration],
    ranges: Sequence[tuple[float, float]],
) -> tuple[Group, ...]:
    """Count altered and increased passes by deceleration.

    Equation:
        Tables 3.7 to 3.9. A deceleration counts in the group whose range, both ends in it, holds
        it when rounded to two digits.

    Args:
        decelerations: average or peak deceleration of each pass, g.
        passes: what each pass altered.
        ranges: lowest and highest deceleration of each group, g.

    Returns:
        One row per range.
    """
    rows = []
    for low, high in ranges:
        found = [
            p for a, p in zip(decelerations, passes, strict=True) if low <= round(a, 2) <= high
        ]
        altered, localized = (
            sum(getattr(p, name) for p in found) for name in ("altered", "localized")
        )
        rows.append(Group(low, high, len(found), altered, localized))
    return tuple(rows)


def increase_of_iri(
    increase: Real, length: Real = 160.9, base: Real = BASE_LENGTH
) -> np.longdouble:
    """Spread a localized increase over a road segment.

    Equation:
        Section 3.3.5.3: 1 m/km over one base length raises the IRI of 160.9 m by 0.05 m/km.

    Args:
        increase: of the short-interval roughness, m/km.
        length: of the segment, m.
        base: base length of the roughness profile, m.

    Returns:
        Rise of the IRI, m/km.
    """
    return np.longdouble(increase) * np.longdouble(base) / np.longdouble(length)
