"""The tree: its fixed top level, its rooms, and what every package ships."""

import re
import subprocess
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
TOP = {"pyproject.toml", "sdk", "adapters", "reference_impl", "conformance", "tests", "docs"}
CUSTOMARY = {
    "README.md",
    "LICENSE",
    "NOTICE",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "CITATION.cff",
    "SECURITY.md",
}
ROOMS = {
    "sdk": "floatref",
    "adapters": "floatref_adapters",
    "reference_impl": "floatref_reference",
    "conformance": "floatref_conformance",
}


def tracked(*options: str) -> list[str]:
    """Return the files under version control."""
    return subprocess.run(
        ["git", "ls-files", *options], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.splitlines()


def test_the_top_level_holds_what_it_always_holds() -> None:
    top = {name.partition("/")[0] for name in tracked()}
    assert {name for name in top if not name.startswith(".")} <= TOP | CUSTOMARY
    assert top >= TOP


def test_every_room_holds_one_package_that_says_it_is_typed() -> None:
    for room, package in ROOMS.items():
        assert {n.split("/")[1] for n in tracked() if n.startswith(f"{room}/")} == {package}
        assert (ROOT / room / package / "py.typed").is_file()
        assert not (ROOT / room / "__init__.py").exists()


def test_tests_are_no_package() -> None:
    assert not [n for n in tracked() if n.startswith("tests/") and n.endswith("__init__.py")]


def test_data_of_others_carries_its_licence_and_source() -> None:
    sources = [p for p in (ROOT / "conformance").rglob("SOURCE.md") if p.parent.name != "data"]
    assert sources
    for source in sources:
        assert (source.parent / "LICENSE.txt").is_file(), source.parent.name


def test_core_and_extras_are_those_that_users_script_against() -> None:
    core = {re.split(r"[<>=\[]", line)[0] for line in PROJECT["dependencies"]}
    assert core == {"click", "jsonschema", "numba", "numpy", "pluggy", "rich", "scipy"}
    assert set(PROJECT["optional-dependencies"]) == {
        "plot",
        "adapters",
        "conformance",
        "batch",
        "gis",
        "dev",
    }
    assert set(PROJECT["scripts"]) == {"floatref", "conformance"}


def test_texts_end_their_lines_alike_and_the_rest_is_left_as_it_is() -> None:
    """As `.gitattributes` says: LF in the repository and in every clone, or bytes as they are."""
    for line in tracked("--eol"):
        (stored, _, *attributes), name = line.split("\t")[0].split(), line.split("\t")[1]
        asked = " ".join(attributes).removeprefix("attr/")
        assert asked == "-text" or "eol=lf" in asked, name
        assert asked == "-text" or stored in ("i/lf", "i/none"), f"{name}: {stored}"
        assert stored != "i/-text" or asked == "-text", f"{name}: name its suffix as binary"
