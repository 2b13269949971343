"""The judge's page names every check, every kind of device, and every exit code."""

import re
from pathlib import Path

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.judge.trial import MOST_HANGS
from floatref_conformance.plugins import load_registry

PAGE = (Path(__file__).parents[2] / "docs" / "conformance.md").read_text(encoding="utf-8")


def test_every_check_has_its_place_in_the_table():
    table = PAGE[PAGE.index("| check |") : PAGE.index("`conformance list` names")]
    assert re.findall(r"`([a-z-]+)`", table) == list(IDS)


def test_every_kind_of_device_is_shown():
    kinds = load_registry().kinds
    assert kinds.keys() >= {"builtin", "exec", "python", "files", "mutant"}
    for kind in kinds.values():
        assert f"| `{kind.usage}` |" in PAGE, kind.usage


def test_exit_codes_are_those_of_the_verdicts():
    for verdict in Verdict:
        shown = re.search(rf"\*\*{verdict.value}\*\* \((?:exit code )?(\d)", PAGE)
        assert shown is not None
        assert int(shown[1]) == verdict.exit_code


def test_the_number_of_hangs_is_the_judges():
    assert MOST_HANGS == 3
    assert "after three hangs" in " ".join(PAGE.split())
