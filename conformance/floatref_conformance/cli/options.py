"""What the options of `run` and `replay` mean."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from math import isfinite
from pathlib import Path
from typing import Any, TypeVar

import click

from floatref.errors import InputError
from floatref_conformance.case_files import FOLDER
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.environment import check_variables
from floatref_conformance.devices.interface import Device
from floatref_conformance.judge.events import Renderer
from floatref_conformance.proving_ground.cache import cache_folder
from floatref_conformance.render.cases import CaseFiles
from floatref_conformance.render.html import NAME, HtmlReport
from floatref_conformance.render.junit import JUnitReport
from floatref_conformance.render.report import JsonReport
from floatref_conformance.render.text import needs_jinja

Wrapped = TypeVar("Wrapped", bound=Callable[..., Any])


def class_of(device: Device, asked: str | None) -> DeviceClass:
    """Return the class that was ``asked`` for, else the one ``device`` claims, else nominal."""
    claimed = getattr(device, "claims", DeviceClass.NOMINAL)
    return DeviceClass(asked) if asked else DeviceClass(claimed)


def limit_time(device: Device, seconds: float | None) -> None:
    """Give ``device`` that long for a recording, if it is one whose time is limited.

    Raises InputError for a time that is no number.
    """
    if seconds is not None and not isfinite(seconds):
        raise InputError(f"--device-timeout is {seconds}; give a number of seconds")
    if seconds is not None and hasattr(device, "timeout_s"):
        device.timeout_s = seconds


def env_option(command: Wrapped) -> Wrapped:
    """Add `--env` to ``command``."""
    return click.option(
        "--env",
        "variables",
        metavar="NAME",
        multiple=True,
        help="Pass this variable of the environment to the device too; may be repeated.",
    )(command)


def pass_variables(device: Device, variables: tuple[str, ...]) -> None:
    """Let ``device`` get ``variables`` of the environment, if it is one that is started.

    Raises InputError for a variable that is not set, or that no device gets.
    """
    check_variables(variables)
    if variables and hasattr(device, "variables"):
        device.variables = variables


def tell_where_truth_is(device: Device) -> None:
    """Print a line on stderr if ``device`` is a program that could read the truth in the cache."""
    if hasattr(device, "variables") and not getattr(device, "confined", False):
        click.echo(
            f"Note: the truth is in {cache_folder()}, which a device of this user could read; "
            "docs/conformance.md has what to do for a certificate",
            err=True,
        )


def writers_into(folder: Path | None) -> list[Renderer]:
    """Return what writes the reports into ``folder``, made if need be; empty without one."""
    if folder is None:
        return []
    # Before a folder is made, or an earlier report removed.
    needs_jinja(NAME)
    writers = (CaseFiles, JsonReport, JUnitReport, HtmlReport)
    return [writer.into(folder) for writer in writers]


@contextmanager
def reports_into(folder: Path | None) -> Iterator[list[Renderer]]:
    """Yield what `writers_into` returns; a run without a verdict leaves no new, empty folder."""
    new = [] if folder is None else [folder / FOLDER, folder, *folder.parents]
    new = [path for path in new if not path.exists()]
    try:
        yield writers_into(folder)
    except BaseException:
        for path in new:
            with suppress(OSError):
                path.rmdir()
        raise
