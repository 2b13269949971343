"""A served run gives the points of the stream, in answers and on the disk, and resumes."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref import InputError, read_profile
from floatref.files.schema import enforce
from floatref.live.as_live import run_as_live

CASES = {
    "one clock": {},
    "distance with times": {"distance": "times", "start_s": 1234.5},
    "two wheel paths": {"tracks": ("left", "right"), "height_hz": 150.0},
}


@pytest.fixture(scope="module")
def made(drive, live):
    """Return a function that returns a recording of `CASES`, and its profile."""
    known = {}

    def make(case):
        if case not in known:
            recording = drive(live.LEGS, **CASES[case])
            known[case] = recording, run_as_live(recording, live.PIPELINE).profile
        return known[case]

    return make


@pytest.mark.parametrize(
    "case",
    ["two wheel paths", *(pytest.param(c, marks=pytest.mark.slow) for c in sorted(CASES)[:2])],
)
def test_answers_and_directory_have_the_points_of_the_stream(made, live, same, tmp_path, case):
    recording, expected = made(case)
    answers, error = live.serve(tmp_path / "run", live.messages_of(recording))
    assert error is None
    assert [answers[0]["kind"], answers[-1]["kind"]] == ["started", "finished"]
    same(live.profile_of(answers), expected)
    found = read_profile(tmp_path / "run")
    same(found, expected)
    assert found.pipeline == expected.pipeline
    assert found.settings == expected.settings
    assert len(found.provenance["live"]["windows"]) == len(expected.provenance["live"]["windows"])
    assert not {p.name for p in (tmp_path / "run").iterdir()} & {"live.json", "windows.jsonl"}


@pytest.mark.slow
@settings(max_examples=8, phases=[Phase.explicit, Phase.generate])
@given(st.integers(0, 2**31), st.lists(st.floats(0.0, 1.0), min_size=1, max_size=3))
def test_a_peer_that_ends_early_leaves_a_run_that_resumes(
    made, live, same, tmp_path_factory, seed, ends
):
    recording, expected = made("two wheel paths")
    path = tmp_path_factory.mktemp("runs") / "run"
    hello, *pieces, finish = live.messages_of(recording)
    rng = np.random.default_rng(seed)
    known = 0
    for part in sorted(ends):
        end = max(round(part * len(pieces)), known)
        # It may send again what the run has, and end within a line.
        sent = pieces[max(0, known - int(rng.integers(0, 30))) : end]
        cut = int(rng.integers(1, 50)) if sent else 0
        data = live.as_lines([hello, *sent])
        _, error = live.serve_bytes(path, data[: len(data) - cut], resume=path.exists())
        assert "ended without the message finish" in str(error)
        known = max(end - 1, 0) if cut else end
        check_prefix(path, expected)
    _, error = live.serve(path, [hello, *pieces[known:], finish], resume=True)
    assert error is None
    same(read_profile(path), expected)


def check_prefix(path, expected):
    """Assert that the points on the disk are the first ones of ``expected``."""
    if not (path / "profile.json").exists():
        return
    found = read_profile(path)
    for name in ("left", "right"):
        count = found[name].elevation.size
        np.testing.assert_array_equal(found[name].elevation, expected[name].elevation[:count])
        np.testing.assert_array_equal(found[name].valid, expected[name].valid[:count])


@pytest.mark.parametrize(
    "pipeline",
    ["temporal-basic", pytest.param("road-prior-smoother", marks=pytest.mark.slow)],
)
def test_answers_obey_their_schema(made, live, tmp_path, pipeline):
    recording, _ = made("two wheel paths")
    messages = live.messages_of(recording, step_s=10.0, provisional=True, pipeline=pipeline)
    found, _ = live.serve(tmp_path / "run", messages[:18])
    bad, _ = live.serve(tmp_path / "run", [messages[0], {"kind": "samples"}], resume=True)
    for answer in [*found, *bad]:
        for track in answer.get("tracks", {}) if answer["kind"] == "points" else ():
            # A validator takes long for thousands of numbers.
            answer["tracks"][track] = {k: v[:20] for k, v in answer["tracks"][track].items()}
        enforce(answer, "floatref-live-answer-1", "answer")
    assert {each["kind"] for each in found} >= {"started", "points", "saved"}
    assert {each["state"] for each in found if each["kind"] == "points"} == {"provisional", "final"}
    assert bad[-1]["kind"] == "refused"


@pytest.mark.slow
def test_samples_without_numbers_follow_one_another(made, live, same, tmp_path):
    recording, expected = made("one clock")
    _, error = live.serve(tmp_path / "run", live.messages_of(recording, numbered=False))
    assert error is None
    same(read_profile(tmp_path / "run"), expected)


@pytest.mark.slow
def test_samples_that_never_came_are_missing(made, live, tmp_path):
    recording, _ = made("one clock")
    messages = live.messages_of(recording)
    answers, error = live.serve(tmp_path / "run", messages[:31] + messages[36:])
    assert error is None
    events = [a["text"] for a in answers if a["kind"] == "event"]
    assert "channel left.height: 2000 samples from 60.000 s on were not sent; " in "\n".join(events)
    profile = read_profile(tmp_path / "run")
    where = profile.distance_m
    assert not profile["left"].valid[(where > 1210.0) & (where < 1390.0)].any()
    assert profile["left"].valid[(where > 500.0) & (where < 900.0)].all()


@pytest.mark.slow
def test_a_complete_run_answers_that_it_is(made, live, same, tmp_path):
    recording, expected = made("one clock")
    messages = live.messages_of(recording, step_s=50.0)
    live.serve(tmp_path / "run", messages)
    again, error = live.serve(tmp_path / "run", messages, resume=True)
    assert error is None
    assert [each["kind"] for each in again] == ["finished"]
    assert again[0]["points"] == expected["left"].elevation.size
    hello = {**messages[0], "points_from": -5}
    again, _ = live.serve(tmp_path / "run", [hello], resume=True)
    same(live.profile_of(again), expected)


@pytest.mark.slow
def test_points_are_sent_again_from_a_number(made, live, same, tmp_path):
    recording, _ = made("two wheel paths")
    messages = live.messages_of(recording)
    first, _ = live.serve(tmp_path / "run", messages[:-1])
    hello = {**messages[0], "points_from": 0}
    again, _ = live.serve(tmp_path / "run", [hello], resume=True)
    same(live.profile_of(again), live.profile_of(first))
    assert again[0]["points"] == sum(
        len(a["tracks"]["left"]["valid"])
        for a in first
        if a["kind"] == "points" and a["state"] == "final"
    )


def test_a_hello_of_another_run_is_refused(made, live, tmp_path):
    recording, _ = made("one clock")
    messages = live.messages_of(recording)
    live.serve(tmp_path / "run", messages[:5])
    other = {**messages[0], "pipeline": "temporal-hpf"}
    answers, error = live.serve(tmp_path / "run", [other], resume=True)
    assert isinstance(error, InputError)
    assert answers[-1]["kind"] == "refused"
    assert answers[-1]["text"].startswith("line 1: hello: pipeline differs from that of the run")
    brief = {"kind": "hello", "format": "floatref-live/1"}
    answers, _ = live.serve(tmp_path / "run", [brief], resume=True)
    assert (
        answers[0]["next"]["left.height"] == messages[4]["channels"]["left.height"]["first"] + 400
    )
