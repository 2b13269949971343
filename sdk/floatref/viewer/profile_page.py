"""The page of one or more profiles of a road: elevation, roughness, IRI of segments, speed."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.files.sources import name_errors
from floatref.measures.locating.shift import Shift, move
from floatref.values.arrays import release
from floatref.values.parts.windows import first_time, points_of
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Recording
from floatref.viewer.drawn_lines import bins_within, finest, write_line
from floatref.viewer.events import Event, events_of_recording, invalid_stretches, slow_stretches
from floatref.viewer.journey import Journey, write_track
from floatref.viewer.lags import find_place, lag_of
from floatref.viewer.page_file import PageOptions, new_page
from floatref.viewer.page_writer import PageWriter
from floatref.viewer.profile_lines import (
    Run,
    elevation_line,
    mean_line,
    recorded_speed,
    roughness_line,
    run_segments,
    speed_line,
)
from floatref.viewer.tables import IRI_HEADER, event_table, iri_row, table


def write_profile_page(
    path: Path,
    profiles: Mapping[str, Profile],
    options: PageOptions,
    recording: Recording | None = None,
) -> dict[str, Any]:
    """Write the page of ``profiles``, by name, to ``path`` and return its document.

    The first is the reference. Each other one is moved to its place on that one's axis where it
    lies more than 1 m away; the page has by how much, and the lag in m that remains.
    ``recording``, of the first one, adds the time axis, speed, events and the map. Raises
    InputError, naming the profile, for a window outside it, and if ``path`` cannot be written.
    """
    runs = _place_runs(profiles, options)
    title = options.title or ", ".join(profiles)
    with new_page(path, title, options.overwrite) as page:
        document = options.head(title, "distance") | _document(page, runs, options, recording)
        page.close(document)
    return document


def _place_runs(profiles: Mapping[str, Profile], options: PageOptions) -> list[Run]:
    """Return ``profiles`` as runs on the axis of the first one."""
    runs: list[Run] = []
    for name, profile in profiles.items():
        with name_errors(name):
            place = find_place(runs[0].profile, profile) if runs else Shift(0.0)
            moved = move(profile, place)
            part = points_of(moved, options.window)
        runs.append(Run(len(runs), name, moved, part, place))
    return runs


def _document(
    page: PageWriter, runs: Sequence[Run], options: PageOptions, recording: Recording | None
) -> dict[str, Any]:
    """Write all arrays, and return the document that refers to them."""
    bins = bins_within([size for run in runs for size in run.sizes()], options.most_bytes)
    panels, rows = _panels_of_paths(page, runs, options, bins)
    journey = None if recording is None else _journey(recording)
    events = _events(runs, recording, journey)
    document: dict[str, Any] = {
        "runs": [_placed(runs[0], run) for run in runs],
        "span": {"distance": _span(runs)},
        "finest": {"samples": finest(panels[0]["lines"]), "of": "points"},
        "events": [event._asdict() for event in events],
        "tables": [table("IRI", IRI_HEADER, rows)] if rows else [],
    }
    if events:
        document["tables"].append(event_table(events))
    if recording is not None and journey is not None:
        document["travel"] = journey.write(page)
        document["map"] = write_track(page, recording, journey.origin_s)
        lines = [journey.speed_line()]
    else:
        lines = [line for run in runs if (line := speed_line(run)) is not None]
    if lines:
        written = [write_line(page, line, bins) for line in lines]
        panels.append({"title": "Speed", "kind": "speed", "lines": written})
    return document | {"panels": panels}


def _panels_of_paths(
    page: PageWriter, runs: Sequence[Run], options: PageOptions, bins: int
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Write elevation, roughness and IRI; return their panels and the rows of the table."""
    written: list[dict[str, dict[str, Any]]] = []
    means: list[dict[str, Any]] = []
    rows: list[dict[str, Any]] = []
    for run, track in ((each, track) for each in runs for track in each.profile.tracks):
        with name_errors(f"{run.name}: track {track.name}"):
            segments = run_segments(run, track, options.segment_m)
            written.append(_write_path(page, run, track, bins))
            if segments:
                means.append(write_line(page, mean_line(run, track, segments[1:]), bins))
        release(track.elevation)
        rows += [iri_row(run.name, track.name, s, not k) for k, s in enumerate(segments)]
    panels = [
        {"title": "Elevation", "kind": "distance", "lines": [w["elevation"] for w in written]},
        {
            "title": "Roughness over 7.62 m",
            "kind": "roughness",
            "lines": [w["roughness"] for w in written],
        },
    ]
    if means:
        panels.append({"title": "IRI of segments", "kind": "roughness", "lines": means})
    return panels, rows


def _write_path(page: PageWriter, run: Run, track: ProfileTrack, bins: int) -> dict[str, Any]:
    return {
        "elevation": write_line(page, elevation_line(run, track), bins),
        "roughness": write_line(page, roughness_line(run, track), bins),
    }


def _events(
    runs: Sequence[Run], recording: Recording | None, journey: Journey | None
) -> list[Event]:
    """Return what happened on the first run, and which stretches of any run are not valid."""
    found = [event for run in runs for event in invalid_stretches(run.profile, run.name)]
    speed = recorded_speed(runs[0].profile)
    if recording is not None and journey is not None:
        found += events_of_recording(recording, journey, journey.origin_s)
    elif speed is not None:
        found += slow_stretches(*speed)
    return [event for event in found if _is_shown(event, _span(runs), journey)]


def _is_shown(event: Event, span: tuple[float, float], journey: Journey | None) -> bool:
    """Return whether any of ``event`` lies in ``span``, in m."""
    begin, end = event.begin, event.end
    if event.domain == "time" and journey is not None:
        begin, end = journey.distance_at(begin), journey.distance_at(end)
    return begin <= span[1] and end >= span[0]


def _journey(recording: Recording) -> Journey:
    journey = Journey.of(recording, first_time(recording))
    if journey is None:
        raise InputError(
            "the recording has no distance that grows; without one it has no place along a profile"
        )
    return journey


def _span(runs: Sequence[Run]) -> tuple[float, float]:
    begins, ends = zip(*(run.span_m for run in runs), strict=True)
    return min(begins), max(ends)


def _placed(reference: Run, run: Run) -> dict[str, Any]:
    """Return name, move, lag and doubt of ``run``; the lag is NaN where its place is not sure."""
    lag = 0.0 if run is reference else np.nan
    if run is not reference and run.place.is_sure:
        lag = lag_of(reference.profile, run.profile)
    return {"name": run.name, "moved": -run.moved_m, "lag": lag, "note": run.place.note}
