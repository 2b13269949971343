"""The page of a recording: every channel over time, or over the distance that was travelled."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from floatref.files.sources import name_errors
from floatref.values.clock import StampedClock
from floatref.values.parts.shown_units import kind_of_channel
from floatref.values.parts.windows import choose_channels, cut_recording, first_time
from floatref.values.recording import Channel, Recording
from floatref.viewer.drawn_lines import BIN_BYTES, MORE_BYTES, Line, bins_within, finest, write_line
from floatref.viewer.events import events_of_recording
from floatref.viewer.journey import Journey, write_track
from floatref.viewer.page_file import PageOptions, new_page
from floatref.viewer.page_writer import PageWriter
from floatref.viewer.tables import channel_table, event_table


def write_recording_page(
    path: Path, name: str, recording: Recording, options: PageOptions, channels: Sequence[str] = ()
) -> dict[str, Any]:
    """Write the page of ``recording`` to ``path`` and return its document.

    ``channels`` names those that are drawn, by default all; the window is in s after the first
    sample of the recording. Raises InputError, naming the recording, for a window or a channel that
    is not in it, and if ``path`` cannot be written.
    """
    origin_s = first_time(recording)
    with name_errors(name):
        cut = cut_recording(recording, options.window, origin_s)
        drawn = replace(cut, channels=choose_channels(cut, channels))
    title = options.title or name
    with new_page(path, title, options.overwrite) as page:
        document = options.head(title, "time") | _document(page, cut, drawn, origin_s, options)
        document["runs"] = [{"name": name, "lag": 0.0}]
        page.close(document)
    return document


def _document(
    page: PageWriter, cut: Recording, drawn: Recording, origin_s: float, options: PageOptions
) -> dict[str, Any]:
    """Write all arrays, and return the document that refers to them."""
    sizes = [(c.values.size, BIN_BYTES + MORE_BYTES * _is_stamped(c)) for c in drawn.channels]
    bins = bins_within(sizes, options.most_bytes)
    panels = _panels(page, drawn, origin_s, bins)
    journey = Journey.of(cut, origin_s)
    if journey is not None:
        lines = [write_line(page, journey.speed_line(), bins)]
        panels.append({"title": "Speed", "kind": "speed", "lines": lines})
    events = events_of_recording(drawn, journey, origin_s)
    return {
        "panels": panels,
        "span": {"time": _span(drawn, origin_s)},
        "finest": {
            "samples": finest([line for panel in panels for line in panel["lines"]]),
            "of": "samples",
        },
        "travel": None if journey is None else journey.write(page),
        "map": write_track(page, cut, origin_s),
        "events": [event._asdict() for event in events],
        "tables": [channel_table(drawn), *([event_table(events)] if events else [])],
    }


def _panels(page: PageWriter, drawn: Recording, origin_s: float, bins: int) -> list[dict[str, Any]]:
    """Write every channel, and return a panel for every quantity."""
    panels: dict[str, dict[str, Any]] = {}
    for channel in drawn.channels:
        label = channel.id.track or "vehicle"
        line = write_line(page, Line.of_channel(channel, origin_s, label), bins)
        title = channel.id.name.replace("_", " ").capitalize().replace("Gnss", "GNSS")
        panels.setdefault(channel.id.name, {"title": title, "lines": []})["lines"].append(line)
    for name, panel in panels.items():
        panel["kind"] = kind_of_channel(name)
    return list(panels.values())


def _is_stamped(channel: Channel) -> bool:
    return isinstance(channel.clock, StampedClock)


def _span(drawn: Recording, origin_s: float) -> tuple[float, float]:
    begins, ends = zip(*(channel.span_s for channel in drawn.channels), strict=True)
    return min(begins) - origin_s, max(ends) - origin_s
