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

    def __init__(self, recordings: bool = False) -> None:
        """Take the names of profile formats, with ``recordings`` those of recordings too."""
        self._recordings = recordings

    def get_metavar(self, param: click.Parameter, ctx: click.Context | None = None) -> str:
        """Return the names as shown in the help."""
        return f"[{'|'.join(self._names())}]"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return ``value`` if it is the name of a format."""
        return str(OneOf(self._names()).convert(value, param, ctx))

    def _names(self) -> list[str]:
        recordings = plugins().recording_formats() if self._recordings else {}
        return [*plugins().profile_formats(), *recordings]
