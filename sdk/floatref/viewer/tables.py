"""The tables under a picture: figures with the kind of their unit, which a page can change."""

from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from typing import Any

from floatref.measures.valid_segments import SegmentIri
from floatref.values.display.short_text import percent
from floatref.values.recording import Recording
from floatref.values.scan import Summary
from floatref.viewer.events import Event

# A phone shows the first columns alone: those that the table is looked at for.
IRI_HEADER = (
    ("profile", ""),
    ("wheel path", ""),
    ("IRI of valid points", "roughness"),
    ("share that counts", ""),
    ("from", "distance"),
    ("length", "distance"),
    ("95 % from", "roughness"),
    ("to", "roughness"),
    ("all points", "roughness"),
    ("not valid", "distance"),
)
EVENT_HEADER = (("event", ""), ("from", ""), ("to", ""), ("detail", ""))
CHANNEL_HEADER = (
    ("channel", ""),
    ("unit", ""),
    ("rate Hz", ""),
    ("samples", ""),
    ("missing", ""),
    ("lowest", ""),
    ("mean", ""),
    ("highest", ""),
)


def table(
    caption: str, header: Sequence[tuple[str, str]], rows: Iterable[Mapping[str, Any]]
) -> dict[str, Any]:
    """Return a table: ``header`` has for every column its name and the kind of its numbers."""
    columns = [{"name": name, "kind": kind} for name, kind in header]
    return {"caption": caption, "columns": columns, "rows": list(rows)}


def iri_row(run: str, path: str, found: SegmentIri, whole: bool = False) -> dict[str, Any]:
    """Return the row of a segment of wheel path ``path``, marked if not all its points count."""
    low, high = found.interval
    share = percent(found.counted_share) if isfinite(found.counted_share) else "–"
    return {
        "cells": [
            run,
            path,
            found.valid_m_per_km,
            share,
            found.start_m,
            found.length_m,
            low,
            high,
            found.all_m_per_km,
            found.invalid_m,
        ],
        "marked": found.marked,
        "whole": whole,
        "place": [found.start_m, found.start_m + found.length_m],
        "domain": "distance",
    }


def event_table(events: Sequence[Event]) -> dict[str, Any]:
    """Return the table of ``events``, each with places in its own domain."""
    rows = [
        {
            "cells": [
                event.kind,
                {"value": event.begin, "kind": event.domain},
                {"value": event.end, "kind": event.domain},
                event.detail,
            ],
            "marked": event.kind in ("missing", "not valid"),
            "place": [event.begin, event.end],
            "domain": event.domain,
        }
        for event in events
    ]
    return table("Events", EVENT_HEADER, rows)


def channel_table(recording: Recording) -> dict[str, Any]:
    """Return the table of all channels, in SI units; one with missing samples is marked."""
    rows = []
    for channel in recording.channels:
        summary = channel.scan.summary
        figures = [f"{x:.6g}" if isfinite(x) else "–" for x in _figures(summary)]
        missing = percent(summary.missing / summary.count)
        cells = [str(channel.id), channel.unit, f"{channel.mean_rate_hz:.6g}"]
        cells += [str(summary.count), missing, *figures]
        rows.append({"cells": cells, "marked": summary.missing > 0})
    return table("Channels", CHANNEL_HEADER, rows)


def _figures(summary: Summary) -> tuple[float, float, float]:
    return summary.least, summary.mean, summary.greatest
