"""Wrong usage of a batch: one clear line each, before any work."""

import os
from pathlib import Path

import pytest

from floatref.batch.jobs.inputs import Defaults, find_jobs
from floatref.errors import InputError
from floatref.files.search import counted_listing


@pytest.mark.posix
@pytest.mark.parametrize(
    ("given", "options", "said"),
    [
        ("no.mf4", {}, "no.mf4: not found"),
        ("no*.mf4", {}, r"no\*.mf4: matches no recording"),
        ("a**/x", {}, r"\*\*"),
        ("profiles", {}, "profiles: no recording in it"),
        ("profiles/p", {}, "profiles/p: no recording in it"),
        ("csv", {"pipeline": "no"}, "pipeline no: unknown"),
        (
            "csv",
            {"settings": {"no": 1.0}},
            "settings no: no pipeline of `auto` has them all",
        ),
        ("csv", {"adapter": "no"}, "adapter no: unknown"),
        ("csv", {"channel_map": Path("no.toml")}, "no.toml: No such file"),
        ("csv", {"channel_map": Path("no.toml"), "adapter": "recording"}, "leave the map out"),
        ("csv", {"segment_m": 0.0}, "segment 0.0 m: must be above zero"),
        ("csv", {"segment_m": float("nan")}, "segment nan m"),
        ("csv", {"segment_m": float("inf")}, "segment inf m"),
        ("pipe", {}, "pipe: is a device or pipe"),
    ],
)
def test_wrong_usage_is_one_line_before_any_work(tree, find, given, options, said):
    os.mkfifo(tree / "pipe")
    with pytest.raises(InputError, match=said) as caught:
        find(tree / given, **options)
    assert "\n" not in str(caught.value)


def test_an_empty_list_and_an_empty_argument_are_told(tree, find):
    (tree / "list").write_text("file\n")
    with pytest.raises(InputError, match="no recording was found"):
        find(tree / "list")
    with pytest.raises(InputError, match="'': not found"):
        find("")


def test_one_file_in_two_ways_is_refused(tree, find):
    (tree / "list").write_text("file,pipeline\ncsv/run.csv,temporal-hpf\n")
    with pytest.raises(InputError, match=r"run.csv: given twice, with different options"):
        find(tree / "csv", tree / "list")


@pytest.mark.parametrize("name", ["csv", "csv/run.csv", "csv/ours"])
def test_what_lies_in_the_output_is_no_source(tree, name):
    (tree / "csv" / "ours").mkdir()
    with pytest.raises(InputError, match="is, or lies in, the folder of --out"):
        find_jobs([str(tree / name)], tree / "csv", Defaults())


def test_a_manifest_is_named_once(tree, find):
    (tree / "list.csv").write_text("file,colour\ncsv/run.csv,red\n")
    with pytest.raises(InputError) as caught:
        find(tree / "list.csv")
    assert str(caught.value).count("list.csv") == 1


def test_a_folder_that_cannot_be_listed_is_told(tree, find, monkeypatch):
    real = os.scandir

    def refusing(path: str | Path) -> object:
        if Path(path).name == "csv":
            raise PermissionError(13, "Permission denied", str(path))
        return real(path)

    monkeypatch.setattr(os, "scandir", refusing)
    with pytest.raises(InputError, match="csv: Permission denied; make it readable"):
        find(tree)


@pytest.mark.parametrize("pattern", ["**/*.nope", "*/*/*/*.nope", "*", "csv/*"])
def test_a_pattern_that_leads_through_too_much_is_refused(tree, find, monkeypatch, pattern):
    monkeypatch.setattr(counted_listing, "MOST", 8)
    for number in range(9):
        (tree / "csv" / f"{number}.md").touch()
    with pytest.raises(InputError) as caught:
        find(tree / pattern)
    assert str(caught.value) == (
        f"{tree / pattern}: more than 8 files and folders to look at; name a folder nearer to the "
        "files, or the files themselves"
    )
