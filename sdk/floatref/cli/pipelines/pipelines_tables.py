"""The tables of `floatref pipelines`: the answer first, then the list of all."""

from collections.abc import Mapping
from typing import Any

import click

from floatref.cli.printing import print_table
from floatref.values.display.short_text import join_some

STOPS = {True: "yes", False: "no", None: "not stated"}
REFUSED = "no pipeline"
EXPLAINED = (
    "at stops: whether the road is measured where the vehicle stops and creeps.\n"
    "floatref pipelines RECORDING answers it for a recording.\n"
)


def print_for_sensors(report: Mapping[str, Any]) -> None:
    """Print a ``report`` of `pipelines_report`."""
    rows = [
        [
            each["sensors"],
            each["taken"] or REFUSED,
            STOPS[each["through_stops"]] if each["taken"] else "–",
        ]
        for each in report["by_sensors"]
    ]
    columns = ("recorded", "auto takes", "at stops")
    print_table("Which for my sensors", columns, rows, numbers=False, whole=columns[1:])
    click.echo(EXPLAINED)
    rows = [[p["name"], STOPS[p["through_stops"]], p["summary"]] for p in report["pipelines"]]
    columns = ("pipeline", "at stops", "what it does")
    print_table("Pipelines", columns, rows, numbers=False, whole=columns[:2])


def print_for_recording(report: Mapping[str, Any]) -> None:
    """Print a ``report`` of `recording_report`."""
    taken = report["taken"]
    answer = f"auto takes {taken}, since {report['reason']}" if taken else f"auto takes {REFUSED}"
    click.echo(f"{report['recording']}: {answer}")
    places = [f"{place:.0f} m" for place in report["stops_m"]]
    if places:
        click.echo(f"The vehicle stops at {join_some(places)}")
    click.echo()
    rows = [
        [p["name"], "no" if p["lacks"] else "yes", STOPS[p["through_stops"]], p["lacks"] or "–"]
        for p in report["pipelines"]
    ]
    columns = ("pipeline", "usable", "at stops", "lacks")
    print_table("Pipelines", columns, rows, numbers=False, whole=columns[:3])
