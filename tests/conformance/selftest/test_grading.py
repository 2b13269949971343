"""A limit holds if the truth is near zero, 1.5 times it fails and 0.67 times it passes."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.measures import iri_trace
from floatref_conformance.checks.stretches import stretch
from floatref_conformance.classes import DeviceClass
from floatref_conformance.selftest import put_in
from floatref_conformance.selftest.grading import (
    Graded,
    Limit,
    Roads,
    Situation,
    find_ungraded,
    grade,
)

SOUND = Limit("toy", "IRI error", DeviceClass.NOMINAL, 0.0, 1.5, 0.67, (0.5, "other"))


def test_a_limit_that_holds_has_no_faults():
    assert SOUND.faults == ()


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"truth_reading": 0.3}, "the truth itself"),
        ({"too_much": 0.99}, "1.5 times the limit passes"),
        ({"allowed": 1.01}, "0.67 times the limit fails"),
        ({"too_much": 1.8}, "1.5 times the limit reads 1.80"),
        ({"allowed": 0.4}, "0.67 times the limit reads 0.40"),
        ({"beside": (1.1, "other")}, "0.67 times the limit fails other"),
        ({"too_much": float("nan")}, "1.5 times the limit passes"),
    ],
)
def test_each_fault_is_told(changes, part):
    assert any(part in fault for fault in replace(SOUND, **changes).faults)


def test_a_limit_of_what_the_filter_does_may_be_used_by_the_truth():
    assert replace(SOUND, truth_reading=0.6, is_error=False).faults == ()


def test_a_limit_that_others_imply_stands_alone():
    assert replace(SOUND, beside=(3.0, "other"), alone=False).faults == ()


@pytest.fixture
def graded(toy_check, monkeypatch):
    """Return a function that grades the toy check's quantity by errors ``off`` times too large."""
    monkeypatch.setattr("floatref_conformance.selftest.grading.make_perfect", lambda t: t.truth)

    def run(check, off=1.0):
        def put(amount):
            def spoil(profile, taken, label):
                rectified = np.abs(iri_trace(stretch(profile, "left", 10.0, 50.0), 0.05))
                share = off * amount / rectified.mean()
                return put_in.make_higher(share)(profile, taken, label)

            return spoil

        situation = Situation(check, check.simplest, (Graded(("IRI error",), put),))
        return list(grade(situation, Roads()))

    return run


def test_every_class_is_graded(graded, toy_check):
    limits = graded(toy_check())
    assert [limit.device_class for limit in limits] == list(DeviceClass)
    for limit in limits:
        assert limit.faults == ()
        assert limit.too_much == pytest.approx(1.5, rel=1e-3)


def test_a_measure_that_reads_too_much_is_found(graded, toy_check):
    assert all(limit.faults for limit in graded(toy_check(skew=0.05)))


def test_a_limit_that_is_set_too_high_is_found(graded, toy_check):
    assert all(limit.faults for limit in graded(toy_check(), off=0.5))


def test_published_limits_without_a_graded_error_are_named(toy_check):
    words = {"IRI error": dict.fromkeys(DeviceClass, "not limited")}
    words["IRI error"][DeviceClass.NOMINAL] = "0.1 m/km"
    check = toy_check(limits={**words, "place": dict.fromkeys(DeviceClass, "1 m")})
    missing = find_ungraded(check, [SOUND])
    assert missing == tuple(f"toy: place, class {c}" for c in DeviceClass)


def test_an_error_is_judged_once_on_each_side_of_each_limit(toy_check, graded, monkeypatch):
    judged, check = [], toy_check()
    real = toy_check.judge

    def judge(self, case, bench):
        judged.append(case)
        return real(self, case, bench)

    monkeypatch.setattr(toy_check, "judge", judge)
    assert len(graded(check)) == len(DeviceClass)
    assert judged == [check.simplest] * (1 + 2 * len(DeviceClass))
