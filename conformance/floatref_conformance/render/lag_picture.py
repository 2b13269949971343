"""How far a run lies ahead of the reference, window by window: the picture of a distance error."""

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.fit import WINDOW_M, fit
from floatref_conformance.certify.worksheet import RunSheet, SectionSheet
from floatref_conformance.render import svg
from floatref_conformance.render.worksheet_pictures import apart


def lag_picture(section: SectionSheet, run: RunSheet, track: str, name: str) -> str:
    """Return the lags of windows of a run against distance; empty where they are not known.

    Of a run that lies right they are level; one that tells distance too long lies the farther
    ahead, the farther it has come.
    """
    if run.profile is None:
        return ""
    found = fit(section.reference, run.profile, track)
    if found.line is None or not found.at_m.size:
        return ""
    ends = np.array([section.start_m, section.end_m])
    lags = found.line.run_at(ends) - ends
    of = f"{run.name}, wheel path {track}"
    return lag_along(found.at_m, found.lag_m, ends, lags, of, name)


def lag_along(
    at_m: FloatArray, lag_m: FloatArray, ends_m: FloatArray, line_m: FloatArray, of: str, name: str
) -> str:
    """Return lags in m at ``at_m`` as dots, and the line through ``line_m`` at ``ends_m``."""
    percent = 100.0 * (line_m[1] - line_m[0]) / (ends_m[1] - ends_m[0])
    lines = (
        svg.Line(f"line of {percent:+.2f} %".replace("-", "−"), ends_m, 1000.0 * line_m, "truth"),
        svg.Line(f"windows of {WINDOW_M:g} m", *apart(at_m, 1000.0 * lag_m), "dot"),
    )
    title = f"{of}: lag against distance"
    told = f"The lag goes from {line_m[0]:.3f} m to {line_m[1]:.3f} m."
    panel = svg.Panel("lag", "mm", lines, 130.0)
    return svg.drawn(svg.Figure(name, title, told, (panel,), "distance in m", ends_m[0], ends_m[1]))
