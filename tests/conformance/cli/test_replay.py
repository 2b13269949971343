"""`conformance replay`: one kept case again, its exit code and what it says."""

import json

import pytest

from floatref_conformance.case_files import read_cases
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import DeviceError


@pytest.fixture
def replay(call, keep, tmp_path):
    """Return a function that has a device judged by a kept case of a rough road."""

    def make(device, *words, **case):
        return call("replay", keep(tmp_path, **case), "--device", f"fake:{device}", *words)

    return make


@pytest.mark.parametrize(
    ("device", "code", "verdict", "said"),
    [
        ("good", 0, "PASS", "every limit is kept"),
        ("bad", 1, "FAIL", "limit 0.1 m/km"),
        ("clipping", 1, "FAIL", "limit 0.1 m/km"),
        ("broken", 1, "FAIL", "out of paper"),
        ("choosy", 4, "INCOMPLETE", "too fast for me"),
    ],
)
def test_the_exit_code_is_that_of_the_verdict(replay, devices, device, code, verdict, said):
    answer = replay(device)
    assert answer.exit_code == code, answer.output
    last = answer.stdout.splitlines()[-1]
    assert last.startswith(f"{verdict}: ")
    assert said in last
    assert last.endswith(f"(class nominal, device fake:{device})")
    assert len(devices[device].seen) == devices[device].closed == 1


@pytest.mark.parametrize(
    ("kept", "words", "decisive", "code"),
    [
        ("nominal", (), "nominal", 0),
        ("adequate", (), "adequate", 1),
        ("adequate", ("--class", "nominal"), "nominal", 0),
        ("nominal", ("--class", "adequate"), "adequate", 1),
    ],
)
def test_the_class_is_that_of_the_case_unless_another_is_asked_for(
    replay, kept, words, decisive, code
):
    answer = replay("low", *words, device_class=DeviceClass(kept))
    assert answer.exit_code == code
    assert f"(class {decisive}, device fake:low)" in answer.stdout


def test_the_numbers_of_the_case_and_all_that_is_measured_are_shown(replay):
    answer = replay("bad", seed=12)
    lines = answer.stdout.splitlines()
    assert lines[0].split(": ")[0] == "toy"
    assert "seed 12" in lines[0]
    assert "iri_m_per_km 6" in lines[0]
    for track in ("left", "right"):
        (row,) = (line for line in lines[1:-1] if track in line)
        assert "IRI error" in row
        assert row.rstrip().endswith("fails")
    assert "\x1b" not in answer.output


def test_a_case_that_needs_what_the_device_lacks_is_not_judged(replay, devices):
    answer = replay("bad", check="needy")
    assert answer.exit_code == 4
    assert "needs gnss" in answer.stdout
    assert devices["bad"].seen == []


def test_a_device_at_fault_when_it_is_to_stop_fails(replay, devices):
    def sticking():
        raise DeviceError("did not stop within 5 s")

    devices["good"].close = sticking
    answer = replay("good")
    assert answer.exit_code == 1
    assert "when it was stopped, the device did not stop within 5 s" in answer.stdout
    devices["broken"].close = sticking
    assert "out of paper" in replay("broken").stdout


def test_a_device_that_cannot_describe_itself_fails(replay, devices):
    devices["good"].said = "a fine device"
    answer = replay("good")
    assert answer.exit_code == 1
    assert "gives a description that is a str" in answer.stdout
    assert devices["good"].closed == 1


@pytest.mark.slow
def test_a_case_of_a_report_fails_alike_and_passes_when_the_device_is_mended(
    run_toy, call, tmp_path
):
    run_toy("bad", "--report", tmp_path, "--seed", 5)
    (kept,) = read_cases(tmp_path)
    path = tmp_path / "cases" / kept.file
    again = call("replay", path, "--device", "fake:bad")
    assert again.exit_code == 1
    assert json.loads(path.read_text())["reason"] in again.stdout
    assert call("replay", path, "--device", "fake:good").exit_code == 0


def test_the_device_gets_the_time_that_is_asked_for(replay, devices):
    replay("low", "--device-timeout", 2.5)
    assert devices["low"].timeout_s == 2.5


@pytest.mark.parametrize(
    ("device", "words", "case", "said"),
    [
        ("nobody", (), {}, "fake:nobody: unknown"),
        ("good", (), {"check": "jumping"}, "check jumping: unknown check"),
        ("good", (), {"check": "stop"}, "check stop: not built yet"),
        ("good", ("--class", "superb"), {}, "superb"),
        ("good", ("--device-timeout", "nan"), {}, "--device-timeout is nan"),
    ],
)
def test_wrong_usage_is_exit_2_in_one_line(replay, devices, device, words, case, said):
    answer = replay(device, *words, **case)
    assert answer.exit_code == 2
    assert said in answer.stderr
    assert "Traceback" not in answer.output
    assert devices["good"].seen == []


@pytest.mark.parametrize("edition", ["1999.1", None, 2026.1])
def test_a_case_of_another_edition_is_exit_2_and_named(replay, devices, edition, tmp_path):
    answer = replay("good", edition=edition)
    assert answer.exit_code == 2
    assert f"{tmp_path / 'cases' / 'toy-1.json'}: the case " in answer.stderr
    assert len(answer.stderr.splitlines()) == 1
    assert devices["good"].seen == []


@pytest.mark.parametrize("content", [None, "{", '{"format": "floatref-scenario/1"}'])
def test_what_is_no_case_is_exit_2_and_named(call, tmp_path, content):
    path = tmp_path / "case.json"
    if content is not None:
        path.write_text(content)
    answer = call("replay", path, "--device", "fake:good")
    assert answer.exit_code == 2
    assert f"{path}: " in answer.stderr
    assert len(answer.stderr.splitlines()) == 1


def test_numbers_that_make_no_drive_are_exit_2_and_the_file_is_named(
    replay, registry, toy_check, tmp_path
):
    class Driven(toy_check):
        def judge(self, case, bench):
            return bench.simulate(case.scenario)

    registry.checks["toy"] = Driven()
    answer = replay("good", manoeuvre="braking", event_speed_kmh=90.0)
    assert answer.exit_code == 2
    assert f"{tmp_path / 'cases' / 'toy-1.json'}: manoeuvre braking" in answer.stderr
