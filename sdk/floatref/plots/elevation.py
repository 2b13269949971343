"""A profile with its roughness and travel speed, as one drawing."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from floatref.measures.gaps import check_heights
from floatref.measures.valid_roughness import roughness_of
from floatref.plots.figure import (
    COLOURS,
    check_suffix,
    in_readable_unit,
    label_of,
    legend,
    line,
    new_figure,
    save,
    shade,
    title,
)
from floatref.plots.validity_marks import draw_marked, iri_labels
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KMH_PER_MPS = 3.6


def draw_profile(
    profile: Profile, path: Path, speed: tuple[FloatArray, FloatArray] | None = None
) -> None:
    """Write a drawing of ``profile`` to ``path`` (.png, .pdf or .svg).

    Elevation, short-interval roughness in m/km, and ``speed`` if given, as distances in m and
    speeds in m/s, if any of them is finite. Points that are not valid for a wheel path are shaded,
    and dotted in it; its IRI is that of valid points with the share that counts. Raises InputError
    for an elevation beyond 1000 km, if matplotlib is missing or ``path`` cannot be written.
    """
    path = Path(path)
    check_suffix(path)
    for track in profile.tracks:
        check_heights(track.elevation)
    if speed is not None and not np.isfinite(speed[1]).any():
        speed = None
    heights = [2.6, 2.2] if speed is None else [2.6, 2.2, 1.3]
    figure, axes = new_figure(len(heights), 1, heights)
    column = axes[:, 0]
    _draw_elevation(column[0], profile)
    _draw_roughness(column[1], profile)
    if speed is not None:
        _draw_speed(column[2], *speed)
    invalid = np.logical_or.reduce([~track.valid for track in profile.tracks])
    for row, ax in enumerate(column):
        shade(ax, profile.distance_m, invalid, "not valid" if row == 0 else None)
    for ax in column[:2]:
        legend(ax)
    title(column[0], _title(profile))
    column[0].set_xlim(profile.distance_m[0], profile.distance_m[-1])
    save(figure, path)


def _draw_elevation(ax: Axes, profile: Profile) -> None:
    factor, unit = in_readable_unit(*(track.elevation for track in profile.tracks))
    for track, colour in zip(profile.tracks, _colours(profile), strict=True):
        z, name = factor * track.elevation, label_of(track.name)
        draw_marked(ax, profile.distance_m, z, track.valid, colour, name)
    ax.set_ylabel(f"Elevation ({unit})")


def _draw_roughness(ax: Axes, profile: Profile) -> None:
    middle = profile.distance_m[:-1] + profile.interval_m / 2.0
    labels = iri_labels(profile)
    for track, colour, label in zip(profile.tracks, _colours(profile), labels, strict=True):
        draw_marked(ax, middle, *roughness_of(track, profile.interval_m), colour, label)
    ax.set_ylabel("Roughness over\n7.62 m (m/km)")
    ax.set_ylim(bottom=0.0)


def _draw_speed(ax: Axes, distance_m: FloatArray, speed_mps: FloatArray) -> None:
    line(ax, np.asarray(distance_m), KMH_PER_MPS * np.asarray(speed_mps), color="0.25")
    ax.set_ylabel("Speed (km/h)")
    ax.set_ylim(0.0, 1.1 * max(1.0, KMH_PER_MPS * float(np.nanmax(speed_mps))))


def _colours(profile: Profile) -> list[str]:
    return [COLOURS[index % len(COLOURS)] for index in range(len(profile.tracks))]


def _title(profile: Profile) -> str:
    made = f"{profile.pipeline}, " if profile.pipeline else ""
    return f"{made}{profile.length_m:.1f} m at {1000.0 * profile.interval_m:g} mm"
