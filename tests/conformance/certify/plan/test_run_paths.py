"""Runs on the command line and in a plan: what is one, each once, and under which name."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files.search import counted_listing
from floatref_conformance.certify.plan.run_paths import check_exists, names_of, natural, runs_of


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A directory of runs of every kind, with what lies beside runs."""
    for name in ("run-10.erd", "run-2.erd", "run-2.bin", "notes.md", ".hidden.erd", "map.toml"):
        (tmp_path / name).touch()
    for name, document in (("profile-1", "profile.json"), ("stop_0.20g", "recording.json")):
        (tmp_path / name).mkdir()
        (tmp_path / name / document).touch()
        (tmp_path / name / "left.f64").touch()
    (tmp_path / "more").mkdir()
    (tmp_path / "more" / "run-1.csv").touch()
    (tmp_path / "empty").mkdir()
    return tmp_path


def found(folder: Path, *texts: str) -> list[str]:
    return [path.relative_to(folder).as_posix() for path in runs_of(texts, folder)]


def test_a_directory_is_searched_for_runs_in_the_order_people_count(folder: Path) -> None:
    assert found(folder, ".") == [
        "more/run-1.csv",
        "profile-1",
        "run-2.erd",
        "run-10.erd",
        "stop_0.20g",
    ]


def test_a_pattern_that_the_shell_left_is_one(folder: Path) -> None:
    assert found(folder, "run-*.erd") == ["run-2.erd", "run-10.erd"]
    assert found(folder, "**/*.csv") == ["more/run-1.csv"]
    assert found(folder, "*-1") == ["profile-1"]


def test_the_json_file_of_a_directory_is_the_directory(folder: Path) -> None:
    given_twice = found(folder, "profile-1/profile.json", "stop_0.20g/recording.json", "profile-1")
    assert given_twice == ["profile-1", "stop_0.20g"]


def test_a_file_that_is_named_is_a_run_whatever_it_is_called(folder: Path) -> None:
    assert found(folder, "notes.md") == ["notes.md"]


def test_a_name_with_the_signs_of_a_pattern_can_be_given(folder: Path) -> None:
    (folder / "run[1].erd").touch()
    assert found(folder, "run[1].erd") == ["run[1].erd"]


@pytest.mark.posix
@pytest.mark.parametrize("link", ["again.erd", "./run-2.erd"])
def test_a_run_that_is_reached_twice_is_one(folder: Path, link: str) -> None:
    (folder / "again.erd").symlink_to(folder / "run-2.erd")
    assert found(folder, "run-2.erd", link) == ["run-2.erd"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("run-3.erd", "run-3.erd: not found"),
        ("run-9*.erd", "no file matches"),
        ("empty", "empty: holds no run"),
        ("a\0b", "not found"),
        ("x" * 5000, "not found"),
    ],
)
def test_what_is_not_there_is_refused(folder: Path, text: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        runs_of(["run-2.erd", text], folder)


def test_a_source_that_is_there(folder: Path) -> None:
    assert check_exists("stop_0.20g/recording.json", folder) == folder / "stop_0.20g"
    with pytest.raises(InputError, match="nowhere: not found"):
        check_exists("nowhere", folder)


@pytest.mark.parametrize(
    ("paths", "names"),
    [
        (["/a/run-1.erd", "/a/stop_0.20g"], ("run-1", "stop_0.20g")),
        (["/a/run.erd", "/a/run.csv"], ("run.erd", "run.csv")),
        (["/a/1/run.erd", "/a/2/run.erd"], ("1/run.erd", "2/run.erd")),
        (["/a/1/x/run", "/b/1/x/run"], ("a/1/x/run", "b/1/x/run")),
        (["/a/run", "/run"], ("a/run", "run")),
        ([], ()),
    ],
)
def test_names_are_as_short_as_they_can_be(paths: list[str], names: tuple[str, ...]) -> None:
    assert names_of([Path(path) for path in paths]) == names


PARTS = st.lists(st.sampled_from(["a", "b", "run.erd", "run.csv", "1"]), min_size=1, max_size=4)


@given(st.lists(PARTS, unique_by=tuple, max_size=6))
def test_different_paths_never_share_a_name(parts: list[list[str]]) -> None:
    paths = [Path("/", *names) for names in parts]
    names = names_of(paths)
    assert len(set(names)) == len(paths)
    assert all(path.as_posix().find(name) > 0 for path, name in zip(paths, names, strict=True))


@given(st.lists(st.integers(0, 2000), unique=True))
def test_numbers_in_names_count_as_numbers(numbers: list[int]) -> None:
    names = sorted((f"run-{number}.erd" for number in numbers), key=natural)
    assert names == [f"run-{number}.erd" for number in sorted(numbers)]


@pytest.mark.posix
def test_a_link_to_nothing_is_a_run_that_will_tell_so(folder: Path) -> None:
    (folder / "more" / "run-2.csv").symlink_to("gone.csv")
    assert found(folder, "more") == ["more/run-1.csv", "more/run-2.csv"]


def test_an_empty_word_is_no_path(folder: Path) -> None:
    with pytest.raises(InputError, match="a path is empty"):
        runs_of([""], folder)


def test_a_name_stays_on_one_line() -> None:
    assert names_of([Path("a/new\nline.erd"), Path("a/tab\there")]) == ("new line", "tab here")


@pytest.mark.parametrize("text", ["**/*", "*/**/none", ".", "[a-b]", "*/*", "a/*.csv"])
def test_a_search_through_too_many_names_is_refused(tmp_path, monkeypatch, text):
    monkeypatch.setattr(counted_listing, "MOST", 5)
    (tmp_path / "a").mkdir()
    for number in range(6):
        (tmp_path / "a" / f"{number}.csv").touch()
    with pytest.raises(InputError, match=rf"^{re.escape(text)}: more than 5 files and folders to"):
        runs_of([text], tmp_path)
    monkeypatch.setattr(counted_listing, "MOST", 6)
    assert len(runs_of(["a/*.csv"], tmp_path)) == 6
