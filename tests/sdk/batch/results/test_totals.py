"""The counts of a batch: every file once, rates of what was worked at, time left by bytes."""

from dataclasses import replace
from math import isnan, nan
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.batch.jobs.job import Job
from floatref.batch.results.record import Effort, Record, Row
from floatref.batch.results.totals import FIRST_WARNINGS, ROUGHEST, Tally

ROW = Row("left", 0, 0.0, 100.0, nan, nan, 1.0, nan, 0.0, 1.0, 1.0)

patient = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
"""How fast examples are made decides nothing."""


def job(name: str, size_bytes: int = 1000) -> Job:
    return Job(Path("/in", name), name, Path("/out"), size_bytes=size_bytes)


def record(name: str, **fields: object) -> Record:
    return replace(Record(name, f"/in/{name}", length_m=500.0, rows=(ROW,)), **fields)


@patient
@given(st.lists(st.sampled_from(["done", "failed", "skipped"]), max_size=30))
def test_every_file_is_counted_once(outcomes: list[str]) -> None:
    tally = Tally()
    jobs = [job(str(index)) for index in range(len(outcomes))]
    tally.begin(jobs, 0.0)
    for item, outcome in zip(jobs, outcomes, strict=True):
        error = "damaged" if outcome == "failed" else ""
        tally.add(item, record(item.name, error=error, skipped=outcome == "skipped"))
    assert tally.seen == tally.done + len(tally.failed) == len(outcomes)
    assert tally.skipped == outcomes.count("skipped")
    assert tally.processed == len(outcomes) - tally.skipped
    assert tally.length_m == 500.0 * (len(outcomes) - outcomes.count("failed"))
    assert tally.new_m == 500.0 * outcomes.count("done")
    assert tally.part == (1.0 if outcomes else 0.0)


def test_time_left_follows_the_bytes_that_were_worked_at() -> None:
    jobs = [job("old", 5 * 10**13), job("large", 3 * 10**13), job("small", 10**13)]
    tally = Tally()
    tally.begin(jobs, 100.0)
    assert isnan(tally.left_s(100.0))
    tally.add(jobs[0], record("old", skipped=True))
    assert isnan(tally.left_s(101.0))
    tally.add(jobs[1], record("large"))
    # Beside such sizes the opening of a file is nothing. What was done before has taken no time.
    assert tally.left_s(130.0) == pytest.approx(10.0, rel=1e-5)
    assert tally.files_per_minute(130.0) == pytest.approx(2.0)
    assert tally.km_per_hour(130.0) == pytest.approx(60.0)


@pytest.mark.parametrize(
    ("sizes", "within"), [((0, 0, 0, 0), 1e-6), ((30_000, 10_000, 800, 1), 0.01)]
)
def test_files_of_unknown_size_count_alike_and_small_ones_nearly(
    sizes: tuple[int, ...], within: float
) -> None:
    jobs = [job(name, size) for name, size in zip("abcd", sizes, strict=True)]
    tally = Tally()
    tally.begin(jobs, 0.0)
    tally.add(jobs[0], record("a"))
    assert tally.part == pytest.approx(0.25, rel=within)
    assert tally.left_s(8.0) == pytest.approx(24.0, rel=within)


@given(st.lists(st.tuples(st.sampled_from("pq"), st.booleans()), max_size=9))
def test_every_profile_counts_for_the_pipeline_that_made_it(files: list[tuple[str, bool]]) -> None:
    tally = Tally()
    for index, (name, failed) in enumerate(files):
        key = {"asked": {"pipeline": "auto"}, **({} if failed else {"pipeline": name})}
        made = record(str(index), key=key, error="damaged" if failed else "")
        tally.add(job(str(index)), made)
    assert tally.pipelines.total() == tally.done
    assert all(tally.pipelines[name] == files.count((name, False)) for name in "pq")


def test_effort_is_summed_and_the_peak_of_memory_is_the_largest() -> None:
    tally = Tally()
    tally.begin([job("a"), job("b"), job("c")], 0.0)
    tally.add(job("a"), record("a", effort=Effort(2.0, 1.0, 10, 4, 700)))
    tally.add(job("b"), record("b", effort=Effort(3.0, 1.5, 20, 6, 500), skipped=True))
    tally.add(job("c"), record("c", effort=Effort(9.0, 9.0, 99, 9, 999), error="damaged"))
    assert tally.effort == Effort(5.0, 2.5, 30, 10, 700)


@patient
@given(st.lists(st.floats(0.0, 20.0) | st.just(nan), max_size=20))
def test_the_roughest_rows_are_kept_in_order(values: list[float]) -> None:
    tally = Tally()
    for index, value in enumerate(values):
        row = replace(ROW, iri_m_per_km=1000.0 * index, iri_of_valid_m_per_km=value)
        tally.add(job(str(index)), record(str(index), rows=(row,)))
    known = sorted((value for value in values if not isnan(value)), reverse=True)
    assert [iri for iri, _, _ in tally.roughest] == known[:ROUGHEST]
    assert all(values[int(name)] == iri for iri, name, _ in tally.roughest)


@given(st.permutations(["run-2", "run-9", "run-10", "run-11", "run-100", "run-101", "run-102"]))
def test_equal_rows_are_ranked_as_people_count_whichever_file_ends_first(names: list[str]) -> None:
    tally = Tally()
    for name in names:
        tally.add(job(name), record(name))
    kept = [name for _, name, _ in tally.roughest]
    assert kept == ["run-2", "run-9", "run-10", "run-11", "run-100"]


@pytest.mark.slow
@patient
@given(st.lists(st.tuples(st.floats(0.0, 20.0), st.floats(0.0, 1.0)), max_size=20))
def test_a_row_of_which_half_is_invalid_is_counted_and_not_ranked(
    rows: list[tuple[float, float]],
) -> None:
    tally = Tally()
    for index, (value, share) in enumerate(rows):
        row = replace(ROW, iri_of_valid_m_per_km=value, counted_share=share)
        tally.add(job(str(index)), record(str(index), rows=(row,)))
    assert tally.not_ranked == sum(share < 0.5 for _, share in rows)
    ranked = sorted((value for value, share in rows if share >= 0.5), reverse=True)
    assert [iri for iri, _, _ in tally.roughest] == ranked[:ROUGHEST]
    assert all(row.counted_share >= 0.5 for _, _, row in tally.roughest)


def test_what_is_left_behind_the_last_segment_is_not_among_the_roughest() -> None:
    tally = Tally()
    rest = replace(ROW, segment=1, start_m=100.0, length_m=0.2, iri_of_valid_m_per_km=99.0)
    short = replace(ROW, length_m=0.2, iri_of_valid_m_per_km=5.0)
    tally.add(job("a"), record("a", rows=(ROW, rest)))
    tally.add(job("b"), record("b", rows=(short,)))
    assert [iri for iri, _, _ in tally.roughest] == [5.0, 1.0]


@given(st.lists(st.integers(0, 4), max_size=9))
def test_the_first_warnings_are_stored_and_all_are_counted(counts: list[int]) -> None:
    tally, lines = Tally(), []
    for file, count in enumerate(counts):
        mine = tuple(f"line {number}" for number in range(count))
        tally.add(job(str(file)), record(str(file), warnings=mine))
        lines += [(str(file), line) for line in mine]
    assert tally.warnings == len(lines)
    assert tally.first_warnings == lines[:FIRST_WARNINGS]
