"""A profile in a notebook or a file: valid points as solid lines, others dotted and shaded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from floatref.measures.gaps import check_heights
from floatref.measures.valid_roughness import roughness_of
from floatref.plots.figure import COLOURS, label_of, legend, new_figure, shade, title
from floatref.plots.long_lines import Even
from floatref.plots.validity_marks import Marked, iri_labels
from floatref.values.arrays import release
from floatref.values.parts.shown_units import SHOWN, Unit, kind_of_length
from floatref.values.profile import Profile

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HEIGHTS = (2.6, 2.2)
MARGIN = 0.3
"""Part of the range of the valid values that is drawn above and below it."""


def profile_figure(profile: Profile, units: str = "si", heading: str | None = None) -> Figure:
    """Return a figure of elevation and short-interval roughness over the distance.

    Lines are solid where points are valid, dotted where they are not; stretches in which any wheel
    path is invalid are shaded. The axes have the range of the valid values: an invalid elevation
    that is wrong by metres leaves them. ``units`` is "si" (m, mm, m/km) or "us" (ft, in, in/mi);
    ``heading`` replaces the title. Raises InputError for an elevation beyond 1000 km, and if
    matplotlib is missing.
    """
    for track in profile.tracks:
        check_heights(track.elevation)
        release(track.elevation)
    figure, axes = new_figure(len(HEIGHTS), 1, HEIGHTS)
    upper, lower = axes[:, 0]
    along = SHOWN["distance"][units]
    _draw_elevation(upper, profile, units)
    _draw_roughness(lower, profile, units)
    invalid = np.logical_or.reduce([~track.valid for track in profile.tracks])
    for ax in (upper, lower):
        shade(ax, _places(profile, along), invalid, "not valid" if ax is upper else None)
        legend(ax)
    lower.set_xlabel(f"Distance ({along.text})")
    title(upper, _title(profile, along) if heading is None else heading)
    if profile.length_m > 0.0:
        end_m = profile.start_m + profile.length_m
        upper.set_xlim(along.factor * profile.start_m, along.factor * end_m)
    return figure


def _title(profile: Profile, along: Unit) -> str:
    length = f"{along.factor * profile.length_m:.1f} {along.text}"
    return f"{profile.pipeline}, {length}" if profile.pipeline else ""


def _places(profile: Profile, along: Unit, off: float = 0.0) -> Even:
    """Return the place of every point, ``off`` intervals farther along."""
    start_m = profile.start_m + off * profile.interval_m
    return Even(along.factor * start_m, along.factor * profile.interval_m)


def _draw_elevation(ax: Axes, profile: Profile, units: str) -> None:
    lines = []
    x = _places(profile, SHOWN["distance"][units])
    for track in profile.tracks:
        lines.append(Marked.of(x, track.elevation, track.valid))
        release(track.elevation)
    spans = [line.span for line in lines if line.span]
    unit = SHOWN[kind_of_length(spans)][units]
    for track, line, colour in zip(profile.tracks, lines, _colours(profile), strict=True):
        line.draw(ax, colour, label_of(track.name), unit.factor)
    _limit(ax, spans, unit)
    ax.set_ylabel(f"Elevation ({unit.text})")


def _draw_roughness(ax: Axes, profile: Profile, units: str) -> None:
    x = _places(profile, SHOWN["distance"][units], 0.5)
    unit, spans = SHOWN["roughness"][units], []
    labels = iri_labels(profile, unit)
    for track in profile.tracks:
        release(track.elevation)
    for track, colour, label in zip(profile.tracks, _colours(profile), labels, strict=True):
        line = Marked.of(x, *roughness_of(track, profile.interval_m))
        line.draw(ax, colour, label, unit.factor)
        spans += [line.span] if line.span else []
        release(track.elevation)
    _limit(ax, spans, unit)
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel(f"Roughness over\n{_base(units)} ({unit.text})")


def _base(units: str) -> str:
    return "25 ft" if units == "us" else "7.62 m"


def _limit(ax: Axes, spans: list[tuple[float, float]], unit: Unit) -> None:
    """Give ``ax`` the range of all ``spans``, and a margin."""
    if not spans:
        return
    low, high = min(low for low, _ in spans), max(high for _, high in spans)
    if high > low:
        margin = MARGIN * (high - low)
        ax.set_ylim(unit.factor * (low - margin), unit.factor * (high + margin))


def _colours(profile: Profile) -> list[str]:
    return [COLOURS[index % len(COLOURS)] for index in range(len(profile.tracks))]
