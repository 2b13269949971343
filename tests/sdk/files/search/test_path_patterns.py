"""Patterns match what a shell matches, in a search that ends, whatever links and folders are."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files.search import counted_listing
from floatref.files.search.counted_listing import CountedListing
from floatref.files.search.path_patterns import find_matches, split_pattern

FILES = ("run-1.erd", "a/run-2.erd", "a/b/run-3.erd", "a/b/c/run-4.erd", "a/b/.d/run-5.erd", ".x")


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("tree")
    for name in FILES:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).touch()
    return folder


def matches(tree: Path, text: str) -> list[str]:
    base, names = split_pattern(text)
    found = find_matches(tree / base, names, CountedListing(text))
    return sorted(path.relative_to(tree).as_posix() for path in found)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("*.erd", ["run-1.erd"]),
        ("*", ["a", "run-1.erd"]),
        ("a/*/*.erd", ["a/b/run-3.erd"]),
        ("**/*.erd", ["a/b/c/run-4.erd", "a/b/run-3.erd", "a/run-2.erd", "run-1.erd"]),
        ("**/b/*.erd", ["a/b/run-3.erd"]),
        ("**/b/**/*.erd", ["a/b/c/run-4.erd", "a/b/run-3.erd"]),
        ("**", ["."]),
        ("**/**/**", ["."]),
        ("a/**", ["a"]),
        ("*/**", ["a"]),
        ("*/b/run-[1-3].erd", ["a/b/run-3.erd"]),
        ("*/../run-?.erd", ["run-1.erd"]),
        (".*", [".x"]),
        ("**/.d/*", ["a/b/.d/run-5.erd"]),
        ("none/*", []),
        ("run-1.erd/*", []),
        ("a\0/*", []),
    ],
)
def test_a_pattern_matches_what_it_says(tree: Path, text: str, expected: list[str]) -> None:
    found = matches(tree, text)
    assert [name.replace("a/../", "") for name in found] == expected


PARTS = st.lists(st.sampled_from(["**", "*", "a", "b", "?", "*.erd"]), min_size=1, max_size=5)


@given(PARTS.filter(lambda parts: parts[-1] != "**" and any("*" in p or "?" in p for p in parts)))
def test_matches_are_those_of_python(tree: Path, parts: list[str]) -> None:
    seen = (path.relative_to(tree) for path in tree.glob("/".join(parts)))
    expected = {path.as_posix() for path in seen if not any(p[0] == "." for p in path.parts)}
    found = matches(tree, "/".join(parts))
    assert found == sorted(expected)


def test_every_folder_is_listed_once(tree: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    listed: list[str] = []
    scandir = os.scandir
    monkeypatch.setattr(os, "scandir", lambda path: (listed.append(str(path)), scandir(path))[1])
    matches(tree, "**/*/**/*/**/*/**/*.none")
    assert len(listed) == len(set(listed)) == 4


@pytest.mark.parametrize("text", ["a**/*", "**.erd"])
def test_two_stars_in_a_name_are_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"bad pattern .*; write \*\* as a name of its own"):
        split_pattern(text)


@pytest.mark.parametrize("text", ["**/*.none", "*/*/*/*.none", "*/*/*/*/*/*/*/*/*"])
def test_a_search_ends_after_a_number_of_entries(
    tree: Path, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(counted_listing, "MOST", 4)
    with pytest.raises(InputError) as caught:
        matches(tree, text)
    assert str(caught.value) == (
        f"{text}: more than 4 files and folders to look at; name a folder nearer to the files, or "
        "the files themselves"
    )


@pytest.mark.posix
@pytest.mark.parametrize("text", ["**/*.erd", "**/x/*.erd", "**/x/**/*.erd"])
def test_two_stars_follow_no_link(tmp_path: Path, text: str) -> None:
    for folder in ("tree/x", "other/x"):
        (tmp_path / folder).mkdir(parents=True)
        (tmp_path / folder / "run.erd").touch()
    for name in ("tree", "other"):
        (tmp_path / "tree" / "x" / name).symlink_to(tmp_path / name)
    assert matches(tmp_path / "tree", text) == ["x/run.erd"]


@pytest.mark.posix
@pytest.mark.parametrize("depth", [1, 2, 5, 30])
def test_a_ring_of_links_is_gone_round_once(tmp_path: Path, depth: int) -> None:
    for name in ("one", "two"):
        (tmp_path / name).symlink_to(tmp_path)
    (tmp_path / "run.erd").touch()
    names = ("*",) * depth + ("*.erd",)
    assert list(find_matches(tmp_path, names, CountedListing(""))) == [
        tmp_path.joinpath(*["one"] * depth, "run.erd")
    ]


@pytest.mark.posix
def test_a_folder_has_the_name_without_links(tmp_path: Path) -> None:
    (tmp_path / "road").mkdir()
    (tmp_path / "road" / "run.erd").touch()
    (tmp_path / "a").symlink_to("road")
    assert matches(tmp_path, "*/*.erd") == ["road/run.erd"]
