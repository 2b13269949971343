"""An edition of the judge: the numbers that it fixes or draws, and the data of its checks.

An edition never changes once it is published: a verdict names it, and can be repeated with it.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref_conformance.editions import EDITION, EDITIONS
from floatref_conformance.editions.drawn import Drawn, Roads
from floatref_conformance.proving_ground.scenario import Scenario

Table = Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class Edition:
    """One edition.

    Attributes:
        name: year and number.
        defaults: the numbers of a scenario that all its drives have, unless a drive says others.
        drawn: the numbers of a scenario that are drawn anew for each drive.
        without_slip: numbers of the drives of checks that ask nothing of the axis of distance.
        roads: the roads from which a check draws, by name.
        early_end_m: length in m by which a profile may end before the recording; it is reported.
        true_axis: whether a profile may lie along the true distance in place of the encoder's.
        wander: numbers of the line of every pass of `repeatability`.
        encoder: numbers of the encoder that `distance` draws.
        document: all its data, which conform to schema ``conformance-edition-1``.
    """

    name: str
    defaults: Mapping[str, Any]
    drawn: Mapping[str, Drawn]
    without_slip: Mapping[str, float]
    roads: Mapping[str, Roads]
    early_end_m: float
    true_axis: bool
    wander: Mapping[str, float]
    encoder: Mapping[str, Drawn]
    document: Table = field(repr=False)

    def make_scenario(self, **numbers: Any) -> Scenario:
        """Return the scenario of ``numbers``, else of the edition's defaults.

        Raises InputError for numbers that make no scenario.
        """
        return Scenario(**{**self.defaults, **numbers})

    def draw_numbers(self, entropy: tuple[int, ...]) -> dict[str, float]:
        """Return a value of every drawn number that follows from ``entropy``."""
        source = np.random.default_rng(np.random.SeedSequence(entropy))
        return {name: drawn.draw(source) for name, drawn in self.drawn.items()}

    def draw_for(self, scenario: Scenario, entropy: tuple[int, ...]) -> Scenario:
        """Return ``scenario`` with the drawn numbers that it leaves at the defaults."""
        numbers = self.draw_numbers(entropy)
        plain = self.make_scenario()
        free: dict[str, Any] = {
            n: v for n, v in numbers.items() if getattr(scenario, n) == getattr(plain, n)
        }
        return replace(scenario, **free) if free else scenario


def find_edition(name: str = EDITION) -> Edition:
    """Return the edition called ``name``; InputError for an unknown name."""
    if name not in EDITIONS:
        raise InputError(f"edition {name}: unknown; choose from {', '.join(EDITIONS)}")
    return _read(name)


@cache
def _read(name: str) -> Edition:
    text = (files(__package__) / f"{name.replace('.', '-')}.toml").read_text(encoding="utf-8")
    document = tomllib.loads(text)
    return Edition(
        name,
        MappingProxyType(document["defaults"]),
        _drawn(document["drawn"]),
        MappingProxyType(document["without_slip"]),
        {key: Roads.of(road) for key, road in document["roads"].items()},
        document["delivery"]["early_end_m"],
        document["delivery"]["true_axis"],
        MappingProxyType(document["wander"]),
        _drawn(document["encoder"]),
        document,
    )


def _drawn(table: Table) -> Mapping[str, Drawn]:
    return MappingProxyType({name: Drawn(**numbers) for name, numbers in table.items()})
