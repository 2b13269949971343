"""One task: its profile is that of `floatref process`, and it is all or nothing."""

import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from floatref.batch import Job
from floatref.batch.results.record import Effort, Record, read_record, write_record
from floatref.batch.work import task
from floatref.batch.work.task import run_job
from floatref.cli.main import main
from floatref.engine.choosing import AUTO
from floatref.errors import PluginError
from floatref.files import profile_directory as profile_files
from floatref.files import read_profile

KINDS = ("directory", "native", "mapped")


def content(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def without_effort(record: Record) -> Record:
    return replace(record, effort=Effort())


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("settings", [{}, {"interval_m": 0.1}])
def test_the_profile_is_that_of_process_bit_by_bit(
    jobs: dict[str, Job], folder: Path, kind: str, settings: dict[str, float]
) -> None:
    job = replace(jobs[kind], settings=settings, pipeline="temporal-hpf", segment_m=30.0)
    (folder / "settings.json").write_text(json.dumps(settings))
    more = [] if job.channel_map is None else ["--map", job.channel_map]
    args = ["process", job.source, "--out", folder / "one", "--pipeline", job.pipeline, *more]
    args += ["--settings", folder / "settings.json"]
    done = CliRunner().invoke(main, list(map(str, args)))
    assert done.exit_code == 0, done.output
    assert run_job(job).error == ""
    assert content(job.profile) == content(folder / "one")


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_what_comes_back_is_what_is_written(jobs: dict[str, Job], kind: str) -> None:
    record = run_job(jobs[kind])
    assert read_record(jobs[kind].record) == record
    assert {row.track for row in record.rows} == {"left", "right"}
    assert record.length_m == read_profile(jobs[kind].profile).length_m
    assert record.effort.bytes_in == sum(Path(p).stat().st_size for p in record.inputs)
    assert record.effort.bytes_out == sum(len(b) for b in content(jobs[kind].profile).values())
    assert record.effort.peak_bytes > 1 << 20


def test_the_record_names_the_pipeline_that_auto_has_taken_and_why(jobs: dict[str, Job]) -> None:
    record = run_job(jobs["directory"])
    profile = read_profile(jobs["directory"].profile)
    assert record.key["asked"]["pipeline"] == AUTO
    assert record.pipeline == profile.pipeline != AUTO
    assert record.key["chosen"] == profile.provenance["chosen"]["reason"]


def test_a_record_that_does_not_name_its_pipeline_still_holds(jobs: dict[str, Job]) -> None:
    job = jobs["directory"]
    made = run_job(job)
    older = {k: v for k, v in made.key.items() if k not in ("pipeline", "chosen")}
    write_record(replace(made, key=older), job.record)
    again = run_job(job, resume=True)
    assert (again.skipped, again.pipeline) == (True, AUTO)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_file_that_is_read_is_among_the_inputs(jobs: dict[str, Job], kind: str) -> None:
    job = jobs[kind]
    expected = {"directory": set(job.source.iterdir()) if kind == "directory" else set()}
    expected["native"] = {job.source}
    expected["mapped"] = set(job.source.parent.iterdir())
    assert set(map(Path, run_job(job).inputs)) == expected[kind]


@pytest.mark.slow
def test_a_task_done_twice_gives_the_same_but_for_its_effort(jobs: dict[str, Job]) -> None:
    job = replace(jobs["mapped"], segment_m=30.0)
    first, before = run_job(job), content(job.profile)
    assert without_effort(run_job(job)) == without_effort(first)
    assert content(job.profile) == before


STEPS = {
    task: (
        "make_profile",
        "measure_segments",
        "write_profile",
        "fingerprint_native",
        "write_record",
    ),
    profile_files: ("write_samples", "write_flags", "write_document"),
}


@pytest.mark.slow
@pytest.mark.parametrize("when", ["before", "after"])
@pytest.mark.parametrize(("module", "step"), [(m, step) for m in STEPS for step in STEPS[m]])
def test_an_interrupted_task_leaves_the_old_or_the_new(
    jobs: dict[str, Job], monkeypatch: pytest.MonkeyPatch, module: object, when: str, step: str
) -> None:
    old, new = jobs["directory"], replace(jobs["directory"], pipeline="temporal-hpf")
    run_job(new)
    wanted = content(new.profile)
    run_job(old)
    states = [content(old.profile), wanted]
    original = getattr(module, step)

    def interrupted(*args: object, **more: object) -> None:
        if when == "after":
            original(*args, **more)
        raise KeyboardInterrupt

    monkeypatch.setattr(module, step, interrupted)
    with pytest.raises(KeyboardInterrupt):
        run_job(new)
    assert content(new.profile) in states
    assert not list(new.out.rglob(".floatref-*"))
    assert read_record(new.record).error == ""
    monkeypatch.undo()
    assert run_job(new, resume=True).error == ""
    assert content(new.profile) == wanted
    assert run_job(new, resume=True).skipped


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-3])


