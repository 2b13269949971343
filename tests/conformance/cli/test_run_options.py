"""What the options of `conformance run` change: class, time, waivers, and kept cases."""

import json

import pytest

from floatref_conformance.case_files import read_cases
from floatref_conformance.classes import DeviceClass
from floatref_conformance.cli.options import class_of
from floatref_conformance.cli.run import RECOMMENDED
from floatref_conformance.devices import builtin
from floatref_conformance.plugins import load_registry
from floatref_conformance.proving_ground.cache import cache_folder


def report_in(folder):
    return json.loads((folder / "report.json").read_text(encoding="utf-8"))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("device", "asked", "decisive", "code"),
    [
        ("good", (), "nominal", 4),
        ("low", (), "adequate", 1),
        ("low", ("--class", "nominal"), "nominal", 4),
        ("good", ("--class", "reference"), "reference", 4),
    ],
)
def test_the_class_is_the_one_asked_for_else_the_one_claimed_else_nominal(
    run_toy, tmp_path, device, asked, decisive, code
):
    answer = run_toy(device, *asked, "--effort", "certification", "--report", tmp_path)
    assert answer.exit_code == code
    assert f"(class {decisive}, " in answer.stdout
    assert report_in(tmp_path)["class"] == decisive


def test_what_a_built_in_claims_is_fixed_and_nominal_unless_it_says_more(monkeypatch):
    monkeypatch.setitem(builtin.CLAIMS, "temporal-basic", DeviceClass.ADEQUATE)
    claimed = {
        name: class_of(load_registry().device(f"builtin:{name}"), None)
        for name in ("temporal-basic", "spatial-basic")
    }
    assert list(claimed.values()) == [DeviceClass.ADEQUATE, DeviceClass.NOMINAL]


def test_the_device_by_default_is_a_built_in_that_claims_a_class():
    device = load_registry().device(RECOMMENDED)
    assert device.pipeline in builtin.CLAIMS
    assert class_of(device, None) is builtin.CLAIMS[device.pipeline]


@pytest.mark.slow
@pytest.mark.parametrize(("words", "limit"), [((), None), (("--device-timeout", 2.5), 2.5)])
def test_the_time_for_a_recording_goes_to_a_device_that_has_one(run_toy, devices, words, limit):
    run_toy("low", *words)
    assert devices["low"].timeout_s == limit
    run_toy("good", *words)
    assert not hasattr(devices["good"], "timeout_s")


@pytest.fixture
def waive(tmp_path):
    """Return a function that writes a file of waivers and returns the words that name it."""

    def make(text):
        path = tmp_path / "known.txt"
        path.write_text(text, encoding="utf-8")
        return "--waive", path

    return make


@pytest.mark.slow
def test_a_waived_failure_is_incomplete_and_the_report_says_waived(run_toy, waive, tmp_path):
    answer = run_toy("bad", *waive("# ours\ntoy halves # since May\n"), "--report", tmp_path)
    assert answer.exit_code == 4
    assert "INCOMPLETE" in answer.stdout
    assert "halves" in answer.stdout
    report = report_in(tmp_path)
    (toy,) = (c for c in report["checks"] if c["id"] == "toy")
    assert (report["verdict"], toy["outcome"]) == ("INCOMPLETE", "waived")
    assert report["class_reached"] is None
    assert toy["worst"]["value"] > toy["worst"]["limit"]
    assert len(read_cases(tmp_path)) == 1


@pytest.mark.slow
def test_a_waiver_covers_no_other_check(call, waive):
    words = ("run", "--device", "fake:bad", "--check", "toy", "--check", "second")
    answer = call(*words, *waive("toy halves"))
    assert answer.exit_code == 1
    assert answer.stdout.rstrip().endswith("--check second")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("toy x", "toy: did not fail: nothing to waive"),
        ("stop x", "stop: was not run"),
    ],
)
def test_a_waiver_of_no_use_is_exit_2(run_toy, waive, text, said):
    answer = run_toy("good", *waive(text))
    assert answer.exit_code == 2
    assert said in answer.stderr
    assert "known.txt" in answer.stderr


def test_an_unusable_waiver_is_told_before_anything_runs(run_toy, waive, devices):
    answer = run_toy("good", *waive("jumping later"))
    assert answer.exit_code == 2
    assert devices["good"].seen == []


@pytest.mark.slow
def test_a_kept_case_that_still_fails_makes_a_pass_a_failure(run_toy, keep, tmp_path):
    assert run_toy("clipping", "--report", tmp_path).exit_code == 4
    kept = keep(tmp_path)
    answer = run_toy("clipping", "--report", tmp_path)
    assert answer.exit_code == 1
    report = report_in(tmp_path)
    assert [c["outcome"] for c in report["checks"] if c["id"] == "toy"] == ["pass"]
    (replayed,) = report["replayed"]
    assert (replayed["file"], replayed["outcome"]) == ("toy-1.json", "fail")
    assert replayed["value"] > replayed["limit"]
    assert "toy-1.json" in answer.stdout
    kept.unlink()
    assert run_toy("clipping", "--report", tmp_path).exit_code == 4


@pytest.mark.slow
def test_what_one_run_keeps_the_next_one_runs_again(run_toy, tmp_path):
    run_toy("bad", "--report", tmp_path)
    (kept,) = read_cases(tmp_path)
    answer = run_toy("good", "--report", tmp_path, "--seed", 7)
    assert answer.exit_code == 4
    replayed = report_in(tmp_path)["replayed"]
    assert [(r["file"], r["outcome"]) for r in replayed] == [(kept.file, "pass")]


@pytest.mark.parametrize("edition", ["1999.1", None])
def test_a_kept_case_of_another_edition_is_listed_as_skipped_with_its_reason(
    run_toy, keep, tmp_path, devices, edition
):
    keep(tmp_path, edition=edition, seed=77)
    answer = run_toy("good", "--report", tmp_path)
    assert answer.exit_code == 4
    (replayed,) = report_in(tmp_path)["replayed"]
    assert (replayed["check"], replayed["outcome"]) == ("toy", "skip")
    assert "edition" in replayed["reason"]
    assert replayed["reason"] in answer.stdout


@pytest.mark.parametrize("text", ["{", "[]", '{"format": "floatref-case/9"}'])
def test_a_kept_case_that_is_unreadable_is_exit_2_before_anything_runs(
    run_toy, tmp_path, devices, text
):
    (tmp_path / "cases").mkdir()
    (tmp_path / "cases" / "odd.json").write_text(text)
    answer = run_toy("good", "--report", tmp_path)
    assert answer.exit_code == 2
    assert "odd.json" in answer.stderr
    assert devices["good"].seen == []


def test_a_program_gets_what_env_names_and_the_place_of_the_truth_is_said(
    run_toy, devices, monkeypatch
):
    monkeypatch.setenv("OF_THE_DEVICE", "its licence")
    devices["good"].variables = ()
    answer = run_toy("good", "--env", "OF_THE_DEVICE")
    assert devices["good"].variables == ("OF_THE_DEVICE",)
    note = f"Note: the truth is in {cache_folder()}, which a device of this user could read; "
    assert note in answer.stderr


def test_of_a_device_that_is_no_program_nothing_is_said_about_the_truth(run_toy):
    assert "the truth is in" not in run_toy("good").output
