"""What goes wrong outside a run: one line and an exit code that is never that of a verdict."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from traceback import extract_tb
from typing import Any

import click

from floatref.cli.lazy import LazyGroup
from floatref.cli.program.interrupts import Ending

FAULT_OF_THE_SUITE = 3
MISSING = {
    "table": "no table",
    "faults": "no study",
    "simulate": "no recording",
    "sample": "no sample",
    "selftest": "no counts",
    "certify": "no worksheet",
    "submit": "no archive",
    "matrix": "no matrix",
}
"""What a sub-command that stops early leaves its caller without; for others it is a verdict."""


class NoVerdict(click.ClickException):
    """One clear line on stderr, exit code 3."""

    exit_code = FAULT_OF_THE_SUITE


class VerdictGroup(LazyGroup):
    """Group whose sub-commands alone say 1: whatever they let through ends with another code."""

    def main(self, *args: Any, **kwargs: Any) -> Any:
        """Run the command; where stderr is closed too, only the exit code remains."""
        try:
            return super().main(*args, **kwargs)
        except OSError:
            drop_output()
            sys.exit(FAULT_OF_THE_SUITE)

    def describe_interruption(self, ctx: click.Context | None) -> str:
        """Return the line of a command that Ctrl-C has ended: without what it leaves its caller."""
        return f"Interrupted: {_missing(ctx)}"

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:
        """Parse the arguments, with `--help`; errors as those of `invoke`."""
        with _no_verdict(None):
            return super().make_context(*args, **kwargs)

    def invoke(self, ctx: click.Context) -> Any:
        """Run the sub-command; an error that nobody expected is one line and exit code 3."""
        with _no_verdict(ctx):
            return super().invoke(ctx)


@contextmanager
def _no_verdict(ctx: click.Context | None) -> Iterator[None]:
    try:
        yield
    except (click.ClickException, click.exceptions.Exit, Ending):
        # A signal just before or behind the command has ended the program, and said so.
        raise
    except BrokenPipeError:
        drop_output()
        raise NoVerdict(f"nobody reads the output any more, {_missing(ctx)}") from None
    except (Exception, SystemExit) as error:
        raise NoVerdict(
            f"the suite itself is at fault, {_missing(ctx)}: {in_one_line(error)}"
        ) from error


def _missing(ctx: click.Context | None) -> str:
    return MISSING.get((ctx and ctx.invoked_subcommand) or "", "no verdict")


def in_one_line(error: BaseException) -> str:
    """Return kind and text of ``error``, and the line of code that raised it."""
    text = " ".join(f"{type(error).__name__}: {error}".split())
    frames = extract_tb(error.__traceback__)
    return (
        f"{text} ({os.path.basename(frames[-1].filename)}:{frames[-1].lineno})" if frames else text
    )


def drop_output() -> None:
    """Discard what remains in the buffers, so that flushing them at exit cannot fail."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
            continue
        with suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
