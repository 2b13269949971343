"""Jobs on a cluster of two processes: one record for each, whatever becomes of its worker."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.posix]

SCRIPT = """
import json
import os
import signal
import sys
from pathlib import Path

from floatref.batch.work.cluster import LOCAL, connect
from floatref.batch.jobs.job import Job
from floatref.batch.work.worker_patience import patient
from floatref.batch.results.record import Record
from floatref.batch.work.running import run_jobs
from floatref.batch.work.worker_patience import silence


def task(job, resume):
    with open(job.out / "started", "a") as stream:
        stream.write(job.name + " ")
    print("a library talks of", job.name)
    if job.name == "deadly":
        os.kill(os.getpid(), signal.SIGKILL)
    if job.name == "raises":
        raise ValueError("odd\\nfile")
    return Record(job.name, str(job.source), skipped=resume)


def jobs(out, sizes):
    return [Job(out / name, name, out, size_bytes=size) for name, size in sizes.items()]


def all_kinds(out, client):
    ordinary = {f"r{index:02d}": index for index in range(16)}
    return run_jobs(client, jobs(out, {**ordinary, "deadly": 100, "raises": 5}), False, task)


def few(out, client):
    return run_jobs(client, jobs(out, {"small": 1, "deadly": 2}), True, task)


def cancelled(out, client):
    from distributed import Future

    for job, record in run_jobs(client, jobs(out, {f"r{i}": i for i in range(40)}), False, task):
        client.cancel([Future(key, client) for key in list(client.futures)])
        yield job, record


def cancelled_and_deserted(out, client):
    yield from cancelled(out, client)
    # What is begun and what waits, with nobody left to do it.
    client.cluster.scale(0)
    with patient(client, patience_s=0.5):
        yield from run_jobs(client, jobs(out, {f"d{i}": i for i in range(4)}), False, task)


if __name__ == "__main__":
    out = Path(sys.argv[1])
    LOCAL["distributed.scheduler.allowed-failures"] = int(sys.argv[4])
    with silence(), connect(out, int(sys.argv[3])) as client:
        found = list(globals()[sys.argv[2]](out, client))
    assert all(job.name == record.name for job, record in found)
    lines = [[r.name, r.error, r.skipped] for _, r in found]
    print(json.dumps(lines))
"""


def run(out: Path, case: str, workers: int = 2, deaths: int = 1) -> list[list[Any]]:
    """Return name, error and whether it was skipped of every record of ``case``."""
    (out / "script.py").write_text(SCRIPT, encoding="utf-8")
    command = [sys.executable, str(out / "script.py"), str(out), case, str(workers), str(deaths)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=900)
    assert (done.returncode, done.stderr) == (0, "")
    found: list[list[Any]] = json.loads(done.stdout)
    return found


@pytest.fixture(scope="module")
def kinds(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[list[Any]]]:
    out = tmp_path_factory.mktemp("kinds")
    return out, run(out, "all_kinds")


def test_every_job_has_one_record(kinds: tuple[Path, list[list[Any]]]) -> None:
    names = [f"r{index:02d}" for index in range(16)]
    assert sorted(name for name, *_ in kinds[1]) == sorted([*names, "deadly", "raises"])


def test_only_files_that_are_to_blame_fail(kinds: tuple[Path, list[list[Any]]]) -> None:
    errors = {name: error for name, error, _ in kinds[1] if error}
    assert set(errors) == {"deadly", "raises"}
    assert errors["raises"] == "ValueError: odd file"
    assert "the worker ended 2 times while it processed this file alone" in errors["deadly"]


def test_a_deadly_file_leaves_its_record(kinds: tuple[Path, list[list[Any]]]) -> None:
    from floatref.batch.results.record import read_record

    assert "worker ended" in read_record(kinds[0] / "records" / "deadly.json").error


def test_what_waits_beside_a_deadly_file_is_not_blamed(tmp_path: Path) -> None:
    # Both are given to the worker at once, and its first death is held against both.
    found = {n: (error, skipped) for n, error, skipped in run(tmp_path, "few", 1, deaths=0)}
    assert "worker ended 1 times" in found.pop("deadly")[0]
    assert found == {"small": ("", True)}
    begun = (tmp_path / "started").read_text(encoding="ascii").split()
    # The largest first, then each of them alone.
    assert begun[0] == "deadly"
    assert sorted(begun[1:]) == ["deadly", "small"]


def test_what_the_cluster_drops_or_nobody_does_is_a_record_as_well(tmp_path: Path) -> None:
    found = run(tmp_path, "cancelled_and_deserted")
    names = [*(f"d{index}" for index in range(4)), *(f"r{index}" for index in range(40))]
    assert sorted(name for name, *_ in found) == sorted(names)
    lost = "the cluster was lost before this file was done; go on with --resume"
    assert {error for _, error, *_ in found if error} == {lost}
    assert all(error for name, error, _ in found if name.startswith("d"))
