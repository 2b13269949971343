"""A file that changes while it is read is a row that says so, not a profile of two states."""

import os
from pathlib import Path
from typing import Any

import pytest

from floatref.batch import Job
from floatref.batch.work import task
from floatref.batch.work.task import run_job

READ = {
    "directory": ["run/left.height.f64", "run/recording.json"],
    "native": ["run.csv"],
    "mapped": ["mapped/run.csv", "mapped/laser.csv", "mapped/map.toml"],
}
ALL = [(kind, name) for kind, names in READ.items() for name in names]


def changing(monkeypatch: pytest.MonkeyPatch, path: Path) -> None:
    """Let ``path`` be written anew, to the same length, once it was read."""
    real = task.make_profile

    def then_changed(*arguments: Any) -> Any:
        content = path.read_bytes()
        path.write_bytes(content)
        os.utime(path, ns=(1, 1))
        return real(*arguments)

    monkeypatch.setattr(task, "make_profile", then_changed)


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "name"), ALL)
def test_what_changes_while_it_is_read_is_said(
    jobs: dict[str, Job], folder: Path, monkeypatch: pytest.MonkeyPatch, kind: str, name: str
) -> None:
    with monkeypatch.context() as patched:
        changing(patched, folder / name)
        record = run_job(jobs[kind])
    assert record.error.startswith(f"{folder / name}: changed while it was read")
    assert not jobs[kind].profile.exists()
    assert run_job(jobs[kind], resume=True).error == ""


def test_what_is_not_read_may_change(
    jobs: dict[str, Job], folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    changing(monkeypatch, folder / "run.csv")
    assert run_job(jobs["directory"]).error == ""
    assert run_job(jobs["mapped"]).error == ""
