"""A cluster that is lost takes no file with it that was done."""

from dataclasses import dataclass
from typing import Any

import pytest

from floatref.batch import Job
from floatref.batch.results.record import Record
from floatref.batch.work.running import LOST, _record
from floatref.batch.work.task import run_job


@dataclass
class Again:
    """What a client has of a task whose worker took the result with it; it is done once more."""

    record: Record
    status: str = "lost"

    def result(self) -> Any:
        self.status = "finished"
        return self.record


@dataclass
class Gone:
    """What a client has of a task after the scheduler died."""

    status: str

    def result(self) -> Any:
        raise OSError("connection closed")


@pytest.mark.slow
@pytest.mark.parametrize("status", ["cancelled", "lost", "finished"])
@pytest.mark.parametrize("resume", [False, True])
def test_a_file_is_done_if_its_task_has_written_so(
    jobs: dict[str, Job], status: str, resume: bool
) -> None:
    job = jobs["native"]
    assert _record(job, Gone(status), resume).error == LOST
    written = run_job(job)
    found = _record(job, Gone(status), resume)
    assert (found.error, found.skipped) == ("", resume)
    assert (found.outputs, len(found.rows)) == (written.outputs, len(written.rows))


@pytest.mark.slow
def test_what_an_earlier_command_wrote_of_other_bytes_does_not_count(jobs: dict[str, Job]) -> None:
    job = jobs["native"]
    run_job(job)
    job.source.write_bytes(job.source.read_bytes() + b"\n")
    assert _record(job, Gone("cancelled"), True).error == LOST


def test_what_failed_before_does_not_count(jobs: dict[str, Job]) -> None:
    job = jobs["native"]
    job.source.write_bytes(b"")
    assert run_job(job).error
    assert _record(job, Gone("cancelled"), True).error == LOST


def test_what_a_worker_took_with_it_is_waited_for(jobs: dict[str, Job]) -> None:
    record = Record("a/run.csv", "/in/run.csv")
    assert _record(jobs["native"], Again(record), False) is record
