"""`live-order`: what a device gave out before a moment does not depend on what came after it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from floatref_conformance.checks.streams.stream_check import Runs, bits, measurement
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.devices.streams.answers import FINAL, PROVISIONAL
from floatref_conformance.devices.streams.transcript import (
    Given,
    Line,
    Transcript,
    differences,
    lines_of,
)
from floatref_conformance.errors import DeviceError

QUANTITY = "change by later samples"


@dataclass(frozen=True)
class OrderCheck:
    """Two runs that differ after a moment give the same points before it."""

    id: str = "live-order"
    title: str = "a point depends on no sample that comes after it"
    clause: str = "Causality"
    derivation: str = (
        "The same drive is streamed twice. Up to a moment at 70 % of it the samples are equal; "
        "after it, what accelerometers and lasers measure is half as large again. The device "
        "answers each sync when it has given out what the samples before it make, and up to ten "
        "seconds of samples may be on their way to it. What it gives out before it answers the "
        "last sync of the common part, provisional or final, must be equal in both runs: the "
        "samples that differ did not exist at that time."
    )
    floor: str = "By that moment the device has given out at least one point."
    limits: Mapping[str, str] = field(
        default_factory=lambda: {QUANTITY: "0, or what the device declares as tolerance_m"}
    )
    is_long: bool = False

    def judge(self, runs: Runs) -> tuple[Measurement, ...]:
        """Return the largest difference of the points that were there by the moment."""
        ours, other = (_before(run, runs.moment_s) for run in (runs.plain, runs.changed))
        if not ours:
            raise DeviceError(
                f"stream: gave out no point in the first {runs.moment_s:.0f} s of the drive; a "
                "device that streams gives out points while the vehicle drives"
            )
        worst: dict[str, float] = {}
        for state in (FINAL, PROVISIONAL):
            for name, apart_m in compare(_of(ours, state), _of(other, state)).items():
                worst[name] = max(worst.get(name, 0.0), apart_m)
        limit = bits(runs.plain)
        return tuple(measurement(QUANTITY, n, v, "m", limit) for n, v in worst.items())


def _before(run: Transcript, moment_s: float) -> tuple[Given, ...]:
    return tuple(each for each in run.given if each.until_s <= moment_s)


def _of(given: Iterable[Given], state: str) -> tuple[Given, ...]:
    return tuple(each for each in given if each.points.state == state)


def compare(ours: Iterable[Given], other: Iterable[Given]) -> Mapping[str, float]:
    """Return, by wheel path, the largest difference in m of what was given out in two runs.

    It is infinite where one run has a point, a flag or a gap and the other has not.
    """
    first, second = lines_of(ours), lines_of(other)
    names = dict.fromkeys((*first, *second))
    return {name: _apart(first.get(name), second.get(name)) for name in names}


def _apart(a: Line | None, b: Line | None) -> float:
    if a is None or b is None or (a.first, a.interval_m) != (b.first, b.interval_m):
        return np.inf
    if a.elevation.size != b.elevation.size:
        return np.inf
    if not np.array_equal(np.isnan(a.given_s), np.isnan(b.given_s)):
        return np.inf
    return float(np.max(differences(a.elevation, a.valid, b.elevation, b.valid)))
