"""A device on its way through the checks: hangs, faults and skips."""

from floatref_conformance.checks.case import Case
from floatref_conformance.classes import Effort
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped
from floatref_conformance.events import SearchStarted, ShrinkStarted
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.trial import MOST_HANGS
from floatref_conformance.verdict import Outcome, Verdict


def test_a_device_that_hangs_is_given_up_and_every_check_fails(plan, result_of, raising, toy_check):
    device = raising(DeviceHung("no answer within 1 s"))
    checks = [toy_check(id=id_, count=5) for id_ in ("one", "two", "three")]
    result = result_of(plan(device, *checks))
    assert len(device.seen) == MOST_HANGS == 3
    assert result.verdict is Verdict.FAIL
    assert [c.outcome for c in result.checks] == 3 * [Outcome.ERROR]
    reasons = [c.reason for c in result.checks]
    assert reasons[0] == "one-1: no answer within 1 s"
    assert reasons[1:] == 2 * ["not asked: the device hung 3 times"]
    assert device.closed == 1


def test_hangs_are_counted_over_all_checks(plan, result_of, raising, toy_check):
    device = raising(DeviceHung("no answer"), lambda number: number % 2 == 0)
    checks = [toy_check(id=f"check-{n}") for n in range(4)]
    result = result_of(plan(device, *checks, searching=False))
    assert len(device.seen) == 2 * MOST_HANGS
    assert "not asked" in result.checks[3].reason
    assert not any("not asked" in check.reason for check in result.checks[:3])


def test_a_device_that_hung_is_not_asked_for_something_simpler(plan, events_of, raising):
    device = raising(DeviceHung("no answer"), lambda number: number == 1)
    events, result = events_of(plan(device, seed=1))
    assert not any(isinstance(e, (SearchStarted, ShrinkStarted)) for e in events)
    assert result.checks[0].counterexample["parameters"]["scenario"] == {"seed": 100}
    assert len(device.seen) == 2


def test_a_fault_counts_more_than_any_value_and_each_keeps_its_case(plan, result_of, fake_device):
    class Half(fake_device):
        def run(self, recording, profile):
            super().run(recording, profile)
            if len(self.seen) == 1:
                raise DeviceError("out of paper")

    (check,) = result_of(plan(Half(), searching=False)).checks
    assert check.outcome is Outcome.ERROR
    assert check.reason == "toy-1: out of paper"
    assert check.counterexample["reason"] == "out of paper"
    assert check.worst_case == "toy-2"
    assert check.class_reached is None


def test_a_recording_that_is_skipped_makes_the_run_incomplete(plan, events_of, raising):
    device = raising(DeviceSkipped("too fast for me"), lambda number: number == 2)
    events, result = events_of(plan(device))
    assert result.verdict is Verdict.INCOMPLETE
    (check,) = result.checks
    assert check.outcome is Outcome.SKIP
    assert check.reason == "toy-2: too fast for me"
    assert check.cases == 2
    assert not any(isinstance(e, SearchStarted) for e in events)


def test_a_skip_hides_no_failure(plan, result_of, raising, fake_device):
    device = raising(DeviceSkipped("no"), lambda number: number == 2)
    device.spoil = lambda tracks: {name: 0.0 * z for name, z in tracks.items()}
    assert result_of(plan(device)).checks[0].outcome is Outcome.FAIL


def test_a_case_may_have_several_runs_and_the_pictures_show_them_all(
    plan, result_of, halving, toy_check
):
    class Thrice(toy_check):
        def cases(self, seed, effort):
            return (Case(self.id, Scenario(), {"runs": 3}),)

        @property
        def simplest(self):
            return self.cases(0, Effort.QUICK)[0]

    (check,) = result_of(plan(halving, Thrice())).checks
    assert [one.label for one in check.passes] == ["run 1", "run 2", "run 3"]
