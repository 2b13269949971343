"""The probes: short recordings, the same for every device and seed, on which flaws differ.

A probe is about one thing: the waves of a road, one speed, one manoeuvre, a gap. They last 10 to
32 s, at 4 kHz, most with one wheel path; an edition of the judge does not change them.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from floatref.values.recording import Recording
from floatref_conformance.checks.faults.injection import change_samples, lose
from floatref_conformance.checks.interface import Taken
from floatref_conformance.checks.sameness.change import change_each
from floatref_conformance.checks.sameness.changes import shift_time
from floatref_conformance.devices.interface import CAPABILITIES, Description
from floatref_conformance.judge.bench import make_taken, restrict_channels
from floatref_conformance.proving_ground.scenario import Scenario

Change = Callable[[Recording], Recording]
SEED = 77
HEIGHT_GAP_M, HEIGHT_GAP_S = 60.0, 0.5
FORCE_GAP_M, FORCE_GAP_S = 120.0, 0.3
OUTAGE_M, OUTAGE_S = 60.0, 4.0
"""Begin and length of what is missing in the probes `gaps` and `outage`."""
OUTAGE_END_M = 115.0
LATER_S = 1e5
"""By how much the recording `later` begins later: single precision has steps of 8 ms there."""


def keep(recording: Recording) -> Recording:
    """Return ``recording``."""
    return recording


@dataclass(frozen=True)
class Probe:
    """A recording that every failing device gets.

    Attributes:
        name: of the probe; the names of its features begin with it.
        scenario: what is simulated.
        event_m: places around which errors are measured by themselves.
        change: what is changed in the simulated recording.
        needs: the capabilities without which the probe shows nothing.
    """

    name: str
    scenario: Scenario
    event_m: tuple[float, ...] = ()
    change: Change = keep
    needs: frozenset[str] = frozenset()

    def take(self, description: Description) -> Taken:
        """Return the recording and its truth, with the channels that the device declares."""
        taken = make_taken(restrict_channels(description, self.scenario))
        return replace(taken, recording=self.change(taken.recording))


def _scenario(**numbers: Any) -> Scenario:
    common = {"seed": SEED, "rate_hz": 4000.0, "tracks": ("left",), "profile_interval_m": 0.025}
    quiet = {"iri_m_per_km": 2.5, "laser_ahead_m": 0.0, "slip_percent_per_g": 0.3}
    return Scenario(**{**common, **quiet, **numbers})


def _lose(recording: Recording, name: str, at_m: float, length_s: float) -> Recording:
    """Return ``recording`` without ``length_s`` of every channel ``name``, from ``at_m`` on."""
    encoder = recording.channel("distance")
    at = min(int(np.searchsorted(encoder.values, at_m)), encoder.values.size - 1)
    begin_s = float(encoder.times_s[at])
    return change_each(
        recording,
        lambda c: change_samples(c, begin_s, begin_s + length_s, lose) if c.id.name == name else c,
    )


def _make_gaps(recording: Recording) -> Recording:
    without = _lose(recording, "height", HEIGHT_GAP_M, HEIGHT_GAP_S)
    return _lose(without, "vertical_specific_force", FORCE_GAP_M, FORCE_GAP_S)


def _lose_receiver(recording: Recording) -> Recording:
    """Return ``recording`` without a fix of the receiver for a while."""
    for name in sorted(CAPABILITIES["gnss"] - {"gnss_quality"}):
        recording = _lose(recording, name, OUTAGE_M, OUTAGE_S)
    encoder = recording.channel("distance")
    begin_s = float(np.interp(OUTAGE_M, encoder.values, encoder.times_s))

    def no_fix(values: np.ndarray, where: slice) -> None:
        values[where] = 0.0

    return change_each(
        recording,
        lambda c: (
            change_samples(c, begin_s, begin_s + OUTAGE_S, no_fix)
            if c.id.name == "gnss_quality"
            else c
        ),
    )


def _begin_later(recording: Recording) -> Recording:
    return shift_time(recording, {"shift_s": LATER_S})


STOP: dict[str, Any] = {
    "manoeuvre": "stop",
    "speed_kmh": 66.0,
    "deceleration_g": 0.3,
    "event_at_m": 125.0,
    "dwell_s": 3.0,
    "final_speed_kmh": 30.0,
    "length_m": 220.0,
}
MEDIUM = _scenario(speed_kmh=50.0, length_m=190.0)
PROBES = (
    Probe("crawl", _scenario(speed_kmh=12.0, length_m=45.0)),
    Probe("road", _scenario(speed_kmh=72.0, length_m=400.0, tracks=("left", "right"))),
    Probe("medium", MEDIUM),
    Probe("gaps", MEDIUM, (HEIGHT_GAP_M + 3.5, FORCE_GAP_M + 2.0), _make_gaps),
    Probe("later", MEDIUM, (), _begin_later),
    Probe("fast", _scenario(speed_kmh=100.0, length_m=290.0)),
    Probe("slow", _scenario(speed_kmh=20.0, length_m=75.0)),
    Probe("quiescent", _scenario(manoeuvre="quiescent")),
    Probe("bounce", _scenario(manoeuvre="bounce")),
    Probe(
        "coasting",
        _scenario(
            manoeuvre="coasting",
            speed_kmh=45.0,
            final_speed_kmh=38.0,
            deceleration_g=0.03,
            event_at_m=60.0,
            length_m=200.0,
        ),
        (100.0,),
    ),
    Probe(
        "throttle",
        _scenario(
            manoeuvre="throttle",
            speed_kmh=30.0,
            final_speed_kmh=45.0,
            deceleration_g=0.15,
            event_at_m=70.0,
            length_m=180.0,
        ),
        (85.0,),
    ),
    Probe(
        "braking",
        _scenario(
            manoeuvre="braking",
            speed_kmh=65.0,
            event_speed_kmh=25.0,
            deceleration_g=0.3,
            event_at_m=120.0,
            laser_ahead_m=0.2,
            length_m=190.0,
        ),
        (120.0,),
    ),
    Probe(
        "near-stop",
        _scenario(
            manoeuvre="near-stop",
            speed_kmh=50.0,
            event_speed_kmh=11.0,
            deceleration_g=0.3,
            event_at_m=110.0,
            dwell_s=2.0,
            final_speed_kmh=30.0,
            length_m=200.0,
        ),
        (112.0,),
    ),
    Probe("stop", _scenario(**STOP), (125.0,)),
    Probe(
        "dead-start",
        _scenario(manoeuvre="dead-start", dwell_s=3.0, final_speed_kmh=40.0, length_m=130.0),
        (0.0,),
    ),
    Probe("outage", MEDIUM, (OUTAGE_END_M,), _lose_receiver, frozenset({"gnss"})),
    Probe(
        "stop-on-a-crown",
        _scenario(**STOP, crown_mm=150.0, crown_length_m=30.0, crown_at_m=130.0),
        (125.0,),
        keep,
        frozenset({"gnss", "imu"}),
    ),
)
"""All probes, in the order in which a device gets them."""


def probes_for(description: Description) -> tuple[Probe, ...]:
    """Return the probes that show something of the device of ``description``."""
    return tuple(p for p in PROBES if p.needs <= set(description.capabilities))
