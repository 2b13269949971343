"""`conformance table`: the published tables beside ours."""

import json
from pathlib import Path

import click

from floatref_conformance.proving_ground.vehicles import VEHICLES
from floatref_conformance.table.settings import TableSettings


@click.command()
@click.option("--plot", type=click.Path(path_type=Path), help="Write heat maps to FILE.png.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@click.option(
    "--roads",
    type=click.IntRange(min=1),
    default=TableSettings.roads,
    show_default=True,
    help="How many roads.",
)
@click.option(
    "--seeds",
    type=click.IntRange(min=1),
    default=TableSettings.seeds,
    show_default=True,
    help="Sets of passes on each road, with other sensor errors.",
)
@click.option(
    "--seed",
    type=click.IntRange(min=0),
    default=TableSettings.seed,
    show_default=True,
    help="Draws the roads and all sensor errors.",
)
@click.option(
    "--vehicle",
    metavar="NAME",
    default=TableSettings.vehicle,
    show_default=True,
    help=f"What drives: {', '.join(VEHICLES)}.",
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
def table(
    plot: Path | None,
    as_json: bool,
    roads: int,
    seeds: int,
    seed: int,
    vehicle: str,
    runs: tuple[str, ...],
    pipelines: tuple[str, ...],
) -> None:
    """Put the published results beside ours: 17 runs through every pipeline.

    Peak of the short-interval roughness profile, error of the IRI and cross correlation with a
    reference pass at 72 km/h, averaged over simulated roads, sensor errors and wheel paths. The
    table judges nothing. All of it takes a quarter of an hour on two free cores, more than 2 GB of
    memory and 1.2 GB of temporary files.
    """
    from floatref_conformance.render.comparison_picture import check_picture, draw_comparison_maps
    from floatref_conformance.render.comparison_text import print_comparison
    from floatref_conformance.render.pass_progress import PassProgress
    from floatref_conformance.render.terminal import PipedConsole
    from floatref_conformance.table import make_table
    from floatref_conformance.table.document import document

    settings = TableSettings(seed, roads, seeds, vehicle, runs, pipelines)
    if plot is not None:
        check_picture(plot)
    with PassProgress(settings.passes) as progress:
        made = make_table(settings, progress)
    try:
        if as_json:
            click.echo(json.dumps(document(made), indent=2, allow_nan=False))
        else:
            print_comparison(made, PipedConsole(emoji=False))
    finally:
        # Minutes of work: neither output is lost because the other one fails.
        if plot is not None:
            draw_comparison_maps(made, plot)
