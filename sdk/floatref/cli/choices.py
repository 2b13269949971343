"""Names on the command line: a mistyped one is refused with the one that was meant."""

from typing import TYPE_CHECKING, Any

import click

from floatref.values.display.similar_names import did_you_mean

if TYPE_CHECKING:
    Choice = click.Choice[str]
else:
    # It takes no type argument before click 8.2.
    Choice = click.Choice


class OneOf(Choice):
    """One of some names, as `click.Choice`."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the name; BadParameter, with the one that was meant, if it is unknown."""
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter as error:
            line = f"{error.message}{hint_behind(value, self.choices)}"
            raise click.BadParameter(line, ctx, param) from error


def hint_behind(name: object, known: Any) -> str:
    """Return a sentence with the nearest of ``known`` to follow another, or nothing."""
    hint = did_you_mean(name, map(str, known))
    return f" {hint[0].upper()}{hint[1:]}" if hint else ""


def hint_at_choices(command: click.Command) -> None:
    """Let every option of ``command`` that takes one of some names refuse others so."""
    for parameter in command.params:
        kind = parameter.type
        if type(kind) is click.Choice:
            parameter.type = OneOf(list(kind.choices), kind.case_sensitive)
