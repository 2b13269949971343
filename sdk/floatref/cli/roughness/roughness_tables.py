"""The tables of `floatref roughness`."""

from collections.abc import Mapping, Sequence
from math import nan
from typing import Any

from floatref.cli.printing import (
    PERCENT_OF_VALID,
    number,
    percent,
    print_areas,
    print_settings,
    print_table,
)
from floatref.measures import in_per_mi

Records = Sequence[Mapping[str, Any]]
AREA = ("start m", "end m", "peak at m")


def print_tables(report: Mapping[str, Any]) -> None:
    """Print a ``report`` of `roughness_report`: tracks, lane, areas, wavebands, sections."""
    tracks, lane = report["tracks"], report["lane"]
    _print_indices(tracks, lane)
    areas = [
        [track["name"], *_area(area), number(area["peak_m_per_km"]), percent(area["valid_share"])]
        for track in tracks
        for area in track["localized_roughness"]
    ]
    print_areas("Localized roughness", ("track", *AREA, "peak m/km", PERCENT_OF_VALID), areas)
    places = [
        [
            place["kind"],
            *_area(place),
            number(1000.0 * place["deviation_m"], 2),
            percent(place["valid_share"]),
        ]
        for place in lane["bumps_and_dips"]
    ]
    of = f"Bumps and dips of {' and '.join(lane['tracks'])}"
    print_areas(of, ("kind", *AREA, "deviation mm", PERCENT_OF_VALID), places)
    _print_wavebands(tracks)
    _print_sections(report["sections"], report["section_length_shares"])
    print_settings(report["settings"])


def _area(area: Mapping[str, Any]) -> list[str]:
    return [number(area[key], 2) for key in ("start_m", "end_m", "peak_at_m")]


def _print_indices(tracks: Records, lane: Mapping[str, Any]) -> None:
    """Print IRI and Ride Number of every wheel path, then MRI, HRI and Ride Number of the lane."""
    rows = [
        _index_row(track["name"], track["iri_m_per_km"], track["ride_number"], track["valid_share"])
        for track in tracks
    ]
    if lane["ride_number"] is not None:
        mean, half_car = (lane[f"{name}_roughness_index_m_per_km"] for name in ("mean", "half_car"))
        rows.append(_index_row("mean (MRI)", mean, lane["ride_number"], lane["valid_share"]))
        rows.append(_index_row("half car (HRI)", half_car, nan, lane["valid_share"]))
    print_table(
        "Roughness", ("track", "IRI m/km", "IRI in/mi", "Ride Number", PERCENT_OF_VALID), rows
    )


def _index_row(name: str, m_per_km: float, rating: float, valid: float) -> list[str]:
    return [
        name,
        number(m_per_km),
        number(in_per_mi(m_per_km), 1),
        number(rating, 2),
        percent(valid),
    ]


def _print_wavebands(tracks: Records) -> None:
    """Print RMS elevation and slope of every wheel path and band."""
    rows = [
        [
            track["name"],
            number(band["long_m"], 2),
            number(band["short_m"], 2),
            number(1000.0 * band["rms_elevation_m"]),
            number(1000.0 * band["rms_slope"]),
            percent(band["valid_share"]),
        ]
        for track in tracks
        for band in track["wavebands"]
    ]
    columns = (
        "track",
        "longest m",
        "shortest m",
        "RMS elevation mm",
        "RMS slope mm/m",
        PERCENT_OF_VALID,
    )
    print_table("Wavebands", columns, rows)


def _print_sections(sections: Records, shares: Mapping[str, float]) -> None:
    """Print every section and the shares of the length by rating."""
    rows = [
        [
            number(section["start_m"], 2),
            number(section["length_m"], 2),
            *(number(value) for value in section["iri_m_per_km"].values()),
            number(section["mean_m_per_km"]),
            number(in_per_mi(section["mean_m_per_km"]), 1),
            section["rating"] or "–",
            percent(section["valid_share"]),
        ]
        for section in sections
    ]
    paths = sections[0]["iri_m_per_km"] if sections else {}
    columns = (
        *("start m", "length m"),
        *(f"{name} m/km" for name in paths),
        *("mean m/km", "in/mi", "rating", PERCENT_OF_VALID),
    )
    print_table("Sections", columns, rows)
    print_table(
        "Rated length",
        ("rating", "length %"),
        [[rating, number(100.0 * part, 1)] for rating, part in shares.items()],
    )
