"""Graded errors of `distance`: displaced or lost features."""

from dataclasses import replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.checks.distance.feature_places import QUANTITIES, DistanceCheck
from floatref_conformance.checks.distance.features import middles
from floatref_conformance.proving_ground.staging import drive_of
from floatref_conformance.selftest import put_in
from floatref_conformance.selftest.grading import Graded, Put, Situation

INTERVAL_M = 0.0025
"""Profile interval in m; displacements are measured in whole intervals."""


def situations(check: DistanceCheck) -> tuple[Situation, ...]:
    """Return the simplest case, a stop, with one wheel path and ideal sensors."""
    scenario = replace(
        check.simplest.scenario,
        tracks=("left",),
        rate_hz=4000.0,
        sensors=0.0,
        dwell_s=1.0,
        profile_interval_m=INTERVAL_M,
    )
    stop_m = scenario.event_at_m
    at = middles(drive_of(scenario).length_m, stop_m)
    puts: tuple[Put, ...] = (
        put_in.move_features,
        lambda percent: put_in.displace(lambda x: percent / 100.0 * x),
        lambda step_m: put_in.displace(lambda x: np.where(x > stop_m, step_m, 0.0)),
        lambda rest_m: put_in.displace(lambda x: rest_m * _beside_a_line(x, at, stop_m)),
        lambda loss: put_in.make_higher(-loss),
    )
    graded = tuple(Graded((name,), put) for (name, _, _), put in zip(QUANTITIES, puts, strict=True))
    return (Situation(check, replace(check.simplest, scenario=scenario), graded),)


def _beside_a_line(x: FloatArray, at_m: FloatArray, stop_m: float) -> FloatArray:
    """Return displacements of features at ``at_m`` that no line with a step at the stop fits.

    The largest is 1, and each feature is displaced as a whole.
    """
    line = np.stack([np.ones_like(at_m), at_m, np.where(at_m > stop_m, 1.0, 0.0)], axis=1)
    bump = np.zeros(at_m.size)
    bump[1] = 1.0
    rest = bump - line @ np.linalg.lstsq(line, bump, rcond=None)[0]
    nearest = np.argmin(np.abs(x[:, None] - at_m[None, :]), axis=1)
    return np.asarray((rest / np.abs(rest).max())[nearest])
