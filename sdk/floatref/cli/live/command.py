"""`floatref live`: samples from another program, points of the profile back."""

from pathlib import Path

import click

from floatref.cli.batch.interruption import interruptible
from floatref.cli.live.live_views import make_monitor, open_views
from floatref.cli.number_option import number_option
from floatref.errors import InputError, TargetExists
from floatref.files.atomic import check_target
from floatref.live.session.connections import is_loopback, read_token, serve_connections
from floatref.live.session.live_run import SAVE_S, LiveRun
from floatref.live.session.peers import followed, standard_streams
from floatref.live.session.serving import Serving

HERE = "127.0.0.1"
LAST_PORT = 65_535
LONGEST_SAVE_S = 3600.0
SAVED = "Interrupted; the run is saved, go on with --resume"
UNSAVED = "Interrupted; the run is as it was saved last, go on with --resume"


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
@click.option("--listen", type=int, metavar="PORT", help="Let a program connect here; 0: any.")
@click.option("--host", default=HERE, show_default=True, help="Address to listen at.")
@click.option("--allow-remote", is_flag=True, help="Let programs of other hosts connect.")
@click.option(
    "--token-file",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="File with the token that a hello has to hold; other hosts need it.",
)
@number_option(
    "--save-every",
    SAVE_S,
    "Save the samples that have come at least this often, by the clock of this machine.",
    "save_s",
    "SECONDS",
)
@click.option("--display", is_flag=True, help="Show the state of the run in this terminal.")
@click.option(
    "--web",
    type=int,
    is_flag=False,
    flag_value=0,
    metavar="[PORT]",
    help="Show it on a page on this machine; without PORT at a free one.",
)
def live(
    out: Path,
    resume: bool,
    follow: Path | None,
    listen: int | None,
    host: str,
    allow_remote: bool,
    token_file: Path | None,
    save_s: float,
    display: bool,
    web: int | None,
) -> None:
    """Make a profile of samples while they come: messages in, points out.

    Messages, as JSON lines or Arrow IPC, come from standard input, and answers go to standard
    output, unless a program connects at a port. docs/live-messages.md has their schema.
    """
    _check(out, resume, follow, listen, save_s)
    token = _check_port(listen, host, allow_remote, token_file)
    monitor = make_monitor(out, display, web)
    run = LiveRun(out, resume, save_s, monitor)
    try:
        with open_views(monitor, display, web, _say):
            _serve(run, follow, listen, host, token)
    finally:
        run.close()


def _serve(run: LiveRun, follow: Path | None, listen: int | None, host: str, token: str) -> None:
    with interruptible(lambda: _describe_end(run)):
        if listen is not None:
            serve_connections(run, host, listen, token, click.echo, _say)
            return
        with standard_streams() if follow is None else followed(follow) as peer:
            Serving(run, peer).serve()


def _describe_end(run: LiveRun) -> str:
    if run.complete or not run.is_begun:
        return "Interrupted"
    return SAVED if run.is_saved else UNSAVED


def _check(out: Path, resume: bool, follow: Path | None, listen: int | None, save_s: float) -> None:
    """Raise InputError now for what cannot work later."""
    if not resume and out.exists():
        raise TargetExists(f"{out}: exists; go on with --resume, or choose another name")
    check_target(out, overwrite=True)
    if follow is not None and listen is not None:
        raise InputError("--follow and --listen: both say where messages come from; give one")
    if not 0.0 <= save_s <= LONGEST_SAVE_S:
        raise InputError(f"--save-every is {save_s:g}; give 0 to {LONGEST_SAVE_S:g} s")


def _check_port(listen: int | None, host: str, allow_remote: bool, token_file: Path | None) -> str:
    """Return the token, empty without one; InputError unless only this host can connect.

    With ``allow_remote`` others may, and then a token is needed.
    """
    if listen is None and (host != HERE or allow_remote or token_file is not None):
        raise InputError("--host, --allow-remote and --token-file are for --listen; give a port")
    if listen is not None and not 0 <= listen <= LAST_PORT:
        raise InputError(f"--listen is {listen}; give a port from 0 to {LAST_PORT}")
    if not is_loopback(host) and not (allow_remote and token_file is not None):
        raise InputError(
            f"--host {host}: lets other hosts connect; give --allow-remote and --token-file too"
        )
    return "" if token_file is None else read_token(token_file)


def _say(text: str) -> None:
    click.echo(text, err=True)
