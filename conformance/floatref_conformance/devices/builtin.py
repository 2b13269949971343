"""Built-in devices: the pipelines of floatref, run in this process."""

import sys
import warnings
from collections.abc import Mapping
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import floatref
from floatref.errors import InputError
from floatref.files import read_recording, write_profile
from floatref.values.display.similar_names import suggest
from floatref.values.profile import Profile
from floatref.values.recording import Recording, Setup
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.host import stream_alone
from floatref_conformance.devices.interface import ARCHITECTURES, DeviceEntry, DeviceKind
from floatref_conformance.devices.streams.serving import Clocks, Stream

MODULE = "floatref_conformance.devices.builtin"
"""This module, as a process that answers a stream imports it."""
RECOMMENDED = "road-prior-smoother"
"""The default device: suppression for a temporal profiler."""
CLAIMS: Mapping[str, DeviceClass] = {
    RECOMMENDED: DeviceClass.NOMINAL,
    "temporal-adaptive-hpf-spatial-backward": DeviceClass.NOMINAL,
    "spatial-hpf-timer-distortion-reflection": DeviceClass.NOMINAL,
    "kalman-smoother-reflection": DeviceClass.ADEQUATE,
}
"""The classes that pipelines claim to reach; other pipelines make no claim."""


@dataclass(frozen=True)
class BuiltinDevice:
    """Pipeline ``pipeline`` of floatref with default settings and the channels that it needs.

    It has no memory of earlier recordings, so it is concurrent: copies may run at once.
    """

    pipeline: str

    @property
    def concurrent(self) -> bool:
        """True: copies in several processes make the same profiles."""
        return True

    @property
    def claims(self) -> DeviceClass:
        """The class by whose limits the pipeline is judged by default."""
        return CLAIMS.get(self.pipeline, DeviceClass.NOMINAL)

    def describe(self) -> Mapping[str, Any]:
        """Return the pipeline's description; its name shows an architecture but temporal."""
        named = [part for part in self.pipeline.split("-") if part in ARCHITECTURES]
        return {
            "name": self.pipeline,
            "version": floatref.__version__,
            "architecture": named[0] if named else "temporal",
            "capabilities": list(floatref.pipeline_capabilities(self.pipeline)),
        }

    @property
    def live_argv(self) -> tuple[str, ...]:
        """The command line of a process that answers a stream with the pipeline."""
        return (sys.executable, "-m", MODULE, self.pipeline)

    def open_stream(self, setup: Setup, clocks: Clocks) -> Stream:
        """Return a stream of floatref."""
        return floatref.start_stream(setup, clocks, self.pipeline)

    def run(self, recording: Path, profile: Path) -> None:
        """Process ``recording`` and write the profile directory ``profile``."""
        write_profile(process_quietly(read_recording(recording), self.pipeline), profile)


def process_quietly(
    recording: Recording, pipeline: str, settings: Mapping[str, Any] | None = None
) -> Profile:
    """Return the profile that ``pipeline`` makes of ``recording``, without its warnings.

    What a plug-in prints goes to standard error: standard output is the report's.
    """
    with warnings.catch_warnings(), redirect_stdout(sys.stderr):
        warnings.simplefilter("ignore", floatref.FloatrefWarning)
        return floatref.process(recording, pipeline, settings)


def process_with_warnings(recording: Recording, pipeline: str) -> tuple[Profile, tuple[str, ...]]:
    """Return the profile that ``pipeline`` makes of ``recording``, and its warnings.

    Those are about sensors: that a pipeline cannot measure a stop says nothing of them.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", floatref.FloatrefWarning)
        profile = floatref.process(recording, pipeline)
    ours = (str(w.message) for w in caught if issubclass(w.category, floatref.FloatrefWarning))
    beside = f"{pipeline} cannot measure "
    return profile, tuple(line for line in ours if not line.startswith(beside))


def make(pipeline: str) -> BuiltinDevice:
    """Return the device of ``pipeline``; InputError if floatref has no such pipeline."""
    names = tuple(floatref.pipelines())
    if pipeline not in names:
        known = suggest(pipeline, names, "known:")
        raise InputError(f"device builtin:{pipeline}: unknown pipeline; {known}")
    return BuiltinDevice(pipeline)


def entries() -> tuple[DeviceEntry, ...]:
    """Return one entry per pipeline."""
    return tuple(DeviceEntry(name, "pipeline of floatref") for name in floatref.pipelines())


BUILTIN = DeviceKind("builtin", "PIPELINE", make, entries)

if __name__ == "__main__":
    stream_alone(make(sys.argv[1]).open_stream)
