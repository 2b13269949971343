"""Lines and measures of a batch: in rows, records, summary and layer, and again with --resume."""

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floatref.batch.jobs.job import Job
from floatref.batch.results.record import Record, read_record, write_record
from floatref.batch.results.segment_layer import layer_columns, write_segment_layer
from floatref.batch.results.segments import SPACING_M, measure_segments
from floatref.batch.results.summary import CSV, PARQUET, RATING, write_summary
from floatref.batch.work.task import run_job
from floatref.engine.run import run
from floatref.measures.ride.segment_measures import MEASURES
from floatref.values.recording import Recording

LATITUDE_STEP = np.degrees(2.0 / 6.4e6)
"""Of the recording's receiver, for every 2 m."""


@pytest.fixture(scope="module")
def record(recording: Recording) -> Record:
    """The rows of a profile of 160 m, in segments of 50 m, with measures."""
    profile = run(recording, "temporal-basic").profile
    rows, remarks = measure_segments(profile, 50.0, recording, measures=True)
    assert remarks == ()
    return Record("run", "/net/run", rows=rows)


def test_a_line_goes_from_the_start_to_the_end_of_its_segment(record: Record) -> None:
    for row in record.rows:
        (line,) = row.lines_deg
        starts = np.degrees(0.8) + np.array([row.start_m, row.start_m + row.length_m]) / 2.0 * (
            LATITUDE_STEP
        )
        assert (line[0][1], line[-1][1]) == pytest.approx(tuple(starts), abs=2e-7)
        assert line[0] == pytest.approx((row.longitude_deg, row.latitude_deg), abs=1e-7)
        assert len(line) == 1 + -(-row.length_m // SPACING_M)


def test_fixes_that_are_missing_break_the_line(recording: Recording) -> None:
    profile = run(recording, "temporal-basic").profile
    channels = []
    for channel in recording.channels:
        values = np.array(channel.values)
        if channel.id.name == "gnss_latitude":
            values[14:66] = np.nan
        channels.append(replace(channel, values=values))
    rows, _ = measure_segments(profile, None, replace(recording, channels=tuple(channels)))
    (before, after) = rows[0].lines_deg
    assert before[-1][1] < after[0][1]


def test_a_record_comes_back_with_lines_and_measures(record: Record, tmp_path: Path) -> None:
    write_record(record, tmp_path / "record.json")
    # As texts: a NaN is not equal to itself in a dataclass, from Python 3.13 on.
    assert repr(read_record(tmp_path / "record.json").rows) == repr(record.rows)


def test_a_record_of_an_earlier_version_has_neither(record: Record, tmp_path: Path) -> None:
    write_record(record, tmp_path / "record.json")
    document = json.loads((tmp_path / "record.json").read_text())
    for row in document["rows"]:
        del row["lines_deg"], row["measures"]
    (tmp_path / "record.json").write_text(json.dumps(document))
    row = read_record(tmp_path / "record.json").rows[0]
    assert (row.lines_deg, row.measures) == ((), None)


def test_the_summary_has_columns_of_measures_only_if_asked(record: Record, tmp_path: Path) -> None:
    from pyarrow import parquet

    write_summary([record], tmp_path)
    with (tmp_path / CSV).open(newline="") as stream:
        assert not set(csv.DictReader(stream).fieldnames or ()) & {*MEASURES, RATING}
    failed = Record("bad", "/net/bad", error="too short")
    write_summary([record, failed], tmp_path, measures=True)
    rows = parquet.read_table(tmp_path / PARQUET).to_pylist()
    for row, line in zip(record.rows, rows, strict=False):
        assert line["ride_number"] == row.measures.ride_number
        assert line[RATING] in ("good", "fair", "poor")
    assert rows[-1]["ride_number"] is None
    with (tmp_path / CSV).open(newline="") as stream:
        assert list(csv.DictReader(stream).fieldnames or ())[-1] == RATING


def test_the_layer_marks_what_is_not_valid_and_counts_what_has_no_place(
    record: Record, tmp_path: Path
) -> None:
    lost = replace(record, name="lost", rows=tuple(replace(r, lines_deg=()) for r in record.rows))
    count = write_segment_layer([record, lost], True, tmp_path / "x.geojson")
    assert (count.written, count.left_out) == (len(record.rows), len(lost.rows))
    found = json.loads((tmp_path / "x.geojson").read_text())["features"]
    for feature, row in zip(found, record.rows, strict=True):
        held = feature["properties"]
        assert list(held) == list(layer_columns(True))
        assert held["marked"] is (row.counted_share < 1.0)
        assert held["counted_share"] == row.counted_share
        assert held["localized_roughness_m"] == row.measures.localized_roughness_m
    assert {feature["properties"]["marked"] for feature in found} == {True}


def test_resume_measures_again_and_processes_nothing(jobs: dict[str, Job]) -> None:
    job = replace(jobs["directory"], segment_m=50.0)
    first = run_job(job)
    assert first.error == ""
    assert run_job(job, resume=True).skipped
    again = run_job(replace(job, measures=True), resume=True)
    assert again.skipped
    assert [row.lines_deg for row in again.rows] == [row.lines_deg for row in first.rows]
    assert all(row.measures is None for row in first.rows)
    assert all(row.measures is not None for row in again.rows)
