"""The device that the judge tests: our software, from a recording to a profile."""

import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import floatref
from acme_roadlogger import __version__
from acme_roadlogger.pipeline import NAME


class Device:
    """The RoadLogger with its own pipeline; only nominal sensors."""

    def describe(self) -> Mapping[str, Any]:
        """Describe the device."""
        return {
            "name": "ACME RoadLogger",
            "version": __version__,
            "architecture": "temporal",
            "capabilities": [],
        }

    def run(self, recording: Path, profile: Path) -> None:
        """Process ``recording``, a recording.json, into the directory ``profile``."""
        with warnings.catch_warnings():
            # The judge does not need the warnings about repaired or flagged samples.
            warnings.simplefilter("ignore", floatref.FloatrefWarning)
            found = floatref.process(floatref.read_recording(recording), NAME)
        floatref.write_profile(found, profile)


def device() -> Device:
    """Return the device: `--device python:acme_roadlogger.device:device`."""
    return Device()
