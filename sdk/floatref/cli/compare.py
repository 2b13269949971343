"""`floatref compare`: the agreement of a profile with a reference, wheel path by wheel path."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import click

from floatref.cli.printing import (
    PERCENT_OF_VALID,
    explain_mark,
    marked,
    number,
    percent,
    print_json,
    print_settings,
    print_table,
)
from floatref.cli.recordings.guessed_units import read_guessing
from floatref.files.sources import name_errors
from floatref.measures import WAVEBANDS, Agreement, IriSettings, iri
from floatref.measures.common_grid import CommonPath
from floatref.measures.locating.matching import match_names
from floatref.measures.locating.shift import Shift, find_shift, move
from floatref.measures.roughness.path_signals import path_agreement
from floatref.measures.valid_iri import CommonIri, iri_of_valid
from floatref.values.arrays import BoolArray, release
from floatref.values.profile import Profile, ProfileTrack

OF_VALID = ("iri_of_valid_m_per_km", "iri_reference_of_valid_m_per_km")


@click.command("compare")
@click.argument("reference", type=click.Path(path_type=Path))
@click.argument("profile", type=click.Path(path_type=Path))
@click.option(
    "--max-offset",
    "max_offset_m",
    type=float,
    default=1.0,
    show_default=True,
    metavar="METRES",
    help="Largest offset searched, around the place of PROFILE.",
)
@click.option("--no-placement", is_flag=True, help="Compare PROFILE as it lies.")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE.png", help="Draw both.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def compare(
    reference: Path,
    profile: Path,
    max_offset_m: float,
    no_placement: bool,
    plot: Path | None,
    as_json: bool,
) -> None:
    """Print how well PROFILE agrees with REFERENCE, by cross correlation and by IRI.

    Wheel paths are matched by name, or by their elevations if not one name is the same; PROFILE
    may have others. If it lies more than 1 m from its
    place on the road of REFERENCE, it is moved there; where that place is not sure, a line says so.
    It is interpolated linearly at the points of REFERENCE where both overlap. An offset or a
    placement above zero means that PROFILE lies farther along. Both IRIs of valid points are over
    the stretches in which both profiles are valid.
    """
    (expected, said), (found, more) = read_guessing(reference), read_guessing(profile)
    notes = [f"{path}: {line}" for path, line in ((reference, said), (profile, more)) if line]
    with name_errors(f"{reference} and {profile}"):
        found, renamed = match_names(expected, found)
        notes += [f"{profile}: {line}" for line in renamed]
        shift = None if no_placement else find_shift(expected, found)
        found = move(found, shift) if shift else found
        report = compare_report(expected, found, max_offset_m, shift) | {"notes": notes}
    if plot is not None:
        from floatref.plots import draw_comparison

        draw_comparison(expected, found, plot, max_offset_m, report["placement_m"])
    if as_json:
        print_json(report)
    else:
        _print_tables(report)


def compare_report(
    reference: Profile, profile: Profile, max_offset_m: float, shift: Shift | None = None
) -> dict[str, Any]:
    """Return the JSON document of `floatref compare --json`, on the points of ``reference``.

    ``shift`` is by how much ``profile`` was moved; None if it is compared as it lies. Raises
    InputError where the two do not overlap, and as the measures do.
    """
    placement_m = shift.placement_m if shift and shift.is_sure else None
    # One after the other: all wheel paths on one grid would be in memory together.
    tracks = []
    for track in reference.tracks:
        common = _common_points(reference, profile, track.name)
        tracks.append(_track_report(reference, profile, common, max_offset_m))
    settings = IriSettings().as_dict(reference.interval_m) | {
        "max_offset_m": max_offset_m,
        "start_m": common.start_m,
        "length_m": common.length_m,
        "grid": "points of REFERENCE, PROFILE linear between its own",
    }
    names = {track.name for track in reference.tracks}
    extra = [track.name for track in profile.tracks if track.name not in names]
    return {
        "settings": settings,
        "placement_m": placement_m,
        "placement_note": shift.note if shift else "",
        "tracks": tracks,
        "not_compared": extra,
    }


@dataclass(frozen=True)
class _Common:
    """What both profiles have of a wheel path, on the reference's points, and its IRIs in m/km."""

    name: str
    start_m: float
    length_m: float
    profile_m_per_km: float
    reference_m_per_km: float
    valid: CommonIri


