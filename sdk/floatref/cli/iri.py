"""`floatref iri`: the IRI of a profile, whole and by segment, and the settings used."""

from collections.abc import Mapping
from dataclasses import replace
from math import nan
from pathlib import Path
from types import MappingProxyType
from typing import Any

import click

from floatref.cli.iri_tables import UNITS, print_iri_tables
from floatref.cli.printing import print_json
from floatref.cli.recordings.segment_places import layer_of, layer_options, write_profile_layer
from floatref.engine.formats import profile_of
from floatref.files.sources import name_errors
from floatref.measures import IriSettings, in_per_mi, mean_roughness_index
from floatref.measures.roughness.iri_interval import CORRELATION_M
from floatref.measures.valid_segments import SegmentIri, segment_iris
from floatref.values.profile import Profile, ProfileTrack


@click.command("iri")
@click.argument("profile", type=click.Path(path_type=Path))
@click.option("--segment", "segment_m", type=float, metavar="METRES", help="Length of a segment.")
@click.option(
    "--units", type=click.Choice(list(UNITS)), default="si", help="m/km (si) or in/mi (us)."
)
@layer_options
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def iri(
    profile: Path, segment_m: float | None, units: str, as_json: bool, **layer_given: Any
) -> None:
    """Print the IRI of PROFILE: a profile directory or a profile file of any format.

    The car runs once over every stretch of valid points, and beside it once over every wheel path;
    then the result is divided into segments.
    """
    settings = IriSettings(segment_m=segment_m)
    layer = layer_of(**layer_given)
    read = profile_of(profile)
    with name_errors(profile):
        report = iri_report(read, settings, units)
    if layer is not None:
        write_profile_layer(read, profile.name, segment_m, layer)
    if as_json:
        print_json(report)
    else:
        print_iri_tables(report, units)


def iri_report(profile: Profile, settings: IriSettings, units: str = "si") -> dict[str, Any]:
    """Return the JSON document of `floatref iri --json`: settings, tracks, mean roughness index.

    ``iri_of_valid_m_per_km`` is over the ``counted_share`` of the length that stretches of valid
    points make; ``iri_m_per_km`` is over all points. Values are in m/km; with ``units`` "us" each
    is also given in in/mi. The mean roughness index is given for two tracks, else None.
    """
    tracks = [_track_report(track, profile, settings, units) for track in profile.tracks]
    used = settings.as_dict(profile.interval_m)
    if any(track.sigma is not None for track in profile.tracks):
        used["error_correlation_m"] = CORRELATION_M
    report: dict[str, Any] = {"settings": used, "tracks": tracks}
    means = _means_of(tracks)
    for key, mean in means.items():
        report[f"{key}_m_per_km"] = mean
        if units == "us":
            report[f"{key}_in_per_mi"] = None if mean is None else in_per_mi(mean)
    shares = [track["counted_share"] for track in tracks]
    report["mean_roughness_index_counted_share"] = min(shares) if len(tracks) == 2 else None
    return report


def _means_of(tracks: list[dict[str, Any]]) -> dict[str, float | None]:
    """Return the mean roughness index of all and of valid points in m/km, None unless of two."""
    pairs = {
        "mean_roughness_index": "iri_m_per_km",
        "mean_roughness_index_of_valid": "iri_of_valid_m_per_km",
    }
    if len(tracks) != 2:
        return dict.fromkeys(pairs)
    left, right = tracks
    return {name: mean_roughness_index(left[key], right[key]) for name, key in pairs.items()}


def _track_report(
    track: ProfileTrack, profile: Profile, settings: IriSettings, units: str
) -> dict[str, Any]:
    """Return name, both IRIs, their share and interval, invalid length in m, and segments."""
    interval, start = profile.interval_m, profile.start_m
    with name_errors(f"track {track.name}"):
        whole = _whole(track, profile, settings)
        segments: tuple[SegmentIri, ...] = (whole,)
        if settings.segment_m is not None:
            segments = segment_iris(track, interval, settings, start)
    return {
        "name": track.name,
        **_figures(whole, units),
        "segments": [_segment_report(segment, units) for segment in segments],
    }


def _whole(track: ProfileTrack, profile: Profile, settings: IriSettings) -> SegmentIri:
    undivided = replace(settings, segment_m=None)
    (whole,) = segment_iris(track, profile.interval_m, undivided, profile.start_m)
    return whole


def figures_of(track: ProfileTrack, profile: Profile) -> dict[str, Any]:
    """Return the IRI of ``track`` in m/km, its share and invalid length, as `iri_report` does.

    Without the interval from its 1-σ, which takes ten times as long and much memory on a long
    run. Raises InputError where there is no IRI.
    """
    found = _whole(replace(track, sigma=None), profile, IriSettings())
    return _without_interval(found, "si")


def no_figures(invalid_m: float) -> dict[str, Any]:
    """Return `figures_of` a wheel path without an IRI, of which so many m are not valid."""
    return _without_interval(SegmentIri(nan, nan, nan, nan, nan, invalid_m), "si")


def _segment_report(segment: SegmentIri, units: str) -> dict[str, Any]:
    """Return start and length in m and the figures of ``segment``."""
    return {
        "start_m": segment.start_m,
        "length_m": segment.length_m,
        **_figures(segment, units),
    }


def _figures(found: SegmentIri, units: str) -> dict[str, Any]:
    """Return the IRI of all and of valid points, its share and interval, and the invalid length."""
    low, high = found.interval
    interval = {"iri_of_valid_low": low, "iri_of_valid_high": high}
    return _without_interval(found, units, interval)


def _without_interval(
    found: SegmentIri, units: str, interval: Mapping[str, float] = MappingProxyType({})
) -> dict[str, Any]:
    values = {"iri": found.all_m_per_km, "iri_of_valid": found.valid_m_per_km, **interval}
    figures: dict[str, Any] = {f"{name}_m_per_km": value for name, value in values.items()}
    if units == "us":
        figures |= {f"{name}_in_per_mi": in_per_mi(value) for name, value in values.items()}
    return figures | {"counted_share": found.counted_share, "invalid_m": found.invalid_m}
