"""The roads of the driving checks: kind and roughness that a seed draws."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from floatref_conformance.checks.driving.edition import edition
from floatref_conformance.proving_ground.scenario import Scenario

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

    def drawn_for(self, scenario: Scenario, entropy: tuple[int, ...]) -> Scenario:
        """Return ``scenario`` with road and seed of its errors drawn by ``entropy``."""
        source = np.random.default_rng(np.random.SeedSequence(entropy))
        seed, kind = int(source.integers(2**32)), int(source.integers(len(self.kinds)))
        steps = round((self.roughest - self.smoothest) / STEP_M_PER_KM)
        iri = self.smoothest + STEP_M_PER_KM * int(source.integers(steps + 1))
        return replace(scenario, seed=seed, road=self.kinds[kind], iri_m_per_km=round(iri, 1))


ROADS: Mapping[str, Roads] = {
    name: Roads(road["smoothest_m_per_km"], road["roughest_m_per_km"], tuple(road["kinds"]))
    for name, road in edition()["roads"].items()
}
"""Those of the edition, by name."""
