"""The default options of files, checked before any work."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any

from floatref.engine.automatic import resolve_named_or_best
from floatref.engine.choosing import AUTO
from floatref.engine.recordings.readers import get_reader, is_native
from floatref.errors import InputError
from floatref.mapping.channel_map.entries import ChannelMap
from floatref.mapping.channel_map.map_document import read_map


@dataclass(frozen=True)
class Defaults:
    """The options of the command, or those of one line of a manifest; fields as those of a job."""

    adapter: str | None = None
    channel_map: Path | None = None
    pipeline: str = AUTO
    settings: Mapping[str, Any] = field(default_factory=dict)
    segment_m: float | None = None
    measures: bool = False


def read_given_map(options: Defaults) -> ChannelMap | None:
    """Return the channel map of ``options``, None without a map.

    Raises InputError for a pipeline, adapter, setting, map or segment that no file can be
    processed with.
    """
    resolve_named_or_best(options.pipeline, options.settings)
    native = options.adapter is None or is_native(get_reader(options.adapter))
    length = options.segment_m
    if length is not None and not (isfinite(length) and length > 0):
        raise InputError(f"segment {length} m: must be above zero; give metres, as in 100")
    if options.channel_map is None:
        return None
    if not native:
        raise InputError(f"adapter {options.adapter}: has our channels; leave the map out")
    return read_map(options.channel_map)


def files_of(chart: ChannelMap | None) -> frozenset[str]:
    """Return the resolved paths of ``chart`` and of its files: they belong to other sources."""
    if chart is None:
        return frozenset()
    entries = (chart.source, *chart.files.values())
    named = [entry.path for entry in chart.files.values()]
    named += [Path(entry.options["dbc"]) for entry in entries if "dbc" in entry.options]
    named += [] if chart.place is None else [chart.place]
    return frozenset(map(os.path.realpath, named))
