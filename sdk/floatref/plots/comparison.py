"""Two profiles side by side: elevation, difference and roughness, as one drawing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from floatref.errors import InputError
from floatref.measures import agreement, high_pass, on_common_grid
from floatref.measures.valid_iri import CommonIri, iri_of_common_points
from floatref.measures.valid_roughness import roughness_of
from floatref.plots.figure import (
    COLOURS,
    REFERENCE_COLOUR,
    check_suffix,
    in_readable_unit,
    legend,
    new_figure,
    save,
    shade,
    title,
)
from floatref.plots.validity_marks import draw_marked, iri_text
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile, ProfileTrack

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HEIGHTS = (2.6, 1.6, 2.2)
MARGIN = 0.05
"""Share of a range of values that is left free beyond it."""


def draw_comparison(
    reference: Profile,
    profile: Profile,
    path: Path,
    max_offset_m: float = 1.0,
    placement_m: float | None = None,
) -> None:
    """Write a drawing of ``profile`` against ``reference`` to ``path`` (.png, .pdf or .svg).

    One column for each wheel path of the reference: both elevations, high-pass filtered alike with
    −3 dB at 91.44 m, their difference, and both short-interval roughness profiles in m/km. The
    title holds the agreement (2.16) within ±``max_offset_m``. Above them stands ``placement_m``, by
    which ``profile`` lay farther along before it was moved, unless that is None or 0. Points that
    are not valid in both are shaded and dotted, and the IRIs are over the others, with their share.
    Raises InputError if a wheel path is missing in ``profile``, the two do not overlap, matplotlib
    is missing, or ``path`` cannot be written.
    """
    path = Path(path)
    check_suffix(path)
    reference, profile = on_common_grid(reference, profile)
    figure, axes = new_figure(len(HEIGHTS), len(reference.tracks), HEIGHTS)
    for column, expected in zip(axes.T, reference.tracks, strict=True):
        found = profile.track(expected.name)
        _draw_track(list(column), expected, found, reference)
        title(column[0], _title(expected, found, reference.interval_m, max_offset_m))
    if placement_m:
        way = "farther along" if placement_m > 0 else "earlier"
        text = f"The profile lay {abs(placement_m):.2f} m {way}, and is moved to its place"
        figure.suptitle(text, x=0.01, ha="left", fontsize="medium")
    axes[0, 0].set_xlim(reference.distance_m[0], reference.distance_m[-1])
    save(figure, path)


def _draw_track(
    column: Sequence[Axes], expected: ProfileTrack, found: ProfileTrack, grid: Profile
) -> None:
    """Draw the three panels of one wheel path."""
    both = expected.valid & found.valid
    z = [high_pass(track.elevation, grid.interval_m) for track in (expected, found)]
    factor, unit = in_readable_unit(*z)
    x = grid.distance_m
    elevation_ax, difference_ax, _ = column
    draw_marked(elevation_ax, x, factor * z[0], both, REFERENCE_COLOUR, "reference")
    draw_marked(elevation_ax, x, factor * z[1], both, COLOURS[0], "profile")
    _limit_to_valid(elevation_ax, both, *(factor * each for each in z))
    elevation_ax.set_ylabel(f"Elevation, wavelengths\nto 91 m ({unit})")
    difference_factor, difference_unit = in_readable_unit(z[1] - z[0])
    draw_marked(difference_ax, x, difference_factor * (z[1] - z[0]), both, COLOURS[1])
    _limit_to_valid(difference_ax, both, difference_factor * (z[1] - z[0]))
    difference_ax.set_ylabel(f"Profile − reference\n({difference_unit})")
    _draw_roughness(column[2], expected, found, grid)
    for row, ax in enumerate(column):
        shade(ax, x, ~both, "not valid" if row == 0 else None)
    for ax in (column[0], column[2]):
        legend(ax)


def _draw_roughness(ax: Axes, expected: ProfileTrack, found: ProfileTrack, grid: Profile) -> None:
    """Draw both short-interval roughness profiles, with the IRIs in the legend."""
    middle = grid.distance_m[:-1] + grid.interval_m / 2.0
    highest, valid = 0.0, expected.valid & found.valid
    values = _common_iri(expected, found, grid.interval_m)
    sides = (
        ("reference", expected, REFERENCE_COLOUR, values.reference_m_per_km),
        ("profile", found, COLOURS[0], values.profile_m_per_km),
    )
    for name, track, colour, value in sides:
        trace, counted = roughness_of(replace(track, valid=valid), grid.interval_m)
        label = f"{name}: {iri_text(value, values.counted_share)}"
        draw_marked(ax, middle, trace, counted, colour, label)
        highest = max(highest, float(np.max(trace[counted], initial=0.0)))
    if highest > 0.0:
        ax.set_ylim(top=(1.0 + MARGIN) * highest)
    ax.set_ylabel("Roughness over\n7.62 m (m/km)")
    ax.set_ylim(bottom=0.0)


def _limit_to_valid(ax: Axes, valid: BoolArray, *lines: FloatArray) -> None:
    """Give ``ax`` the range of the ``valid`` points of all ``lines``, and a margin."""
    shown = np.concatenate([line[valid & np.isfinite(line)] for line in lines])
    if shown.size and np.ptp(shown) > 0.0:
        margin = MARGIN * float(np.ptp(shown))
        ax.set_ylim(float(shown.min()) - margin, float(shown.max()) + margin)


def _common_iri(expected: ProfileTrack, found: ProfileTrack, interval_m: float) -> CommonIri:
    """Return the IRI of both over common valid points; NaN for an interval too long for the car."""
    try:
        return iri_of_common_points(expected, found, interval_m)
    except InputError:
        return CommonIri(float("nan"), float("nan"), 0.0)


def _title(
    expected: ProfileTrack, found: ProfileTrack, interval_m: float, max_offset_m: float
) -> str:
    """Return wheel path, agreement and offset as text."""
    try:
        result = agreement(
            expected.elevation, found.elevation, interval_m, max_offset_m=max_offset_m
        )
    except InputError:
        return f"{expected.name}: too little in common for an agreement"
    sound = bool((expected.valid & found.valid).all())
    # The legend is on the right of the lower line.
    invalid = "" if sound else "\nwith points that are not valid"
    return (
        f"{expected.name}: agreement {result.cross_correlation:.3f} "
        f"at an offset of {result.offset_m:+.3f} m{invalid}"
    )
