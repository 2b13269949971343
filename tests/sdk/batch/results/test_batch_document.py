"""batch.json: counts, and costs from which larger work is estimated."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from floatref.batch.jobs.job import Job
from floatref.batch.results.batch_document import (
    Command,
    Finished,
    batch_document,
    write_batch_document,
)
from floatref.batch.results.record import Effort, Record
from floatref.batch.results.totals import Tally
from floatref.errors import InputError

KEY = {"asked": {"pipeline": "auto"}, "pipeline": "best"}
RECORD = Record("a", "/in/a", key=KEY, length_m=2000.0, effort=Effort(9.0, 3.0, 4_000, 1_000, 77))
FINISHED = Finished(10.0, 2, [Path("/in/notes.txt")], ["z", "y"])


def tally() -> Tally:
    found = Tally()
    jobs = [Job(Path("/in", name), name, Path("/out")) for name in "abc"]
    found.begin(jobs, 0.0)
    found.add(jobs[0], RECORD)
    found.add(jobs[1], replace(RECORD, name="b", skipped=True))
    found.add(jobs[2], Record("c", "/in/c", error="damaged"))
    return found


def test_counts_and_costs_are_told(tmp_path: Path) -> None:
    document = batch_document(Command(["in"], {"jobs": 2}), tally(), FINISHED)
    place = write_batch_document(document, tmp_path)
    assert json.loads(place.read_text(encoding="ascii")) == document
    assert document["files"] == {
        "found": 3,
        "done": 2,
        "failed": 1,
        "skipped": 1,
        "passed_over": 1,
        "no_longer_given": 2,
    }
    assert document["pipelines"] == {"best": 2}
    assert document["length_km"] == 4.0
    assert document["effort"]["cpu_s_per_km"] == 1.5
    assert document["effort"]["bytes_in_per_km"] == 2000.0
    assert document["effort"]["bytes_out_per_km"] == 500.0
    assert document["this_run"] == {
        "processed": 2,
        "wall_s": 10.0,
        "workers": 2,
        "length_km": 2.0,
    }
    assert document["failures"] == [{"name": "c", "error": "damaged"}]


def test_without_a_profile_nothing_is_told_per_kilometre(tmp_path: Path) -> None:
    document = batch_document(Command(["in"], {}), Tally(), FINISHED)
    write_batch_document(document, tmp_path)
    assert document["effort"]["cpu_s_per_km"] is None


def test_a_document_that_breaks_the_schema_is_never_written(tmp_path: Path) -> None:
    document = batch_document(Command(["in"], {}), Tally(), FINISHED)
    with pytest.raises(InputError, match="has no processed"):
        write_batch_document(
            {**document, "this_run": {"wall_s": 1, "workers": 1, "length_km": 0}}, tmp_path
        )
    assert list(tmp_path.iterdir()) == []
