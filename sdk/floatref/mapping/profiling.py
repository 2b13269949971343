"""From what was read to its profile, with the origin of the readings in its provenance."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from floatref.files.sources import naming
from floatref.mapping.sources import Source

if TYPE_CHECKING:
    from floatref.architectures.processing import Result


def profiled(
    read: Source,
    pipeline: str,
    settings: Mapping[str, Any],
    progress: Callable[[float], None] | None = None,
) -> "Result":
    """Return the profile of ``read`` by ``pipeline``, and one line for each thing to know.

    Lines, and those of errors, have the native names of channels. ``progress`` is called with
    the part of the recording that is through. Raises InputError with one line naming the source
    for a recording, pipeline or setting that cannot be used.
    """
    from floatref.architectures.processing import run

    with naming(read.path), read.named():
        result = run(read.recording, pipeline, settings, progress)
    provenance = {**result.profile.provenance, **read.origin}
    told = (*read.warnings, *map(read.said, result.warnings))
    profile = replace(result.profile, provenance=provenance)
    return replace(result, profile=profile, warnings=told)
