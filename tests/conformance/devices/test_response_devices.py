"""Devices of architecture response: no height is theirs, and no check that asks for one."""

import json

import pytest
from click.testing import CliRunner

from floatref.files import read_recording
from floatref_conformance.checks.verdict import Outcome, Verdict
from floatref_conformance.classes import Effort
from floatref_conformance.cli.main import main
from floatref_conformance.devices.interface import CAPABILITIES, Description
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.exporting import export
from floatref_conformance.judge.bench import DeviceBench
from floatref_conformance.judge.replaying import replay
from floatref_conformance.judge.runner import run
from floatref_conformance.plugins import load_registry
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.render.html import HtmlReport
from floatref_conformance.render.junit import JUnitReport
from floatref_conformance.render.report import JsonReport

SAID = Description("fake", "1", "response", ("response",))
REASON = "needs a height sensor, which architecture response does not have"
NEEDY = frozenset({"height"})


@pytest.fixture
def wheels(fake_device):
    """Return a device without a height sensor."""
    return fake_device(architecture="response", capabilities=("response",))


def names_in(recording):
    return {channel.id.name for channel in recording.channels}


def test_a_run_shows_it_wheels_vehicle_and_no_height(plan, result_of, wheels):
    assert result_of(plan(wheels)).verdict is Verdict.PASS
    for *_, given in wheels.seen:
        assert "unsprung_displacement" in names_in(given)
        assert "height" not in names_in(given)
        assert given.setup.vehicle.model == "quarter-car"


def test_a_temporal_device_with_the_capability_sees_both(plan, result_of, fake_device):
    device = fake_device(capabilities=("response",))
    assert result_of(plan(device)).verdict is Verdict.PASS
    for *_, given in device.seen:
        assert {"height", "unsprung_displacement"} <= names_in(given)
        assert given.setup.vehicle is not None


def test_a_replay_shows_it_no_height_either(toy_check, wheels):
    check = toy_check()
    assert replay(wheels, check, check.simplest, find_edition()).measurements
    assert "height" not in names_in(wheels.seen[0][3])
    needy = toy_check(needs=NEEDY)
    assert replay(wheels, needy, needy.simplest, find_edition()).skipped == REASON
    assert len(wheels.seen) == 1


def test_an_export_holds_no_height_and_leaves_out_what_needs_one(toy_check, tmp_path):
    checks = (toy_check(), toy_check(id="needy", needs=NEEDY, count=5))
    folder = tmp_path / "out"
    folder.mkdir()
    (tmp_path / "both").mkdir()
    assert export(checks, folder, SAID, 0, Effort.QUICK, lambda *_: None) == 2
    for path in folder.glob("*/recording.json"):
        assert not list(path.parent.glob("*height*"))
        assert "unsprung_displacement" in names_in(read_recording(path))
    both = Description("both", "1", "temporal", ("response",))
    assert export(checks, tmp_path / "both", both, 0, Effort.QUICK, lambda *_: None) == 5


@pytest.mark.parametrize("capabilities", [("response",), ("imu", "gnss", "response")])
def test_what_a_check_has_simulated_lacks_what_the_device_may_not_have(wheels, capabilities):
    scenario = Scenario(length_m=20.0, rate_hz=1000.0, tracks=("left",))
    for architecture, height in (("response", False), ("temporal", True)):
        said = Description("fake", "1", architecture, capabilities)
        found = names_in(DeviceBench(wheels, said).simulate(scenario).recording)
        assert ("height" in found) == height
        assert bool(found & CAPABILITIES["gnss"]) == ("gnss" in capabilities)


def test_it_owes_the_wheel_paths_whose_wheels_it_sees(plan, result_of, wheels):
    wheels.spoil = lambda tracks: {"left": tracks["left"]}
    (check,) = result_of(plan(wheels)).checks
    assert check.outcome is Outcome.ERROR
    assert "track right: not delivered, though it has a channel unsprung_s" in check.reason


def test_what_needs_a_height_leaves_the_verdict_alone(plan, result_of, fake_device, toy_check):
    needy = toy_check(id="needy", needs=NEEDY, skew=5.0)
    for spoil, verdict in ((1.0, Verdict.PASS), (0.5, Verdict.FAIL)):
        made = [
            fake_device(
                lambda tracks, by=spoil: {t: by * z for t, z in tracks.items()},
                architecture="response",
                capabilities=("response",),
            )
            for _ in range(2)
        ]
        alone = result_of(plan(made[0], toy_check(), searching=False))
        result = result_of(plan(made[1], toy_check(), needy, searching=False))
        assert alone.verdict is result.verdict is verdict
        assert result.checks[1].outcome is Outcome.NOT_APPLICABLE
        assert result.checks[1].reason == REASON
        assert len(made[0].seen) == len(made[1].seen)
    assert result_of(plan(made[0], needy)).verdict is Verdict.INCOMPLETE


def test_every_report_says_that_a_height_sensor_is_needed(plan, wheels, toy_check, tmp_path):
    needy = toy_check(id="needy", needs=NEEDY | {"gnss"})
    writers = [kind.into(tmp_path) for kind in (JsonReport, HtmlReport, JUnitReport)]
    run(plan(wheels, toy_check(), needy), lambda e: [w.handle(e) for w in writers])
    for name in ("report.json", "report.html", "junit.xml"):
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert f"needs gnss, which the device does not declare; {REASON}" in text
    checks = json.loads((tmp_path / "report.json").read_text())["checks"]
    assert {c["id"]: c["outcome"] for c in checks} == {"toy": "pass", "needy": "not-applicable"}
    assert "response, no height sensor" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_one_that_does_not_declare_its_channels_is_at_fault(plan, result_of, fake_device):
    device = fake_device(architecture="response")
    result = result_of(plan(device, searching=False))
    assert result.verdict is Verdict.FAIL
    assert "architecture response without capability response" in result.checks[0].reason
    assert device.seen == []
    with pytest.raises(DeviceError, match="declare it"):
        Description.of(device.describe())


def test_the_checks_of_a_standing_vehicle_alone_need_a_height_sensor_and_say_so():
    needs = {id_: check.needs for id_, check in load_registry().checks.items()}
    assert {id_ for id_, needed in needs.items() if needed} == {"quiescent", "bounce"}
    called = CliRunner().invoke
    assert "Needs: a height sensor" in called(main, ["explain", "bounce"]).stdout
    assert "Needs" not in called(main, ["explain", "stop"]).stdout
    listed = " ".join(called(main, ["list"]).stdout.split())
    assert listed.count("; needs a height sensor") == 2
    assert called(main, ["list", "--json"]).stdout.count('"height"') == 2


def test_an_export_for_the_architecture_needs_the_capability(tmp_path):
    words = ["export", "--out", str(tmp_path / "out"), "--architecture", "response"]
    answer = CliRunner().invoke(main, words)
    assert answer.exit_code == 2
    assert answer.stderr.strip().splitlines()[-1].endswith("add --capability response")
    assert not (tmp_path / "out").exists()
