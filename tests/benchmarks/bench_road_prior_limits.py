"""Where the road-prior smoother fails: a stop made worse in many ways, each at some severities.

Every one is simulated, processed by the road prior and by two pipelines for the same nominal
sensors, and compared with the road under the laser over 160.9 m about the stop, after the IRI
filter. Points are compared along the encoder's distance: what the encoder is off by is the error of
the axis, not of the elevation. Run as

    python tests/benchmarks/bench_road_prior_limits.py [--quick] [--seeds N] [--only KIND...]
        [--set NAME=VALUE...] [--json FILE] [--page FILE] [--plot FILE]
"""

import argparse
import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from road_prior_adversities import Adversity, adversities
from road_prior_measuring import OURS, Row, measured, quietly, simulated, stretch, truth
from tables import show, write_page

from floatref.measures import high_pass

LEAST = 0.96
"""Cross correlation below which a case counts as a failure."""
COLUMNS = (
    *("kind", "severity", "road prior", "lowest", "IRI, %", "within 2 sigma, %", "valid, %"),
    *("adaptive, temporal", "reflection, spatial"),
)
DRAWN = ("none", "crack", "coarse texture", "creeping", "locked wheel", "laser dropout")
"""Kinds that are drawn where none are asked for."""


def cells(rows: Sequence[Row]) -> list[str]:
    """Return one line of the table; ``rows`` are those of a case."""
    ours, *others = rows
    line = [ours.kind, ours.severity]
    if ours.found:
        mark = "" if ours.lowest >= LEAST else " !"
        line += [f"{ours.mean('cross_correlation'):.3f}", f"{ours.lowest:.3f}{mark}"]
        line += [f"{ours.mean('iri_error_percent'):+.1f}"]
        line += [f"{ours.mean(f'{name}_percent'):.1f}" for name in ("within", "valid")]
    else:
        line += ["refused"] * 5
    return line + [f"{o.mean('cross_correlation'):.3f}" if o.found else "refused" for o in others]


def draw(cases: Sequence[Adversity], settings: dict[str, float], path: Path) -> None:
    """Draw the error and two sigma of each case against the distance from the stop."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    size = (9.0, 1.8 * len(cases))
    figure, axes = pyplot.subplots(len(cases), 1, sharex=True, figsize=size, squeeze=False)
    for case, axis in zip(cases, axes[:, 0], strict=True):
        made = simulated(case, 0)
        track = quietly(made.recording, OURS, settings).tracks[0]
        interval_m = made.truth.interval_m
        points = interval_m * np.arange(track.elevation.size)
        road = high_pass(truth(made, track.name, points), interval_m)
        inside = stretch(made, case.where_m, interval_m)
        place = (points - points[(inside.start + inside.stop) // 2])[inside]
        axis.fill_between(place, -2e3 * track.sigma[inside], 2e3 * track.sigma[inside], alpha=0.3)
        axis.plot(place, 1e3 * (track.elevation - road)[inside], color="C3", linewidth=0.8)
        axis.set_title(f"{case.kind}, {case.severity}", fontsize=9, loc="left")
        axis.set_ylabel("error, mm")
    axes[-1, 0].set_xlabel("distance from the stop, m")
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def number(text: str) -> tuple[str, float]:
    """Return name and value of a setting."""
    name, _, value = text.partition("=")
    return name, float(value)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="one seed, every kind's worst alone")
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--only", nargs="+", default=[], help="begins of kinds")
    parser.add_argument("--set", nargs="+", type=number, default=[], help="settings of ours")
    parser.add_argument("--json", type=Path, help="figures, written as they come")
    parser.add_argument("--page", type=Path, help="Markdown page whose table is replaced")
    parser.add_argument("--plot", type=Path, help="draw errors instead of measuring")
    return parser.parse_args()


def main() -> None:
    """Print a line for each case as it is there, and the table."""
    given, lines, figures = arguments(), [], []
    settings = dict(given.set)
    only = tuple(given.only) or (DRAWN if given.plot else ())
    cases = [case for case in adversities() if not only or case.kind.startswith(only)]
    if given.quick or (given.plot and not given.only):
        cases = list({case.kind: case for case in cases}.values())
    if given.plot:
        draw(cases, settings, given.plot)
        return
    for case in cases:
        rows = measured(case, 1 if given.quick else given.seeds, settings)
        lines.append(cells(rows))
        figures += [row.summary() for row in rows]
        print(" | ".join(lines[-1]), flush=True)
        if given.json:
            given.json.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    title = f"Cross correlation with the road; ! below {LEAST}. {settings or ''}"
    show(title, COLUMNS, lines, 150)
    if given.page:
        write_page(given.page, lines, COLUMNS)


if __name__ == "__main__":
    main()
