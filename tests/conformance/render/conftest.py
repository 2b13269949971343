"""Results of runs with every outcome."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.case import DEFAULT, Case
from floatref_conformance.checks.verdict import CheckResult, Measurement, Outcome, Pass, RunResult
from floatref_conformance.classes import DeviceClass, same_limit

DEVICE = {
    "spec": "exec:./firmware 'x y'",
    "name": "firmware",
    "version": "2",
    "architecture": "spatial",
    "capabilities": ("imu",),
}
STOP = replace(DEFAULT, manoeuvre="stop", speed_kmh=60.0, bump_mm=20.0, bump_at_m=150.0)


def road(interval):
    x = np.arange(int(500.0 / interval) + 1) * interval
    return 0.01 * np.sin(x / 3.0)


@pytest.fixture
def stopped():
    """A pass over a stop: every point from 300 to 330 m flagged, of them 310 to 320 m missing."""
    interval = 0.05
    x, z = np.arange(10001) * interval, road(interval)
    found = np.where((x > 310.0) & (x < 320.0), np.nan, z + 0.002)
    valid = (x < 300.0) | (x > 330.0)
    tracks = (ProfileTrack.of("left", found, valid), ProfileTrack.of("right", z))
    truth = tuple(ProfileTrack.of(name, z) for name in ("left", "right"))
    return Pass("", Profile(interval, truth), Profile(interval, tracks), STOP)


@pytest.fixture
def check(stopped):

    def make(outcome, id_="stop", value=None, reason="", limits=None, **changes):
        default = {Outcome.PASS: 0.5, Outcome.FAIL: 3.0, Outcome.WAIVED: 2.0}.get(outcome)
        value = default if value is None else value
        limits = same_limit(1.0, 0.5) if limits is None else limits
        worst = None if value is None else Measurement("IRI error", "left", value, "m/km", limits)
        failed = outcome in (Outcome.FAIL, Outcome.ERROR)
        found = {
            "case": "stop-2, simplified",
            "parameters": Case("stop", STOP, {"gap_s": 0.25}).parameters,
            "reason": reason,
            "file": "cases/stop-1a2b3c4d.json",
        }
        made = CheckResult(
            id_,
            "R 56-14, 6",
            outcome,
            reason,
            DeviceClass.NOMINAL if outcome is Outcome.PASS else None,
            4 if worst or failed else 0,
            worst,
            "stop-2" if worst else "",
            found if failed else None,
            passes=(stopped,) if outcome is Outcome.FAIL else (),
            shown=worst,
            shown_case="stop-2" if worst else "",
        )
        return replace(made, **changes)

    return make


@pytest.fixture
def result():

    def make(*checks, replayed=(), device_class=DeviceClass.NOMINAL, given=(None, None), **device):
        about = {**DEVICE, **device}
        return RunResult(about, device_class, 7, "quick", checks, tuple(replayed), *given)

    return make


@pytest.fixture
def kept():
    """Return a function that makes the entry of a case that was run again."""

    def make(outcome, reason="", file="stop-0000aaaa.json", value=1.5):
        entry = {"file": file, "check": "stop", "outcome": outcome.value, "reason": reason}
        return {**entry, "value": value, "limit": 1.0, "unit": "m/km"}

    return make


@pytest.fixture
def every(check, result, kept, hostile):
    """A result with every outcome, each said in hostile words."""
    checks = [check(o, o.value, reason=hostile * (o is not Outcome.PASS)) for o in Outcome]
    again = [kept(o, hostile, f"{o.value}.json") for o in Outcome]
    words = {"spec": hostile, "name": hostile, "version": hostile}
    return result(*checks, replayed=again, **words)
