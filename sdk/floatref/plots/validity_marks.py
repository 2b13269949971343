"""How drawings mark what is not valid: dotted lines, and each IRI with the share it is over."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from floatref.errors import InputError
from floatref.measures.valid_iri import profile_iri
from floatref.plots.figure import Places, label_of
from floatref.plots.long_lines import Reduced
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.display.short_text import percent
from floatref.values.parts.shown_units import SHOWN, Unit
from floatref.values.profile import Profile

if TYPE_CHECKING:
    from matplotlib.axes import Axes

M_PER_KM = SHOWN["roughness"]["si"]
PALE = 0.55
"""Opacity of a line where the points are not valid."""


@dataclass(frozen=True, eq=False)
class Marked:
    """A line that is solid where points are valid, and dotted and paler elsewhere."""

    solid: Reduced
    dotted: Reduced

    @classmethod
    def of(cls, x: Places, y: FloatArray, valid: BoolArray) -> Marked:
        """Return ``y``, shape (N,), over ``x``."""
        # The dotted line reaches the neighbours that are valid: no gap is seen between them.
        beside = ~valid
        beside[1:] |= ~valid[:-1]
        beside[:-1] |= ~valid[1:]
        return cls(Reduced.of(x, y, valid), Reduced.of(x, y, beside))

    def draw(self, ax: Axes, colour: str, label: str | None = None, factor: float = 1.0) -> None:
        """Draw both parts on ``ax``, values multiplied by ``factor``; ``label`` is of the solid."""
        self.solid.draw(ax, factor, color=colour, label=label)
        self.dotted.draw(ax, factor, color=colour, alpha=PALE, linestyle=":")

    @property
    def span(self) -> tuple[float, float] | None:
        """Lowest and highest valid value, or of all values if no valid one is finite."""
        return self.solid.span or self.dotted.span


def draw_marked(
    ax: Axes, x: FloatArray, y: FloatArray, valid: BoolArray, colour: str, label: str | None = None
) -> None:
    """Draw ``y`` over ``x``: solid with ``label`` where ``valid``, dotted and paler elsewhere."""
    Marked.of(x, y, valid).draw(ax, colour, label)


def iri_text(valid_m_per_km: float, counted_share: float, unit: Unit = M_PER_KM) -> str:
    """Return the IRI of valid points in ``unit`` and the share, 0 to 1, it is over, as a label."""
    if np.isnan(valid_m_per_km):
        return "no IRI of valid points"
    value = f"{unit.factor * valid_m_per_km:.{2 if unit.factor == 1.0 else 1}f}"
    return f"IRI {value} {unit.text} over {percent(counted_share)}"


def iri_labels(profile: Profile, unit: Unit = M_PER_KM) -> list[str]:
    """Return a label for every wheel path: its name, IRI of valid points and their share."""
    names = [label_of(track.name) for track in profile.tracks]
    try:
        found = profile_iri(profile)
    except InputError:  # An interval too long for the car.
        return names
    texts = [iri_text(each.valid_m_per_km, each.counted_share, unit) for each in found]
    return [f"{name}: {text}" for name, text in zip(names, texts, strict=True)]
