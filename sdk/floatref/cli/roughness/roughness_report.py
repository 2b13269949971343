"""The JSON document of `floatref roughness`: every figure with the share of it that is valid."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.files.sources import name_errors
from floatref.measures import (
    WAVEBANDS,
    HpmsSection,
    IriSettings,
    Waveband,
    bumps_and_dips,
    hpms_sections,
    iri,
    join_profile_indices,
    localized_roughness,
    mean_path,
    mean_roughness_index,
    rated_shares,
    ride_number,
    ride_profile_index,
    waveband_energy,
)
from floatref.measures.ride.bumps_and_dips import AVERAGE_BASE_M, DEVIATION_LIMIT_M
from floatref.measures.roughness.roughness_profile import (
    BASE_M,
    LOCALIZED_ABOVE_M_PER_KM,
    TENTH_OF_A_MILE_M,
)
from floatref.measures.valid_segments import segment_iris
from floatref.values.arrays import release
from floatref.values.profile import Profile, ProfileTrack

OF_ONE_PATH: dict[str, float | None] = dict.fromkeys(
    (
        "mean_roughness_index_m_per_km",
        "half_car_roughness_index_m_per_km",
        "ride_number",
        "mean_roughness_index_of_valid_m_per_km",
        "half_car_roughness_index_of_valid_m_per_km",
        "counted_share",
    )
)
"""The figures of a lane that need two wheel paths, None where it has one."""


@dataclass(frozen=True)
class RoughnessLimits:
    """What a contract says: threshold in m/km, deviation, section and wavebands in m.

    Raises InputError for a threshold, deviation or section that is not above zero.
    """

    threshold_m_per_km: float = LOCALIZED_ABOVE_M_PER_KM
    deviation_m: float = DEVIATION_LIMIT_M
    section_m: float = TENTH_OF_A_MILE_M
    bands: tuple[Waveband, ...] = tuple(WAVEBANDS.values())

    @classmethod
    def of(
        cls,
        threshold: float,
        deviation: float,
        section: float,
        bands: Sequence[tuple[float, float]],
    ) -> "RoughnessLimits":
        """Return the limits; without ``bands`` the three diagnostic ones."""
        if not bands:
            return cls(threshold, deviation, section)
        return cls(threshold, deviation, section, tuple(Waveband(*band) for band in bands))

    def __post_init__(self) -> None:
        """Refuse what cannot be a limit."""
        for name in ("threshold_m_per_km", "deviation_m", "section_m"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0.0):
                raise InputError(f"{name} is {value}; give a finite number above zero")


def tracks_of_lane(profile: Profile, names: Sequence[str] | None) -> tuple[ProfileTrack, ...]:
    """Return the wheel paths ``names`` of ``profile``, or all it has, of which a lane has 1 or 2.

    Raises InputError for a path that is missing, one that is given twice, or more than two.
    """
    tracks = tuple(map(profile.track, names)) if names else profile.tracks
    if len(tracks) > 2 or len({track.name for track in tracks}) < len(tracks):
        known = ", ".join(track.name for track in profile.tracks)
        raise InputError(
            f"a lane has two different wheel paths, the profile {known}; give --tracks LEFT RIGHT"
        )
    return tracks


def roughness_report(
    profile: Profile, limits: RoughnessLimits, names: Sequence[str] | None = None
) -> dict[str, Any]:
    """Return the JSON document of `floatref roughness --json`.

    ``names`` are the two wheel paths of the lane. Raises InputError as the measures do.
    """
    lane = tracks_of_lane(profile, names)
    tracks = [_describe_track(track, profile, limits) for track in lane]
    sections = hpms_sections(
        [track.elevation for track in lane],
        profile.interval_m,
        [track.valid for track in lane],
        profile.start_m,
        limits.section_m,
    )
    return {
        "settings": _settings(limits, profile.interval_m),
        "tracks": tracks,
        "lane": _describe_lane(lane, tracks, profile, limits),
        "sections": [_describe_section(section, lane) for section in sections],
        "section_length_shares": dict(rated_shares(sections)),
        "section_length_shares_of_valid": dict(rated_shares(sections, of_valid=True)),
    }


def _settings(limits: RoughnessLimits, interval_m: float) -> dict[str, Any]:
    """Return the settings that are printed with the figures."""
    return {
        **IriSettings(segment_m=limits.section_m).as_dict(interval_m),
        "localized_roughness": f"IRI over {BASE_M:g} m above a threshold (AASHTO R 54)",
        "threshold_m_per_km": limits.threshold_m_per_km,
        "bumps_and_dips": f"off a centred average of {AVERAGE_BASE_M:g} m (Tex-1001-S)",
        "deviation_m": limits.deviation_m,
        "ride_number": "5 exp(-160 PI), PI of two paths by root mean square (UMTRI)",
        "rating": "good below 95 in/mi, poor above 170 in/mi (23 CFR 490.313)",
    }


def _describe_track(
    track: ProfileTrack, profile: Profile, limits: RoughnessLimits
) -> dict[str, Any]:
    """Return the figures of one wheel path."""
    z, interval = track.elevation, profile.interval_m
    with name_errors(f"track {track.name}"):
        index = ride_profile_index(z, interval)
        areas = localized_roughness(
            z,
            interval,
            limits.threshold_m_per_km,
            start_m=profile.start_m,
            valid=track.valid,
        )
        energies = [waveband_energy(z, interval, band, track.valid) for band in limits.bands]
        described = {
            "name": track.name,
            "valid_share": float(np.mean(track.valid)),
            "iri_m_per_km": iri(z, interval),
            **_of_valid("iri", track, interval),
            "ride_profile_index": index,
            "ride_number": ride_number(index),
            "localized_roughness": [asdict(area) for area in areas],
            "wavebands": [asdict(energy) for energy in energies],
        }
    # What was read of its file would stay in memory beside the next wheel path.
    release(z)
    return described


def _of_valid(name: str, track: ProfileTrack, interval_m: float) -> dict[str, float]:
    """Return the IRI of the valid points of ``track`` in m/km, by ``name``, and their share."""
    (found,) = segment_iris(replace(track, sigma=None), interval_m)
    return {f"{name}_of_valid_m_per_km": found.valid_m_per_km, "counted_share": found.counted_share}


def _describe_lane(
    lane: Sequence[ProfileTrack],
    tracks: list[dict[str, Any]],
    profile: Profile,
    limits: RoughnessLimits,
) -> dict[str, Any]:
    """Return the figures of the lane; None for those that need two wheel paths and have one."""
    interval, first, last = profile.interval_m, lane[0], lane[-1]
    valid = first.valid & last.valid
    mean = ProfileTrack.of("mean", mean_path(first.elevation, last.elevation, interval), valid)
    places = bumps_and_dips(
        mean.elevation,
        interval,
        limits.deviation_m,
        start_m=profile.start_m,
        valid=valid,
    )
    return {
        "tracks": [track.name for track in lane],
        "valid_share": float(np.mean(valid)),
        **(OF_ONE_PATH if len(tracks) == 1 else _of_two_paths(mean, tracks, interval)),
        "bumps_and_dips": [asdict(place) for place in places],
    }


def _of_two_paths(
    mean: ProfileTrack, tracks: list[dict[str, Any]], interval_m: float
) -> dict[str, float | None]:
    """Return MRI, HRI and Ride Number of two wheel paths; ``tracks`` are their own figures.

    ``mean`` is the mean of both, whose IRI is the HRI.
    """
    left, right = tracks
    of_valid = (track["iri_of_valid_m_per_km"] for track in tracks)
    values = (
        mean_roughness_index(left["iri_m_per_km"], right["iri_m_per_km"]),
        iri(mean.elevation, interval_m),
        ride_number(join_profile_indices(left["ride_profile_index"], right["ride_profile_index"])),
        mean_roughness_index(*of_valid),
    )
    half_car = _of_valid("half_car_roughness_index", mean, interval_m)
    return {**dict(zip(OF_ONE_PATH, values, strict=False)), **half_car}


def _describe_section(section: HpmsSection, lane: Sequence[ProfileTrack]) -> dict[str, Any]:
    """Return the record of one section, its IRIs by wheel path."""
    by_path = {
        name: dict(zip((track.name for track in lane), values, strict=True))
        for name, values in (
            ("iri_m_per_km", section.iri_m_per_km),
            ("iri_of_valid_m_per_km", section.iri_of_valid_m_per_km),
        )
    }
    return asdict(section) | by_path
