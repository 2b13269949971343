"""`floatref warm`: what pipelines compile, compiled before the first recording is there."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from time import perf_counter

import click

from floatref.cli.printing import print_json, print_table
from floatref.cli.warm.children import Children
from floatref.engine.choosing import BEST
from floatref.engine.plugins import plugins
from floatref.errors import InputError
from floatref.files.scratch import scratch_folder
from floatref.files.sources import name_errors
from floatref.kernels.compiling import stores_code

NOT_STORED = (
    "nothing was stored, numba finds no folder for its cache; name one that can be written in "
    "NUMBA_CACHE_DIR"
)


@click.command("warm")
@click.argument("pipelines", nargs=-1, metavar="[PIPELINE]...")
@click.option("--all", "every", is_flag=True, help="Warm all pipelines.")
@click.option(
    "--jobs",
    type=click.IntRange(1, 64),
    default=2,
    show_default=True,
    help="Pipelines that are warmed side by side.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def warm(pipelines: tuple[str, ...], every: bool, jobs: int, as_json: bool) -> None:
    """Compile now what each PIPELINE would compile with its first recording.

    Without PIPELINE, those that `auto` chooses from. A made-up run is processed, and its profile is
    thrown away; compiled code is stored where numba stores it: beside the modules, in the folder
    NUMBA_CACHE_DIR, or in the cache of the user.
    """
    known = plugins().pipelines()
    if every and pipelines:
        raise InputError("--all warms every pipeline; give it, or names of pipelines")
    names = list(known) if every else list(dict.fromkeys(pipelines or (name for name, _ in BEST)))
    for name in names:
        plugins().pipeline(name)
    taken = _warm_all(names, jobs)
    if not stores_code():
        click.echo(f"Warning: {NOT_STORED}", err=True)
    if as_json:
        print_json({"pipelines": [{"pipeline": n, "wall_s": t} for n, t in taken]})
    else:
        print_table("Warm", ("pipeline", "s"), [[n, f"{t:.1f}"] for n, t in taken])


def _warm_all(names: Sequence[str], jobs: int) -> list[tuple[str, float]]:
    """Return each of the pipelines ``names`` and its time in s; all ends with the first error."""
    children = Children()
    with scratch_folder("warm") as folder, ThreadPoolExecutor(jobs) as pool:
        try:
            return list(pool.map(lambda name: _warm_in_process(children, name, folder), names))
        except BaseException:
            children.end()
            raise


def _warm_in_process(children: Children, name: str, folder: Path) -> tuple[str, float]:
    """Process the made-up run in a process of its own; return the pipeline and the time in s."""
    from floatref.cli.warm.made_up_run import made_up_recording
    from floatref.files import write_recording

    run, begin = folder / f"{name}-run", perf_counter()
    write_recording(made_up_recording(name), run)
    with name_errors(f"pipeline {name}"):
        children.run(["process", str(run), "--pipeline", name, "--out", str(folder / name)])
    return name, perf_counter() - begin