def _common_points(reference: Profile, profile: Profile, name: str) -> _Common:
    """Return what both have of the wheel path ``name``; InputError where they do not overlap."""
    path = CommonPath.of(reference, profile, name)
    both = path.usable(of_valid=True)
    with name_errors(f"track {name}"):
        # One after the other: an hour of both would be in memory together.
        (expected, share, expected_of_all), (found, _, found_of_all) = (
            _iris(points(0, path.size), both, path.interval_m)
            for points in (path.expected, path.found)
        )
    length_m = (path.size - 1) * path.interval_m
    valid = CommonIri(expected, found, share)
    return _Common(name, path.start_m, length_m, found_of_all, expected_of_all, valid)


def _iris(track: ProfileTrack, both: BoolArray, interval_m: float) -> tuple[float, float, float]:
    """Return the IRI in m/km where ``both`` are valid, its share, and the IRI of all points."""
    valid, share = iri_of_valid(replace(track, valid=both), interval_m)
    every = iri(track.elevation, interval_m)
    release(track.elevation)
    return valid, share, every


def _track_report(
    reference: Profile, profile: Profile, common: _Common, max_offset_m: float
) -> dict[str, Any]:
    """Return agreement and IRI of a wheel path that both have in ``common``."""

    def agree(band: str) -> Agreement:
        return path_agreement(reference, profile, common.name, band, max_offset_m)

    with name_errors(f"track {common.name}"):
        found = agree("iri")
        bands = {
            band: agree(band).cross_correlation
            for band, limits in WAVEBANDS.items()
            if limits.long_m > 2 * reference.interval_m
        }
    return {
        "name": common.name,
        "cross_correlation": found.cross_correlation,
        "offset_m": found.offset_m,
        "iri_m_per_km": common.profile_m_per_km,
        "iri_reference_m_per_km": common.reference_m_per_km,
        "correlation": found.correlation,
        "amplitude_factor": found.amplitude_factor,
        "wavebands": bands,
        "iri_of_valid_m_per_km": common.valid.profile_m_per_km,
        "iri_reference_of_valid_m_per_km": common.valid.reference_m_per_km,
        "counted_share": common.valid.counted_share,
    }


def _print_tables(report: dict[str, Any]) -> None:
    """Print the agreement of every wheel path, the IRI of its valid points, and the settings."""
    tracks = report["tracks"]
    columns = ("track", "cross correlation", "offset m", "IRI m/km", "reference m/km", "difference")
    rows = [
        [
            _name(track),
            number(track["cross_correlation"], 4),
            number(track["offset_m"], 4),
            number(track["iri_m_per_km"]),
            number(track["iri_reference_m_per_km"]),
            _difference(track["iri_m_per_km"], track["iri_reference_m_per_km"]),
        ]
        for track in tracks
    ]
    print_table("Agreement of the IRI filter's output", columns, rows)
    _print_valid(tracks)
    bands = [
        [
            _name(track),
            *(number(track["wavebands"].get(band, float("nan")), 4) for band in WAVEBANDS),
        ]
        for track in tracks
    ]
    print_table("Cross correlation of slope by waveband", ("track", *WAVEBANDS), bands)
    some = any(track["counted_share"] < 1.0 for track in tracks)
    explain_mark(some, "all figures but those of valid points have the others too")
    _print_placement(report)
    for note in report["notes"]:
        click.echo(f"{note}\n")
    if report["not_compared"]:
        click.echo(f"Not in the reference: {', '.join(report['not_compared'])}\n")
    print_settings(report["settings"])


def _print_placement(report: Mapping[str, Any]) -> None:
    """Print by how much the profile was moved, or why its place is not sure; else nothing."""
    placement_m, note = report["placement_m"], report["placement_note"]
    if placement_m:
        way = "farther along" if placement_m > 0 else "earlier"
        click.echo(f"Placement: PROFILE lies {abs(placement_m):.2f} m {way}, and is moved there\n")
    if note and placement_m is None:
        click.echo(f"Placement: not sure, PROFILE is compared as it lies: {note}\n")
    elif note:
        click.echo(f"PROFILE: {note}\n")


def _print_valid(tracks: Sequence[Mapping[str, Any]]) -> None:
    """Print both IRIs over the points that are valid in both, and their share."""
    columns = ("track", "IRI m/km", "reference m/km", "difference", PERCENT_OF_VALID)
    rows = []
    for track in tracks:
        found, expected = (track[key] for key in OF_VALID)
        rows.append(
            [
                track["name"],
                number(found),
                number(expected),
                _difference(found, expected),
                percent(track["counted_share"]),
            ]
        )
    print_table("IRI of valid points", columns, rows)


def _name(track: Mapping[str, Any]) -> str:
    return marked(track["name"], track["counted_share"] < 1.0)


def _difference(value: float, expected: float) -> str:
    """Return the difference of an IRI from the expected one, in per cent, if there is one."""
    return f"{100.0 * (value / expected - 1.0):+.2f} %" if expected > 0.0 else "–"
