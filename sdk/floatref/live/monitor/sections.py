"""The IRI of sections of 0.1 mile, as the points of a stream come, in memory that does not grow.

The quarter car remembers some 20 m of road, and what it began with is e⁻¹ after 10 m. So a section
needs few points before it: the three sections held suffice for all digits, and where a stretch of
valid points begins in them the figure is that of the whole profile.
"""

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.live.points import LivePoints, missing_points
from floatref.measures.roughness.iri_interval import NORMAL_95, iri_interval
from floatref.measures.roughness.iri_settings import LONGEST_INTERVAL_M
from floatref.measures.roughness.roughness_index import SHORTEST_PART, STANDARD
from floatref.measures.valid_segments import trace_of_valid
from floatref.values.profile import ProfileTrack

SECTION_M = 160.9344
"""Length of a section in m, 0.1 mile."""
BEFORE = 3
"""Sections that are held before the present one."""
SHOWN = 24
"""Finished sections that are held."""


@dataclass(frozen=True)
class TrackFigures:
    """A section of one wheel path.

    Attributes:
        name: of the wheel path.
        iri_m_per_km: mean over stretches of valid points, NaN without any.
        sigma_m_per_km: 1-σ of that, from the 1-σ of the elevation; NaN where not known.
        counted_share: share of the section that the mean is over, 0 to 1.
    """

    name: str
    iri_m_per_km: float
    sigma_m_per_km: float
    counted_share: float


@dataclass(frozen=True)
class Section:
    """A section from ``start_m``, ``length_m`` long so far, in m on the axis of distance.

    Attributes:
        start_m, length_m: in m.
        tracks: figures of every wheel path.
        is_final: whether its points never change.
        is_running: whether it still grows.
    """

    start_m: float
    length_m: float
    tracks: tuple[TrackFigures, ...]
    is_final: bool
    is_running: bool = False


