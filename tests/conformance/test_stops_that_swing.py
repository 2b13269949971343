"""A soft van stops in a gutter: whole steps of its fit swing about the answer, halves do not."""

import pytest

import floatref
from floatref.estimators.road_slope import gauss_newton, levelled
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.table.families.conditions import STOPS
from floatref_conformance.table.families.family_settings import draw_drive

pytestmark = pytest.mark.slow
GUTTER, SEED, NUMBER = STOPS[2], 777, 27


def changes(monkeypatch, whole_steps):
    """Return the largest changes of the pitch by the last passes of the fits of the stop."""
    found = []

    def fit(stretch):
        found.append(gauss_newton.fit(stretch))
        return found[-1]

    monkeypatch.setattr(gauss_newton, "WHOLE_STEPS", whole_steps)
    monkeypatch.setattr(levelled, "fit", fit)
    recording = simulate(draw_drive(SEED, GUTTER, NUMBER, frozenset())).recording
    floatref.process(recording, "road-prior-smoother")
    return [each.changed_rad for each in found]


def test_half_steps_settle_what_whole_steps_do_not(monkeypatch):
    assert max(changes(monkeypatch, gauss_newton.PASSES)) >= levelled.UNSETTLED_RAD
    assert max(changes(monkeypatch, 10)) < gauss_newton.SETTLED_RAD
