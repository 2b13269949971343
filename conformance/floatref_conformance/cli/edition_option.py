"""The option `--edition` of every command that asks for checks."""

import click

from floatref_conformance.editions import EDITION, EDITIONS

edition_option = click.option(
    "--edition",
    type=click.Choice(EDITIONS),
    default=EDITION,
    show_default=True,
    help="Edition of the checks: an earlier one repeats its reports.",
)
