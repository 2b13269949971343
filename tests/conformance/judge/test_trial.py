"""A device on its way through the checks: hangs, faults and skips."""

import pytest

from floatref.errors import InputError
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.classes import Effort
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped
from floatref_conformance.judge.events import SearchStarted, ShrinkStarted
from floatref_conformance.judge.trial import MOST_HANGS
from floatref_conformance.proving_ground.scenario import Scenario


def test_a_device_that_hangs_is_given_up_and_every_check_fails(plan, result_of, raising, toy_check):
    device = raising(DeviceHung("no answer within 1 s"))
    checks = [toy_check(id=id_, count=5) for id_ in ("one", "two", "three")]
    result = result_of(plan(device, *checks))
    assert len(device.seen) == MOST_HANGS == 3
    assert result.verdict is Verdict.FAIL
    assert [c.outcome for c in result.checks] == 3 * [Outcome.ERROR]
    reasons = [c.reason for c in result.checks]
    assert reasons[0] == "one-1: no answer within 1 s"
    assert reasons[1:] == 2 * ["not run: the device hung 3 times"]
    assert device.closed == 1


def test_hangs_are_counted_over_all_checks(plan, result_of, raising, toy_check):
    device = raising(DeviceHung("no answer"), lambda number: number % 2 == 0)
    checks = [toy_check(id=f"check-{n}") for n in range(4)]
    result = result_of(plan(device, *checks, searching=False))
    assert len(device.seen) == 2 * MOST_HANGS
    assert "not run" in result.checks[3].reason
    assert not any("not run" in check.reason for check in result.checks[:3])


def test_a_device_that_hung_is_not_asked_for_something_simpler(plan, events_of, raising):
    device = raising(DeviceHung("no answer"), lambda number: number == 1)
    events, result = events_of(plan(device, seed=1))
    assert not any(isinstance(e, (SearchStarted, ShrinkStarted)) for e in events)
    numbers = result.checks[0].counterexample["parameters"]
    assert numbers == Case("toy", Scenario(seed=100)).parameters
    assert len(device.seen) == 2


def test_a_device_that_is_wrong_now_and_then_is_told_from_one_that_always_is(
    plan, result_of, fake_device, halving
):
    """It is wrong once, in the first case, and so in none that is simpler."""

    class Moody(fake_device):
        def run(self, recording, profile):
            self.spoil = halving.spoil if not self.seen else fake_device().spoil
            super().run(recording, profile)

    (check,) = result_of(plan(Moody(), seed=1)).checks
    assert check.outcome is Outcome.FAIL
    said = "passed when run again: the device does not fail it every time"
    assert check.reason.endswith(f"; the simplest case {said}")
    assert check.counterexample["reason"].endswith(f"; {said}")
    (steady,) = result_of(plan(halving, seed=1)).checks
    assert "run again" not in steady.reason + steady.counterexample["reason"]


def test_a_simplest_case_that_the_device_skips_when_run_again_says_so(plan, result_of, raising):
    device = raising(DeviceSkipped("too hot"), lambda number: number > 2)
    device.spoil = lambda tracks: {name: 0.0 * z for name, z in tracks.items()}
    (check,) = result_of(plan(device, searching=False)).checks
    assert "skipped when run again" in check.counterexample["reason"]


def test_a_fault_counts_more_than_any_value_and_each_keeps_its_case(plan, result_of, fake_device):
    class Half(fake_device):
        def run(self, recording, profile):
            super().run(recording, profile)
            if len(self.seen) == 1:
                raise DeviceError("out of paper")

    (check,) = result_of(plan(Half(), searching=False)).checks
    assert check.outcome is Outcome.ERROR
    assert check.reason.startswith("toy-1: out of paper; ")
    assert check.counterexample["reason"].startswith("out of paper; ")
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


@pytest.mark.parametrize("stretches", [((150.0, 170.0), (10, 50)), ()])
def test_a_failure_keeps_what_the_check_scores_of_its_simplest_case(
    plan, result_of, halving, toy_check, stretches
):
    class Telling(toy_check):
        def list_scored(self, case):
            return stretches if case.scenario.seed == 0 else ((1.0, 2.0),)

    assert result_of(plan(halving, Telling())).checks[0].scored_m == stretches
    assert (
        result_of(plan(halving, Telling(), seed=1, searching=False)).checks[0].scored_m != stretches
    )


@pytest.mark.parametrize(
    "answer", [InputError("no room"), KeyError("x"), SystemExit(0), 5, ((1,),)]
)
def test_a_check_that_fails_to_say_what_it_scores_ends_no_run(
    plan, result_of, halving, toy_check, answer
):
    class Silent(toy_check):
        def list_scored(self, case):
            if isinstance(answer, BaseException):
                raise answer
            return answer

    (check,) = result_of(plan(halving, Silent())).checks
    assert check.outcome is Outcome.FAIL
    assert check.scored_m == ()


def test_a_skip_hides_no_failure(plan, result_of, raising, fake_device):
    device = raising(DeviceSkipped("no"), lambda number: number == 2)
    device.spoil = lambda tracks: {name: 0.0 * z for name, z in tracks.items()}
    assert result_of(plan(device)).checks[0].outcome is Outcome.FAIL


def test_the_wheel_path_that_fails_the_simplest_case_is_told_not_that_of_the_worst(
    plan, result_of, fake_device
):
    class OneSided(fake_device):
        """Is wrong on the left in its first case and, less so, on the right in all others."""

        def run(self, recording, profile):
            wrong, factor = ("right", 0.5) if self.seen else ("left", 0.0)
            self.spoil = lambda t: {n: z * (factor if n == wrong else 1.0) for n, z in t.items()}
            super().run(recording, profile)

    (check,) = result_of(plan(OneSided(), seed=1)).checks
    assert check.worst.track == "left"
    assert check.worst_track == "right"


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
