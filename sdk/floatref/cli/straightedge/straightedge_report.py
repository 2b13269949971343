"""The JSON document of `floatref straightedge`: every figure with the share of it that is valid."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.files.sources import name_errors
from floatref.measures import (
    Profilograph,
    TraceRules,
    must_grind,
    profile_indices,
    profilograph_trace,
    rolling_straightedge,
    valid_frames,
)
from floatref.measures.ride.deviation_areas import check_length, check_limit
from floatref.measures.ride.rolling_straightedge import EIGHTH_INCH_M, LENGTH, TEN_FEET_M
from floatref.values.profile import Profile, ProfileTrack


@dataclass(frozen=True)
class Straightedge:
    """Length of a straightedge and the deviation that is allowed in its middle, in m.

    Raises InputError unless both are above zero.
    """

    length_m: float = TEN_FEET_M
    tolerance_m: float = EIGHTH_INCH_M

    def __post_init__(self) -> None:
        """Refuse a setting before a long road is read."""
        check_length(self.length_m, LENGTH)
        check_limit(self.tolerance_m)


def parse_wheels(text: str) -> tuple[float, ...]:
    """Return the places in m that ``text`` lists, with commas between them.

    Raises InputError for what is no number.
    """
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise InputError(
            f"--wheels {text}: not a list of numbers; give places in m, as -3.81,3.81"
        ) from None


def straightedge_report(
    profile: Profile, edge: Straightedge, machine: Profilograph, rules: TraceRules
) -> dict[str, Any]:
    """Return the JSON document of `floatref straightedge --json`.

    Raises InputError as the measures do, and for a profile on which neither has a place.
    """
    # The profilograph needs the most memory, so the areas of the straightedge come after it.
    traces = [_describe_trace(track, profile, machine, rules) for track in profile.tracks]
    tracks: list[dict[str, Any]] = [
        {
            "name": track.name,
            "valid_share": float(np.mean(track.valid)),
            "straightedge": _describe_edge(track, profile, edge),
            "profilograph": trace,
        }
        for track, trace in zip(profile.tracks, traces, strict=True)
    ]
    settings = {
        "interval_m": profile.interval_m,
        "straightedge_m": tracks[0]["straightedge"]["length_m"],
        "tolerance_m": edge.tolerance_m,
        **machine.as_dict(profile.interval_m),
        **rules.as_dict(),
    }
    return {"settings": settings, "tracks": tracks}


def _describe_edge(track: ProfileTrack, profile: Profile, edge: Straightedge) -> dict[str, Any]:
    """Return what the straightedge measures on one wheel path."""
    z, interval, start = track.elevation, profile.interval_m, profile.start_m
    with name_errors(f"track {track.name}"):
        result = asdict(
            rolling_straightedge(z, interval, edge.length_m, edge.tolerance_m, start, track.valid)
        )
        if not np.isfinite(result["largest_m"]):
            raise InputError(
                f"the straightedge of {result['length_m']:g} m has no place on the measured "
                f"{(np.count_nonzero(np.isfinite(z)) - 1) * interval:g} m; give a longer profile"
            )
        return result


def _describe_trace(
    track: ProfileTrack, profile: Profile, machine: Profilograph, rules: TraceRules
) -> dict[str, Any]:
    """Return profile indices and what must be ground of one wheel path.

    The index of the whole is that of the segments by their measured lengths.
    """
    z, interval, start = track.elevation, profile.interval_m, profile.start_m
    with name_errors(f"track {track.name}"):
        trace = profilograph_trace(z, interval, machine)
        sound = valid_frames(z, interval, machine, track.valid)
        segments = profile_indices(trace, sound, interval, rules, start)
        measured = [each for each in segments if each.measured_m > 0.0]
        length = sum(each.measured_m for each in measured)
        total = sum(each.profile_index_m_per_km * each.measured_m for each in measured)
        known = np.isfinite(trace)
        return {
            "profile_index_m_per_km": total / length if length else float("nan"),
            "measured_m": length,
            "valid_share": float(np.mean(sound[known])) if known.any() else float("nan"),
            "segments": [asdict(each) for each in segments],
            "must_grind": [
                asdict(each) for each in must_grind(trace, sound, interval, rules, start)
            ],
        }
