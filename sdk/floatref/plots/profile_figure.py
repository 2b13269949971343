"""A profile in a notebook: what is valid as solid lines, what is not dotted and shaded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from floatref.measures.roughness.gaps import check_heights
from floatref.measures.valid_roughness import roughness_of
from floatref.plots.figure import (
    COLOURS,
    in_readable_unit,
    label_of,
    legend,
    new_figure,
    shade,
    title,
)
from floatref.plots.validity_marks import draw_marked, iri_labels
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HEIGHTS = (2.6, 2.2)
MARGIN = 0.3
"""Part of the range of the valid values that is drawn above and below it."""


def profile_figure(profile: Profile) -> Figure:
    """Return a figure of elevation and short-interval roughness in m/km over distance in m.

    Lines are solid where points are valid, dotted where they are not; stretches in which any wheel
    path is invalid are shaded. The axes have the range of the valid values: an invalid elevation
    that is wrong by metres leaves them. Raises InputError for an elevation beyond 1000 km, and if
    matplotlib is missing.
    """
    for track in profile.tracks:
        check_heights(track.elevation)
    figure, axes = new_figure(len(HEIGHTS), 1, HEIGHTS)
    upper, lower = axes[:, 0]
    _draw_elevation(upper, profile)
    _draw_roughness(lower, profile)
    invalid = np.logical_or.reduce([~track.valid for track in profile.tracks])
    for ax in (upper, lower):
        shade(ax, profile.distance_m, invalid, "not valid" if ax is upper else None)
        legend(ax)
    title(upper, f"{profile.pipeline}, {profile.length_m:.1f} m" if profile.pipeline else "")
    if profile.length_m > 0.0:
        upper.set_xlim(profile.distance_m[0], profile.distance_m[-1])
    return figure


def _draw_elevation(ax: Axes, profile: Profile) -> None:
    shown = [_valid_or_all(track.elevation, track.valid) for track in profile.tracks]
    factor, unit = in_readable_unit(*shown)
    for track, colour in zip(profile.tracks, _colours(profile), strict=True):
        draw_marked(
            ax,
            profile.distance_m,
            factor * track.elevation,
            track.valid,
            colour,
            label_of(track.name),
        )
    _limit(ax, [factor * values for values in shown])
    ax.set_ylabel(f"Elevation ({unit})")


def _draw_roughness(ax: Axes, profile: Profile) -> None:
    middle = profile.distance_m[:-1] + profile.interval_m / 2.0
    labels = iri_labels(profile)
    shown = []
    for track, colour, label in zip(profile.tracks, _colours(profile), labels, strict=True):
        trace, counted = roughness_of(track, profile.interval_m)
        draw_marked(ax, middle, trace, counted, colour, label)
        shown.append(_valid_or_all(trace, counted))
    _limit(ax, shown)
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel("Roughness over\n7.62 m (m/km)")


def _valid_or_all(values: FloatArray, valid: BoolArray) -> FloatArray:
    """Return the finite ``values`` that are ``valid``, or all of them if no valid one is finite."""
    finite = np.isfinite(values)
    chosen = valid & finite
    return values[chosen if chosen.any() else finite]


def _limit(ax: Axes, shown: list[FloatArray]) -> None:
    """Give ``ax`` the range of all values ``shown``, and a margin."""
    values = np.concatenate(shown)
    if values.size and values.max() > values.min():
        margin = MARGIN * (values.max() - values.min())
        ax.set_ylim(values.min() - margin, values.max() + margin)


def _colours(profile: Profile) -> list[str]:
    return [COLOURS[index % len(COLOURS)] for index in range(len(profile.tracks))]
