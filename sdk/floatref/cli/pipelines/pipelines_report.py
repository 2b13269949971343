"""The JSON documents of `floatref pipelines`: by sensors, or for a recording at hand."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floatref.engine.advice.by_sensors import pipelines_by_sensors
from floatref.engine.choosing import missing_for, passed_over, usable
from floatref.engine.plugins import plugins
from floatref.screening.travel import Travel

if TYPE_CHECKING:
    from floatref.mapping.sources import Source
    from floatref.values.recording import Recording


def pipelines_report() -> dict[str, Any]:
    """Return the JSON document of `floatref pipelines --json`."""
    known = plugins().pipelines()
    return {
        "pipelines": [
            {
                "name": pipeline.name,
                "architecture": pipeline.architecture,
                "summary": pipeline.summary,
                "settings": dict(pipeline.settings),
                "capabilities": pipeline.capabilities,
                "through_stops": pipeline.through_stops,
            }
            for pipeline in known.values()
        ],
        "by_sensors": [asdict(each) for each in pipelines_by_sensors(known)],
        "warnings": plugins().reports,
    }


def recording_report(path: Path, read: "Source") -> dict[str, Any]:
    """Return the JSON document of `floatref pipelines RECORDING --json`.

    ``taken`` is what `auto` takes, None if no pipeline of it has all channels.
    """
    recording, known = read.recording, plugins().pipelines()
    taken = next(usable(recording, known), None)
    return {
        "recording": str(path),
        "tracks": recording.tracks,
        "taken": taken and taken.pipeline,
        "reason": taken and taken.reason,
        "stops_m": _stops_m(recording),
        "pipelines": [
            {
                "name": name,
                "lacks": missing_for(recording, pipeline) or None,
                "through_stops": pipeline.through_stops,
            }
            for name, pipeline in known.items()
        ],
        "warnings": [*read.warnings, *passed_over(recording, known), *plugins().reports],
    }


def _stops_m(recording: "Recording") -> tuple[float, ...]:
    """Return where the vehicle stops, in m; nothing without an encoder."""
    has_encoder = recording.find("distance", recording.tracks[0]) is not None
    return Travel.of(recording).stops_m() if has_encoder else ()
