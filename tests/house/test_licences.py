"""Every package that floatref brings along states a licence under which it may be used here."""

import importlib
import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]
LOCK = ROOT / ".ci" / "lock.txt"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture
def dependencies(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    return importlib.import_module("dependencies")


def asked() -> list[Requirement]:
    """Return every line of pyproject.toml, those of the extras included."""
    extras = PROJECT["optional-dependencies"].values()
    lines = [*PROJECT["dependencies"], *(line for extra in extras for line in extra)]
    return [need for line in lines if (need := Requirement(line)).name != "floatref"]


def locked() -> dict[str, tuple[str, int]]:
    """Return the version of every package in the lock, and how many files it has hashes of."""
    text = LOCK.read_text(encoding="utf-8").replace("\\\n", " ")
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    found = {}
    for line in lines:
        need = Requirement(re.split(r"\s--hash", line)[0])
        (version,) = (each.version for each in need.specifier)
        found[canonicalize_name(need.name)] = (
            version,
            len(re.findall(r"sha256:[0-9a-f]{64}", line)),
        )
    return found


def test_every_licence_is_one_of_the_families(dependencies) -> None:
    everything = dependencies.list_all()
    assert len(everything) > len(dependencies.list_asked()) > 20
    unknown = {each.name for each in everything if not dependencies.licence_of(each.name)}
    assert not unknown


@pytest.mark.parametrize(
    "licence",
    [
        "GPL-3.0-only",
        "GNU General Public License v2 (GPLv2)",
        "AGPL-3.0",
        "Proprietary",
        "",
        "SSPL",
    ],
)
def test_another_licence_has_no_family(dependencies, licence) -> None:
    assert dependencies.family(licence) == ""


def test_the_page_lists_what_floatref_asks_for(dependencies) -> None:
    page = dependencies.PAGE.read_text(encoding="utf-8")
    assert dependencies.table() in page
    users = {extra for extra in PROJECT["optional-dependencies"] if extra != "dev"}
    assert set(dependencies.EXTRAS) == users


def test_the_lock_has_a_version_in_every_range() -> None:
    versions = locked()
    for need in asked():
        version, files = versions[canonicalize_name(need.name)]
        assert need.specifier.contains(version), need
        assert files > 0, need


def test_the_lock_names_no_place_to_fetch_from() -> None:
    text = LOCK.read_text(encoding="utf-8")
    assert "://" not in text
    assert not re.search(r"^-", text, re.MULTILINE)
    assert all(files > 0 for _, files in locked().values())
