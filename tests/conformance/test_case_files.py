"""Cases as files: what is written is read back, and what is no case is refused by name."""

import json
import os
from dataclasses import fields, replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance import EDITION, EDITIONS
from floatref_conformance.case_files import document, name_of, read_case, read_cases
from floatref_conformance.checks.case import CHANNELS_BY_NEED, DEFAULT, Case
from floatref_conformance.checks.verdict import CheckResult, Outcome, RunResult
from floatref_conformance.classes import DeviceClass
from floatref_conformance.judge.events import RunFinished, RunStarted
from floatref_conformance.proving_ground.scenario import LIMITS, MANOEUVRES, ROADS, Scenario
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES
from floatref_conformance.render.cases import CaseFiles

NUMBERS = st.floats(allow_nan=False, allow_infinity=False) | st.integers(-(2**63), 2**63)
VARIATIONS = st.dictionaries(st.text(max_size=8), NUMBERS | st.text(max_size=8), max_size=4)


def of_field(field):
    """Return a strategy of the values that one field of a scenario may have."""
    if field.name in LIMITS:
        low, high = LIMITS[field.name]
        if isinstance(field.default, int):
            return st.integers(int(low), int(high))
        return st.floats(max(low, 0.5) if field.name == "speed_kmh" else low, high)
    names = {"road": ROADS, "manoeuvre": MANOEUVRES, "vehicle": list(VEHICLES)}
    if field.name in names:
        return st.sampled_from(names[field.name])
    if field.name == "tracks":
        return st.sampled_from([("left",), ("right", "left"), ("left", "right", "centre")])
    return st.just(field.default)


@st.composite
def cases(draw):
    some = draw(st.lists(st.sampled_from(fields(Scenario)), max_size=8, unique_by=lambda f: f.name))
    scenario = Scenario(**{field.name: draw(of_field(field)) for field in some})
    return Case(draw(st.text(min_size=1, max_size=12)), scenario, draw(VARIATIONS))


@pytest.mark.slow
@settings(deadline=None, max_examples=100)
@given(case=cases(), device_class=st.sampled_from(DeviceClass), reason=st.text(max_size=40))
def test_what_is_written_is_read_back(tmp_path_factory, case, device_class, reason):
    path = tmp_path_factory.getbasetemp() / "toy-1.json"
    path.write_text(json.dumps(document(case, device_class, "exec:./x", reason)))
    kept = read_case(path)
    assert (kept.case, kept.device_class) == (case, device_class)
    assert (kept.file, kept.case.name) == ("toy-1.json", "toy-1")
    assert kept.case.digest == case.digest


@pytest.mark.slow
@settings(deadline=None, max_examples=100)
@given(cases())
def test_a_case_is_told_by_what_differs_from_the_defaults_alone(case):
    parameters = case.parameters["scenario"]
    assert all(getattr(DEFAULT, name) != getattr(case.scenario, name) for name in parameters)
    assert not set(parameters) & set(CHANNELS_BY_NEED)
    assert Case.of(case.check, json.loads(json.dumps(case.parameters))) == case


@pytest.mark.slow
@settings(deadline=None, max_examples=100)
@given(cases(), cases())
def test_files_are_named_apart_by_the_numbers_alone(case, other):
    assert name_of(case) == name_of(replace(case, name="another name"))
    assert case == other or name_of(case) != name_of(other)


def test_the_channels_of_a_device_are_no_part_of_a_case():
    without = Scenario(**dict.fromkeys(CHANNELS_BY_NEED, False))
    assert Case("toy", without).parameters == Case("toy", Scenario()).parameters
    assert Case("toy", without).digest == Case("toy", Scenario()).digest


def test_a_variation_is_kept_from_being_changed():
    numbers = {"gap_s": 1.0}
    case = Case("toy", Scenario(), numbers)
    numbers["gap_s"] = 2.0
    assert case.variation["gap_s"] == 1.0
    with pytest.raises(TypeError):
        case.variation["gap_s"] = 3.0


def test_a_file_says_what_failed_and_why():
    written = document(Case("toy", Scenario(seed=4)), DeviceClass.ADEQUATE, "exec:./x", "too rough")
    assert written == {
        "format": "floatref-case/1",
        "edition": EDITION,
        "check": "toy",
        "class": "adequate",
        "device": "exec:./x",
        "reason": "too rough",
        # What a file does not name is what the first edition meant.
        "scenario": {"seed": 4, "slip_percent_per_g": 2.5, "laser_ahead_m": 0.105},
        "variation": {},
    }


CASE = {
    "format": "floatref-case/1",
    "edition": EDITION,
    "check": "toy",
    "scenario": {},
    "variation": {},
}


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("{", "not JSON"),
        ("\udcff", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ([], "format 'list': unknown"),
        ({**CASE, "format": "floatref-case/9"}, "format 'floatref-case/9': unknown"),
        ({**CASE, "check": 5}, "has no check"),
        ({**CASE, "class": "superb"}, "class 'superb': unknown"),
        ({**CASE, "class": ["nominal"]}, "class ['nominal']: unknown"),
        ({**CASE, "scenario": []}, "JSON object"),
        ({**CASE, "scenario": {"speed_kmh": "fast"}}, "speed_kmh is 'fast'"),
        ({**CASE, "scenario": {"speed_kmh": 1e9}}, "speed_kmh is 1000000000"),
        ({**CASE, "scenario": {"manoeuvre": "jump"}}, "manoeuvre 'jump'"),
        ({**CASE, "variation": [1]}, "variation"),
        ({**CASE, "variation": {"gap_s": None}}, "variation"),
        ({**CASE, "variation": {"gap_s": float("nan")}}, "variation"),
        (" " * (1 << 20) + json.dumps(CASE), "larger than any case"),
    ],
)
def test_what_is_no_case_is_refused_with_the_files_name_in_one_line(tmp_path, content, words):
    path = tmp_path / "cases" / "bad.json"
    path.parent.mkdir()
    text = content if isinstance(content, str) else json.dumps(content)
    path.write_bytes(text.encode(errors="surrogateescape"))
    for read in (lambda: read_case(path), lambda: read_cases(tmp_path)):
        with pytest.raises(InputError) as caught:
            read()
        assert str(caught.value).startswith(f"{path}: ")
        assert words in str(caught.value)
        assert "\n" not in str(caught.value)


