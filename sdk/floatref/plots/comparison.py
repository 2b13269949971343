"""Two profiles side by side: elevation, difference and roughness, as one drawing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from floatref.errors import InputError
from floatref.measures import agreement, high_pass, on_common_grid
from floatref.plots.figure import (
    COLOURS,
    REFERENCE_COLOUR,
    check_suffix,
    in_readable_unit,
    legend,
    line,
    new_figure,
    roughness,
    save,
    shade,
    title,
)
from floatref.values.profile import Profile, ProfileTrack

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HEIGHTS = (2.6, 1.6, 2.2)


def draw_comparison(
    reference: Profile, profile: Profile, path: Path, max_offset_m: float = 1.0
) -> None:
    """Write a drawing of ``profile`` against ``reference`` to ``path`` (.png, .pdf or .svg).

    One column for each wheel path of the reference: both elevations, high-pass filtered alike with
    −3 dB at 91.44 m, their difference, and both short-interval roughness profiles in m/km. The
    title holds the agreement (2.16) within ±``max_offset_m``. Invalid points of ``profile`` are
    shaded. Raises InputError if a wheel path is missing in ``profile``, the two do not overlap,
    matplotlib is missing, or ``path`` cannot be written.
    """
    path = Path(path)
    check_suffix(path)
    reference, profile = on_common_grid(reference, profile)
    figure, axes = new_figure(len(HEIGHTS), len(reference.tracks), HEIGHTS)
    for column, expected in zip(axes.T, reference.tracks, strict=True):
        found = profile.track(expected.name)
        _draw_track(list(column), expected, found, reference)
        title(column[0], _title(expected, found, reference.interval_m, max_offset_m))
    axes[0, 0].set_xlim(reference.distance_m[0], reference.distance_m[-1])
    save(figure, path)


def _draw_track(
    column: Sequence[Axes], expected: ProfileTrack, found: ProfileTrack, grid: Profile
) -> None:
    """Draw the three panels of one wheel path."""
    z = [high_pass(track.elevation, grid.interval_m) for track in (expected, found)]
    factor, unit = in_readable_unit(*z)
    x = grid.distance_m
    elevation_ax, difference_ax, _ = column
    line(elevation_ax, x, factor * z[0], color=REFERENCE_COLOUR, label="reference")
    line(elevation_ax, x, factor * z[1], color=COLOURS[0], label="profile")
    elevation_ax.set_ylabel(f"Elevation, wavelengths\nto 91 m ({unit})")
    difference_factor, difference_unit = in_readable_unit(z[1] - z[0])
    line(difference_ax, x, difference_factor * (z[1] - z[0]), color=COLOURS[1])
    difference_ax.set_ylabel(f"Profile − reference\n({difference_unit})")
    _draw_roughness(column[2], expected, found, grid)
    for row, ax in enumerate(column):
        shade(ax, x, ~found.valid, "not valid" if row == 0 else None)
    for ax in (column[0], column[2]):
        legend(ax)


def _draw_roughness(ax: Axes, expected: ProfileTrack, found: ProfileTrack, grid: Profile) -> None:
    """Draw both short-interval roughness profiles, with the IRIs in the legend."""
    middle = grid.distance_m[:-1] + grid.interval_m / 2.0
    sides = (("reference", expected, REFERENCE_COLOUR), ("profile", found, COLOURS[0]))
    for name, track, colour in sides:
        trace, value = roughness(track.elevation, grid.interval_m)
        label = f"{name}: IRI {value:.2f} m/km" if value == value else f"{name}: no IRI"
        line(ax, middle, trace, color=colour, label=label)
    ax.set_ylabel("Roughness over\n7.62 m (m/km)")
    ax.set_ylim(bottom=0.0)


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
    return (
        f"{expected.name}: agreement {result.cross_correlation:.3f} "
        f"at an offset of {result.offset_m:+.3f} m"
    )
