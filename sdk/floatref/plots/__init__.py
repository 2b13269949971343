"""Drawings of profiles, written as files; needs the extra ``floatref[plot]``."""

from floatref.plots.comparison import draw_comparison
from floatref.plots.profile import draw_profile

__all__ = ["draw_comparison", "draw_profile"]
