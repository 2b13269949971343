"""`--diagnostics` of `floatref process`: the innovations as a picture, a table and JSON."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from math import nan
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floatref.cli.printing import number, print_table
from floatref.errors import InputError
from floatref.files.atomic import check_target, replace_file
from floatref.files.sources import real_path

if TYPE_CHECKING:
    from floatref.engine.run import Result

SUFFIX = ".innovations.png"
"""Added to the name of the profile, which may have a suffix already."""
HEADING = (
    "innovations over their expected 1-σ; lines: root mean square, 1 if consistent; "
    "right: all of the run, and the normal density"
)
COLUMNS = (
    *("track", "reading", "count", "mean NIS", "95 % from", "to"),
    *("% in 2 sigma", "mean, sigma", "left out"),
)
DIGITS = {
    "mean_nis": 3,
    "lower_95_percent": 3,
    "upper_95_percent": 3,
    "within_2_sigma_percent": 1,
    "mean_sigmas": 3,
}
"""Decimals of the columns in the middle, by their keys in the record."""


def picture_beside(out: Path) -> Path:
    """Return the place of the picture that belongs to the profile ``out``."""
    return out.with_name(f"{out.name}{SUFFIX}")


def check_picture(out: Path, plot: Path | None, overwrite: bool) -> None:
    """Raise InputError now for a picture to whose place writing would fail later."""
    from floatref.plots import check_drawing

    picture = picture_beside(out)
    if plot is not None and real_path(plot) == real_path(picture):
        raise InputError(f"{plot}: is the name of the innovations' picture; choose another")
    check_target(picture, overwrite)
    check_drawing(picture)


@contextmanager
def draw_beside(result: "Result", out: Path) -> Iterator[None]:
    """Draw beside the picture of ``out``; it gets its name after everything else is written."""
    from floatref.plots import draw_innovations

    profile = result.profile
    heading = f"{profile.pipeline}: {HEADING}"
    with replace_file(picture_beside(out), overwrite=True) as beside:
        draw_innovations(result.innovations, beside, heading)
        yield


def report_innovations(result: "Result", out: Path) -> dict[str, Any]:
    """Return what `floatref process --json` prints of them."""
    found = result.profile.provenance["innovations"]
    return {"innovations": found, "innovations_picture": str(picture_beside(out))}


def print_innovations(report: Mapping[str, Any]) -> None:
    """Print the table of a ``report`` of `report_innovations`."""
    rows = [
        [track, kind, *_row(each)]
        for track, kinds in report["innovations"].items()
        for kind, each in kinds.items()
    ]
    print_table(report["innovations_picture"], COLUMNS, rows)


def _row(each: Mapping[str, Any]) -> list[str]:
    values = [nan if each[key] is None else float(each[key]) for key in DIGITS]
    middle = [number(value, d) for value, d in zip(values, DIGITS.values(), strict=True)]
    return [str(each["count"]), *middle, str(each["left_out"])]
