"""The data of the driving checks, `edition.toml`, and its roads."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np

from floatref_conformance.proving_ground.scenario import Scenario

Table = Mapping[str, Any]
STEP_M_PER_KM = 0.1


@dataclass(frozen=True)
class Roads:
    """Roads of some kinds between two values of the IRI.

    Attributes:
        smoothest, roughest: mean IRI of the wheel paths, in m/km.
        kinds: names of roads; the first is the simplest.
    """

    smoothest: float
    roughest: float
    kinds: tuple[str, ...]

    def draw_for(self, scenario: Scenario, entropy: tuple[int, ...]) -> Scenario:
        """Return ``scenario`` with a road and a seed drawn from ``entropy``."""
        source = np.random.default_rng(np.random.SeedSequence(entropy))
        seed, kind = int(source.integers(2**32)), int(source.integers(len(self.kinds)))
        steps = round((self.roughest - self.smoothest) / STEP_M_PER_KM)
        iri = self.smoothest + STEP_M_PER_KM * int(source.integers(steps + 1))
        return replace(scenario, seed=seed, road=self.kinds[kind], iri_m_per_km=round(iri, 1))


@cache
def edition() -> Table:
    """Return the whole document, which conforms to schema ``conformance-driving-1``."""
    text = (files(__package__) / "edition.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def derivation_of(check: Table) -> str:
    """Return how the cases of ``check`` are made, and the reasons of its limits."""
    return str(check["derivation"]).format_map(_texts())


def floor_of(check: Table) -> str:
    """Return what a profile must contain: the bump at the place of ``check``."""
    return str(edition()["floor"]["text"]).format(where=check["bump"], slow=check.get("slow", ""))


@cache
def _texts() -> Mapping[str, str]:
    """Return the shared texts of derivations, each with earlier ones inserted."""
    texts: dict[str, str] = {}
    for name, text in edition()["texts"].items():
        texts[name] = text.format_map(texts)
    return texts


ROADS: Mapping[str, Roads] = {
    name: Roads(road["smoothest_m_per_km"], road["roughest_m_per_km"], tuple(road["kinds"]))
    for name, road in edition()["roads"].items()
}
"""The roads of the edition, by name."""
