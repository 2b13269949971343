"""Mutants: devices that are wrong on purpose, each with the checks that must fail it.

A mutant is a sound pipeline with one error before or after it. A check that passes the pipeline
and fails the mutant has detected just this error. Hostile programs are also mutants: they deliver
a sound profile and behave badly. The mutants of streams make sound profiles of recordings.
"""

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files import read_recording, write_profile
from floatref.values.display.similar_names import suggest
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.builtin import BuiltinDevice, process_quietly
from floatref_conformance.devices.interface import Device, DeviceEntry, DeviceKind
from floatref_conformance.mutants import MUTATIONS
from floatref_conformance.mutants.hostile import HOSTILE, hostile_device
from floatref_conformance.mutants.in_streams import STREAM_MUTANTS, stream_mutant
from floatref_conformance.mutants.mutation import Mutation


@dataclass(frozen=True)
class Mutant:
    """A device with one mutation."""

    mutation: Mutation

    @property
    def claims(self) -> DeviceClass:
        """The class by whose limits the mutant is judged."""
        return self.mutation.claims

    def describe(self) -> Mapping[str, Any]:
        """Return the description of the sound pipeline, with the mutation's name."""
        return {**BuiltinDevice(self.mutation.pipeline).describe(), "name": self.mutation.name}

    def run(self, recording: Path, profile: Path) -> None:
        """Mutate ``recording``, process it, mutate the profile and write it."""
        wrong, recorded = self.mutation, read_recording(recording)
        made = process_quietly(wrong.before(recorded), wrong.pipeline, wrong.settings)
        write_profile(wrong.after(made, recorded), profile)


def make(name: str) -> Device:
    """Return mutant ``name`` in its initial state; InputError if it is unknown."""
    for mutation in MUTATIONS:
        if mutation.name == name:
            return Mutant(deepcopy(mutation))
    if name in [hostile.name for hostile in HOSTILE]:
        return hostile_device(name)
    if name in [mutant.name for mutant in STREAM_MUTANTS]:
        return stream_mutant(name)
    known = suggest(name, [entry.name for entry in entries()], "known:")
    raise InputError(f"device mutant:{name}: unknown mutant; {known}")


def entries() -> tuple[DeviceEntry, ...]:
    """Return one entry per mutant; a hostile program must fail all checks of recordings."""
    wrong = tuple(DeviceEntry(m.name, m.wrong, m.fails) for m in (*MUTATIONS, *STREAM_MUTANTS))
    return wrong + tuple(DeviceEntry(h.name, h.wrong, tuple(IDS)) for h in HOSTILE)


MUTANT = DeviceKind("mutant", "NAME", make, entries)
