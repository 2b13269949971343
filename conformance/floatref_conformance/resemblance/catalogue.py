"""The features of every flaw of the catalogue on the probes, kept as data.

`vectors.json` beside this module is written by `.ci/resemblance_data.py`: the features of the
mutant of each flaw, and of good devices of several pipelines, whose spread is the scale.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib.resources import files

from floatref_conformance.checks.likeness import Likeness
from floatref_conformance.devices.interface import RESPONSE, Description
from floatref_conformance.errors import SuiteError
from floatref_conformance.mutants.flaws import list_flaws
from floatref_conformance.resemblance.comparing import LEAST, MOST_FLAWS, GoodRange, compare
from floatref_conformance.resemblance.features import Features
from floatref_conformance.resemblance.probes import PROBES

FILE = "vectors.json"
FORMAT = "conformance-flaw-vectors/1"
GOOD: Mapping[str, tuple[str, ...]] = {
    "height": (
        "temporal-adaptive-hpf-spatial-backward",
        "spatial-hpf-timer-distortion-reflection",
        "kalman-smoother-reflection",
        "road-prior-smoother",
    ),
    RESPONSE: ("response-observer", "response-joint-input-state"),
}
"""Pipelines without a flaw, with a height sensor and without one."""


@dataclass(frozen=True)
class FlawVector:
    """The features of one flaw.

    Attributes:
        mutant: the device that has it.
        needs: the capabilities of its pipeline: a device without them cannot have the flaw.
        features: of the mutant on the probes.
    """

    mutant: str
    needs: tuple[str, ...]
    features: Features


@dataclass(frozen=True)
class Vectors:
    """The content of `vectors.json`: ``good`` has the features of good devices by pipeline."""

    flaws: Sequence[FlawVector]
    good: Mapping[str, Features]


def hash_probes() -> str:
    """Return a hash of the probes: vectors of other probes cannot be compared."""
    texts = [f"{p.name} {p.scenario.hash} {p.event_m}" for p in PROBES]
    return sha256("\n".join(texts).encode()).hexdigest()[:16]


@cache
def read_vectors() -> Vectors:
    """Return the vectors; SuiteError if they are those of other probes."""
    document = json.loads((files(__package__) / FILE).read_text(encoding="utf-8"))
    if document.get("format") != FORMAT or document.get("probes") != hash_probes():
        raise SuiteError(f"{FILE} is of other probes; run .ci/resemblance_data.py")
    names = document["features"]
    flaws = tuple(
        FlawVector(f["mutant"], tuple(f["needs"]), _named(names, f["values"]))
        for f in document["flaws"]
    )
    return Vectors(flaws, {k: _named(names, v) for k, v in document["good"].items()})


def _named(names: Sequence[str], values: Sequence[float | None]) -> Features:
    """Return ``values`` by name; those behind the last one are missing."""
    return dict(zip(names, values, strict=False))


def write_vectors(vectors: Vectors) -> str:
    """Return ``vectors`` as the content of `vectors.json`, one flaw a line."""
    everyone = [*(f.features for f in vectors.flaws), *vectors.good.values()]
    names = list(dict.fromkeys(name for features in everyone for name in features))

    def row(features: Features) -> list[float | None]:
        return [features.get(name) for name in names]

    head = {"format": FORMAT, "probes": hash_probes(), "features": names}
    flaws = [
        {"mutant": f.mutant, "needs": list(f.needs), "values": row(f.features)}
        for f in vectors.flaws
    ]
    lines = ",\n".join(f"  {json.dumps(flaw)}" for flaw in flaws)
    good = ",\n".join(f"  {json.dumps(n)}: {json.dumps(row(f))}" for n, f in vectors.good.items())
    start = json.dumps(head, indent=1)[:-2]
    return f'{start},\n "flaws": [\n{lines}\n ],\n "good": {{\n{good}\n }}\n}}\n'


def find_range(vectors: Vectors, has_height: bool) -> GoodRange:
    """Return the range of features of good devices, with a height sensor or without one."""
    names = GOOD["height" if has_height else RESPONSE]
    return GoodRange.of(vectors.good[name] for name in names)


def find_nearest(
    features: Features, description: Description, vectors: Vectors | None = None
) -> tuple[Likeness, ...]:
    """Return the flaws that a device of ``description`` resembles, the nearest first.

    At most `MOST_FLAWS`, each with at least `LEAST` in common; empty where no flaw is near.
    """
    ranked = rank_flaws(features, description, vectors or read_vectors())
    return tuple(one for one in ranked if one.alike >= LEAST)[:MOST_FLAWS]


def rank_flaws(
    features: Features, description: Description, vectors: Vectors
) -> tuple[Likeness, ...]:
    """Return all flaws that the device can have, the nearest first."""
    good = find_range(vectors, description.has_height)
    names = {flaw.mutant: flaw.name for flaw in list_flaws()}
    able = set(description.capabilities)
    found = [
        Likeness(f.mutant, names[f.mutant], round(compare(features, f.features, good), 2) + 0.0)
        for f in vectors.flaws
        if set(f.needs) <= able and (RESPONSE in f.needs) != description.has_height
    ]
    return tuple(sorted(found, key=lambda one: -one.alike))
