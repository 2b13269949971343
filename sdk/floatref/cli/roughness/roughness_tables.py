"""The tables of `floatref roughness`."""

from collections.abc import Mapping, Sequence
from math import nan
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
AREA = ("start m", "end m", "peak at m")


def print_tables(report: Mapping[str, Any]) -> None:
    """Print a ``report`` of `roughness_report`: tracks, lane, areas, wavebands, sections."""
    tracks, lane = report["tracks"], report["lane"]
    _print_indices(tracks, lane)
    areas = [
        [
            marked(track["name"], area["valid_share"] < 1.0),
            *_area(area),
            number(area["peak_m_per_km"]),
            percent(area["valid_share"]),
        ]
        for track in tracks
        for area in track["localized_roughness"]
    ]
    print_areas("Localized roughness", ("track", *AREA, "peak m/km", PERCENT_OF_VALID), areas)
    places = [
        [
            marked(place["kind"], place["valid_share"] < 1.0),
            *_area(place),
            number(1000.0 * place["deviation_m"], 2),
            percent(place["valid_share"]),
        ]
        for place in lane["bumps_and_dips"]
    ]
    of = f"Bumps and dips of {' and '.join(lane['tracks'])}"
    print_areas(of, ("kind", *AREA, "deviation mm", PERCENT_OF_VALID), places)
    _print_wavebands(tracks)
    _print_sections(report["sections"])
    _print_rated_length(report)
    explain_mark(
        lane["valid_share"] < 1.0, "all figures but those of valid points have the others too"
    )
    print_settings(report["settings"])


def _area(area: Mapping[str, Any]) -> list[str]:
    return [number(area[key], 2) for key in ("start_m", "end_m", "peak_at_m")]


def _print_indices(tracks: Records, lane: Mapping[str, Any]) -> None:
    """Print IRI and Ride Number of every wheel path, then MRI, HRI and Ride Number of the lane."""
    rows = [_index_row(track["name"], "iri", track, track["ride_number"]) for track in tracks]
    if lane["ride_number"] is not None:
        mean, half_car = "mean_roughness_index", "half_car_roughness_index"
        rows.append(_index_row("mean (MRI)", mean, lane, lane["ride_number"]))
        rows.append(_index_row("half car (HRI)", half_car, lane, nan))
    columns = ("track", "IRI m/km", "IRI in/mi", "of valid m/km", "Ride Number", PERCENT_OF_VALID)
    print_table("Roughness", columns, rows)


def _index_row(name: str, index: str, figures: Mapping[str, Any], rating: float) -> list[str]:
    """Return the cells of a wheel path, or the lane, whose ``index`` is so named in its figures."""
    m_per_km = figures[f"{index}_m_per_km"]
    return [
        marked(name, figures["valid_share"] < 1.0),
        number(m_per_km),
        number(in_per_mi(m_per_km), 1),
        number(figures[f"{index}_of_valid_m_per_km"]),
        number(rating, 2),
        percent(figures["valid_share"]),
    ]


def _print_wavebands(tracks: Records) -> None:
    """Print RMS elevation and slope of every wheel path and band."""
    rows = [
        [
            marked(track["name"], band["valid_share"] < 1.0),
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


def _print_sections(sections: Records) -> None:
    """Print every section, its rating, and beside it that of its valid points."""
    rows = [
        [
            marked(number(section["start_m"], 2), section["valid_share"] < 1.0),
            number(section["length_m"], 2),
            *(number(value) for value in section["iri_m_per_km"].values()),
            number(section["mean_m_per_km"]),
            number(in_per_mi(section["mean_m_per_km"]), 1),
            section["rating"] or "–",
            number(section["mean_of_valid_m_per_km"]),
            section["rating_of_valid"] or "–",
            percent(section["valid_share"]),
        ]
        for section in sections
    ]
    paths = sections[0]["iri_m_per_km"] if sections else {}
    columns = (
        *("start m", "length m"),
        *(f"{name} m/km" for name in paths),
        *("mean m/km", "in/mi", "rating", "of valid m/km", "of valid", PERCENT_OF_VALID),
    )
    print_table("Sections", columns, rows)


def _print_rated_length(report: Mapping[str, Any]) -> None:
    """Print the shares of the length by rating, of all points and of valid ones."""
    some = any(section["valid_share"] < 1.0 for section in report["sections"])
    every, valid = report["section_length_shares"], report["section_length_shares_of_valid"]
    print_table(
        marked("Rated length", some),
        ("rating", "length %", "of valid %"),
        [
            [rating, *(number(100.0 * part[rating], 1) for part in (every, valid))]
            for rating in every
        ],
    )
