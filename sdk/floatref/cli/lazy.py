"""A click group whose sub-commands are imported when they are called, and their errors."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from io import TextIOWrapper
from traceback import walk_tb
from typing import Any

import click

from floatref.cli.choices import hint_at_choices, hint_behind
from floatref.cli.program.interrupts import INTERRUPTED, raising_interrupt
from floatref.errors import FloatrefError, TargetExists

OVERWRITE = "--overwrite"
STREAMS = ("stdin", "stdout", "stderr")
"""Names in `sys`, in the order of the file descriptors 0, 1 and 2."""


def open_outputs() -> None:
    """Open the closed standard streams on the null device.

    Otherwise the next opened file would be used as a standard stream, by us and by child processes.
    """
    while (number := os.open(os.devnull, os.O_RDWR)) < len(STREAMS):
        os.set_inheritable(number, True)
    os.close(number)
    for number, name in enumerate(STREAMS):
        if getattr(sys, name) is None:
            mode = "w" if number else "r"
            # It stays open as long as the process.
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115


def replace_unknown_letters() -> None:
    """Have letters that an output's encoding lacks written as `?`; those of JSON are ASCII.

    A pipe of Windows has the code page of the system, in which there is no σ, and often no dash.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")


class UnusableInput(click.ClickException):
    """One clear line on stderr, exit code 2."""

    exit_code = 2


class LazyGroup(click.Group):
    """Group of sub-commands given as ``{name: ("module:attribute", summary)}``."""

    def __init__(
        self, *args: Any, lazy: dict[str, tuple[str, str]] | None = None, **kwargs: Any
    ) -> None:
        """Store where each sub-command is; import nothing."""
        super().__init__(*args, **kwargs)
        self._lazy = lazy or {}

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the sub-commands in the order they were given."""
        return list(self._lazy)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import and return sub-command ``cmd_name``, or None if it is unknown."""
        if cmd_name not in self._lazy:
            return None
        module, attribute = self._lazy[cmd_name][0].split(":")
        command = getattr(import_module(module), attribute)
        if not isinstance(command, click.Command):
            raise TypeError(f"{module}:{attribute} is not a command")
        hint_at_choices(command)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the sub-command that ``args`` begin with; UsageError, with the one meant."""
        if args and args[0] in self._lazy:
            # Most of a short command is the loading of modules: what ends it then knows its name.
            ctx.invoked_subcommand = args[0]
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError as error:
            raise click.UsageError(
                f"{error.message}{hint_behind(args[0], self._lazy)}", ctx
            ) from error

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the sub-commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, text) for name, (_, text) in self._lazy.items()])

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:
        """Parse the arguments, with `--help`; errors as those of `invoke`."""
        open_outputs()
        replace_unknown_letters()
        with self._interruptible(None), _one_line():
            return super().make_context(*args, **kwargs)

    def invoke(self, ctx: click.Context) -> Any:
        """Run the sub-command; an error the user can act on becomes one line and exit code 2."""
        with self._interruptible(ctx), _one_line(), self._name_overwrite(ctx):
            return super().invoke(ctx)

    def describe_interruption(self, ctx: click.Context | None) -> str:
        """Return the line of a command that Ctrl-C has ended."""
        return "Interrupted"

    @contextmanager
    def _interruptible(self, ctx: click.Context | None) -> Iterator[None]:
        """Make one line and exit code 130 of Ctrl-C, and of SIGTERM where a command takes it."""
        try:
            with raising_interrupt():
                yield
        except (KeyboardInterrupt, click.Abort):
            click.echo(self.describe_interruption(ctx), err=True)
            raise click.exceptions.Exit(INTERRUPTED) from None

    @contextmanager
    def _name_overwrite(self, ctx: click.Context) -> Iterator[None]:
        """Name the option of a command that can replace the target which it refuses."""
        try:
            yield
        except TargetExists as error:
            command = self.get_command(ctx, ctx.invoked_subcommand or "")
            options = [name for param in command.params for name in param.opts] if command else []
            if OVERWRITE not in options:
                raise
            raise TargetExists(f"{error}, or replace it with {OVERWRITE}") from error


@contextmanager
def _one_line() -> Iterator[None]:
    try:
        yield
    except click.UsageError as error:
        # click puts three lines of usage before an error that knows its context.
        if not isinstance(error, getattr(click.exceptions, "NoArgsIsHelpError", ())):
            error.ctx = None
        raise
    except FloatrefError as error:
        raise UnusableInput(" ".join(str(error).split())) from error
    except BrokenPipeError:
        raise
    except MemoryError as error:
        what = f"not enough memory ({error})" if str(error) else "not enough memory"
        raise UnusableInput(f"{what}; cut the run into shorter ones") from error
    except OSError as error:
        raise UnusableInput(f"{_place(error)}{error.strerror or error}") from error


def _place(error: OSError) -> str:
    """Return the place of ``error``, followed by a colon; "" if that is unknown."""
    if error.filename:
        return f"{error.filename}: "
    modules = [frame.f_globals.get("__name__", "") for frame, _ in walk_tb(error.__traceback__)]
    if not any(name == click.echo.__module__ or name.startswith("rich.") for name in modules):
        return ""
    _drop_output()
    return "standard output: "


def _drop_output() -> None:
    """Redirect standard output to the null device: remaining text would fail again at exit."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
