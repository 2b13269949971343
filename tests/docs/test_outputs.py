"""The versioned outputs: complete, read as written, and every change of a number is listed."""

import importlib
from math import isnan, nan
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import floatref

ROOT = Path(__file__).parents[2]
NUMBERS = st.just(nan) | st.floats(-1e6, 1e6)
ROWS = st.dictionaries(
    st.tuples(st.sampled_from(("stop", "brake")), st.sampled_from(tuple(floatref.pipelines()))),
    st.just(()) | st.tuples(*[NUMBERS] * 10),
    min_size=1,
)
PART = ("stop", "response")
PIPELINES = (
    *("temporal-basic", "temporal-adaptive-hpf-spatial-backward"),
    *("spatial-hpf-timer-distortion-reflection", "kalman-smoother", "road-prior-smoother"),
    "response-joint-input-state",
)


@pytest.fixture(scope="module")
def outputs():
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(ROOT / ".ci"))
        return importlib.import_module("outputs")


@settings(deadline=None)
@given(ROWS)
def test_what_is_written_is_read_and_no_difference(outputs, rows):
    text = outputs.write_text(rows)
    read = outputs.read_text(text)
    assert list(read) == list(rows)
    assert outputs.compare(read, rows) == outputs.compare(rows, read) == []
    assert outputs.write_text(read) == text


@settings(deadline=None)
@given(st.lists(st.floats(-1e6, 1e6), min_size=10, max_size=10), st.integers(0, 9), st.data())
def test_a_change_is_listed_if_it_is_beyond_the_tolerance(outputs, numbers, at, data):
    unit, before = outputs.UNITS[at], numbers[at]
    allowed = 2e-3 * abs(before) + outputs.FLOORS[unit]
    factor = data.draw(st.sampled_from((-2.0, -0.9, 0.9, 2.0)))
    changed = [*numbers]
    changed[at] = before + factor * allowed
    key = ("stop", "temporal-basic")
    lines = outputs.compare({key: tuple(numbers)}, {key: tuple(changed)})
    assert len(lines) == (abs(factor) > 1)
    assert all(line.startswith(f"stop temporal-basic {outputs.NAMES[at]}: ") for line in lines)


def test_rows_that_come_go_or_are_refused_are_listed(outputs):
    key, row = ("stop", "temporal-basic"), (1.0,) * 10
    assert outputs.compare({}, {key: row}) == ["stop temporal-basic: not stored"]
    assert outputs.compare({key: row}, {key: ()}) == ["stop temporal-basic: now refused"]
    assert outputs.compare({key: ()}, {key: row}) == ["stop temporal-basic: now taken"]
    lost = outputs.compare({key: row}, {key: (nan, *row[1:])})
    assert lost == ["stop temporal-basic iri_left: 1 became - m/km"]


def test_the_file_has_a_row_for_each_recording_and_pipeline_that_takes_it(outputs):
    stored = outputs.read_text(outputs.FILE.read_text(encoding="ascii"))
    pipelines = tuple(floatref.pipelines())
    wanted = {(n, p) for n, w in outputs.RECORDINGS.items() for p in pipelines if w.takes(p)}
    assert set(stored) == wanted, f"write it anew: {outputs.COMMAND}"
    assert {pipeline for _, pipeline in stored} == set(pipelines)
    page = (ROOT / "docs" / "change-indication.md").read_text(encoding="utf-8")
    assert all(f"`{name}`" in page for name in outputs.RECORDINGS)
    assert all(len(row) == 10 and not isnan(row[2]) for row in stored.values() if row)


@pytest.mark.slow
def test_a_part_of_the_outputs_is_as_it_is_stored(outputs):
    """An indication: look at the difference, then write the file anew."""
    stored = outputs.read_text(outputs.FILE.read_text(encoding="ascii"))
    lines = outputs.compare(stored, dict(outputs.make_rows(PART, PIPELINES)))
    assert lines == [], f"no error in itself; if it is intended: {outputs.COMMAND}"
