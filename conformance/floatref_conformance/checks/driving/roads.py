"""The roads of the driving checks: kind and roughness that a seed draws."""

from dataclasses import dataclass, replace

import numpy as np

from floatref_conformance.proving_ground.scenario import Scenario

LEVEL_KINDS = ("sayers-normal", "sayers-rough", "measured", "iso-B")
"""Spectra of Table 2.2, a measured profile, and ISO 8608, all scaled to a roughness."""
KINDS = (*LEVEL_KINDS, "sayers-asphalt-long-waves")
"""With long waves beyond those of white slope, too."""
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
    kinds: tuple[str, ...] = KINDS

    def drawn_for(self, scenario: Scenario, entropy: tuple[int, ...]) -> Scenario:
        """Return ``scenario`` with road and seed of its errors drawn by ``entropy``."""
        source = np.random.default_rng(np.random.SeedSequence(entropy))
        seed, kind = int(source.integers(2**32)), int(source.integers(len(self.kinds)))
        steps = round((self.roughest - self.smoothest) / STEP_M_PER_KM)
        iri = self.smoothest + STEP_M_PER_KM * int(source.integers(steps + 1))
        return replace(scenario, seed=seed, road=self.kinds[kind], iri_m_per_km=round(iri, 1))


EVERYDAY = Roads(0.8, 5.0)
"""New to worn pavement."""
WORN = Roads(1.5, 4.0)
"""Roads on which an error that the nominal sensors cannot avoid stays a share of the roughness."""
LEVEL = Roads(1.5, 4.0, LEVEL_KINDS)
"""The same without long waves, whose slope a profiler that slows down to a stop carries along."""
