"""Draw what every pipeline makes of one stop, beside the road that was driven.

The run is simulated once, with all sensors; every pipeline has the channels that it declares. Long
waves of the road are filtered as those of the profiles are. Cross correlations are those of
`conformance table`, but with the road itself and not with another pass. What every profile is off
by behind the stop is printed, all of it and without its long waves. Run as

    python tests/benchmarks/draw_stop_under_every_algorithm.py docs/images/FILE.png [--run NAME]
"""

import argparse
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from kind_drives import KIND

import floatref
from floatref.measures import high_pass
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.profile import ProfileTrack
from floatref_conformance.proving_ground.drives.runs import RUNS, SECTION_START_M
from floatref_conformance.proving_ground.scenario import scenario_of_run
from floatref_conformance.table.passes import Driven, Processing
from floatref_conformance.table.scores import PEAK_M, score

matplotlib.use("Agg")
from matplotlib import pyplot

TRACK, COLUMNS, LIMIT_MM = "left", 3, 30.0
LEVEL_M = 30.0
"""Waves longer than this are the level of the few metres behind a stop."""
LEGEND = (
    "distance from the start of the section, m\n"
    "black: the road; dotted: where the vehicle stands; bold: cross correlation with the road; "
    "in the panel: the range of what leaves it"
)
COLOURS = {"temporal": "C0", "spatial": "C2", "kalman": "C4", "road": "C3", "response": "C1"}
"""By the first word of a pipeline's name."""


def on_the_encoders_axis(driven: Driven, points: FloatArray, interval_m: float) -> FloatArray:
    """Return the road, filtered as profiles are, at ``points`` of the encoder's distance."""
    road = np.interp(points, driven.encoder_m, driven.truth.track(TRACK).elevation)
    return high_pass(road, interval_m)


def beyond(elevation_mm: FloatArray) -> str:
    """Return between which values an elevation lies that leaves the panel; else nothing."""
    lowest, highest = elevation_mm.min(), elevation_mm.max()
    if max(-lowest, highest) <= LIMIT_MM:
        return ""
    unit, scale = ("m", 1e-3) if max(-lowest, highest) >= 1000.0 else ("mm", 1.0)
    digits = 1 if unit == "m" else 0
    return f"{scale * lowest:+.{digits}f} to {scale * highest:+.{digits}f} {unit}".replace("-", "−")


def print_behind(name: str, place: IndexArray, off: FloatArray, interval_m: float) -> None:
    """Print the RMS of ``off`` in m at the points ``place``, as it is and without its level."""
    short = high_pass(off, interval_m, LEVEL_M)[place]
    whole, left = (1e3 * np.sqrt(np.mean(part**2)) for part in (off[place], short))
    print(f"{name:42s}{whole:10.2f} mm; high-pass filtered at {LEVEL_M:g} m{left:10.2f} mm")


def draw_panel(
    axis: Any, name: str, profile: floatref.Profile, driven: Driven, stop_m: float | None
) -> None:
    """Draw one profile over the road; places count from the start of the section."""
    elevation = profile.track(TRACK).elevation
    points = profile.start_m + profile.interval_m * np.arange(elevation.size)
    road = on_the_encoders_axis(driven, points, profile.interval_m)
    truth = floatref.Profile(profile.interval_m, (ProfileTrack.of(TRACK, road),), profile.start_m)
    agreement = score(truth, profile)[TRACK].cross_correlation
    place = points - SECTION_START_M
    inside = (place >= PEAK_M[0]) & (place <= PEAK_M[1])
    if stop_m is not None:
        behind = np.flatnonzero(inside & (place > stop_m))
        print_behind(name, behind, elevation - road, profile.interval_m)
    found = 1e3 * elevation[inside]
    axis.plot(place[inside], found, color=COLOURS[name.split("-")[0]], linewidth=1.6)
    axis.plot(place[inside], 1e3 * road[inside], color="black", linewidth=0.7)
    axis.set_title(name, fontsize=8, loc="left")
    axis.set_title(f"{agreement:.3f}", fontsize=9, loc="right", fontweight="bold")
    where = {"transform": axis.transAxes, "ha": "right", "va": "bottom", "fontsize": 8}
    axis.text(0.98, 0.03, beyond(found), bbox={"fc": "white", "ec": "none", "pad": 1.0}, **where)


def draw(run: str, driven: Driven, path: Path) -> None:
    """Draw a panel for each pipeline in the order of their families."""
    rows = -(-len(driven.profiles) // COLUMNS)
    size = (11.0, 1.75 * rows)
    figure, axes = pyplot.subplots(
        rows, COLUMNS, sharex=True, sharey=True, figsize=size, squeeze=False
    )
    stop_m = RUNS[run].event_location_m
    for axis, (name, profile) in zip(axes.flat, driven.profiles.items(), strict=False):
        draw_panel(axis, name, profile, driven, stop_m)
        if stop_m is not None:
            axis.axvline(stop_m, color="grey", linewidth=0.7, linestyle=":")
        axis.grid(alpha=0.25)
    for axis in axes.flat[len(driven.profiles) :]:
        axis.set_axis_off()
    for axis in axes.flat[max(0, len(driven.profiles) - COLUMNS) : len(driven.profiles)]:
        axis.tick_params(labelbottom=True)
    axes[0, 0].set_ylim(-LIMIT_MM, LIMIT_MM)
    axes[0, 0].set_xlim(*PEAK_M)
    figure.supylabel("elevation, mm", fontsize=9)
    figure.supxlabel(LEGEND, fontsize=9)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main() -> None:
    """Drive the run, and draw."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("path", type=Path)
    parser.add_argument("--run", default="sg_10.7s_0.20g")
    given = parser.parse_args()
    processing = Processing(floatref.pipelines())
    scenario = scenario_of_run(given.run, tracks=(TRACK,), imu=True, gnss=True, **KIND)
    draw(given.run, processing.drive(scenario, given.run), given.path)


if __name__ == "__main__":
    main()
