"""What tables in the terminal have in common: how a block looks, and a drive in one line."""

import json
from dataclasses import fields

from rich.box import SIMPLE_HEAD
from rich.table import Table

from floatref_conformance.proving_ground.scenario import Scenario

CELL_PADDING = (0, 1, 0, 0)
"""One space behind a column, so that the default table fits 80 columns."""


def begin_block(
    title: str, padding: int | tuple[int, int, int, int] = CELL_PADDING, show_edge: bool = True
) -> Table:
    """Return a table without columns below its ``title``."""
    return Table(
        title=title,
        title_justify="left",
        title_style="bold",
        box=SIMPLE_HEAD,
        padding=padding,
        pad_edge=False,
        show_edge=show_edge,
    )


def describe_drive(scenario: Scenario) -> str:
    """Return the scenario file of a drive, without what is usual in it."""
    values = ((field, getattr(scenario, field.name)) for field in fields(Scenario))
    return json.dumps({field.name: value for field, value in values if value != field.default})
