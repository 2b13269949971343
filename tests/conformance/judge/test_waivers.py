"""Waivers: how they are written, what they do to a result, and which of them are of no use."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.checks.verdict import CheckResult, Outcome, RunResult, Verdict
from floatref_conformance.classes import DeviceClass
from floatref_conformance.judge.waivers import check_used, read_waivers, waive

KNOWN = {"toy": None, "second": None}


@pytest.fixture
def read(tmp_path):
    """Return a function that reads a text as a file of waivers."""

    def make(text):
        path = tmp_path / "waivers.txt"
        path.write_text(text, encoding="utf-8")
        return read_waivers(path, KNOWN)

    return make


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("toy waits for new firmware", "waits for new firmware"),
        ("  toy \t waits for  new firmware  ", "waits for  new firmware"),
        ("toy\twaits", "waits"),
        ("toy waits # since May", "waits"),
        ("toy # since May", "since May"),
        ("toy#since May", "since May"),
        ("toy", "no reason given"),
        ("toy #", "no reason given"),
        ("toy wartet auf größere Räder", "wartet auf größere Räder"),
    ],
)
def test_a_line_is_an_id_and_why(read, line, reason):
    assert read(f"# known\n\n{line}\n   \nsecond x\n") == {"toy": reason, "second": "x"}


@pytest.mark.parametrize("text", ["", "\n\n", "# toy\n", "   # toy waits\n"])
def test_a_file_of_comments_waives_nothing(read, text):
    assert read(text) == {}


def test_the_mark_that_some_editors_put_first_is_no_part_of_an_id(tmp_path):
    path = tmp_path / "waivers.txt"
    path.write_bytes(b"\xef\xbb\xbftoy waits\r\nsecond x\r\n")
    assert read_waivers(path, KNOWN) == {"toy": "waits", "second": "x"}


def test_a_check_of_the_suite_may_be_waived_though_it_is_not_built(read):
    assert read("stop later") == {"stop": "later"}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("toy x\njumping y\n", "line 2: jumping: unknown check; known: toy, second"),
        ("toy x\n# more\ntoy y\n", "line 3: toy: waived twice"),
        ("toy, second", "line 1: toy,: unknown check"),
        ("x" * ((1 << 20) + 1), "larger than any list of waivers"),
    ],
)
def test_what_waives_no_check_is_refused_with_file_and_line(read, text, words):
    with pytest.raises(InputError, match=r"waivers\.txt") as caught:
        read(text)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_no_text_is_refused(tmp_path):
    (tmp_path / "bytes").write_bytes(b"toy \xff\xfe")
    for name, words in (("bytes", "not UTF-8"), ("missing", "No such file"), (".", "is a folder")):
        with pytest.raises(InputError, match=words):
            read_waivers(tmp_path / name, KNOWN)


@pytest.mark.parametrize("outcome", list(Outcome))
def test_only_a_limit_that_a_named_check_breaks_is_waived_and_says_so(outcome):
    result = CheckResult("toy", "", outcome, "too rough", counterexample={"case": "c"})
    after = waive(result, {"toy": "known", "second": "known"})
    assert waive(result, {"second": "known"}) is result
    if outcome is Outcome.FAIL:
        assert after.outcome is Outcome.WAIVED
        assert after.reason == "waived (known): too rough"
        assert after.counterexample == result.counterexample
    else:
        assert after is result


def run_result(outcomes, replayed=()):
    checks = tuple(CheckResult(id_, "", outcome) for id_, outcome in outcomes.items())
    kept = tuple({"check": id_, "outcome": outcome.value} for id_, outcome in replayed)
    return RunResult({}, DeviceClass.NOMINAL, 0, "quick", checks, kept)


@settings(deadline=None, max_examples=60)
@given(st.dictionaries(st.sampled_from("abc"), st.sampled_from(Outcome)), st.data())
def test_a_waiver_that_no_failure_needed_is_refused_by_name(tmp_path_factory, outcomes, data):
    path = tmp_path_factory.getbasetemp() / "waivers.txt"
    used = [id_ for id_, outcome in outcomes.items() if outcome is Outcome.WAIVED]
    unsure = [id_ for id_, outcome in outcomes.items() if outcome is Outcome.ERROR]
    result = run_result(outcomes)
    check_used(dict.fromkeys([*used, *unsure], "x"), result, path)
    for unused in {*"abc"} - {*used, *unsure}:
        waivers = dict.fromkeys(data.draw(st.permutations([*used, unused])), "x")
        said = {Outcome.PASS: "did not fail", Outcome.FAIL: "did not fail"}.get(
            outcomes.get(unused, Outcome.SKIP), "was not run|does not apply to the device"
        )
        with pytest.raises(InputError, match=rf"waivers\.txt: {unused}: ({said}): nothing"):
            check_used(waivers, result, path)


def test_a_waiver_of_a_check_that_the_device_skipped_says_so(tmp_path):
    skipped = CheckResult("toy", "", Outcome.SKIP, "too fast for me", cases=2)
    result = RunResult({}, DeviceClass.NOMINAL, 0, "quick", (skipped,))
    with pytest.raises(InputError, match="toy: was skipped by the device"):
        check_used({"toy": "x"}, result, tmp_path)


def test_a_kept_case_needs_the_waiver_of_its_check(tmp_path):
    result = run_result({"toy": Outcome.PASS}, [("toy", Outcome.PASS), ("toy", Outcome.WAIVED)])
    check_used({"toy": "x"}, result, tmp_path)
    assert result.verdict is Verdict.INCOMPLETE
