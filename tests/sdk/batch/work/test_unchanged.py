"""What is done is kept for as long as nothing that it depends on has changed."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from floatref.batch import Job
from floatref.batch.results.record import read_record
from floatref.batch.work import task, unchanged
from floatref.batch.work.task import run_job


class Counted:
    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.count = 0
        original = task.make_profile

        def make_profile(*args: Any) -> Any:
            self.count += 1
            return original(*args)

        monkeypatch.setattr(task, "make_profile", make_profile)


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> Counted:
    return Counted(monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["directory", "native", "mapped"])
def test_nothing_is_processed_again_if_nothing_has_changed(
    jobs: dict[str, Job], counted: Counted, kind: str
) -> None:
    first = run_job(jobs[kind])
    again = run_job(jobs[kind], resume=True)
    assert again == replace(first, skipped=True)
    assert counted.count == 1
    run_job(jobs[kind])
    assert counted.count == 2


def flip(path: Path) -> None:
    """Change the last digit or byte of ``path``, which stays as long."""
    content = bytearray(path.read_bytes())
    at = max(k for k, byte in enumerate(content) if not chr(byte).isspace())
    content[at] ^= 1
    path.write_bytes(content)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("directory", "run/right.height.f64"),
        ("directory", "run/gnss_latitude.f64"),
        ("native", "run.csv"),
        ("mapped", "mapped/run.csv"),
        ("mapped", "mapped/laser.csv"),
        ("native", "out/profiles/a/run.csv/left.f64"),
        ("native", "out/profiles/a/run.csv/right.valid.u8"),
        ("native", "out/profiles/a/run.csv/profile.json"),
    ],
)
def test_one_byte_of_an_input_or_output_is_enough(
    jobs: dict[str, Job], folder: Path, counted: Counted, kind: str, name: str
) -> None:
    run_job(jobs[kind])
    flip(folder / name)
    assert not run_job(jobs[kind], resume=True).skipped
    # Bytes that make a file unreadable end the work before it is processed.
    assert counted.count == 2 or read_record(jobs[kind].record).error


@pytest.mark.slow
def test_a_comment_in_the_map_is_enough(jobs: dict[str, Job], counted: Counted) -> None:
    job = jobs["mapped"]
    run_job(job)
    assert job.channel_map is not None
    job.channel_map.write_text(job.channel_map.read_text() + "# checked\n")
    assert not run_job(job, resume=True).skipped
    assert counted.count == 2


@pytest.mark.slow
@pytest.mark.parametrize("name", ["left.f64", "profile.json"])
def test_an_output_that_is_gone_is_made_again(
    jobs: dict[str, Job], counted: Counted, name: str
) -> None:
    run_job(jobs["native"])
    (jobs["native"].profile / name).unlink()
    assert not run_job(jobs["native"], resume=True).skipped
    assert (jobs["native"].profile / name).exists()
    assert counted.count == 2


@pytest.mark.slow
@pytest.mark.parametrize("spoil", [Path.unlink, flip, lambda p: p.write_text("")])
def test_a_record_that_is_gone_or_damaged_is_made_again(
    jobs: dict[str, Job], spoil: Callable[[Path], object]
) -> None:
    first = run_job(jobs["native"])
    spoil(jobs["native"].record)
    again = run_job(jobs["native"], resume=True)
    assert not again.skipped
    assert replace(again, effort=first.effort) == first


@pytest.mark.slow
@pytest.mark.parametrize(
    "change",
    [
        {"pipeline": "temporal-hpf"},
        {"settings": {"cutoff_wavelength_m": 91.0}},
        {"adapter": "csv"},
    ],
)
def test_another_wish_is_another_profile(
    jobs: dict[str, Job], counted: Counted, change: dict[str, Any]
) -> None:
    run_job(jobs["native"])
    changed = replace(jobs["native"], **change)
    assert not run_job(changed, resume=True).skipped
    assert run_job(changed, resume=True).skipped
    assert counted.count == 2


@pytest.mark.slow
@pytest.mark.parametrize("library", ["floatref", *unchanged.LIBRARIES])
def test_another_version_does_the_work_again(
    jobs: dict[str, Job], counted: Counted, monkeypatch: pytest.MonkeyPatch, library: str
) -> None:
    run_job(jobs["native"])
    changed = {**unchanged.versions(), library: "999"}
    monkeypatch.setattr(unchanged, "versions", lambda: changed)
    assert not run_job(jobs["native"], resume=True).skipped
    assert counted.count == 2


@pytest.mark.posix
@pytest.mark.slow
def test_a_link_that_leads_elsewhere_is_another_input(
    jobs: dict[str, Job], folder: Path, counted: Counted
) -> None:
    link = folder / "link.csv"
    link.symlink_to(folder / "run.csv")
    job = replace(jobs["native"], source=link)
    run_job(job)
    link.unlink()
    (folder / "other.csv").write_bytes((folder / "run.csv").read_bytes())
    link.symlink_to(folder / "other.csv")
    assert not run_job(job, resume=True).skipped
    assert counted.count == 2


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["directory", "mapped"])
def test_another_segment_measures_anew_and_processes_nothing(
    jobs: dict[str, Job], counted: Counted, kind: str
) -> None:
    job = jobs[kind]
    run_job(replace(job, segment_m=30.0))
    kept = run_job(replace(job, segment_m=45.0), resume=True)
    assert (counted.count, kept.skipped) == (1, True)
    assert read_record(job.record) == replace(kept, skipped=False)
    fresh = run_job(replace(job, segment_m=45.0))
    assert kept.rows == fresh.rows
    assert len(fresh.rows) == 8
    assert (kept.key, kept.warnings, kept.remarks) == (fresh.key, fresh.warnings, fresh.remarks)


def test_what_failed_is_always_tried_again(jobs: dict[str, Job], counted: Counted) -> None:
    job = replace(jobs["native"], settings={"cutoff_wavelength_m": -1.0})
    for _ in range(2):
        assert run_job(job, resume=True).error
    assert counted.count == 2


def test_a_new_file_in_a_native_folder_is_another_input(
    folder: Path, recording: Any, know: Callable[[object], None]
) -> None:
    class Vendor:
        name, summary = "vendor", "of a plug-in"

        def recognises(self, source: Path) -> bool:
            return source.name == "native"

        def read(self, source: Path) -> Any:
            return recording

    know(Vendor())
    native = folder / "native"
    native.mkdir()
    (native / "one.bin").write_bytes(b"1")
    job = Job(native, "native", folder / "out")
    assert run_job(job).error == ""
    assert run_job(job, resume=True).skipped
    (native / "two.bin").write_bytes(b"2")
    assert not run_job(job, resume=True).skipped
