"""The run: what a device sees, and what each thing it can do wrong leads to."""

import json
import sys

import numpy as np
import pytest

from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import SuiteError
from floatref_conformance.events import RunFinished
from floatref_conformance.render.report import as_json
from floatref_conformance.runner import run
from floatref_conformance.verdict import Outcome, Verdict


def result_of(plan):
    last = list(run(plan))[-1]
    assert isinstance(last, RunFinished)
    return last.result


def scaled(gain):
    return lambda tracks: {name: gain * z for name, z in tracks.items()}


def test_a_device_that_delivers_the_road_passes_and_reaches_the_strictest_class(plan, fake_device):
    result = result_of(plan(fake_device()))
    assert result.verdict is Verdict.PASS
    assert result.class_reached is DeviceClass.REFERENCE
    assert result.checks[0].counterexample is None


def test_the_events_come_in_order_and_count_the_cases(plan, fake_device, toy_check):
    names = [type(e).__name__ for e in run(plan(fake_device(), toy_check(count=2)))]
    assert names == [
        "RunStarted", "CheckStarted", "CaseFinished", "CaseFinished", "CheckFinished",
        "RunFinished",
    ]  # fmt: skip


def test_a_device_beyond_the_limit_fails_with_value_limit_and_case(plan, fake_device):
    result = result_of(plan(fake_device(scaled(0.5))))
    check = result.checks[0]
    assert result.verdict is Verdict.FAIL
    assert check.outcome is Outcome.FAIL
    assert check.worst.value > check.worst.limits[DeviceClass.NOMINAL]
    assert check.class_reached is None
    assert check.counterexample["parameters"]["seed"] in (0, 1)
    assert "limit 0.1 m/km" in check.reason


def test_the_class_decides_and_an_easier_class_may_be_reached(plan, fake_device):
    device = fake_device(scaled(0.99))
    value = result_of(plan(device)).checks[0].worst.value
    assert 0.01 < value < 0.05
    strict = result_of(plan(device, device_class=DeviceClass.REFERENCE))
    assert strict.verdict is Verdict.FAIL
    assert strict.class_reached is DeviceClass.ADEQUATE
    assert result_of(plan(device, device_class=DeviceClass.ADEQUATE)).verdict is Verdict.PASS


@pytest.mark.parametrize(
    ("capabilities", "more"),
    [
        ((), set()),
        (("imu",), {"longitudinal_specific_force", "pitch_rate"}),
        (("gnss",), {"gnss_height"}),
    ],
)
def test_a_device_sees_nominal_and_declared_channels_alone(plan, fake_device, capabilities, more):
    device = fake_device(capabilities=capabilities)
    list(run(plan(device)))
    seen = {c.id.name for c in device.seen[0][3].channels}
    assert seen == {"vertical_specific_force", "height", "distance"} | more


def test_paths_are_neutral_hold_no_truth_and_are_new_in_every_case(plan, fake_device):
    device = fake_device()
    list(run(plan(device)))
    paths = [recording for recording, *_ in device.seen]
    assert len(set(paths)) == len(paths) == 2
    for recording, profile, existed, given in device.seen:
        assert not existed
        assert recording.name == "recording.json"
        assert profile.parent == recording.parent.parent
        assert not profile.parent.exists()
        assert "toy" not in str(recording)
        assert not any(word in str(recording) for word in ("truth", "seed", "case"))
        assert (given.vendor, given.model) == ("", "")


def test_truth_is_nowhere_under_the_paths_that_a_device_gets(plan, fake_device):
    files = []

    class Nosy(fake_device):
        def run(self, recording, profile):
            files.extend(p.name for p in profile.parent.rglob("*") if p.is_file())
            super().run(recording, profile)

    list(run(plan(Nosy())))
    channels = {"vertical_specific_force", "height", "distance"}
    assert {name.removesuffix(".f64").split(".")[-1] for name in files} - channels == {"json"}


class Quitter:
    def describe(self):
        return {"name": "q", "version": "1", "architecture": "spatial", "capabilities": []}

    def run(self, recording, profile):
        sys.exit(0)


class Raiser(Quitter):
    def run(self, recording, profile):
        raise ZeroDivisionError("no\nspeed")


class Silent(Quitter):
    def run(self, recording, profile):
        pass


class Babbler(Quitter):
    text = "{not json"

    def run(self, recording, profile):
        profile.mkdir()
        (profile / "profile.json").write_text(self.text)


class Stranger(Babbler):
    text = json.dumps({"format": "profile-of-ours/9", "interval_m": 0.05, "tracks": []})


class FileMaker(Quitter):
    def run(self, recording, profile):
        profile.write_text("distance_m,left_elevation_m\n")


@pytest.mark.parametrize(
    ("device", "words"),
    [
        (Quitter, "SystemExit"),
        (Raiser, "ZeroDivisionError: no speed"),
        (Silent, "no profile directory"),
        (Babbler, "unusable profile"),
        (Stranger, "unusable profile"),
        (FileMaker, "no profile directory"),
    ],
)
def test_a_device_that_crashes_or_babbles_is_an_error_and_fails(plan, device, words):
    result = result_of(plan(device()))
    assert result.verdict is Verdict.FAIL
    assert result.checks[0].outcome is Outcome.ERROR
    assert words in result.checks[0].reason
    assert "\n" not in result.checks[0].reason
    assert result.class_reached is None


