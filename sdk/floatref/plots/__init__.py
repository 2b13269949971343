"""Drawings of profiles, innovations, networks and noise; needs the extra ``plot``."""

from floatref.plots.allan_deviation import draw_allan
from floatref.plots.comparison import draw_comparison
from floatref.plots.elevation import draw_profile
from floatref.plots.figure import check_drawing, save
from floatref.plots.innovation_picture import draw_innovations
from floatref.plots.network import SUMMARY_COLUMNS, draw_summary
from floatref.plots.sensitivity import draw_sensitivity

__all__ = [
    "SUMMARY_COLUMNS",
    "check_drawing",
    "draw_allan",
    "draw_comparison",
    "draw_innovations",
    "draw_profile",
    "draw_sensitivity",
    "draw_summary",
    "save",
]
