"""The catalogue of flaws: what each mutant stands for among real profilers.

`flaws.json` beside this module has the sentences; what a mutant does, and which checks have to
fail it, come from the mutants themselves.
"""

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from floatref_conformance.mutants.device import entries

FILE = "flaws.json"


@dataclass(frozen=True)
class Flaw:
    """One flaw of a profiler's software.

    Attributes:
        mutant: the device that has it: `mutant:NAME`.
        name: of the flaw, in a few words.
        wrong: what the mutant does.
        road: how it looks in a profile.
        origin: how a profiler comes to have it.
        found_by: ids of the checks that have to fail it.
    """

    mutant: str
    name: str
    wrong: str
    road: str
    origin: str
    found_by: tuple[str, ...]


@cache
def list_flaws() -> tuple[Flaw, ...]:
    """Return the flaw of every mutant, in the order of the mutants."""
    texts = json.loads((files(__package__) / FILE).read_text(encoding="utf-8"))
    return tuple(
        Flaw(
            entry.name,
            texts[entry.name]["flaw"],
            entry.summary,
            texts[entry.name]["road"],
            texts[entry.name]["origin"],
            entry.fails,
        )
        for entry in entries()
    )
