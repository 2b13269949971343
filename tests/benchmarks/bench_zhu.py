"""Section 4 of Zhu et al. (2021): five random roads, an obstacle, two speeds; beside the print.

    python tests/benchmarks/bench_zhu.py [--seeds N] [--plot FILE.png] [--page FILE]

``--page`` writes the three tables into a Markdown page that has ones like them.
"""

import argparse
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import zhu_simulation as zhu
from tables import show, write_page

from floatref.vehicle_response import Hold

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PRINTED = (8.84, 10.34, 7.61, 7.47, 7.39)
"""Table 2, in percent."""
COLUMNS = (
    *("road", "front axle", "rear axle", "both, by (8)", "force linear"),
    *("road rough between samples", "Table 2"),
)
BANDS = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.5)
"""Edges in cycles/m of the bands that spectra are compared in."""
OBSTACLE_COLUMNS = "drawn noise", "largest error on it, %", "elsewhere, %"
BAND_COLUMNS = ("speed", "rate", *(f"{low:g}-{high:g}" for low, high in pairwise(BANDS)))
PART_M = 51.2
"""Length of the parts of a road whose spectra are averaged."""
SPEED, RATE, LENGTH_M = 10.0, 200.0, 100.0
SPEEDS = ((SPEED, RATE), (20.0, 400.0), (20.0, RATE))
"""Speed in m/s and rate in Hz: twice tied by 20 samples per metre, and once not."""


def random_road(seed: int, spacing_m: float, hold: Hold) -> list[float]:
    """Return the RMSE in percent of front axle, rear axle and both, on one drawn road."""
    drive = zhu.driven(zhu.random_road(seed, spacing_m, LENGTH_M), spacing_m, SPEED, RATE)
    roads, both = zhu.estimated(drive, *zhu.measured(drive, seed), hold)
    found = [(roads[:, 1], 1), (roads[:, 0], 0), (both, 1)]
    return [zhu.rmse_percent(road, drive.road[:, axle]) for road, axle in found]


def random_roads(seeds: int) -> list[list[str]]:
    """Return one line of the table for every road, and their mean."""
    rows = []
    for seed in range(seeds):
        sampled = random_road(seed, SPEED / RATE, Hold.ZERO_ORDER)
        linear = random_road(seed, SPEED / RATE, Hold.FIRST_ORDER)[2]
        rough = random_road(seed, SPEED / RATE / 10, Hold.FIRST_ORDER)[2]
        rows.append([*sampled, linear, rough])
    means = np.mean(rows, axis=0).tolist()
    printed = [f"{p:.2f}" for p in PRINTED] + [""] * max(0, seeds - len(PRINTED))
    lines = [
        [str(n + 1), *(f"{x:.2f}" for x in row), p]
        for n, (row, p) in enumerate(zip(rows, printed, strict=False))
    ]
    return [*lines, ["mean", *(f"{x:.2f}" for x in means), f"{np.mean(PRINTED):.2f}"]]


def over_obstacle(seed: int) -> tuple[zhu.Array, zhu.Array, zhu.Array]:
    """Return place in m, obstacle and its estimate in m."""
    spacing_m = SPEED / RATE / 10
    drive = zhu.driven(zhu.obstacle(spacing_m, 40.0), spacing_m, SPEED, RATE)
    _, both = zhu.estimated(drive, *zhu.measured(drive, seed), Hold.ZERO_ORDER)
    return SPEED / RATE * np.arange(both.size), drive.road[:, 1], both


def obstacles(seeds: int) -> list[list[str]]:
    """Return the largest errors on and beside the obstacle, but for the two samples at its ends."""
    lines = []
    for seed in range(seeds):
        place, true, found = over_obstacle(seed)
        on, away = (place > 8.02) & (place < 8.78), (place < 7.98) | (place > 8.82)
        errors = [np.abs(found - true)[where].max() for where in (on, away)]
        lines.append([str(seed + 1), *(f"{100 * e / 0.2:.1f}" for e in errors)])
    return lines