DAMAGE: dict[str, tuple[str, str, Callable[[Path], object]]] = {
    "cut": ("directory", "run/left.height.f64", _cut),
    "gone": ("directory", "run/distance.f64", Path.unlink),
    "empty document": ("directory", "run/recording.json", lambda p: p.write_text("")),
    "not JSON": ("directory", "run/recording.json", lambda p: p.write_text('{"format": nul')),
    "infinite": ("directory", "run/distance.f64", lambda p: p.write_bytes(b"\0" * 6 + b"\xf0\x7f")),
    "no table": ("native", "run.csv", lambda p: p.write_bytes(bytes(range(256)))),
    "nothing": ("native", "run.csv", lambda p: p.write_bytes(b"")),
    "missing": ("native", "run.csv", Path.unlink),
    "no map": ("mapped", "mapped/map.toml", lambda p: p.write_text("format = ")),
    "no side file": ("mapped", "mapped/laser.csv", Path.unlink),
}


@pytest.mark.slow
@pytest.mark.parametrize("damage", DAMAGE)
def test_a_bad_file_is_a_record_with_one_line_and_its_old_profile_goes(
    jobs: dict[str, Job], folder: Path, damage: str
) -> None:
    kind, name, spoil = DAMAGE[damage]
    job = jobs[kind]
    run_job(job)
    spoil(folder / name)
    for resume in (False, True):
        record = run_job(job, resume)
        assert record.error
        assert record.error.isprintable()
        assert Path(name).name in record.error
        assert (record.rows, record.skipped) == ((), False)
        assert read_record(job.record) == record
        assert not job.profile.exists()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("error", "said"),
    [
        (ZeroDivisionError("a\nb"), "a fault of floatref or of a plug-in: ZeroDivisionError: a b"),
        (MemoryError(), "not enough memory"),
        (OSError(28, "No space left on device", "x.f64"), "x.f64: No space left on device"),
        (PluginError("two of them"), "two of them"),
    ],
)
def test_whatever_is_raised_is_one_line(
    jobs: dict[str, Job], monkeypatch: pytest.MonkeyPatch, error: Exception, said: str
) -> None:
    def refused(*args: object, **more: object) -> None:
        raise error

    monkeypatch.setattr(task, "write_profile", refused)
    record = run_job(jobs["native"])
    assert record.error.startswith(said)
    assert record.error.isprintable()
    assert not jobs["native"].profile.exists()


def test_an_output_that_cannot_be_written_is_an_error_of_the_record(jobs: dict[str, Job]) -> None:
    jobs["native"].out.write_text("a file where the folder should be")
    record = run_job(jobs["native"])
    assert "profiles" in record.error or "records" in record.error
    assert record.rows == ()


def test_the_profile_goes_if_its_record_cannot_be_written(jobs: dict[str, Job]) -> None:
    job = jobs["native"]
    job.record.mkdir(parents=True)
    assert "is not a file" in run_job(job).error
    assert not job.profile.exists()


def test_other_files_below_a_profile_that_goes_are_left(jobs: dict[str, Job]) -> None:
    job = jobs["native"]
    run_job(job)
    (job.profile / "notes.txt").write_text("mine")
    job.source.unlink()
    assert run_job(job).error
    assert content(job.profile) == {"notes.txt": b"mine"}


def test_what_a_plug_in_does_to_one_file_is_not_said_of_the_next(
    jobs: dict[str, Job], know: Callable[[object], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    from floatref.engine import formats

    class Fragile:
        name, summary = "fragile", "of a plug-in"

        def recognises(self, source: Path) -> bool:
            raise ValueError(f"cannot tell of {source.name}")

        def read(self, source: Path) -> None:
            raise AssertionError

    know(Fragile())
    monkeypatch.setattr(task, "plugins", formats.plugins)
    for _ in range(2):
        warnings = run_job(jobs["directory"]).warnings
        assert sum("cannot tell of run" in line for line in warnings) == 1


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the peak is that of /proc")
def test_the_peak_of_a_process_is_not_that_of_the_one_that_started_it():
    held = np.ones(80_000_000)
    code = "from floatref.batch.work.task import peak_bytes; print(peak_bytes())"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout
    assert int(found) < held.nbytes
