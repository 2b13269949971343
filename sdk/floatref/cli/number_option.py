"""Options of commands that are one number with a unit, whose default the help shows."""

from collections.abc import Callable
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])
METRES = "METRES"


def number_option(
    flag: str, default: float, meaning: str, name: str | None = None, unit: str = METRES
) -> Callable[[F], F]:
    """Return the option ``flag`` with its ``default`` and ``meaning``, a number in ``unit``.

    ``name`` is that of the command's argument, by default made from ``flag``.
    """
    names = (flag,) if name is None else (flag, name)
    return click.option(
        *names, type=float, metavar=unit, default=default, show_default=True, help=meaning
    )
