"""The choice of a profile format on the command line, from the registered ones."""

from typing import TYPE_CHECKING, Any

import click

from floatref.cli.choices import OneOf
from floatref.engine.plugins import plugins

if TYPE_CHECKING:
    NameType = click.ParamType[str]
else:
    # It takes no type argument before click 8.4.
    NameType = click.ParamType


class FormatName(NameType):
    """The name of a registered format; plug-ins are loaded only when it is used."""

    name = "format"

    def get_metavar(self, param: click.Parameter, ctx: click.Context | None = None) -> str:
        """Return the names as shown in the help."""
        return f"[{'|'.join(plugins().profile_formats())}]"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return ``value`` if it is the name of a format."""
        return str(OneOf(list(plugins().profile_formats())).convert(value, param, ctx))
