"""`floatref vehicle`: estimates of a vehicle from its runs, as settings for the next runs."""

from collections.abc import Mapping, Sequence
from math import hypot, isfinite, sqrt
from pathlib import Path
from typing import Any

import click

from floatref.cli.printing import print_json, print_table
from floatref.engine.formats import profile_of
from floatref.errors import InputError
from floatref.files.atomic import check_target, replace_file
from floatref.files.document import write_document
from floatref.files.sources import name_errors, real_path

PAIRS = (("lean_expected_rad", "lean_sigma_rad"), ("tilt_expected", "tilt_sigma"))
"""Estimates of a run, each with its 1-σ."""
NAMES = frozenset(name for pair in PAIRS for name in pair)


@click.command("vehicle")
@click.argument("profiles", metavar="[PROFILE...]", nargs=-1, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="FILE.json",
    help="Where to write the settings.",
)
@click.option(
    "--slip",
    nargs=2,
    type=click.Path(path_type=Path),
    metavar="BRAKE PASS",
    help="Profiles of two passes over one road, one with a brake and one at speed.",
)
@click.option("--overwrite", is_flag=True, help="Replace what is there.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def vehicle(
    profiles: tuple[Path, ...],
    out: Path,
    slip: tuple[Path, Path] | None,
    overwrite: bool,
    as_json: bool,
) -> None:
    """Write settings of a vehicle's lean and tilt, estimated in the runs of PROFILEs.

    All PROFILEs are of one vehicle. A road-prior pipeline estimates both when it brakes. With
    --slip the settings also have the slip of its encoder's wheel, by which the distance is
    corrected. `floatref process --settings` reads the result, so that the next run begins with
    them.
    """
    check_target(out, overwrite)
    if not profiles and slip is None:
        raise InputError("no profile is given; give PROFILEs, or --slip BRAKE PASS, or both")
    if len({real_path(place) for place in profiles}) < len(profiles):
        raise InputError("a profile is given twice; give every run once")
    pipeline, learned = _read_estimates(profiles) if profiles else ("", [])
    settings = combine_estimates(learned) if learned else {}
    found = _read_slip(slip) if slip else {}
    settings |= {"slip_per_g": found["slip_per_g"]} if found else {}
    with replace_file(out, overwrite) as beside:
        write_document(settings, beside)
    report: dict[str, Any] = {"file": str(out), "pipeline": pipeline, "runs": len(learned)}
    report |= {"settings": settings} | ({"slip": found} if found else {})
    if as_json:
        print_json(report)
        return
    if learned:
        _print_table(out, profiles, learned, settings)
    if found:
        _print_slip(out, found)


def combine_estimates(learned: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Return the settings of a vehicle from the estimates ``learned`` in its runs.

    Means are weighted by 1/σ²; their 1-σ is that of one more run: 1/√Σ(1/σ²) and the spread of the
    runs about the mean, in quadrature.
    """
    found = {}
    for mean, sigma in PAIRS:
        weights = [1.0 / run[sigma] ** 2 for run in learned]
        total = sum(weights)
        value = sum(w * run[mean] for w, run in zip(weights, learned, strict=True)) / total
        off = (w * (run[mean] - value) ** 2 for w, run in zip(weights, learned, strict=True))
        found[mean] = value
        found[sigma] = hypot(1.0 / sqrt(total), sqrt(sum(off) / total))
    return found


def _read_slip(passes: tuple[Path, Path]) -> dict[str, float]:
    """Return the slip of two passes, its 1-σ, and how many stretches agree."""
    from floatref.measures.slip.two_passes import slip_of_passes

    with name_errors(f"{passes[0]} and {passes[1]}"):
        found = slip_of_passes(*map(profile_of, passes))
    return {
        "slip_per_g": found.slip_per_g,
        "slip_sigma_per_g": found.sigma_per_g,
        "stretches": found.stretches,
    }


def _print_slip(out: Path, found: Mapping[str, float]) -> None:
    numbers = [100.0 * found["slip_per_g"], 100.0 * found["slip_sigma_per_g"]]
    row = ["slip", *(f"{number:.2f}" for number in numbers), f"{found['stretches']:.0f}"]
    print_table(str(out), ("", "% per g", "1-σ", "stretches"), [row])


def _read_estimates(profiles: Sequence[Path]) -> tuple[str, list[Mapping[str, float]]]:
    """Return the pipeline of all ``profiles`` and the estimates of each run."""
    read = {place: profile_of(place) for place in profiles}
    pipeline = next(iter(read.values())).pipeline
    for place, profile in read.items():
        if profile.pipeline != pipeline:
            other = profile.pipeline or "missing"
            raise InputError(f"{place}: pipeline is {other}, that of the first is {pipeline}")
    return pipeline, [
        _check_estimates(place, profile.provenance) for place, profile in read.items()
    ]


def _check_estimates(place: Path, provenance: Mapping[str, Any]) -> Mapping[str, float]:
    learned = provenance.get("learned")
    if learned is None:
        raise InputError(
            f"{place}: holds no estimate of a vehicle; give a profile by a road-prior pipeline, "
            "of a run with a brake"
        )
    if not isinstance(learned, dict) or learned.keys() != NAMES:
        raise InputError(f"{place}: provenance learned has to hold {', '.join(sorted(NAMES))}")
    for name, value in learned.items():
        good = isinstance(value, int | float) and isfinite(value)
        if not good or (name.endswith(("sigma", "sigma_rad")) and value <= 0):
            raise InputError(f"{place}: learned {name} is {value}; process the run again")
    return learned


def _print_table(
    out: Path,
    profiles: Sequence[Path],
    learned: Sequence[Mapping[str, float]],
    settings: Mapping[str, float],
) -> None:
    names = [name for pair in PAIRS for name in pair]
    lines = [*zip(map(str, profiles), learned, strict=True), ("kept", settings)]
    rows = [[title, *(f"{values[name]:.5f}" for name in names)] for title, values in lines]
    print_table(str(out), ("run", *names), rows)
