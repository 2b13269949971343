"""`process`: a recording, or the path of one, through a pipeline to a profile."""

import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from floatref.engine.choosing import AUTO
from floatref.engine.run import FloatrefWarning, Result
from floatref.errors import InputError
from floatref.live.as_live import way_of
from floatref.values.profile import Profile
from floatref.values.recording import Recording


def process(
    recording: Recording | Path | str,
    pipeline: str = AUTO,
    settings: Mapping[str, Any] | None = None,
    channel_map: Path | str | None = None,
    adapter: str | None = None,
    as_live: bool = False,
) -> Profile:
    """Return the profile of ``recording`` by ``pipeline``.

    ``auto`` takes the pipeline that bears most, of those whose channels were recorded; the
    profile's ``provenance["chosen"]`` says why.

    ``recording`` may be the path of a recording directory or of a native file, such as "run.mf4".
    A native file whose columns do not have our names needs ``channel_map``, the path of its map;
    ``adapter`` names what reads it, by default what recognises it. ``settings`` replaces the
    pipeline's defaults by name. The profile of a path has its source in ``provenance``.

    ``as_live`` makes the profile that a live stream makes of the same samples, window by window.

    Warns with `FloatrefWarning`. Raises InputError for a recording, path, map, pipeline or setting
    that cannot be used and PluginError if two plug-ins answer the same point.
    """
    chosen = settings or {}
    if isinstance(recording, Recording):
        _check_read(channel_map, adapter)
        result = way_of(as_live)(recording, pipeline, chosen)
    else:
        result = _process_path(Path(recording), pipeline, chosen, channel_map, adapter, as_live)
    for line in result.warnings:
        warnings.warn(line, FloatrefWarning, stacklevel=2)
    return result.profile


def _check_read(channel_map: Path | str | None, adapter: str | None) -> None:
    """Raise InputError for a way of reading given with a recording, which is already read."""
    for name, given in (("channel_map", channel_map), ("adapter", adapter)):
        if given is not None:
            raise InputError(f"{name} {given}: the recording is already read; give its path")


def _process_path(
    source: Path,
    pipeline: str,
    settings: Mapping[str, Any],
    channel_map: Path | str | None,
    adapter: str | None,
    as_live: bool,
) -> Result:
    from floatref.mapping.sources import make_profile, recording_of

    chart = None if channel_map is None else Path(channel_map)
    read = recording_of(source, adapter, chart)
    return make_profile(read, pipeline, settings, as_live=as_live)
