"""One entry of the list of faults, and the words by which an entry is written."""

from dataclasses import dataclass, replace

import numpy as np

from floatref.values.recording import Recording
from floatref_conformance.faults import placing
from floatref_conformance.faults.placing import Change, Fault
from floatref_conformance.faults.sample_faults import Effect


@dataclass(frozen=True)
class ListedFault:
    """A fault of a recording.

    Attributes:
        name: unique; starts with what is faulty.
        wrong: what is wrong, in a few words.
        whole_run: whether it lasts from the begin to the end of the run.
        fault: makes a healthy recording faulty.
        twin: name of the healthy recording of `twins` that has the same samples, which is why no
            recording can show the fault; "" if a recording can.
    """

    name: str
    wrong: str
    whole_run: bool
    fault: Fault
    twin: str = ""

    @property
    def sensor(self) -> str:
        """What is faulty: the begin of the name."""
        return self.name.partition("-")[0]

    def damage(self, recording: Recording, seed: int = 0) -> Recording:
        """Return ``recording`` with this fault; random numbers follow from ``seed`` and name."""
        source = np.random.default_rng([seed, *self.name.encode()])
        return self.fault(recording, source)


def whole(name: str, channel: str, wrong: str, effect: Effect) -> ListedFault:
    """Return the fault ``wrong`` of all samples of ``channel``."""
    return ListedFault(name, wrong, True, placing.change(channel, placing.on_run(effect)))


def clocked(name: str, channel: str, wrong: str, how: Change, run: bool = True) -> ListedFault:
    """Return the fault ``wrong`` of the times of ``channel``."""
    return ListedFault(name, wrong, run, placing.change(channel, how))


def part(
    name: str, channel: str, wrong: str, effect: Effect, length_s: float | None
) -> ListedFault:
    """Return the fault ``wrong`` of ``channel`` for ``length_s``; without it to the run's end."""
    how = placing.on_stretch(effect, length_s)
    return ListedFault(name, wrong, False, placing.change(channel, how))


def hidden(listed: ListedFault, twin: str) -> ListedFault:
    """Return ``listed`` as a fault that no recording can show, because of a healthy ``twin``."""
    return replace(listed, twin=twin)
