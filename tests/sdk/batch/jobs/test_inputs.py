"""Sources: every recording of a tree once, and nothing that is none."""

import os
import shutil
from pathlib import Path

import pytest

from floatref.batch.jobs.inputs import Defaults, Found, find_jobs
from floatref.values.recording import Recording
from floatref_adapters.testing import WRITERS

MAP = """format = "floatref-map/1"
[[files]]
name = "gnss"
path = "gnss.csv"
[source]
dbc = "names.csv"
[[channels]]
native = "a"
channel = "height"
"""


def names(found: Found) -> list[str]:
    return [job.name for job in found.jobs]


def test_a_tree_gives_every_recording_and_passes_over_the_rest(tree, find):
    found = find(tree)
    runs = {f"{suffix[1:]}/run{suffix}" for suffix in WRITERS}
    assert set(names(found)) == runs | {"ours/run", "run.txt", "damaged.mf4"}
    assert names(found) == sorted(names(found), key=lambda name: name.split("/"))
    passed = {str(path.relative_to(tree)) for path in found.passed_over}
    suffixes = ("", ".csv", ".erd", ".txt", ".parquet")
    profiles = {f"profiles/p{suffix}" for suffix in suffixes}
    assert passed == profiles | {"notes.md", "readme.txt", "list.csv"}


