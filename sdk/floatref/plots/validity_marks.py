"""How drawings mark what is not valid: dotted lines, and each IRI with the share it is over."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from floatref.errors import InputError
from floatref.measures.valid_iri import profile_iri
from floatref.plots.figure import label_of, line
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.display.short_text import percent
from floatref.values.profile import Profile

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PALE = 0.55
"""Opacity of a line where the points are not valid."""


def draw_marked(
    ax: Axes, x: FloatArray, y: FloatArray, valid: BoolArray, colour: str, label: str | None = None
) -> None:
    """Draw ``y`` over ``x``: solid with ``label`` where ``valid``, dotted and paler elsewhere."""
    line(ax, x, np.where(valid, y, np.nan), color=colour, label=label)
    # The dotted line reaches the neighbours that are valid, so that no gap is seen between them.
    beside = ~valid
    beside[1:] |= ~valid[:-1]
    beside[:-1] |= ~valid[1:]
    rest = np.where(beside, y, np.nan)
    line(ax, x, rest, color=colour, alpha=PALE, linestyle=":")


def iri_text(valid_m_per_km: float, counted_share: float) -> str:
    """Return the IRI of valid points in m/km and the share, 0 to 1, it is over, as a label."""
    if np.isnan(valid_m_per_km):
        return "no IRI of valid points"
    return f"IRI {valid_m_per_km:.2f} m/km over {percent(counted_share)}"


def iri_labels(profile: Profile) -> list[str]:
    """Return a label for every wheel path: its name, IRI of valid points and their share."""
    names = [label_of(track.name) for track in profile.tracks]
    try:
        found = profile_iri(profile)
    except InputError:  # An interval too long for the car.
        return names
    texts = [iri_text(each.valid_m_per_km, each.counted_share) for each in found]
    return [f"{name}: {text}" for name, text in zip(names, texts, strict=True)]