class Sections:
    """Takes points in order and measures section after section.

    Attributes:
        origin: number of the point at which sections begin; None before the first.
        finished: the last `SHOWN` sections that are complete.
        end: number of the point behind the last one; None before the first.
    """

    def __init__(self, is_final: bool) -> None:
        """Begin without points; ``is_final`` is that of the sections."""
        self._is_final = is_final
        self.origin: int | None = None
        self.finished: deque[Section] = deque(maxlen=SHOWN)
        self.end: int | None = None
        self._first = self._number = 0
        self._interval_m = 1.0
        self._tracks: tuple[ProfileTrack, ...] = ()

    def begin(self, origin: int, number: int) -> None:
        """Measure from section ``number`` on, section 0 of which begins at point ``origin``."""
        self.origin, self._number = origin, number

    def realign(self, origin: int) -> None:
        """Let sections begin at ``origin``: the present one begins at the next edge."""
        if self.origin in (None, origin):
            self.origin = origin
            return
        start = self._edge(self._number)
        self.origin = origin
        self._number = max(int((start - origin) * self._interval_m / SECTION_M) - 1, 0)
        while self._edge(self._number) < start:
            self._number += 1

    def add(self, points: LivePoints) -> None:
        """Take ``points``; those that came before are left out, and a gap has missing points."""
        if points.interval_m > LONGEST_INTERVAL_M:
            return
        self._interval_m = points.interval_m
        if self.origin is None:
            self.origin = points.first
        if self.end is None:
            self._first = self.end = points.first
            before = int((points.first - self.origin) * points.interval_m / SECTION_M) - 1
            self._number = max(self._number, before)
            while self._edge(self._number + 1) <= points.first:
                self._number += 1
        skipped = max(self.end - points.first, 0)
        if skipped < len(points):
            self._bridge(points, points.first + skipped)
            self._append(_cut(points.tracks, skipped, len(points)))
            self._measure()

    def running(self) -> Section | None:
        """Return the section that still grows; None while it is empty."""
        if self.origin is None or self.end is None:
            return None
        start = self._edge(self._number)
        return None if self.end - start < 2 else self._section(start, self.end - 1, True)

    def close(self) -> None:
        """Finish the last section; one shorter than a tenth joins the one before."""
        last = self.running()
        if last is None:
            return
        start = self._edge(self._number)
        assert self.end is not None
        if self.finished and last.length_m < SHORTEST_PART * SECTION_M * (1.0 - 1e-9):
            self.finished.pop()
            start = self._edge(self._number - 1)
        self.finished.append(self._section(start, self.end - 1, False))
        self._number += 1

    @property
    def held(self) -> int:
        """Number of points in memory."""
        return 0 if self.end is None else self.end - self._first

    def _edge(self, number: int) -> int:
        assert self.origin is not None
        return self.origin + round(number * SECTION_M / self._interval_m)

    def _bridge(self, points: LivePoints, first: int) -> None:
        """Hold missing points up to ``first``; of a long gap, its first and last sections alone."""
        assert self.origin is not None
        assert self.end is not None
        names = [track.name for track in points.tracks]
        if first - self.end > (BEFORE + 1) * SECTION_M / self._interval_m:
            ends = self._edge(self._number + 1) + self._after() + 1
            self._append(missing_points(names, max(ends - self.end, 1)))
            self._measure()
            number = int((first - self.origin) * self._interval_m / SECTION_M) - 1
            self._number = max(number, self._number)
            self._first = self.end = max(self._edge(self._number), self.end)
            self._tracks = ()
        if first > self.end:
            self._append(missing_points(names, first - self.end))

    def _append(self, tracks: tuple[ProfileTrack, ...]) -> None:
        assert self.end is not None
        self.end += tracks[0].elevation.size
        self._tracks = (
            tuple(map(_join, self._tracks, tracks)) if self._tracks else tuple(map(_known, tracks))
        )

    def _measure(self) -> None:
        """Measure the sections that are complete, and drop what no other needs."""
        assert self.end is not None
        while self.end - self._after() > self._edge(self._number + 1):
            start, end = self._edge(self._number), self._edge(self._number + 1)
            self.finished.append(self._section(start, end, False))
            self._number += 1
        needed = self._edge(max(self._number - BEFORE, 0))
        dropped = min(needed - self._first, self.held - 1)
        if dropped > 0:
            self._tracks = tuple(map(_copy, _cut(self._tracks, dropped, self.held)))
            self._first += dropped

    def _after(self) -> int:
        """Return the points behind a section that decide whether its last stretch counts."""
        return STANDARD.start_count(self._interval_m) + STANDARD.window(self._interval_m) + 1

    def _section(self, start: int, end: int, is_running: bool) -> Section:
        """Return the section from point ``start`` to point ``end``."""
        before = self._edge(max(self._number - BEFORE, 0))
        low = max(min(before, start) - self._first, 0)
        high = min(end + self._after() + 1 - self._first, self.held)
        inside = slice(max(start - self._first - low, 0), end - self._first - low)
        tracks = _cut(self._tracks, low, high)
        return Section(
            start * self._interval_m,
            (end - start) * self._interval_m,
            tuple(self._figures(track, inside, end - start) for track in tracks),
            self._is_final,
            is_running,
        )

    def _figures(self, track: ProfileTrack, inside: slice, count: int) -> TrackFigures:
        """Return the figures of the intervals ``inside`` of ``track``, of ``count`` in all."""
        try:
            trace = trace_of_valid(track, self._interval_m)[inside]
        except InputError:  # The elevation is beyond 1000 km: no figure.
            return TrackFigures(track.name, np.nan, np.nan, 0.0)
        counted = np.abs(trace[np.isfinite(trace)])
        if not counted.size:
            return TrackFigures(track.name, np.nan, np.nan, 0.0)
        mean, sigma = float(counted.mean()), np.nan
        if self._is_final and track.sigma is not None:
            found = iri_interval(trace, track.sigma[inside], self._interval_m)
            sigma = (found.high_m_per_km - mean) / NORMAL_95
        return TrackFigures(track.name, mean, sigma, counted.size / count)


def newest(final: Sections, provisional: Sections) -> list[Section]:
    """Return the finished sections, provisional ones where there is no final one, by distance."""
    last = final.finished[-1].start_m if final.finished else -np.inf
    beyond = (each for each in provisional.finished if each.start_m > last + 0.5 * SECTION_M)
    return [*final.finished, *beyond]


def _cut(tracks: Iterable[ProfileTrack], low: int, high: int) -> tuple[ProfileTrack, ...]:
    def cut(track: ProfileTrack) -> ProfileTrack:
        sigma = None if track.sigma is None else track.sigma[low:high]
        return ProfileTrack(track.name, track.elevation[low:high], track.valid[low:high], sigma)

    return tuple(map(cut, tracks))


def _copy(track: ProfileTrack) -> ProfileTrack:
    """Return ``track`` in arrays of its own, so that longer ones give their memory back."""
    sigma = None if track.sigma is None else track.sigma.copy()
    return ProfileTrack(track.name, track.elevation.copy(), track.valid.copy(), sigma)


def _known(track: ProfileTrack) -> ProfileTrack:
    """Return ``track`` with a 1-σ, NaN where it is not known."""
    if track.sigma is not None:
        return track
    sigma = np.full(track.elevation.size, np.nan)
    return ProfileTrack(track.name, track.elevation, track.valid, sigma)


def _join(one: ProfileTrack, other: ProfileTrack) -> ProfileTrack:
    one, other = _known(one), _known(other)
    assert one.sigma is not None
    assert other.sigma is not None
    return ProfileTrack(
        one.name,
        np.concatenate([one.elevation, other.elevation]),
        np.concatenate([one.valid, other.valid]),
        np.concatenate([one.sigma, other.sigma]),
    )
