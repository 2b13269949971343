"""How far a run lies ahead of the reference, window by window: the picture of a distance error."""

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.lags import AGREES, WINDOW_M, Line, followed, window_lags
from floatref_conformance.certify.slopes import slope_of
from floatref_conformance.certify.worksheet import RunSheet, RunTrack, SectionSheet
from floatref_conformance.render import svg
from floatref_conformance.render.worksheet_pictures import apart

LEAST = 3
"""Windows that tell a lag, at least."""


def lag_picture(section: SectionSheet, run: RunSheet, track: RunTrack, name: str) -> str:
    """Return the lags of windows of a run against distance; empty where too few agree.

    Of a run that lies right they are level; one that tells distance too long lies the farther
    ahead, the farther it has come.
    """
    found = _lags(section, run, track)
    if found is None:
        return ""
    at, lag, ends, line = found
    return lag_along(at, lag, ends, line, f"{run.name}, wheel path {track.track}", name)


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


def _lags(
    section: SectionSheet, run: RunSheet, track: RunTrack
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray] | None:
    """Return where windows lie and their lags, and the ends of the line and its lags there."""
    if run.profile is None or not np.isfinite([track.distance_percent, track.offset_m]).all():
        return None
    p, q = (
        slope_of(profile.track(track.track), profile.start_m, profile.interval_m)
        for profile in (section.reference, run.profile)
    )
    if p is None or q is None:
        return None
    middle = (section.start_m + section.end_m) / 2
    known = Line(middle, middle + track.offset_m, 1.0 + track.distance_percent / 100.0)
    line = followed(p, q, known)
    windows = window_lags(p, q, line)
    agreeing = windows.correlation >= AGREES
    if np.count_nonzero(agreeing) < LEAST:
        return None
    ends = np.array([section.start_m, section.end_m])
    at = windows.at_m[agreeing]
    lag = line.run_at(at) - at + windows.lag_m[agreeing]
    return at, lag, ends, line.run_at(ends) - ends
