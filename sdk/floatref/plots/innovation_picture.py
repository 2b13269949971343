"""Normalized innovations of a run: along its time, and their histogram beside the normal one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle
from math import pi, sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.errors import InputError
from floatref.measures.consistency import bound_mean_nis
from floatref.plots.figure import (
    COLOURS,
    REFERENCE_COLOUR,
    check_suffix,
    label_of,
    legend,
    new_figure,
    save,
    title,
)
from floatref.values.arrays import FloatArray
from floatref.values.innovations import BIN, EDGES, FARTHEST, NEAR, Innovations

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW_INCHES = 1.7
WIDTHS_INCHES = (9.0, 2.6)
NARROWEST, WIDEST = 4.5, FARTHEST
"""Sigma at the ends of an axis; what lies farther is drawn as a triangle at the end."""
TOGETHER = 64
"""Number of innovations of the sample in one point of the line of their root mean square."""
APART = 2.5
"""They are apart in time if they take longer than usual by this factor."""
LINE_POINTS = (2.8, 1.4)
"""Widths of the lines of the first wheel path, and of others, which may lie upon it."""


def draw_innovations(
    found: Mapping[str, Mapping[str, Innovations]], path: Path, heading: str
) -> None:
    """Write a drawing of ``found``, by wheel path and kind of reading, to ``path``.

    One row for each kind, ``heading`` above the first. On the left z of the sample over time in s,
    the lines of two sigma, and the root mean square of `TOGETHER` at a time, which is 1 where the
    filter is consistent. On the right the histogram of all z with the standard normal density.
    Raises InputError without any innovation, if matplotlib is missing, or where ``path`` cannot be
    written.
    """
    path = Path(path)
    check_suffix(path)
    tracks = list(found)
    kinds = [k for kinds in found.values() for k, each in kinds.items() if each.count]
    kinds = list(dict.fromkeys(kinds))
    if not kinds:
        raise InputError("no innovations to draw; the filter has had no reading")
    rows = len(kinds)
    figure, axes = new_figure(rows, 2, [ROW_INCHES] * rows, shared=False, widths=WIDTHS_INCHES)
    for number, kind in enumerate(kinds):
        own = [(track, found[track][kind]) for track in tracks if kind in found[track]]
        _draw_kind(axes[number, 0], axes[number, 1], kind, [p for p in own if p[1].count])
    _share_time(list(axes[:, 0]))
    axes[-1, 0].set_xlabel("Time (s)")
    axes[-1, 1].set_xlabel("Share per sigma")
    figure.suptitle(heading, x=0.01, ha="left", fontsize="medium", parse_math=False)
    save(figure, path)


def _draw_kind(
    along: Axes, beside: Axes, kind: str, own: Sequence[tuple[str, Innovations]]
) -> None:
    """Draw all wheel paths of one ``kind`` in its two panels."""
    most = max(float(np.abs(each.sample).max()) for _, each in own)
    highest = float(np.clip(1.05 * most, NARROWEST, WIDEST))
    every = NEAR if highest < 3.0 * NEAR else 2.0 * NEAR
    ticks = every * np.arange(-(highest // every), highest // every + 1)
    for number, ((track, each), colour) in enumerate(zip(own, cycle(COLOURS), strict=False)):
        _draw_points(along, each, colour, highest)
        name = f"{label_of(track)}: {_figures(each)}"
        along.plot(*_rms(each), color=colour, linewidth=LINE_POINTS[min(number, 1)], label=name)
        beside.stairs(each.bins / (each.count * BIN), EDGES, orientation="horizontal", color=colour)
    z = np.linspace(-FARTHEST, FARTHEST, 241)
    normal = np.exp(-0.5 * z * z) / sqrt(2.0 * pi)
    beside.plot(normal, z, color=REFERENCE_COLOUR, linewidth=1.0, linestyle="--")
    for ax in (along, beside):
        ax.set_yticks(ticks)
        ax.set_ylim(-highest, highest)
        for bound in (-NEAR, NEAR):
            ax.axhline(bound, color=REFERENCE_COLOUR, linewidth=0.8, linestyle=":")
    beside.set_xlim(left=0.0)
    along.set_ylabel("ν / √S")
    title(along, kind)
    legend(along)


def _draw_points(ax: Axes, each: Innovations, colour: str, highest: float) -> None:
    """Draw the sample as points, and what is beyond the axis as triangles at its end."""
    inside = np.abs(each.sample) <= highest
    style: dict[str, Any] = {"color": colour, "linestyle": "", "zorder": 1.9}
    ax.plot(each.times_s[inside], each.sample[inside], marker=".", ms=1.6, alpha=0.35, **style)
    for sign, marker in ((1.0, "^"), (-1.0, "v")):
        beyond = sign * each.sample > highest
        ends = np.full(np.count_nonzero(beyond), sign * 0.96 * highest)
        ax.plot(each.times_s[beyond], ends, marker=marker, ms=3.0, **style)


def _rms(each: Innovations) -> tuple[FloatArray, FloatArray]:
    """Return mean times in s and the root mean square of so many of the sample at a time.

    NaN where these are apart in time, as on both sides of a stop.
    """
    parts = max(1, each.sample.size // TOGETHER)
    edges = np.linspace(0, each.sample.size, parts, endpoint=False).astype(np.int64)
    sizes = np.diff(edges, append=each.sample.size)
    times_s = np.add.reduceat(each.times_s, edges) / sizes
    rms = np.sqrt(np.add.reduceat(each.sample**2, edges) / sizes)
    lasts_s = each.times_s[np.append(edges[1:], each.sample.size) - 1] - each.times_s[edges]
    return times_s, np.where(lasts_s > APART * np.median(lasts_s), np.nan, rms)


def _share_time(axes: Sequence[Axes]) -> None:
    """Give all ``axes`` the time from the first to the last sample of any."""
    ends = [line.get_xdata() for ax in axes for line in ax.lines if line.get_linestyle() != ":"]
    times = np.concatenate([np.asarray(each, np.float64) for each in ends])
    for ax in axes:
        ax.set_xlim(times.min(), max(times.max(), times.min() + 1e-3))


def _figures(each: Innovations) -> str:
    low, high = bound_mean_nis(each.count)
    return f"mean NIS {each.mean_nis:.3g} of {each.count} ({low:.2f} to {high:.2f})"