OLDER = {**CASE, "edition": "1999.1", "scenario": {"vehicle": "horse"}, "variation": {"legs": 4}}


@pytest.mark.parametrize("content", [OLDER, {**OLDER, "edition": 5}, {**OLDER, "edition": None}])
def test_a_case_of_another_edition_is_refused_and_none_of_its_numbers_is_read(tmp_path, content):
    path = tmp_path / "cases" / "older.json"
    path.parent.mkdir()
    path.write_text(json.dumps(content))
    (kept,) = read_cases(tmp_path)
    assert kept.case.check == "toy"
    assert str(content["edition"] or "no edition") in kept.refused
    assert EDITION in kept.refused
    path.write_text(json.dumps(CASE))
    assert read_case(path).refused == ""


@pytest.mark.parametrize("edition", EDITIONS)
def test_a_file_has_its_edition_and_only_that_one_reads_it(tmp_path, edition):
    case = Case("toy", Scenario(seed=3))
    path = tmp_path / "cases" / "toy-1.json"
    path.parent.mkdir()
    path.write_text(json.dumps(document(case, DeviceClass.NOMINAL, "x", "rough", edition)))
    assert read_case(path).edition == edition
    for asked in EDITIONS:
        kept = read_case(path, asked)
        assert [one.refused for one in read_cases(tmp_path, asked)] == [kept.refused]
        assert (kept.refused == "") is (asked == edition)
        assert kept.refused == "" or f"'{edition}'" in kept.refused
        assert asked == edition or kept.refused.endswith(f"in {asked}; take it out")


@pytest.mark.parametrize("edition", EDITIONS)
def test_what_a_case_does_not_name_is_what_the_first_edition_meant(tmp_path, edition):
    path = tmp_path / "old.json"
    path.write_text(json.dumps({**CASE, "edition": edition, "scenario": {"speed_kmh": 60.0}}))
    scenario = read_case(path).case.scenario
    assert scenario == Scenario(speed_kmh=60.0, slip_percent_per_g=0.3, laser_ahead_m=0.0)


@pytest.mark.parametrize("make", [lambda path: None, os.mkdir])
def test_a_file_that_is_none_is_refused(tmp_path, make):
    path = tmp_path / "case.json"
    make(path)
    with pytest.raises(InputError, match=r"case\.json: .*; name a case file"):
        read_case(path)


@pytest.mark.posix
@pytest.mark.parametrize("linked", ["cases", "cases/toy-1.json"])
def test_cases_are_not_read_through_a_link(tmp_path, linked):
    (tmp_path / "cases").mkdir()
    kept = document(Case("toy", Scenario()), DeviceClass.NOMINAL, "exec:./x", "too rough")
    (tmp_path / "cases" / "toy-1.json").write_text(json.dumps(kept))
    assert len(read_cases(tmp_path)) == 1
    elsewhere = (tmp_path / linked).rename(tmp_path / "elsewhere")
    (tmp_path / linked).symlink_to(elsewhere)
    with pytest.raises(InputError, match=f"{linked}: "):
        read_cases(tmp_path)


def test_a_folder_without_cases_has_none(tmp_path):
    assert read_cases(tmp_path / "new") == ()
    (tmp_path / "cases").mkdir()
    (tmp_path / "cases" / "notes.txt").write_text("not a case")
    assert read_cases(tmp_path) == ()


def result(*checks):
    device = {"spec": "exec:./x"}
    return RunResult(device, DeviceClass.ADEQUATE, 0, "quick", checks)


def failed(case, reason="too rough", outcome=Outcome.FAIL):
    found = {"case": "c", "parameters": case.parameters, "reason": reason, "file": name_of(case)}
    return CheckResult(case.check, "", outcome, counterexample=found)


def test_the_simplest_failing_case_of_every_check_is_written_and_older_ones_stay(tmp_path):
    old, new, waived = (Case(id_, Scenario(seed=3)) for id_ in ("old", "new", "waived"))
    CaseFiles.into(tmp_path).handle(RunFinished(result(failed(old))))
    finished = result(
        failed(new), failed(waived, outcome=Outcome.WAIVED), CheckResult("x", "", Outcome.PASS)
    )
    CaseFiles.into(tmp_path).handle(RunFinished(finished))
    kept = read_cases(tmp_path)
    assert [one.case for one in kept] == sorted((old, new, waived), key=name_of)
    assert {one.device_class for one in kept} == {DeviceClass.ADEQUATE}
    assert sorted(p.name for p in tmp_path.rglob("*.json")) == [one.file for one in kept]


def test_nothing_is_written_before_the_verdict(tmp_path):
    CaseFiles.into(tmp_path).handle(RunStarted("x", None, (), ()))
    assert read_cases(tmp_path) == ()


def test_a_text_of_a_device_that_is_no_unicode_is_written_all_the_same(tmp_path):
    case = Case("toy", Scenario())
    CaseFiles.into(tmp_path).handle(RunFinished(result(failed(case, "said \udcff é\x00"))))
    (path,) = (tmp_path / "cases").iterdir()
    assert json.loads(path.read_text(encoding="utf-8"))["reason"] == "said \udcff é\x00"