def without_right(tracks):
    return {"left": tracks["left"]}


def cut(tracks):
    return {name: z[:-10] for name, z in tracks.items()}


def longer(tracks):
    return {name: np.append(z, np.zeros(10)) for name, z in tracks.items()}


def holed(tracks):
    z = tracks["left"].copy()
    z[500] = np.nan
    return {**tracks, "left": z}


def absurd(tracks):
    return {name: 1e300 * (1 + z) for name, z in tracks.items()}


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (without_right, "track right: not delivered"),
        (cut, "the recording goes from 0.000 m to 59.980 m"),
        (longer, "the recording goes from"),
        (holed, "track left: 1 of 801 points without elevation from 10.0 m to 50.0 m"),
        (absurd, "elevation beyond 1e+06 m"),
    ],
)
def test_an_incomplete_profile_is_an_error_that_names_what_is_missing(
    plan, fake_device, spoil, words
):
    result = result_of(plan(fake_device(spoil)))
    assert result.verdict is Verdict.FAIL
    assert result.checks[0].outcome is Outcome.ERROR
    assert words in result.checks[0].reason


def test_a_missing_elevation_where_nothing_counts_is_no_error(plan, fake_device):
    def spoil(tracks):
        return {name: np.where(np.arange(z.size) < 10, np.nan, z) for name, z in tracks.items()}

    assert result_of(plan(fake_device(spoil))).verdict is Verdict.PASS


def test_a_device_may_choose_its_interval_as_long_as_it_carries_the_iri(plan, fake_device):
    assert result_of(plan(fake_device(interval_m=0.04))).verdict is Verdict.PASS
    wide = result_of(plan(fake_device(interval_m=0.3)))
    assert "interval_m is 0.3" in wide.checks[0].reason


@pytest.mark.parametrize(
    "said",
    [
        "a fine device",
        {"name": "x"},
        {"name": "x", "version": "1", "architecture": "magic", "capabilities": []},
        {"name": "x", "version": "1", "architecture": "spatial", "capabilities": ["truth"]},
        {"name": "x", "version": "1", "architecture": "spatial", "capabilities": [[]]},
        {"name": "x", "version": "1", "architecture": "spatial"},
    ],
)
def test_a_device_that_describes_itself_wrongly_is_an_error(plan, fake_device, said):
    device = fake_device(said=said)
    result = result_of(plan(device))
    assert result.verdict is Verdict.FAIL
    assert result.checks[0].outcome is Outcome.ERROR
    assert device.seen == []


def test_a_check_that_needs_an_undeclared_capability_leaves_the_verdict_alone(
    plan, fake_device, toy_check
):
    needy = toy_check(id="needy", needs=frozenset({"gnss"}))
    result = result_of(plan(fake_device(), toy_check(), needy))
    outcomes = {c.id: c.outcome for c in result.checks}
    assert outcomes == {"toy": Outcome.PASS, "needy": Outcome.NOT_APPLICABLE}
    assert result.verdict is Verdict.PASS
    assert result_of(plan(fake_device(), needy)).verdict is Verdict.INCOMPLETE


def test_what_is_left_out_makes_a_pass_incomplete_but_not_a_failure(plan, fake_device):
    good = result_of(plan(fake_device(), left_out=("other",)))
    assert good.verdict is Verdict.INCOMPLETE
    assert good.class_reached is None
    assert {c.id: c.outcome for c in good.checks}["other"] is Outcome.SKIP
    bad = result_of(plan(fake_device(scaled(0.5)), left_out=("other",)))
    assert bad.verdict is Verdict.FAIL


def test_the_oracle_overrules_a_wrong_measure(plan, fake_device, toy_check):
    with pytest.raises(SuiteError, match=r"IRI is .* by the reference"):
        list(run(plan(fake_device(), toy_check(skew=0.01))))
    assert result_of(plan(fake_device(), toy_check(skew=1e-5))).verdict is Verdict.PASS


def test_an_error_of_the_suite_is_not_blamed_on_the_device(plan, fake_device, toy_check):
    class Broken(toy_check):
        def judge(self, case, profile, simulated):
            raise KeyError("left")

    with pytest.raises(SuiteError, match="KeyError"):
        list(run(plan(fake_device(), Broken())))


def test_the_same_seed_makes_the_same_report_and_another_seed_another(plan, fake_device):
    device = fake_device(scaled(0.5))
    reports = [as_json(result_of(plan(device, seed=seed))) for seed in (4, 4, 5)]
    assert json.dumps(reports[0]) == json.dumps(reports[1])
    assert reports[0]["checks"][0]["worst"] != reports[2]["checks"][0]["worst"]


def test_faults_reported_twice_are_the_same_text(plan):
    texts = [result_of(plan(Babbler())).checks[0].reason for _ in range(2)]
    assert texts[0] == texts[1]
