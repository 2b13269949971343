"""Make the vectors of the catalogue: every mutant and some good devices over the probes."""

from collections.abc import Callable, Iterable

from floatref_conformance.devices import builtin
from floatref_conformance.devices.interface import CAPABILITIES, Device
from floatref_conformance.judge.exercise import describe
from floatref_conformance.mutants import MUTATIONS
from floatref_conformance.mutants.device import make
from floatref_conformance.resemblance.catalogue import GOOD, FlawVector, Vectors
from floatref_conformance.resemblance.features import Features, measure_features
from floatref_conformance.resemblance.probe_answers import ask_probes

Show = Callable[[str], None]


def measure_device(device: Device) -> tuple[tuple[str, ...], Features]:
    """Return the capabilities of ``device``, and its features on the probes."""
    description = describe(device)
    features = measure_features(ask_probes(device, description))
    return tuple(c for c in CAPABILITIES if c in description.capabilities), features


def measure_vectors(show: Show, names: Iterable[str] = ()) -> Vectors:
    """Return the vectors of the mutants ``names``, all without any, and of the good devices.

    ``show`` is called with a line for every device. Mutants of the protocol and of streams make
    sound profiles, or no profile: their faults name them.
    """
    wanted = set(names)
    flaws = []
    for mutation in MUTATIONS:
        if not wanted or mutation.name in wanted:
            show(mutation.name)
            needs, features = measure_device(make(mutation.name))
            flaws.append(FlawVector(mutation.name, needs, features))
    good = {}
    for pipeline in (name for kind in GOOD.values() for name in kind):
        show(pipeline)
        good[pipeline] = measure_device(builtin.make(pipeline))[1]
    return Vectors(tuple(flaws), good)
