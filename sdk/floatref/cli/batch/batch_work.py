"""The work of `floatref batch`: open folder and cluster, process all files, write one summary."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from time import monotonic
from typing import Any

import click

from floatref.batch.jobs.defaults import Defaults
from floatref.batch.jobs.inputs import Found
from floatref.batch.jobs.job import Job
from floatref.batch.results.batch_document import (
    Command,
    Finished,
    batch_document,
    write_batch_document,
)
from floatref.batch.results.folder import is_worked_in, not_given, prepare_folder
from floatref.batch.results.record import Returned, returned_records
from floatref.batch.results.segment_layer import write_segment_layer
from floatref.batch.results.summary import write_summary
from floatref.batch.results.totals import Tally
from floatref.batch.work.cluster import connect, count_workers
from floatref.batch.work.running import run_jobs
from floatref.batch.work.worker_patience import patient, silence
from floatref.cli.batch.batch_report import progress, tell_remarks, tell_warnings


@dataclass(frozen=True)
class Work:
    """The arguments of the command, as given."""

    given: Sequence[str]
    defaults: Defaults
    out: Path
    resume: bool
    jobs: int | None
    cluster: str | None
    plot: Path | None
    gis: tuple[Path, ...] = ()
    unencrypted: bool = False

    @property
    def command(self) -> Command:
        """Return the command as stored in batch.json."""
        options = asdict(self.defaults)
        chart = options.pop("channel_map")
        return Command(
            self.given,
            {
                **options,
                "map": None if chart is None else str(chart),
                "jobs": self.jobs,
                "cluster": self.cluster,
                "resume": self.resume,
                "gis": list(map(str, self.gis)),
            },
        )


def work_through(found: Found, work: Work, tally: Tally) -> dict[str, Any]:
    """Process the files ``found``, count them in ``tally``, and return the content of batch.json.

    Raises InputError for a folder or a cluster that cannot be used.
    """
    with prepare_folder(work.out, work.resume), returned_records(work.out) as returned:
        workers = _process(found.jobs, work, tally, returned)
        wall_s = monotonic() - tally.began_s
        gone = not_given(work.out, found.jobs)
        tell_remarks(found.passed_over, gone)
        tell_warnings(tally)
        write_summary(returned.of(found.jobs), work.out, work.defaults.measures)
        finished = Finished(wall_s, workers, found.passed_over, gone)
        document = batch_document(work.command, tally, finished)
        write_batch_document(document, work.out)
        for layer in work.gis:
            count = write_segment_layer(
                returned.of(found.jobs), work.defaults.measures, layer, overwrite=True
            )
            click.echo(f"{layer}: {count}", err=True)
        if work.plot is not None:
            _draw(work.out, work.plot)
    return document


def _process(jobs: Sequence[Job], work: Work, tally: Tally, returned: Returned) -> int:
    """Fill ``tally`` and ``returned``; return the number of workers."""
    with (
        silence() as shown,
        connect(work.out, work.jobs, work.cluster, work.unencrypted) as client,
        patient(client, is_busy=_busy(work)) as lost,
    ):
        workers = count_workers(client)
        tally.begin(jobs, monotonic())
        with progress(tally, shown, lambda: count_workers(client)) as tell:
            for job, record in run_jobs(client, jobs, work.resume, lost=lost):
                tally.add(job, record)
                returned.add(record)
                tell()
        return max(workers, count_workers(client))


def _busy(work: Work) -> Callable[[], bool]:
    """Return a function that says whether a task is being done, as far as that can be known.

    The locks of another machine's tasks need not be seen here.
    """
    return (lambda: True) if work.cluster else partial(is_worked_in, work.out)


def _draw(out: Path, plot: Path) -> None:
    from floatref.batch.results.summary import read_columns
    from floatref.plots import SUMMARY_COLUMNS, draw_summary

    draw_summary(read_columns(out, SUMMARY_COLUMNS), plot)
