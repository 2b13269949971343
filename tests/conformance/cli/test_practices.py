"""`conformance practices`, and the practice of a certification in its worksheet."""

import json
from dataclasses import replace
from hashlib import sha256
from importlib import import_module
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from floatref_conformance.certify.practice.practice_document import list_names, read_own
from floatref_conformance.certify.practice.requirements import Source
from floatref_conformance.cli.main import main

shown = import_module("floatref_conformance.cli.certify.practices")


def call(*words: str) -> Result:
    return CliRunner().invoke(main, list(words))


def test_the_list_and_its_json_name_every_practice() -> None:
    listed = json.loads(call("practices", "--json").stdout)["practices"]
    assert [one["name"] for one in listed] == list(list_names())
    shown = call("practices")
    assert shown.exit_code == 0
    assert all(name in shown.stdout for name in list_names())


@pytest.mark.parametrize("name", list_names())
def test_one_practice_is_shown_with_every_clause_and_source(name: str) -> None:
    text = "".join(call("practices", name).stdout.split())
    document = json.loads(call("practices", name, "--json").stdout)
    practice = read_own(name)
    assert practice.sha256 in text
    assert len(document["limits"]) == len(practice.requirements)
    for one, row in zip(practice.requirements, document["limits"], strict=True):
        assert "".join(str(one.source).split()) in text
        assert row["limit"] == (one.word if one.limit is None else one.limit)


@pytest.mark.parametrize("command", [("practices",), ("certify", "x", "--practice")])
def test_an_unknown_name_is_one_line_and_exit_2(
    command: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x").write_text("")
    options = ("--reference", "x") if command[0] == "certify" else ()
    result = call(*command, "aashto-r56-15", *options)
    assert result.exit_code == 2
    assert "aashto-r56-14" in result.stderr
    assert result.stderr.strip().count("\n") == 0


def test_a_class_that_a_practice_does_not_have_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x").write_text("")
    path = str(tmp_path / "x")
    words = (path, "--reference", path, "--practice", "tex-1001-s", "--class", "adequate")
    result = call("certify", *words)
    assert result.exit_code == 2
    assert "practice tex-1001-s has no limits for it" in result.stderr


def test_whatever_a_text_of_a_practice_holds_moves_no_cursor(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    hostile = "a\x1b]0;owned\x07\u202e\nPASS"
    own = read_own("tex-1001-s")
    first = replace(own.requirements[0], clause=hostile, source=Source(hostile), missing=hostile)
    made = replace(own, title=hostile, version=hostile, notes=(hostile,), requirements=(first,))
    monkeypatch.setattr(shown, "find_practice", lambda name: made)
    for words in (("practices", "x"), ("practices",)):
        text = call(*words).stdout
        assert "\\u202e" in "".join(text.split())
        assert text.replace("\n", "").isprintable()
        assert "PASS" not in [line.strip() for line in text.splitlines()]


def test_the_digest_is_that_of_an_agencys_file(tmp_path: Path) -> None:
    limit = {"quantity": "runs", "limit": 3, "unit": "", "clause": "rule 1"}
    document = {
        "format": "conformance-practice/1",
        "name": "county",
        "title": "County handbook",
        "version": "4",
        "limits": [{**limit, "source": {"document": "handbook"}}],
    }
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    found = json.loads(call("practices", str(path), "--json").stdout)
    assert found["sha256"] == sha256(path.read_bytes()).hexdigest()
    assert found["limits"][0]["basis"] == "agency"
