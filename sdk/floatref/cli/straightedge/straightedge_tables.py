"""The tables of `floatref straightedge`."""

from collections.abc import Mapping, Sequence
from typing import Any

from floatref.cli.printing import (
    PERCENT_OF_VALID,
    explain_mark,
    marked,
    number,
    percent,
    print_areas,
    print_settings,
    print_table,
)
from floatref.measures import in_per_mi

Records = Sequence[Mapping[str, Any]]
AREA = ("track", "start m", "end m", "peak at m")


def print_tables(report: Mapping[str, Any]) -> None:
    """Print a ``report`` of `straightedge_report`: both machines, then their areas."""
    tracks = report["tracks"]
    _print_straightedge(tracks)
    beyond = [
        [_name(track, area), *_area(area, "deviation_m")]
        for track in tracks
        for area in track["straightedge"]["areas"]
    ]
    print_areas("Beyond the tolerance", (*AREA, "deviation mm", PERCENT_OF_VALID), beyond)
    _print_profilograph(tracks)
    bumps = [
        [_name(track, area), *_area(area, "height_m")]
        for track in tracks
        for area in track["profilograph"]["must_grind"]
    ]
    print_areas("Must be ground", (*AREA, "height mm", PERCENT_OF_VALID), bumps)
    explain_mark(any(t["valid_share"] < 1.0 for t in tracks), "all figures have the others too")
    print_settings(report["settings"])


def _area(area: Mapping[str, Any], size: str) -> list[str]:
    """Return the cells of ``area``, whose ``size`` is in m."""
    places = (number(area[key], 2) for key in ("start_m", "end_m", "peak_at_m"))
    return [*places, number(1000.0 * area[size], 2), percent(area["valid_share"])]


def _print_straightedge(tracks: Records) -> None:
    """Print the largest deviation of every wheel path, and how much of it is beyond tolerance."""
    rows = []
    for track in tracks:
        edge = track["straightedge"]
        cells = (1000.0 * edge["largest_m"], 100.0 * edge["defective_share"])
        rows.append(
            [_name(track, edge), *(number(cell, 2) for cell in cells), percent(edge["valid_share"])]
        )
    columns = ("track", "largest mm", "defective %", PERCENT_OF_VALID)
    print_table("Straightedge", columns, rows)


def _print_profilograph(tracks: Records) -> None:
    """Print the profile index of every wheel path as a whole, then of every segment."""
    columns = ("track", "start m", "measured m", "scallops", "PI m/km", "PI in/mi")
    rows = []
    for track in tracks:
        whole = track["profilograph"]
        scallops = sum(segment["scallops"] for segment in whole["segments"])
        rows.append([_name(track, whole), "whole", *_index(whole, scallops)])
        for segment in whole["segments"]:
            start = number(segment["start_m"], 2)
            rows.append([_name(track, segment), start, *_index(segment, segment["scallops"])])
    print_table("Profilograph", (*columns, PERCENT_OF_VALID), rows)


def _name(track: Mapping[str, Any], part: Mapping[str, Any]) -> str:
    """Return the name of ``track``, with the mark if not all points of its ``part`` are valid."""
    return marked(track["name"], part["valid_share"] < 1.0)


def _index(part: Mapping[str, Any], scallops: int) -> list[str]:
    """Return the cells of a profile index."""
    index = part["profile_index_m_per_km"]
    return [
        number(part["measured_m"], 2),
        str(scallops),
        number(index, 4),
        number(in_per_mi(index), 2),
        percent(part["valid_share"]),
    ]
