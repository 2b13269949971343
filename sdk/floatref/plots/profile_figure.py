"""A profile in a notebook: what is valid as solid lines, what is not dotted and shaded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.gaps import check_heights
from floatref.measures.valid_iri import profile_iri, valid_stretches
from floatref.plots.figure import (
    COLOURS,
    in_readable_unit,
    label_of,
    legend,
    line,
    new_figure,
    roughness,
    shade,
    title,
)
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.display.iri_table import TrackIri
from floatref.values.display.short_text import percent
from floatref.values.profile import Profile, ProfileTrack

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HEIGHTS = (2.6, 2.2)
MARGIN = 0.3
"""Part of the range of the valid values that is drawn above and below it."""
PALE = 0.55
"""Opacity of a line where the points are not valid."""


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
        _draw_marked(
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
    labels = _iri_labels(profile)
    shown = []
    for track, colour, label in zip(profile.tracks, _colours(profile), labels, strict=True):
        trace, counted = _roughness_of(track, profile.interval_m)
        _draw_marked(ax, middle, trace, counted, colour, label)
        shown.append(_valid_or_all(trace, counted))
    _limit(ax, shown)
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel("Roughness over\n7.62 m (m/km)")


def _roughness_of(track: ProfileTrack, interval_m: float) -> tuple[FloatArray, BoolArray]:
    """Return the roughness in m/km of every interval, and which lie in a stretch that counts.

    Each of these stretches is measured as a profile of its own.
    """
    trace, _ = roughness(track.elevation, interval_m)
    counted = np.zeros(trace.size, dtype=np.bool_)
    for stretch in valid_stretches(track.valid, interval_m):
        inside = slice(stretch.start, stretch.stop - 1)
        trace[inside], _ = roughness(track.elevation[stretch], interval_m)
        counted[inside] = True
    return trace, counted


def _iri_labels(profile: Profile) -> list[str]:
    names = [label_of(track.name) for track in profile.tracks]
    try:
        found = profile_iri(profile)
    except InputError:  # An interval too long for the car.
        return names
    return [f"{name}: {_iri_text(each)}" for name, each in zip(names, found, strict=True)]


def _iri_text(found: TrackIri) -> str:
    if np.isnan(found.valid_m_per_km):
        return "no IRI of valid points"
    return f"IRI {found.valid_m_per_km:.2f} m/km over {percent(found.counted_share)}"


def _draw_marked(
    ax: Axes, x: FloatArray, y: FloatArray, valid: BoolArray, colour: str, label: str
) -> None:
    """Draw ``y`` over ``x``: solid with ``label`` where ``valid``, dotted and paler elsewhere."""
    line(ax, x, np.where(valid, y, np.nan), color=colour, label=label)
    # The dotted line reaches the neighbours that are valid, so that no gap is seen between them.
    beside = ~valid
    beside[1:] |= ~valid[:-1]
    beside[:-1] |= ~valid[1:]
    rest = np.where(beside, y, np.nan)
    line(ax, x, rest, color=colour, alpha=PALE, linestyle=":")


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
