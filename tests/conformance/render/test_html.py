"""`report.html`: one sound file that leads nowhere else and says what was found."""

import re
from dataclasses import replace
from math import nan

import numpy as np
import pytest
from tests.conformance.page_reader import Page, assert_accessible, assert_sound

from floatref.errors import InputError
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.interface import Description
from floatref_conformance.judge.events import RunFinished, RunStarted
from floatref_conformance.plugins import load_registry
from floatref_conformance.render import text
from floatref_conformance.render.html import HtmlReport, as_html


@pytest.fixture
def page():
    return lambda result, checks=(): Page(as_html(result, checks))


@pytest.fixture(scope="module")
def suite_checks():
    return tuple(load_registry().checks.values())


def test_the_page_is_sound_and_leads_nowhere_else(every, suite_checks):
    assert_sound(as_html(every, suite_checks))


def test_the_drawing_of_what_is_asked_shows_what_the_check_scores(result, suite_checks):
    text = as_html(result(), suite_checks)
    for part in ("Scored: 163 to 437.3.", "Scored: 110 to 210. Scored: 330 to 430."):
        assert part in text


def test_what_a_device_says_is_text(page, every, hostile):
    found = page(every)
    assert "<script>alert('x')</script>" in found.text
    assert not [name for _, a in found.elements for name in a if name.startswith("on")]
    as_html(every).encode("utf-8")


def test_every_link_has_its_target_and_every_id_is_the_only_one(page, every, suite_checks):
    found = page(every, suite_checks)
    ids = [a["id"] for _, a in found.elements if "id" in a]
    assert len(ids) == len(set(ids))
    named = [a[k] for _, a in found.elements for k in ("aria-labelledby",) if k in a]
    linked = [a["href"][1:] for a in found.all("a")]
    assert {id_ for words in named for id_ in words.split()} | set(linked) <= set(ids)


def test_who_hears_the_page_is_told_the_same(page, every, suite_checks):
    assert_accessible(page(every, suite_checks))


def test_the_verdict_comes_first_with_what_it_rests_on(page, check, result):
    words = page(result(check(Outcome.FAIL), check(Outcome.PASS, "bounce"))).text
    order = ["FAIL", "1 of 2 checks that ran passed", "Class judged nominal", "Seed 7", "Checks"]
    places = [words.index(part, 60) for part in order]
    assert places == sorted(places)


def test_the_worst_check_comes_first_and_what_was_not_run_last(check, result):
    made = result(
        check(Outcome.SKIP, "not-run", reason="not selected"),
        check(Outcome.PASS, "easy", 0.1),
        check(Outcome.PASS, "close", 0.9),
        check(Outcome.FAIL, "far", 9.0),
        check(Outcome.FAIL, "numberless", nan),
        check(Outcome.ERROR, "broken", reason="garbage"),
    )
    rows = re.findall(r'<th scope="row"><a href="[^"]*">([^<]*)</a>', as_html(made))
    assert rows == ["broken", "numberless", "far", "close", "easy", "not-run"]


def test_a_bar_is_as_long_as_the_share_of_the_limit(check, result):
    text = as_html(result(check(Outcome.PASS, "a", 0.3), check(Outcome.FAIL, "b", 600.0)))
    assert [float(width) for width in re.findall(r"width:([\d.]+)%", text)] == [100.0, 20.0]


def test_no_value_is_shown_that_the_class_does_not_limit(page, check, result):
    said = {
        0.0: "no value that class nominal limits was measured",
        371.2: "no value that class nominal limits was valid "
        "up to 371.2 m of a wheel path flagged invalid",
    }
    for flagged_m, sentence in said.items():
        above = {DeviceClass.ADEQUATE: 0.08}
        words = page(result(check(Outcome.PASS, limits=above, flagged_m=flagged_m))).text
        assert f"pass no limit {sentence} nominal 4" in words
        assert "IRI error" not in words
        words = page(result(check(Outcome.PASS, flagged_m=flagged_m))).text
        assert "IRI error" in words
        assert "nothing was" not in words


@pytest.mark.parametrize("outcome", [Outcome.SKIP, Outcome.NOT_APPLICABLE])
def test_what_was_not_run_is_never_called_passed(page, check, result, outcome):
    words = page(result(check(outcome, "later", reason="not selected"))).text
    assert "INCOMPLETE" in words
    assert "0 of 0 checks that ran passed" in words
    assert "pass " not in words[words.index("Checks") :].split("What was not run")[0]


