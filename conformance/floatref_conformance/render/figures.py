"""The picture of a pass: truth against result, their roughness, and the speed driven."""

from collections.abc import Callable

import numpy as np

from floatref.errors import InputError
from floatref.measures import high_pass, short_interval_roughness
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.stretches import Stretches
from floatref_conformance.checks.verdict import Pass
from floatref_conformance.render import places
from floatref_conformance.render.svg import WIDTH, Figure, Line, Mark, Panel, Shade, draw_figure

HIGH_PASS_M = 91.44
"""The truth is shown as a profile is delivered: −3 dB at this wavelength."""
END_M = 106.0
"""At each end of a run the high-pass (105.91 m) has not run in."""
TRUTH, RESULT = "truth, filtered alike", "result"


def figure_of(done: Pass, track: str, name: str, scored_m: Stretches = ()) -> str:
    """Return the picture of ``track`` in ``done`` as one SVG element.

    Elevation, short-interval roughness and speed lie above one another on the distance axis;
    stretches flagged invalid are shaded, those scored, ``scored_m``, too, and events are marked.
    What cannot be calculated, since nothing was measured, has no line. ``name`` begins the ids.
    """
    true, found = done.truth.track(track), done.result.track(track)
    pairs = (
        (done.truth, filter_elevation(true.elevation, done.truth.interval_m), TRUTH, "truth"),
        (done.result, found.elevation, RESULT, "result"),
    )
    x, speed = places.speed_along(done.scenario)
    elevation = tuple(_elevation(*pair) for pair in pairs)
    panels = (
        Panel("elevation", "mm", elevation, 150.0, held=_between_the_ends(elevation)),
        Panel("roughness", "m/km", tuple(_roughness(*pair) for pair in pairs), 110.0, True),
        Panel("speed", "km/h", (Line("speed", x, speed, "speed"),), 70.0, True),
    )
    start, end = _extent(done)
    shades, marks = _shades(done, found, scored_m), _marks(done)
    return draw_figure(
        Figure(
            name,
            f"Wheel path {track}: truth against result",
            _description(done, found, shades),
            panels,
            "distance in m",
            start,
            end,
            shades,
            marks,
        )
    )


def filter_elevation(elevation: FloatArray, interval_m: float) -> FloatArray:
    """Return a true elevation in m high-passed as a profile is; NaN if it is too short."""
    return _calculate(lambda: high_pass(elevation, interval_m, HIGH_PASS_M), elevation.size)


def stretches(
    distance: FloatArray, flagged: BoolArray, columns: int = int(WIDTH)
) -> tuple[tuple[float, float], ...]:
    """Return the stretches of ``distance`` that are ``flagged``, in m, as seen in a picture.

    The points are looked at in ``columns`` groups, one of which is flagged if a point of it is.
    """
    if not flagged.any():
        return ()
    size = -(-flagged.size // columns)
    groups = np.logical_or.reduceat(flagged, np.arange(0, flagged.size, size))
    edges = np.flatnonzero(np.diff(np.concatenate([[False], groups, [False]])))
    ends = [(int(a) * size, min(int(b) * size, flagged.size) - 1) for a, b in edges.reshape(-1, 2)]
    return tuple((float(distance[a]), float(distance[b])) for a, b in ends)


def _elevation(profile: Profile, elevation: FloatArray, label: str, style: str) -> Line:
    return Line(label, profile.distance_m, 1000.0 * elevation, style)


def _between_the_ends(lines: tuple[Line, ...]) -> FloatArray | None:
    """Return the values that lie away from both ends of a run; None if it is too short.

    What the high-pass makes of the ends would leave nothing to be seen of the rest.
    """
    inner = [line.y[(line.x > END_M) & (line.x < line.x[-1] - END_M)] for line in lines]
    held = np.concatenate(inner)
    return held if np.isfinite(held).any() else None


def _roughness(profile: Profile, elevation: FloatArray, label: str, style: str) -> Line:
    size = elevation.size - 1
    rough = _calculate(lambda: short_interval_roughness(elevation, profile.interval_m), size)
    middle = profile.distance_m[:-1] + profile.interval_m / 2
    return Line(label, middle, rough, style)


def _calculate(calculate: Callable[[], FloatArray], size: int) -> FloatArray:
    """Return what ``calculate`` returns; NaN where the profile does not allow it."""
    try:
        return calculate()
    except InputError:
        return np.full(size, np.nan)


def _extent(done: Pass) -> tuple[float, float]:
    """Return where the axis of distance starts and ends, in m."""
    return 0.0, max(float(done.truth.distance_m[-1]), 1.0)


def _shades(done: Pass, found: ProfileTrack, scored_m: Stretches) -> tuple[Shade, ...]:
    bumps = tuple((place.start_m, place.end_m) for place in places.bumps(done.scenario))
    return (
        Shade("scored", places.join_stretches(scored_m), "scored"),
        Shade("flagged invalid", stretches(done.result.distance_m, ~found.valid), "flagged"),
        Shade("known bump", bumps, "bump"),
    )


def _marks(done: Pass) -> tuple[Mark, ...]:
    return tuple(Mark(place.start_m, place.name) for place in places.events(done.scenario))


def _description(done: Pass, found: ProfileTrack, shades: tuple[Shade, ...]) -> str:
    """Return what there is to see, for those who do not."""
    flagged = done.result.interval_m * float(np.sum(~found.valid))
    missing = int(np.isnan(found.elevation).sum())
    happens = "; ".join(f"{p.name} at {p.start_m:.4g} m" for p in places.events(done.scenario))
    return (
        "Three plots along the distance: elevation of the truth and of the result, their "
        "roughness over 7.62 m, and the speed. "
        f"{flagged:.1f} m are flagged invalid, {missing} points have no elevation. {happens}"
    ).strip()
