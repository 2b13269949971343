"""The IRI of the valid points of a profile, beside that of all its points.

An elevation that is not valid may be wrong by metres, and the car remembers it for some metres of
road. A straight line over the invalid points has a bend at either end, which the car feels too:
1.90 m/km of road become 2.32 at a stop. So every stretch of valid points is measured as a profile
of its own, at whose start the car is at rest, and the longer one counts for more.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.measures.gaps import measured_stretch
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.measures.roughness.roughness_index import STANDARD, iri, rectified_sums
from floatref.values.arrays import BoolArray, FloatArray, IndexArray, release
from floatref.values.display.iri_table import ProfileIri, TrackIri
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.scanning import first_where, stretch_edges


def profile_iri(profile: Profile, settings: IriSettings = STANDARD) -> ProfileIri:
    """Return the IRI of every wheel path of ``profile``, in m/km, and the share that counts.

    A stretch of valid points counts if it is longer than the car needs to start, 11 m; the IRI is
    the mean over all intervals in these. A figure is NaN where nothing is long enough. Raises
    InputError, naming the wheel path, for an interval above 2 m and an elevation beyond 1000 km.
    """
    return ProfileIri(
        tuple(_track_iri(track, profile.interval_m, settings) for track in profile.tracks)
    )


def valid_stretches(
    valid: BoolArray, interval_m: float, settings: IriSettings = STANDARD
) -> Iterator[slice]:
    """Yield every stretch of points, all ``valid``, at the interval in m, that is long enough."""
    needed = settings.start_count(interval_m)
    edges = stretch_edges(valid)
    firsts, ends = edges[::2], edges[1::2]
    for at in np.flatnonzero(ends - firsts > needed):
        yield slice(int(firsts[at]), int(ends[at]))


def sums_of_valid(
    track: ProfileTrack,
    edges: IndexArray,
    interval_m: float,
    settings: IriSettings = STANDARD,
) -> tuple[FloatArray, IndexArray]:
    """Return of every segment the sum of the rectified output in m/km, and its intervals, (n,).

    Only stretches of valid points count. ``edges``, shape (n + 1,), are the first interval of every
    segment and the end. Raises InputError as `profile_iri`, without the name of the wheel path.
    """
    sums, counts = np.zeros(edges.size - 1), np.zeros(edges.size - 1, dtype=np.int64)
    for stretch in valid_stretches(track.valid, interval_m, settings):
        first, end = stretch.start, stretch.stop - 1
        low = int(np.searchsorted(edges, first, side="right")) - 1
        high = int(np.searchsorted(edges, end))
        inside = np.clip(edges[low : high + 1], first, end) - first
        z = track.elevation[stretch]
        sums[low:high] += rectified_sums(z, interval_m, inside, settings)
        counts[low:high] += np.diff(inside)
        # What was read of a file would stay in memory.
        release(z)
    return sums, counts


@dataclass(frozen=True)
class CommonIri:
    """IRI in m/km of a reference and a profile over the points that are valid in both.

    ``counted_share`` is the share of all intervals that both are over, 0 to 1.
    """

    reference_m_per_km: float
    profile_m_per_km: float
    counted_share: float


def iri_of_common_points(
    reference: ProfileTrack, profile: ProfileTrack, interval_m: float
) -> CommonIri:
    """Return the IRI of both over the stretches in which both are valid; they have equal points.

    NaN where no stretch is long enough. Raises InputError as `profile_iri`.
    """
    both = reference.valid & profile.valid
    expected, share = iri_of_valid(replace(reference, valid=both), interval_m)
    # What was read of its file would stay in memory beside the other.
    release(reference.elevation)
    found, _ = iri_of_valid(replace(profile, valid=both), interval_m)
    release(profile.elevation)
    return CommonIri(expected, found, share)


def iri_of_valid(
    track: ProfileTrack, interval_m: float, settings: IriSettings = STANDARD
) -> tuple[float, float]:
    """Return the IRI in m/km over all stretches of valid points, and their share of the road.

    NaN and 0 without a stretch that is long enough. Raises InputError as `profile_iri`.
    """
    try:
        # The window of the moving average checks the interval.
        settings.window(interval_m)
        edges = np.array([0, track.valid.size - 1], dtype=np.int64)
        sums, counts = sums_of_valid(track, edges, interval_m, settings)
    except InputError as error:
        raise InputError(f"track {track.name}: {error}") from error
    total, count = float(sums[0]), int(counts[0])
    return (total / count, count / (track.valid.size - 1)) if count else (np.nan, 0.0)


def _track_iri(track: ProfileTrack, interval_m: float, settings: IriSettings) -> TrackIri:
    valid, share = iri_of_valid(track, interval_m, settings)
    try:
        every = _iri_of_all(track, interval_m, settings)
    except InputError as error:
        raise InputError(f"track {track.name}: {error}") from error
    return TrackIri(track.name, valid, share, every)


def _iri_of_all(track: ProfileTrack, interval_m: float, settings: IriSettings) -> float:
    """Return the IRI in m/km over all points; NaN if too few are measured."""
    if first_where(np.isfinite, track.elevation) is None:
        return np.nan
    stretch = measured_stretch(track.elevation)
    if stretch.stop - stretch.start <= settings.start_count(interval_m):
        return np.nan
    return iri(track.elevation, interval_m, settings)