def test_a_failure_shows_numbers_picture_and_commands(page, check, result, stopped):
    found = page(result(check(Outcome.FAIL, reason="IRI error: 3 m/km, limit 1 m/km")))
    words = found.text
    for part in ("IRI error: 3 m/km", "manoeuvre stop", "bump_mm 20", "gap_s 0.25"):
        assert part in words
    assert "conformance replay cases/stop-1a2b3c4d.json --device" in words
    assert "--class nominal --seed 7 --check stop" in words
    assert len(found.all("svg")) == 2
    for part in ("elevation (mm)", "roughness (m/km)", "speed (km/h)", "flagged invalid", "stop"):
        assert part in words
    left = stopped.result.track("left")
    flagged, missing = 0.05 * (~left.valid).sum(), np.isnan(left.elevation).sum()
    sentence = f"{flagged:.1f} m are flagged invalid, {missing} points have no elevation."
    assert f"{sentence} stop at 316 m" in words


@pytest.mark.slow
def test_what_the_check_scored_is_shaded_and_nothing_where_it_did_not_say(check, result):
    def shaded(style, **changes):
        text = as_html(result(check(Outcome.FAIL, **changes)))
        found = re.findall(f'<path class="{style}" d="([^"]*)"', text)[:1]
        return [
            tuple(map(float, ends)) for ends in re.findall(r"M([\d.]+) [\d.]+h([\d.]+)", *found)
        ]

    (flagged,) = shaded("flagged", scored_m=((300.0, 330.0), (100.0, 200.0)))
    first, second = shaded("scored", scored_m=((300.0, 330.0), (100.0, 200.0)))
    assert second == pytest.approx(flagged, abs=1.5)
    assert second[0] - first[0] == pytest.approx(2.0 * first[1], rel=0.01)
    assert '<path class="scored"' not in as_html(result(check(Outcome.FAIL)))


def test_a_profile_of_which_nothing_was_measured_is_pictured_all_the_same(
    page, check, result, stopped
):
    nothing = ProfileTrack.of("left", np.full(10, np.nan))
    empty = replace(stopped, result=Profile(0.05, (nothing,)))
    assert len(page(result(check(Outcome.FAIL, passes=(empty,)))).all("svg")) == 1


@pytest.mark.parametrize("track", ["left", "right"])
def test_the_first_picture_is_of_the_wheel_path_that_fails_the_case_shown(
    page, check, result, track
):
    words = page(result(check(Outcome.FAIL, worst_track=track))).text
    other = {"left": "right", "right": "left"}[track]
    assert words.index(f"wheel path {track}:") < words.index(f"wheel path {other}:")


def test_recordings_without_a_picture_are_counted(page, check, result, stopped):
    words = page(result(check(Outcome.FAIL, passes=(stopped,) * 5))).text
    assert "3 more recordings of this case are not pictured" in words


def test_kept_cases_are_listed_with_what_they_came_to(page, check, result, kept):
    made = result(check(Outcome.PASS), replayed=[kept(Outcome.FAIL, "too rough")])
    words = page(made).text
    assert words.index("FAIL") < words.index("1 of 1 kept cases still fails")
    assert "stop-0000aaaa.json stop fail 1.5 m/km 1 m/km too rough" in words


def test_what_a_check_asks_is_told_with_its_limits_and_its_drawing(page, result, suite_checks):
    found = page(result(), suite_checks)
    for asked in suite_checks:
        for part in (asked.title, asked.clause, asked.derivation, *asked.limits):
            assert " ".join(part.split()) in found.text
    assert len(found.all("svg")) == len(suite_checks)


@pytest.mark.slow
def test_the_report_explains_the_checks_of_its_run_and_replaces_an_older_one(
    tmp_path, check, result, suite_checks
):
    (tmp_path / "report.html").write_text("old", encoding="utf-8")
    report = HtmlReport.into(tmp_path)
    assert list(tmp_path.iterdir()) == []
    report.handle(RunStarted("x", Description("x", "1", "temporal", ()), suite_checks, ()))
    report.handle(RunFinished(result(check(Outcome.PASS))))
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert text == as_html(result(check(Outcome.PASS)), suite_checks)


def test_without_the_template_engine_the_user_is_told_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(text, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"pip install -e \"\.\[conformance\]\""):
        HtmlReport.into(tmp_path)