def at_speed(speed: float, rate_hz: float, length_m: float = 400.0) -> tuple[zhu.Array, ...]:
    """Return wave numbers and densities of estimate and road, of one road at any speed."""
    from scipy.signal import welch

    spacing_m = 0.005
    drive = zhu.driven(zhu.random_road(7, spacing_m, length_m), spacing_m, speed, rate_hz)
    _, both = zhu.estimated(drive, *zhu.measured(drive, 7), Hold.FIRST_ORDER)
    points = rate_hz / speed
    part = round(PART_M * points)
    waves, found = welch(both, points, nperseg=part)
    return waves, found, welch(drive.road[:, 1], points, nperseg=part)[1]


def band_ratios(waves: zhu.Array, density: zhu.Array, other: zhu.Array) -> list[float]:
    inside = [(waves >= low) & (waves < high) for low, high in pairwise(BANDS)]
    return [float(density[i].sum() / other[i].sum()) for i in inside]


def speeds() -> list[list[str]]:
    """Return the ratio of estimate to road by band, at two speeds and rates."""
    lines = []
    for speed, rate_hz in SPEEDS:
        ratios = band_ratios(*at_speed(speed, rate_hz))
        lines.append([f"{speed:g} m/s", f"{rate_hz:g} Hz", *(f"{r:.2f}" for r in ratios)])
    return lines


def draw(path: Path) -> None:
    """Draw road and estimate, their spectra, the obstacle, and spectra at two speeds."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(2, 2, figsize=(10.0, 7.0), layout="constrained")
    spacing_m = SPEED / RATE
    drive = zhu.driven(zhu.random_road(0, spacing_m, LENGTH_M), spacing_m, SPEED, RATE)
    _, both = zhu.estimated(drive, *zhu.measured(drive, 0), Hold.ZERO_ORDER)
    place = spacing_m * np.arange(both.size)
    for axis, (x, road, found), title in (
        (axes[0, 0], (place, drive.road[:, 1], both), "Class E at 10 m/s, the first of five"),
        (axes[0, 1], over_obstacle(0), "Obstacle of (16)"),
    ):
        axis.plot(x, 1e3 * road, color="0.3", linewidth=1.6, label="road")
        axis.plot(x, 1e3 * found, color="C3", linewidth=0.9, label="estimate")
        axis.set(title=title, xlabel="distance, m", ylabel="elevation, mm")
    axes[0, 0].set_xlim(20.0, 60.0)
    axes[0, 1].set_xlim(4.0, 24.0)
    _draw_spectra(axes[1, 0], axes[1, 1])
    for axis in axes.flat:
        axis.grid(alpha=0.3)
        axis.legend()
    figure.savefig(path, dpi=110)


def _draw_spectra(density: "Axes", ratio: "Axes") -> None:
    edges = np.geomspace(BANDS[0], 10.0, 28)
    for number, (speed, rate_hz) in enumerate(SPEEDS):
        waves, found, road = at_speed(speed, rate_hz)
        label, colour = f"{speed:g} m/s at {rate_hz:g} Hz", f"C{3 - number}"
        if number == 0:
            density.loglog(waves[1:], road[1:], color="0.3", linewidth=1.6, label="road")
        density.loglog(waves[1:], found[1:], color=colour, linewidth=0.8, label=label)
        inside = [(waves >= low) & (waves < high) for low, high in pairwise(edges)]
        rows = [(waves[i].mean(), found[i].sum() / road[i].sum()) for i in inside if i.any()]
        ratio.semilogx(*np.transpose(rows), color=colour, label=label)
    density.set(title="One road, 400 m", xlabel="wave number, cycles/m", ylabel="density, m³")
    ratio.set(title="Estimate over road", xlabel="wave number, cycles/m", ylabel="ratio of power")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--plot", type=Path, help="figure to draw")
    parser.add_argument("--page", type=Path, help="Markdown page whose table is replaced")
    return parser.parse_args()


def main() -> None:
    """Print the three tables of section 4."""
    asked = arguments()
    tables = [
        (
            "RMSE in percent, class E at 10 m/s, 200 Hz, noise 5 %",
            COLUMNS,
            random_roads(asked.seeds),
        ),
        ("Obstacle, percent of its height", OBSTACLE_COLUMNS, obstacles(asked.seeds)),
        ("Power of the estimate over that of the road, by band", BAND_COLUMNS, speeds()),
    ]
    for title, columns, lines in tables:
        show(title, columns, lines, 110)
        if asked.page:
            write_page(asked.page, lines, columns)
    if asked.plot:
        draw(asked.plot)


if __name__ == "__main__":
    main()
