"""Worksheets of a certification: two good runs, one too long, one unreadable."""

from dataclasses import replace
from math import nan

import numpy as np
import pytest

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.judging.contents import (
    Cause,
    Criterion,
    Judged,
    RunSheet,
    RunTrack,
    SectionSheet,
    StationarySheet,
    Worksheet,
)
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass


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
    return criterion


@pytest.fixture
def run_of():
    """Return a function that makes a run, and one that makes the numbers of a wheel path."""
    return run_sheet, run_track


@pytest.fixture
def section_of():

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
            run_sheet(2, tracks, notes=("reversed: driven from the other end",)),
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