def test_a_job_knows_where_its_source_is_and_how_large(tree, find, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = find("tree/ours/run", "tree/csv/run.csv", segment_m=100.0, pipeline="temporal-hpf")
    folder, table = found.jobs
    assert folder.source == tree / "ours" / "run"
    assert folder.size_bytes == sum(f.stat().st_size for f in (tree / "ours/run").iterdir())
    assert find("tree/ours/run/recording.json").jobs[0].size_bytes == folder.size_bytes
    assert table.source == tree / "csv" / "run.csv"
    assert table.size_bytes == (tree / "csv" / "run.csv").stat().st_size
    for job in found.jobs:
        assert (job.out, job.segment_m, job.pipeline) == (tmp_path / "out", 100.0, "temporal-hpf")
        assert job.profile.is_relative_to(tmp_path / "out")


@pytest.mark.posix
def test_every_way_to_a_source_leads_to_one_job(tree, find):
    run = tree / "ours" / "run"
    (tree / "link.csv").symlink_to(tree / "csv" / "run.csv")
    ways = [run, run / "recording.json", tree / "ours", tree / "ours/*/recording.json"]
    assert names(find(*ways)) == ["run"]
    assert names(find(*reversed(ways))) == ["run"]
    found = find(tree / "csv" / "run.csv", tree / "csv/../csv/run.csv", tree / "link.csv")
    assert names(found) == ["run.csv"]


@pytest.mark.posix
def test_links_to_folders_are_not_followed(tree, find):
    (tree / "ours" / "loop").symlink_to(tree, target_is_directory=True)
    found = find(tree / "ours")
    assert names(found) == ["run"]
    assert found.passed_over == (tree / "ours" / "loop",)


def test_the_output_and_that_of_other_batches_are_not_searched(tree, find, tmp_path):
    for name in ("profiles", "records"):
        (tree / "old" / name).mkdir(parents=True)
    (tree / "old" / ".lock").touch()
    shutil.copy(tree / "csv" / "run.csv", tree / "old" / "profiles" / "run.csv")
    before = names(find(tree))
    assert not [name for name in before if name.startswith("old")]
    out = tree / "new"
    shutil.copytree(tree / "csv", out)
    assert names(find_jobs([str(tree)], out, Defaults())) == before
    for pattern in ("*", "**/*.csv"):
        found = find_jobs([str(tree / pattern)], out, Defaults())
        assert not [name for name in names(found) if name.startswith("new")]
    assert "new/run.csv" in names(find(tree))


@pytest.mark.parametrize(
    ("pattern", "expected"),
    [
        ("**/*.mf4", ["damaged.mf4", "mf4/run.mf4"]),
        ("*/run.[ch]*", ["csv/run.csv", "h5/run.h5"]),
        ("ours/*", ["run"]),
        ("ours/*/*", ["run"]),
        ("csv*", ["csv/run.csv"]),
        (".h*", [".hidden.csv"]),
        ("notes.m?", ["notes.md"]),
    ],
)
def test_patterns_are_expanded_and_named_below_their_fixed_part(tree, find, pattern, expected):
    wanted = [name.replace(".hidden", "_hidden") for name in expected]
    assert names(find(tree / pattern)) == wanted


def test_two_stars_find_in_folders_what_is_found_there_without(tree, find):
    shutil.copy(tree / "notes.md", tree / "csv" / "notes.md")
    below = [name for name in names(find(tree)) if "/" in name]
    assert [name for name in names(find(tree / "**/*")) if "/" in name] == below


def test_an_existing_name_with_brackets_is_no_pattern(tree, find):
    shutil.copy(tree / "csv" / "run.csv", tree / "run[1].csv")
    assert names(find(tree / "run[1].csv")) == ["run[1].csv"]


def test_a_manifest_gives_what_it_names_even_what_is_missing(tree, find):
    text = "file,pipeline\ncsv/run.csv,\nno.mf4,temporal-hpf\nours,\nnotes.md,\nprofiles/p,\n"
    (tree / "list").write_text(text)
    found = find(tree / "list")
    expected = ["csv/run.csv", "no.mf4", "ours/run", "notes.md", "profiles/p"]
    assert names(found) == expected
    assert [job.pipeline for job in found.jobs][1] == "temporal-hpf"
    assert found.jobs[1].size_bytes == 0
    assert found.passed_over == ()


def test_files_of_one_name_are_told_apart(tree, find, tmp_path):
    other = tmp_path / "other"
    shutil.copytree(tree / "csv", other)
    found = find(tree / "csv", other, tree / "h5" / "run.h5")
    assert len(set(names(found))) == 3
    assert names(found)[2] == "run.h5"
    assert sorted(names(find(other, tree / "h5" / "run.h5", tree / "csv"))) == sorted(names(found))


def test_files_of_the_map_belong_to_other_sources(tree, find):
    for name in ("gnss.csv", "names.csv"):
        shutil.copy(tree / "csv" / "run.csv", tree / "csv" / name)
    chart = tree / "csv" / "map.toml"
    chart.write_text(MAP)
    for given in (tree / "csv", tree / "csv/*.*"):
        found = find(given, channel_map=chart)
        assert names(found) == ["run.csv"]
        assert found.jobs[0].channel_map == chart
        assert found.passed_over == ()
    assert [job.channel_map for job in find(tree / "ours", channel_map=chart).jobs] == [None]


def test_a_named_adapter_reads_its_own_and_what_nobody_recognises(tree, find):
    found = find(tree, adapter="mdf4")
    assert names(found) == ["damaged.mf4", "mf4/run.mf4"]
    assert tree / "ours" / "run" in found.passed_over
    assert names(find(tree / "notes.md", adapter="mdf4")) == ["notes.md"]


def test_the_adapter_of_the_map_is_for_files(tree, find):
    chart = tree / "map.toml"
    chart.write_text(MAP.replace("[source]", '[source]\nadapter = "mdf4"'))
    assert names(find(tree, channel_map=chart)) == ["damaged.mf4", "mf4/run.mf4", "ours/run"]


@pytest.mark.slow
def test_a_folder_that_an_adapter_recognises_is_one_source(tree, find, know):
    class Vendor:
        name, summary = "vendor", "folders of a vendor"

        def recognises(self, source: Path) -> bool:
            return source.suffix == ".run"

        def read(self, source: Path) -> Recording:
            raise NotImplementedError

    know(Vendor())
    (tree / "ours" / "a.run" / "deep").mkdir(parents=True)
    (tree / "ours" / "a.run" / "deep" / "x.csv").write_text("abc")
    found = find(tree / "ours")
    assert names(found) == ["a.run", "run"]
    assert found.jobs[0].size_bytes == 3


@pytest.mark.posix
def test_a_pipe_in_a_tree_is_not_waited_for(tree, find):
    os.mkfifo(tree / "csv" / "pipe.csv")
    found = find(tree / "csv")
    assert names(found) == ["run.csv"]
    assert found.passed_over == (tree / "csv" / "pipe.csv",)


@pytest.mark.posix
def test_a_link_that_leads_nowhere_is_a_source_that_cannot_be_read(tree, find):
    (tree / "csv" / "gone.mf4").symlink_to(tree / "nowhere.mf4")
    assert names(find(tree / "csv")) == ["gone.mf4", "run.csv"]


@pytest.mark.posix
def test_a_ring_of_links_is_a_source_that_cannot_be_read(tree, find):
    for one, other in (("a.csv", "b.csv"), ("b.csv", "a.csv"), ("a", "a")):
        (tree / "ours" / one).symlink_to(other)
    found = find(tree / "ours")
    assert names(found) == ["a.csv", "b.csv", "run"]
    assert found.passed_over == (tree / "ours" / "a",)
