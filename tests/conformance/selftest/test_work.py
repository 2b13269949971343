"""Every limit of the suite: what is 1.5 times as much fails, what is 0.67 times as much passes."""

import pytest

from floatref_conformance.plugins import load_registry
from floatref_conformance.selftest.work import grade_all, list_ungraded

CHECKS = load_registry().checks
LONG = {"invariance", "braking", "stop", "throttle", "low-speed", "near-stop"}


@pytest.mark.slow
@pytest.mark.parametrize(
    "id_", [pytest.param(i, marks=pytest.mark.slow if i in LONG else ()) for i in CHECKS]
)
def test_every_limit_of_the_check_holds_on_both_sides(id_):
    check = CHECKS[id_]
    limits = tuple(grade_all([check]))
    assert [(x.quantity, x.device_class, x.faults) for x in limits if x.faults] == []
    assert list_ungraded([check], limits) == ()


def test_the_limits_of_other_checks_are_known_to_have_no_grader(toy_check):
    check = toy_check(limits={"IRI error": {"nominal": "0.1 m/km"}})
    assert list_ungraded([check], tuple(grade_all([check]))) == ("toy: IRI error, class nominal",)
