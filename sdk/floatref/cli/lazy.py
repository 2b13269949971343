"""A click group whose sub-commands are imported when they are called, and their errors."""

from importlib import import_module
from typing import Any

import click

from floatref.errors import FloatrefError


class UnusableInput(click.ClickException):
    """One clear line on stderr, exit code 2."""

    exit_code = 2


class LazyGroup(click.Group):
    """Group of sub-commands given as ``{name: ("module:attribute", summary)}``."""

    def __init__(
        self, *args: Any, lazy: dict[str, tuple[str, str]] | None = None, **kwargs: Any
    ) -> None:
        """Keep where each sub-command lives; import none of them."""
        super().__init__(*args, **kwargs)
        self._lazy = lazy or {}

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the sub-commands in the order they were given."""
        return list(self._lazy)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import and return sub-command ``cmd_name``, or None if there is none."""
        if cmd_name not in self._lazy:
            return None
        module, attribute = self._lazy[cmd_name][0].split(":")
        command = getattr(import_module(module), attribute)
        if not isinstance(command, click.Command):
            raise TypeError(f"{module}:{attribute} is not a command")
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the sub-commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, text) for name, (_, text) in self._lazy.items()])

    def invoke(self, ctx: click.Context) -> Any:
        """Run the sub-command; an error the user can act on becomes one line and exit code 2."""
        try:
            return super().invoke(ctx)
        except FloatrefError as error:
            raise UnusableInput(" ".join(str(error).split())) from error
        except BrokenPipeError:
            raise
        except OSError as error:
            where = f"{error.filename}: " if error.filename else ""
            raise UnusableInput(f"{where}{error.strerror or error}") from error
