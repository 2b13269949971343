"""Whether the errors of a profile are as large as its 1-sigma says: the NEES.

The normalized estimation error squared of a point is the square of its error over the variance that
the device states; its mean is 1 if sigma is right, 4 if the errors are twice as large as stated.
Neighbours share their errors, so that a run has far fewer independent points than points: there
are no chi-square bounds here.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.measures import on_common_grid
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile


@dataclass(frozen=True)
class PathNees:
    """The mean NEES of one wheel path of one recording, and of how many points it is the mean."""

    track: str
    mean: float
    points: int


@dataclass(frozen=True)
class NeesEnds:
    """The mean NEES of several wheel paths together.

    Attributes:
        wheel_paths: how many they are.
        lowest, median, highest: of their means.
        highest_case, highest_track: case and wheel path of the highest.
    """

    wheel_paths: int
    lowest: float
    median: float
    highest: float
    highest_case: str
    highest_track: str


def mean_nees(error_m: FloatArray, sigma_m: FloatArray) -> tuple[float | None, int]:
    """Return the mean of error² over sigma², both of shape (n,), and of how many points it is.

    Points without either, or with a sigma of 0, do not count; None without any that do.
    """
    counted = np.isfinite(error_m) & np.isfinite(sigma_m) & (sigma_m > 0.0)
    if not counted.any():
        return None, 0
    ratio = error_m[counted] / sigma_m[counted]
    return float(np.mean(ratio * ratio)), int(np.count_nonzero(counted))


def nees_of(truth: Profile, profile: Profile) -> tuple[PathNees, ...]:
    """Return the mean NEES of all valid points of each wheel path of ``truth`` with a sigma.

    ``truth`` is high-pass filtered as profiles are; its distance is the true one, so that an error
    of the axis counts as an error. Empty for a profile that does not overlap with it.
    """
    try:
        found, true = on_common_grid(profile, truth)
    except InputError:
        return ()
    known = {track.name: track for track in found.tracks}
    means = []
    for track in true.tracks:
        own = known.get(track.name)
        if own is None or own.sigma is None:
            continue
        error = np.where(own.valid, own.elevation - track.elevation, np.nan)
        mean, points = mean_nees(error, own.sigma)
        if mean is not None:
            means.append(PathNees(track.name, mean, points))
    return tuple(means)


def nees_ends(cases: Iterable[tuple[str, Iterable[PathNees]]]) -> NeesEnds | None:
    """Return the ends of all wheel paths of ``cases``, each with its name; None without any."""
    found = [(each, case) for case, paths in cases for each in paths]
    if not found:
        return None
    means = [each.mean for each, _ in found]
    worst, case = max(found, key=lambda pair: pair[0].mean)
    median = float(np.median(means))
    return NeesEnds(len(found), min(means), median, worst.mean, case, worst.track)
