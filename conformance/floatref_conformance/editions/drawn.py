"""What an edition draws: numbers between two ends, and roads of some kinds."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import ceil, floor
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

STEP_M_PER_KM = 0.1


@dataclass(frozen=True)
class Drawn:
    """A number between two ends, in whole steps from the simplest.

    Attributes:
        low, high: the ends.
        step: of the values, so that a case is easy to read.
        simplest: the value towards which a failing case is simplified.
    """

    low: float
    high: float
    step: float
    simplest: float = 0.0

    def draw(self, source: np.random.Generator) -> float:
        """Return a value that ``source`` draws."""
        base, least, most = self._counts()
        return round(base + self.step * int(source.integers(least, most + 1)), 6)

    def strategy(self) -> "SearchStrategy[float]":
        """Return the Hypothesis strategy of all values."""
        from hypothesis import strategies as st

        base, least, most = self._counts()
        return st.integers(least, most).map(lambda count: round(base + count * self.step, 6))

    def _counts(self) -> tuple[float, int, int]:
        """Return the base, and the smallest and the largest count of steps from it."""
        base = min(max(self.simplest, self.low), self.high)
        least = ceil((self.low - base) / self.step - 1e-9)
        return base, least, floor((self.high - base) / self.step + 1e-9)


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

    @classmethod
    def of(cls, table: Mapping[str, Any]) -> "Roads":
        """Return the roads of a table of an edition."""
        return cls(table["smoothest_m_per_km"], table["roughest_m_per_km"], tuple(table["kinds"]))

    def draw_for(self, scenario: Scenario, entropy: tuple[int, ...]) -> Scenario:
        """Return ``scenario`` with a road and a seed drawn from ``entropy``."""
        source = np.random.default_rng(np.random.SeedSequence(entropy))
        seed, kind = int(source.integers(2**32)), int(source.integers(len(self.kinds)))
        steps = round((self.roughest - self.smoothest) / STEP_M_PER_KM)
        iri = self.smoothest + STEP_M_PER_KM * int(source.integers(steps + 1))
        return replace(scenario, seed=seed, road=self.kinds[kind], iri_m_per_km=round(iri, 1))
