"""From the answers on the probes to a vector of named features, each a signed, scaled error.

A feature is asinh(x/s) of an error x and the smallest difference s that counts: linear for small
errors and logarithmic for large ones, so that a flaw twice as large has nearly the same vector.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

import numpy as np

from floatref_conformance.resemblance.compared_path import ComparedPath, compare_paths
from floatref_conformance.resemblance.event_features import list_event, list_flags
from floatref_conformance.resemblance.parked_features import list_bounce, list_parked
from floatref_conformance.resemblance.probe_answers import Answer
from floatref_conformance.resemblance.road_features import (
    Feature,
    list_gain,
    list_holds,
    list_motion,
    list_pairs,
    list_waves,
)

LEAST_AXIS = 0.002
LEAST_START_M = 0.1
DIGITS = 3
Features = Mapping[str, float | None]
"""Values by name; None where the device delivered nothing to measure."""
STEADY, PARKED = ("crawl", "slow", "medium", "fast"), ("quiescent", "bounce")
MEASURES: Sequence[tuple[tuple[str, ...], Callable[[ComparedPath], Iterator[Feature]]]] = (
    (PARKED, list_parked),
    (("bounce",), list_bounce),
    (("road",), list_waves),
    (("road",), list_motion),
    (STEADY, list_gain),
    (("road", *STEADY), list_holds),
)
"""Which features are measured on which probes."""


def measure_features(answers: Iterable[Answer]) -> dict[str, float | None]:
    """Return the features of all ``answers``, rounded so that processors agree on them."""
    found: dict[str, float | None] = {}
    reference: ComparedPath | None = None
    for answer in answers:
        paths = list(compare_paths(answer))
        found |= _scale(answer.probe.name, _list_axis(answer))
        found |= _scale(answer.probe.name, _list_features(answer, paths))
        if answer.probe.name == "medium" and paths:
            reference = paths[0]
        if answer.probe.name == "later" and paths and reference is not None:
            found |= _scale("later", _list_difference(paths[0], reference))
    return found


def _scale(probe: str, features: Iterable[Feature]) -> dict[str, float | None]:
    """Return scaled values by name; None for one that is no number."""
    scaled = {f"{probe}: {name}": float(np.arcsinh(x / s)) for name, x, s in features}
    return {n: round(x, DIGITS) + 0.0 if np.isfinite(x) else None for n, x in scaled.items()}


def _list_axis(answer: Answer) -> Iterator[Feature]:
    """Yield whether there is a profile, and by how much its axis is wrong."""
    yield "nothing", 0.0 if answer.profile is not None else 1.0, 0.1
    if answer.profile is not None:
        recorded = answer.taken.recording.channel("distance").values
        length = float(np.nanmax(recorded) - recorded[0])
        profile = answer.profile
        yield "begin", profile.start_m - float(recorded[0]), LEAST_START_M
        end_m = profile.start_m + profile.length_m - float(recorded[0])
        yield "length", end_m / length - 1.0, LEAST_AXIS


def _list_features(answer: Answer, paths: list[ComparedPath]) -> Iterator[Feature]:
    """Yield the features of what the probe is about, of its first wheel path."""
    if not paths:
        return
    name, path, events_m = answer.probe.name, paths[0], answer.probe.event_m
    for probes, measure in MEASURES:
        if name in probes:
            yield from measure(path)
    if name == "road":
        yield from list_pairs(paths)
    if events_m:
        yield from list_event(path, events_m)
    if name == "gaps":
        yield from list_flags(path, events_m)


def _list_difference(path: ComparedPath, reference: ComparedPath) -> Iterator[Feature]:
    """Yield by how much a recording that begins later gives another profile, in m."""
    count = min(path.found.size, reference.found.size)
    yield "differs", float(np.std(path.found[:count] - reference.found[:count])), 2e-5
