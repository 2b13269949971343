"""Drawings of profiles and sensor noise, written as files; needs the extra ``floatref[plot]``."""

from floatref.plots.allan import draw_allan
from floatref.plots.comparison import draw_comparison
from floatref.plots.figure import check_drawing
from floatref.plots.profile import draw_profile
from floatref.plots.sensitivity import draw_sensitivity

__all__ = ["check_drawing", "draw_allan", "draw_comparison", "draw_profile", "draw_sensitivity"]
