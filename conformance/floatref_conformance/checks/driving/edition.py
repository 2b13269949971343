"""The driving checks as data of the edition, `edition.toml`, and the roads that it names."""

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
        """Return ``scenario`` with road and seed of its errors drawn by ``entropy``."""
        source = np.random.default_rng(np.random.SeedSequence(entropy))
        seed, kind = int(source.integers(2**32)), int(source.integers(len(self.kinds)))
        steps = round((self.roughest - self.smoothest) / STEP_M_PER_KM)
        iri = self.smoothest + STEP_M_PER_KM * int(source.integers(steps + 1))
        return replace(scenario, seed=seed, road=self.kinds[kind], iri_m_per_km=round(iri, 1))


@cache
def edition() -> Table:
    """Return the whole document; it keeps schema ``conformance-driving-1``."""
    text = (files(__package__) / "edition.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def derivation_of(check: Table) -> str:
    """Return how the cases of ``check`` are made, and why its limits are what they are."""
    return str(check["derivation"]).format_map(_texts())


def floor_of(check: Table) -> str:
    """Return what must be in a profile: the bump, where ``check`` has it."""
    return str(edition()["floor"]["text"]).format(where=check["bump"], slow=check.get("slow", ""))


@cache
def _texts() -> Mapping[str, str]:
    """Return the texts that derivations share, each with those above it filled in."""
    texts: dict[str, str] = {}
    for name, text in edition()["texts"].items():
        texts[name] = text.format_map(texts)
    return texts


ROADS: Mapping[str, Roads] = {
    name: Roads(road["smoothest_m_per_km"], road["roughest_m_per_km"], tuple(road["kinds"]))
    for name, road in edition()["roads"].items()
}
"""Those of the edition, by name."""
