"""Results of runs with every outcome, and texts that a hostile device may send."""

from dataclasses import replace
from math import nan

import numpy as np
import pytest

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.limits import CertificationLimits
from floatref_conformance.certify.worksheet import (
    Cause,
    Criterion,
    Judged,
    RunSheet,
    RunTrack,
    SectionSheet,
    StationarySheet,
    Worksheet,
)
from floatref_conformance.checks.case import Case
from floatref_conformance.classes import DeviceClass, same_limit
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.verdict import (
    CheckResult,
    Measurement,
    Outcome,
    Pass,
    RunResult,
    Verdict,
)

HOSTILE = "<script>alert('x')</script>&amp;\x00\x1b[31m\u202e\ud800\ufffe \U0001f600 ]]>\r\n\"'"
DEVICE = {
    "spec": "exec:./firmware 'x y'",
    "name": "firmware",
    "version": "2",
    "architecture": "spatial",
    "capabilities": ("imu",),
}
STOP = Scenario(manoeuvre="stop", speed_kmh=60.0, bump_mm=20.0, bump_at_m=150.0)


def road(interval):
    x = np.arange(int(500.0 / interval) + 1) * interval
    return 0.01 * np.sin(x / 3.0)


@pytest.fixture
def hostile():
    return HOSTILE


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
    """Return a function that makes the result of one check."""

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
        )
        return replace(made, **changes)

    return make


@pytest.fixture
def result():
    """Return a function that makes the result of a run."""

    def make(*checks, replayed=(), device_class=DeviceClass.NOMINAL, given=(None, None), **device):
        about = {**DEVICE, **device}
        return RunResult(about, device_class, 7, "quick", checks, tuple(replayed), *given)

    return make


@pytest.fixture
def kept():
    """Return a function that makes the entry of a case that was run again."""

    def make(outcome, reason="", file="stop-0000aaaa.json", value=1.5):
        told = {"file": file, "check": "stop", "outcome": outcome.value, "reason": reason}
        return {**told, "value": value, "limit": 1.0, "unit": "m/km"}

    return make


@pytest.fixture
def every(check, result, kept, hostile):
    """A result with every outcome, each said in hostile words."""
    checks = [check(o, o.value, reason=hostile * (o is not Outcome.PASS)) for o in Outcome]
    again = [kept(o, hostile, f"{o.value}.json") for o in Outcome]
    words = {"spec": hostile, "name": hostile, "version": hostile}
    return result(*checks, replayed=again, **words)


def rough(seed=0, metres=160.0, interval=0.05):
    steps = np.random.default_rng(seed).normal(0.0, 2e-4, int(metres / interval) + 1)
    return np.cumsum(steps - steps.mean())


def run_track(track, accuracy=0.97, distance=0.02, height=0.1, causes=(), **changes):
    changes["causes"] = tuple(causes)
    made = RunTrack(track, accuracy, 0.0, 1.5, 0.4, 0.96, distance, 0.01, height, 0.1, 0.0)
    return replace(made, **changes)


def run_sheet(number, tracks, noise=2e-4, stretched=0.0, **changes):
    """One run over `rough`, with noise of its own, that takes the road longer by a share."""
    interval = 0.05
    along = np.arange(rough().size) * interval
    found = []
    for index, track in enumerate(tracks):
        noisy = rough(index) + np.random.default_rng(100 + number).normal(0.0, noise, along.size)
        shown = np.interp(along / (1.0 + stretched), along, noisy)
        found.append(ProfileTrack.of(track.track, shown))
    profile = Profile(
        interval, tuple(found), 100.0, provenance={"sha256": {"recording.json": "0" * 64}}
    )
    made = RunSheet(f"run-{number}", f"runs/run-{number}.csv", (), tuple(tracks), "", profile)
    return replace(made, **changes)


def criterion(id_="accuracy", value=0.95, limit=0.90, judged=Judged.PASS, **changes):
    unit = changes.pop("unit", "")
    clause = "AASHTO R 56-14, 8.3.2"
    made = Criterion(id_, id_.title(), clause, value, limit, unit, not unit, judged, "left")
    return replace(made, **changes)


@pytest.fixture
def judged():
    """Return a function that makes a criterion."""
    return criterion


@pytest.fixture
def run_of():
    """Return a function that makes a run, and one that makes the numbers of a wheel path."""
    return run_sheet, run_track


@pytest.fixture
def section_of():
    """Return a function that makes a section with ``runs``."""

    def make(runs, criteria=(), name="A1", tracks=("left", "right"), **changes):
        reference = Profile(
            0.05, tuple(ProfileTrack.of(t, rough(i)) for i, t in enumerate(tracks)), 100.0
        )
        n = len(runs)
        pairs = np.where(np.triu(np.ones((n, n), dtype=bool), 1), 0.96, np.nan)
        made = SectionSheet(
            name, "reference.csv", 100.0, 260.0, dict.fromkeys(tracks, 1.5), tuple(runs),
            dict.fromkeys(tracks, pairs), tuple(criteria), reference,
        )  # fmt: skip
        return replace(made, **changes)

    return make


@pytest.fixture
def certified(section_of):
    """Return a function that makes a worksheet: two good runs, one too long, one unreadable."""

    def make(**changes):
        long = Cause("distance", "takes the section 1.00 % longer", 0.93)
        tracks = [run_track("left"), run_track("right")]
        bad = [run_track(t, 0.31, 1.0, causes=[long]) for t in ("left", "right")]
        runs = (
            run_sheet(1, tracks),
            run_sheet(2, tracks, said=("reversed: driven from the other end",)),
            run_sheet(3, bad, stretched=0.01),
            RunSheet("run-4", "runs/run-4.csv", (), (), "holds no profile"),
        )
        reason = "run-3 takes the section 1.00 % longer"
        criteria = (
            criterion(),
            criterion("distance", 1.0, 0.15, Judged.FAIL, unit="%", reason=reason),
            criterion("iri-bias", 0.4, None, Judged.REPORTED, unit="%"),
        )
        still = Profile(0.05, (ProfileTrack.of("left", 1e-5 * np.sin(np.arange(4000.0))),))
        quiescent = StationarySheet(
            "quiescent", "still.csv", 20.0, 180.0, {"left": 0.02}, (),
            (criterion("quiescent", 0.02, 0.047, unit="m/km"),), still,
        )  # fmt: skip
        bounce = StationarySheet(
            "bounce", "none.csv", 0.0, 0.0, {}, ("could not be read",),
            (criterion("bounce", nan, 0.126, Judged.MISSING, unit="m/km", reason="none.csv"),),
        )  # fmt: skip
        made = Worksheet(
            "Van 7", DeviceClass.NOMINAL, CertificationLimits(), Verdict.FAIL,
            (section_of(runs, criteria),), (quiescent, bounce), (),
            {"pipeline": "temporal-basic", "map": None}, {"floatref": "1"},
        )  # fmt: skip
        return replace(made, **changes)

    return make
