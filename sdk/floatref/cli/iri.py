"""`floatref iri`: the IRI of a profile, whole and by segment, and the settings used."""

from pathlib import Path
from typing import Any

import click
import numpy as np

from floatref.cli.printing import number, print_json, print_settings, print_table
from floatref.engine.formats import profile_of
from floatref.files.sources import name_errors
from floatref.measures import IriSettings, Segment, in_per_mi, iri_segments, mean_roughness_index
from floatref.measures import iri as whole_iri
from floatref.values.profile import Profile, ProfileTrack

UNITS = {"si": "m/km", "us": "in/mi"}


@click.command("iri")
@click.argument("profile", type=click.Path(path_type=Path))
@click.option("--segment", "segment_m", type=float, metavar="METRES", help="Length of a segment.")
@click.option(
    "--units", type=click.Choice(list(UNITS)), default="si", help="m/km (si) or in/mi (us)."
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def iri(profile: Path, segment_m: float | None, units: str, as_json: bool) -> None:
    """Print the IRI of PROFILE: a profile directory or a profile file of any format.

    The car runs once over every wheel path; then the result is divided into segments.
    """
    settings = IriSettings(segment_m=segment_m)
    read = profile_of(profile)
    with name_errors(profile):
        report = iri_report(read, settings, units)
    if as_json:
        print_json(report)
    else:
        _print_tables(report, units)


def iri_report(profile: Profile, settings: IriSettings, units: str = "si") -> dict[str, Any]:
    """Return the JSON document of `floatref iri --json`: settings, tracks, mean roughness index.

    Values are in m/km; with ``units`` "us" each is also given in in/mi. The mean roughness index is
    given for two tracks, else None.
    """
    tracks = [_track_report(track, profile, settings, units) for track in profile.tracks]
    report: dict[str, Any] = {"settings": settings.as_dict(profile.interval_m), "tracks": tracks}
    mean = None
    if len(tracks) == 2:
        mean = mean_roughness_index(*(track["iri_m_per_km"] for track in tracks))
    report["mean_roughness_index_m_per_km"] = mean
    if units == "us":
        report["mean_roughness_index_in_per_mi"] = None if mean is None else in_per_mi(mean)
    return report


def _track_report(
    track: ProfileTrack, profile: Profile, settings: IriSettings, units: str
) -> dict[str, Any]:
    """Return name, IRI, invalid length in m, and segments of ``track``."""
    interval = profile.interval_m
    with name_errors(f"track {track.name}"):
        value = whole_iri(track.elevation, interval, settings)
        segments = iri_segments(track.elevation, interval, settings, profile.start_m)
    return {
        "name": track.name,
        **_in_units(value, units),
        "invalid_m": float(np.count_nonzero(~track.valid)) * interval,
        "segments": [_segment_report(segment, units) for segment in segments],
    }


def _segment_report(segment: Segment, units: str) -> dict[str, float]:
    """Return start and length in m and the IRI of ``segment``."""
    return {
        "start_m": segment.start_m,
        "length_m": segment.length_m,
        **_in_units(segment.iri_m_per_km, units),
    }


def _in_units(value: float, units: str) -> dict[str, float]:
    """Return an IRI in m/km under its key, and in in/mi for US units."""
    both = {"iri_m_per_km": value}
    if units == "us":
        both["iri_in_per_mi"] = in_per_mi(value)
    return both


def _print_tables(report: dict[str, Any], units: str) -> None:
    """Print tracks, segments if there are several, and settings."""
    unit, key, digits = UNITS[units], "iri_m_per_km", 3
    if units == "us":
        key, digits = "iri_in_per_mi", 1
    tracks = report["tracks"]
    rows = [[t["name"], number(t[key], digits), number(t["invalid_m"], 1)] for t in tracks]
    mean = report["mean_roughness_index" + key.removeprefix("iri")]
    if mean is not None:
        rows.append(["mean roughness index", number(mean, digits), ""])
    print_table("IRI", ("track", f"IRI {unit}", "invalid m"), rows)
    if report["settings"]["segment_m"] is not None:
        columns = ("track", "start m", "length m", f"IRI {unit}")
        cut = [
            [t["name"], number(s["start_m"], 2), number(s["length_m"], 2), number(s[key], digits)]
            for t in tracks
            for s in t["segments"]
        ]
        print_table("Segments", columns, cut)
    print_settings(report["settings"])
