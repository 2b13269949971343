"""`worksheet.html`: one sound file to be filed, in which every word of a file is text."""

import re
from dataclasses import replace

import pytest
from tests.conformance.page_reader import Page, assert_accessible, assert_sound

from floatref.errors import InputError
from floatref_conformance.certify.judging.contents import Judged
from floatref_conformance.certify.worksheet.page import as_html, write_page
from floatref_conformance.render import text


@pytest.fixture
def spoilt(certified, hostile, run_of):
    """A worksheet in which everything that a file can say is hostile."""
    make, numbers = run_of
    made = certified(
        profiler=hostile, settings={hostile: hostile}, versions={hostile: [hostile, {"x": hostile}]}
    )
    section = made.sections[0]
    causes = tuple(
        replace(cause, text=hostile)
        for run in section.runs
        for t in run.tracks
        for cause in t.causes
    )
    run = make(1, [numbers("left", causes=causes), numbers("right")], name=hostile, source=hostile,
               notes=(hostile,))  # fmt: skip
    run = replace(run, profile=replace(run.profile, provenance={"sha256": {hostile: hostile}}))
    unread = replace(run, tracks=(), profile=None, error=hostile)
    criteria = tuple(
        replace(one, title=hostile, reason=hostile, clause=hostile, track=hostile)
        for one in section.criteria
    )
    section = replace(
        section, name=hostile, reference_source=hostile, runs=(run, unread), criteria=criteria
    )
    tests = tuple(replace(s, id=hostile, source=hostile, notes=(hostile,)) for s in made.stationary)
    return replace(made, sections=(section, section), stationary=tests)


def test_the_page_is_sound_and_leads_nowhere_at_all(certified):
    assert assert_sound(as_html(certified())).all("a") == []


def test_what_a_file_says_is_text(spoilt, hostile):
    text = as_html(spoilt)
    found = Page(text)
    assert found.crossed == found.open == []
    assert found.all("script") == []
    assert not [name for _, a in found.elements for name in a if name.startswith("on")]
    assert found.text.count("<script>alert('x')</script>") > 20
    assert not {"\x00", "\x1b", "\u202e", "\ud800"} & set(text)
    text.encode("utf-8")


@pytest.mark.slow
def test_every_id_is_the_only_one_and_every_label_is_there(certified):
    made = certified()
    found = Page(as_html(replace(made, sections=made.sections * 2)))
    ids = [a["id"] for _, a in found.elements if "id" in a]
    assert len(ids) == len(set(ids))
    named = [a["aria-labelledby"] for _, a in found.elements if "aria-labelledby" in a]
    assert {id_ for words in named for id_ in words.split()} <= set(ids)


def test_who_hears_the_page_is_told_the_same(certified):
    assert_accessible(Page(as_html(certified())))


def test_the_verdict_comes_first_and_every_criterion_with_its_reason(certified):
    words = Page(as_html(certified())).text
    order = ["FAIL Van 7", "2 of 3 criteria", "Class nominal", "pass A1 Accuracy left 0.9500 ≥ 0.9"]
    order += ["fail A1 Distance left +1.000 % ± 0.15 %", "run-3 takes the section 1.00 % longer"]
    order += ["missing bounce Bounce left – ≤ 0.126 m/km", "Signatures", "Section A1"]
    places = [words.index(part, 60) for part in order]
    assert places == sorted(places)


def test_a_run_that_does_not_agree_is_marked_by_a_word(certified):
    text = as_html(certified())
    rows = re.findall(r'<tr( class="bad")?>\s*<th scope="row"><span', text)
    assert rows == ["", "", ' class="bad"', ' class="bad"'] * 2
    words = Page(text).text
    assert words.count("run-3 does not agree") == 2
    assert words.count("run-4 not used") == 2
    assert "not used: holds no profile" in words


def test_files_are_named_with_their_hashes(certified):
    words = Page(as_html(certified())).text
    assert f"runs/run-2.csv: recording.json {'0' * 64}" in words


def test_the_page_can_be_signed_and_each_section_begins_on_a_sheet(certified):
    text = as_html(certified())
    for name in ("Operator of the profiler", "Certified by", "Agency", "Date"):
        assert name in text
    assert "break-before: page" in text
    assert [a.get("class") for a in Page(text).all("section")].count("leaf") == 3


def test_an_empty_worksheet_is_a_page_too(certified, judged):
    missing = judged("runs", 0.0, 10.0, Judged.MISSING, reason="no runs were found")
    found = Page(as_html(certified(profiler="", sections=(), stationary=(), criteria=(missing,))))
    assert "no runs were found" in found.text
    assert found.crossed == found.open == []


@pytest.mark.slow
def test_a_page_replaces_an_older_one_or_leaves_it(certified, tmp_path, monkeypatch):
    path = tmp_path / "worksheet.html"
    path.write_text("old", encoding="utf-8")
    write_page(certified(), path)
    assert path.read_text(encoding="utf-8") == as_html(certified())
    assert list(tmp_path.iterdir()) == [path]
    monkeypatch.setattr(text, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"pip install -e \"\.\[conformance\]\""):
        write_page(certified(), path)
    assert path.read_text(encoding="utf-8") == as_html(certified())
