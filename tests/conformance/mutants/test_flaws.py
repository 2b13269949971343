"""The catalogue of flaws is that of the mutants, and its page and JSON are as they are written."""

import importlib
import json
from importlib.resources import files
from pathlib import Path

import pytest

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.mutants.device import entries
from floatref_conformance.mutants.flaws import FILE, list_flaws

ROOT = Path(__file__).parents[3]


@pytest.fixture
def written(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    return importlib.import_module("flaws_page")


def test_every_mutant_has_its_flaw_and_every_flaw_its_mutant():
    texts = json.loads((files("floatref_conformance.mutants") / FILE).read_text(encoding="utf-8"))
    assert set(texts) == {entry.name for entry in entries()}
    assert [flaw.mutant for flaw in list_flaws()] == [entry.name for entry in entries()]


def test_flaws_are_told_apart_by_name_and_sentence():
    for of in (lambda flaw: flaw.name, lambda flaw: flaw.road + flaw.origin):
        assert len({of(flaw) for flaw in list_flaws()}) == len(list_flaws())


def test_texts_are_sentences_and_checks_are_there():
    for flaw in list_flaws():
        for text in (flaw.road, flaw.origin):
            assert text[0].isupper(), flaw.mutant
            assert text.endswith("."), flaw.mutant
            assert len(text) <= 200, flaw.mutant
        assert not flaw.name.endswith(".")
        assert flaw.found_by
        assert set(flaw.found_by) <= {*IDS, *STREAM_CHECKS}


def test_page_and_json_are_as_they_are_written(written):
    assert written.PAGE.read_text(encoding="utf-8") == written.page()
    assert written.DATA.read_text(encoding="utf-8") == written.document()


def test_a_page_names_what_does_not_find_it_where_that_is_shorter(written):
    assert written.describe_checks(tuple(IDS)) == "every check of recordings"
    assert written.describe_checks(("stop",)) == "`stop`"
    but = tuple(id_ for id_ in IDS if id_ != "stop")
    assert written.describe_checks(but) == "every check of recordings but `stop`"
    assert written.describe_checks(tuple(STREAM_CHECKS)[:1]) == "`live-order`"
