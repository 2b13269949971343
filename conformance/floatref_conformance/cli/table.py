"""`conformance table`: the published tables beside ours, or drawn stops against the truth."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from floatref.errors import InputError
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES
from floatref_conformance.table.families.conditions import FAMILIES, STOPS_FAMILY
from floatref_conformance.table.families.family_settings import ALL, FamilySettings
from floatref_conformance.table.table_settings import TableSettings

OF_PUBLISHED_RUNS = ("runs", "roads", "seeds")
"""What makes no sense with drawn stops."""


def _count_option(
    name: str, default: int, text: str, least: int = 1
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Return the option ``name``, a whole number of ``least`` or more, whose help is ``text``."""
    kind = click.IntRange(min=least)
    return click.option(name, type=kind, default=default, show_default=True, help=text)


@click.command()
@click.option("--plot", type=click.Path(path_type=Path), help="Draw the table to FILE.png.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@_count_option("--roads", TableSettings.roads, "How many roads.")
@_count_option(
    "--seeds", TableSettings.seeds, "Sets of passes on each road, with other sensor errors."
)
@_count_option(
    "--seed", TableSettings.seed, "Draws the roads, all sensor errors, and drawn stops.", least=0
)
@click.option(
    "--vehicle",
    metavar="NAME",
    default=TableSettings.vehicle,
    show_default=True,
    help=f"What drives: {', '.join(VEHICLES)}. Drawn stops: all of them unless it is given.",
)
@click.option(
    "--run", "runs", metavar="RUN", multiple=True, help="This run alone; may be repeated."
)
@click.option(
    "--pipeline",
    "pipelines",
    metavar="NAME",
    multiple=True,
    help="This one alone; may be repeated.",
)
@_count_option(
    "--stops",
    0,
    "Drawn stops of each vehicle on each of three roads in place of the runs; 0: the runs.",
    least=0,
)
@click.option(
    "--family",
    type=click.Choice((*FAMILIES, STOPS_FAMILY, ALL)),
    help="Drawn drives of this family of roads, vehicles and sensors in place of the runs.",
)
@_count_option("--drives", FamilySettings.drives, "With --family: drives of each condition.")
@_count_option("--jobs", FamilySettings.jobs, "With --family: processes at a time.")
def table(
    plot: Path | None,
    as_json: bool,
    roads: int,
    seeds: int,
    seed: int,
    vehicle: str,
    runs: tuple[str, ...],
    pipelines: tuple[str, ...],
    stops: int,
    family: str | None,
    drives: int,
    jobs: int,
) -> None:
    """Put the published results beside ours: 17 runs through every pipeline.

    Peak of the short-interval roughness profile, error of the IRI and cross correlation with a
    reference pass at 72 km/h, averaged over simulated roads, sensor errors and wheel paths. The
    table judges nothing. All of it takes a quarter of an hour on two free cores, more than 2 GB of
    memory and 1.2 GB of temporary files.

    With --stops N every vehicle makes N drawn stops (0.5 to 120 s) on each of three roads (IRI 0.8,
    1.8 and 4 m/km), and what the pipelines make of 160.9 m around the stop is compared with the
    truth along the laser's path, high-pass filtered as profiles are: cross correlation, error of
    the IRI, and how often the truth lies within two sigma.

    With --family every condition of the family is driven --drives times on drawn roads, vehicles
    and sensors: `single` changes one thing at a time at one stop, `urban` has stops on crowns,
    humps, dips and changes of grade, `rural` speed that changes, curves and concrete, `harsh` hard
    brakes, leaf springs and all at once. Quantiles of the cross correlation and of the IRI's error
    are shown along the true distance and along the encoder's, and at the end where points that are
    marked valid are wrong. `all` takes some twenty minutes on two free cores. `stops`, which is not
    of it, has stops of 1 to 60 s on plain roads, crowns, humps and breaks of grade, and shows by
    condition and vehicle how many wheel paths are right or wrong, valid or flagged, and how many
    points sigma contains. --jobs changes no figure.
    """
    from floatref_conformance.table.comparison_picture import check_picture

    if stops or family:
        _refuse_options_of_runs("--stops" if stops else "--family")
    _refuse_options_of_families(stops, family)
    settings = TableSettings(seed, roads, seeds, vehicle, runs, pipelines)
    if plot is not None:
        check_picture(plot)
    if family:
        chosen = FamilySettings(family, seed, drives, settings.pipelines, jobs)
        _show_family(chosen, as_json, plot)
    elif stops:
        _show_drawn_stops(stops, settings, as_json, plot)
    else:
        _show_published_runs(settings, as_json, plot)


def _refuse_options_of_runs(other: str) -> None:
    """Raise InputError for an option given beside the ``other`` that has no meaning there."""
    for option in click.get_current_context().command.params:
        if option.name in OF_PUBLISHED_RUNS and _is_given(option.name):
            raise InputError(f"{option.opts[0]}: not together with {other}; leave one of them out")


def _refuse_options_of_families(stops: int, family: str | None) -> None:
    """Raise InputError for what makes no sense beside, or without, --family."""
    for name in ("drives", "jobs"):
        if family is None and _is_given(name):
            raise InputError(f"--{name}: only with --family; add it, or leave --{name} out")
    if family is not None and (stops or _is_given("vehicle")):
        other = "--stops" if stops else "--vehicle"
        raise InputError(f"{other}: not together with --family; leave one of them out")


def _is_given(name: str) -> bool:
    """Return whether the option ``name`` is on the command line."""
    source = click.get_current_context().get_parameter_source(name)
    return source is click.core.ParameterSource.COMMANDLINE


def _show_published_runs(settings: TableSettings, as_json: bool, plot: Path | None) -> None:
    """Make and show the published tables beside ours."""
    from floatref_conformance.table import make_table
    from floatref_conformance.table.comparison_picture import draw_comparison_maps
    from floatref_conformance.table.comparison_text import print_comparison
    from floatref_conformance.table.making import PassProgress
    from floatref_conformance.table.table_document import document

    with PassProgress(settings.passes) as progress:
        made = make_table(settings, progress)
    _show(made, document if as_json else None, print_comparison, plot, draw_comparison_maps)


def _show_drawn_stops(stops: int, chosen: TableSettings, as_json: bool, plot: Path | None) -> None:
    """Make and show the table of drawn stops."""
    from floatref_conformance.table.making import PassProgress
    from floatref_conformance.table.stops import StopSettings, make_stop_table
    from floatref_conformance.table.stops.stop_document import stop_document
    from floatref_conformance.table.stops.stops_picture import draw_stops
    from floatref_conformance.table.stops.stops_text import print_stops

    vehicles = (chosen.vehicle,) if _is_given("vehicle") else ()
    settings = StopSettings(chosen.seed, stops, vehicles, chosen.pipelines)
    with PassProgress(settings.passes) as progress:
        made = make_stop_table(settings, progress)
    _show(made, stop_document if as_json else None, print_stops, plot, draw_stops)


def _show_family(settings: FamilySettings, as_json: bool, plot: Path | None) -> None:
    """Make and show a table of families."""
    from floatref_conformance.table.families.family_document import family_document
    from floatref_conformance.table.families.family_making import make_family_table
    from floatref_conformance.table.families.family_picture import draw_families
    from floatref_conformance.table.families.family_text import print_families
    from floatref_conformance.table.making import PassProgress

    with PassProgress(settings.passes) as progress:
        made = make_family_table(settings, progress)
    _show(made, family_document if as_json else None, print_families, plot, draw_families)


def _show(
    made: Any,
    document: Callable[[Any], dict[str, Any]] | None,
    print_made: Callable[[Any, Any], None],
    plot: Path | None,
    draw: Callable[[Any, Path], None],
) -> None:
    """Print ``made`` by ``document``, or else as text, and draw it to ``plot`` if given."""
    from floatref_conformance.render.terminal import PipedConsole

    try:
        if document is not None:
            click.echo(json.dumps(document(made), indent=2, allow_nan=False))
        else:
            print_made(made, PipedConsole(emoji=False))
    finally:
        # Minutes of work: neither output is lost because the other one fails.
        if plot is not None:
            draw(made, plot)
