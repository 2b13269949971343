"""Section V of Imine et al. beside ours: the chirp, the left wheel, the right wheel that stands.

Usage:

    python tests/benchmarks/bench_imine.py [--seeds N] [--plot FILE.png]
"""

import argparse
from pathlib import Path

import numpy as np
from imine_cases import BENCH, FIELD, TIMES, Case, chirps, drive, left_road, observed
from rich.console import Console
from rich.table import Table

from floatref.values.arrays import FloatArray

MICRO = "µm"


def largest(cases: list[Case], wheel: int) -> float:
    """Return the largest error of an estimate in m, of all ``cases``."""
    return max(float(np.nanmax(np.abs(case.error[:, wheel]))) for case in cases)


def row(case: str, sensors: str, cases: list[Case], printed: str, wheel: int) -> list[str]:
    error, height = largest(cases, wheel), float(np.abs(cases[0].road[:, wheel]).max())
    rms = max(float(np.sqrt(np.nanmean(each.error[:, wheel] ** 2))) for each in cases)
    share = f"{100.0 * error / height:.2f} %" if height else "–"
    return [case, sensors, f"{1e6 * error:.1f} {MICRO}", share, f"{1e6 * rms:.1f} {MICRO}", printed]


def table(chirp: Case, lines: Case, bench: list[Case], field: list[Case]) -> Table:
    """Return the figures beside those in print."""
    made = Table(title="Road by the observer with unknown inputs")
    for column in ("case", "sensors", "largest error", "of the height", "RMS", "print"):
        made.add_column(column)
    made.add_row(*row("V.A chirp, left", "ideal", [chirp], f"5 {MICRO}, 0.5 %", 0))
    made.add_row(*row("V.A chirp, right", "ideal", [chirp], "–", 1))
    made.add_row(*row("V.A chirp, left, straight lines", "ideal", [lines], "–", 0))
    made.add_row(*row("V.B.1 left wheel", "bench", bench, "0.4 %", 0))
    made.add_row(*row("V.B.1 left wheel", "field", field, "–", 0))
    made.add_row(*row("V.B.2 right wheel stands", "bench", bench, "–", 1))
    made.add_row(*row("V.B.2 right wheel stands", "field", field, "2 mm", 1))
    return made


def draw(path: Path, chirp: Case, left: Case, right: Case) -> None:
    """Draw road and estimate of the three cases, and below them the error."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(2, 3, figsize=(13, 6), sharex=True, layout="constrained")
    panels = [
        ("V.A chirp, 0.5 to 10 Hz, ideal sensors", chirp, 0, 1e3, 1e6, "error, µm"),
        ("V.B.1 left wheel, sensors of a bench", left, 0, 1e3, 1e6, "error, µm"),
        ("V.B.2 right wheel stands, sensors of the field", right, 1, 1e3, 1e3, "error, mm"),
    ]
    for (above, below), (title, case, wheel, scale, error_scale, unit) in zip(
        axes.T, panels, strict=True
    ):
        above.plot(TIMES, scale * case.road[:, wheel], color="black", linewidth=2.2, label="road")
        estimate: FloatArray = scale * case.estimate.road[:, wheel]
        above.plot(TIMES, estimate, color="C1", linewidth=0.9, label="estimate")
        if wheel:
            chassis = scale * case.displacements[:, 2]
            above.plot(TIMES, chassis, color="C0", linewidth=0.9, label="chassis, as measured")
        above.set_title(title, fontsize=10)
        above.set_ylabel("height, mm")
        below.plot(TIMES, error_scale * case.error[:, wheel], color="C3", linewidth=0.7)
        below.set_ylabel(unit)
        below.set_xlabel("time, s")
        for axis in (above, below):
            axis.grid(alpha=0.3)
    axes[0, 2].legend(loc="lower right", fontsize=8)
    figure.savefig(path, dpi=110)


def main() -> None:
    """Print the table, and draw the figure if asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--plot", type=Path)
    asked = parser.parse_args()
    swept, drove = drive(chirps), drive(left_road())
    chirp, lines = observed(swept), observed(swept, degree=1)
    seeds = range(1, asked.seeds + 1)
    bench = [observed(drove, BENCH, seed) for seed in seeds]
    field = [observed(drove, FIELD, seed) for seed in seeds]
    Console().print(table(chirp, lines, bench, field))
    if asked.plot:
        draw(asked.plot, chirp, bench[0], field[0])


if __name__ == "__main__":
    main()
