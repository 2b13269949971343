"""`floatref live`: samples from another program, points of the profile back."""

from pathlib import Path

import click

from floatref.cli.number_option import number_option
from floatref.live.session.live_run import SAVE_S, LiveRun
from floatref.live.session.peers import followed, standard_streams
from floatref.live.session.serving import Serving


@click.command("live")
@click.option(
    "-o",
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="DIRECTORY",
    help="The profile, which grows.",
)
@click.option("--resume", is_flag=True, help="Go on with the run in DIRECTORY.")
@click.option(
    "--follow",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Read messages from a file that another program is writing.",
)
@number_option(
    "--save-every",
    SAVE_S,
    "Save the samples that have come at least this often, by the clock of this machine.",
    "save_s",
    "SECONDS",
)
def live(out: Path, resume: bool, follow: Path | None, save_s: float) -> None:
    """Make a profile of samples while they come: messages in, points out.

    Messages, as JSON lines or Arrow IPC, come from standard input, and answers go to standard
    output. docs/live-messages.md has their schema.
    """
    run = LiveRun(out, resume, save_s)
    try:
        with standard_streams() if follow is None else followed(follow) as peer:
            Serving(run, peer).serve()
    finally:
        run.close()
