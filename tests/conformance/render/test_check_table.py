"""The judge's table: whole words at any width, and the worst quantity in words."""

from io import StringIO
from math import nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rich.console import Console

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.verdict import CheckResult, Measurement, Outcome, RunResult
from floatref_conformance.classes import DeviceClass, same_limit
from floatref_conformance.plugins import load_registry
from floatref_conformance.render.check_table import check_table, describe_shown

QUANTITIES = sorted({name for c in load_registry().checks.values() for name in c.limits})
DEVICE = {"spec": "fake:x", "name": "x", "version": "1", "architecture": "temporal"}
NUMBERS = st.floats(0.0, 1e6) | st.just(nan)


def lines(checks, width):
    file = StringIO()
    console = Console(file=file, force_terminal=True, color_system=None, width=width)
    made = RunResult(DEVICE, DeviceClass.NOMINAL, 0, "quick", tuple(checks))
    console.print(check_table(made, console), crop=False)
    return [line.rstrip() for line in file.getvalue().splitlines()]


def words(checks, width):
    return sorted(word for line in lines(checks, width) for word in line.split() if word[0] != "─")


@st.composite
def check_results(draw, ids=tuple(IDS)):
    shown = Measurement(
        draw(st.sampled_from(QUANTITIES)),
        "left",
        draw(NUMBERS),
        draw(st.sampled_from(["", "%", "m", "mm", "m/km", "periods"])),
        draw(st.just({}) | st.floats(0.01, 999.0).map(lambda limit: same_limit(limit, limit))),
    )
    return CheckResult(
        draw(st.sampled_from(ids)),
        "",
        draw(st.sampled_from(Outcome)),
        class_reached=draw(st.sampled_from([None, *DeviceClass])),
        cases=draw(st.integers(1, 99999)),
        shown=draw(st.sampled_from([None, shown])),
    )


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(st.lists(check_results(), min_size=1, max_size=15))
def test_eighty_columns_hold_the_whole_words_of_a_wide_terminal(checks):
    assert max(map(len, lines(checks, 80))) <= 80
    assert words(checks, 80) == words(checks, 250)


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(
    st.lists(check_results(ids=["a-check-with-a-very-long-name-of-a-vendor", "b"]), min_size=1),
    st.integers(20, 300),
)
def test_no_word_is_split_at_any_width(checks, width):
    assert words(checks, width) == words(checks, 300)


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(st.lists(check_results(), min_size=1, max_size=15))
def test_a_wide_terminal_has_one_line_for_each_check(checks):
    rows = [line for line in lines(checks, 250) if line.startswith(tuple(f" {i} " for i in IDS))]
    assert [row.split()[0] for row in rows] == [check.id for check in checks]
    for check, row in zip(checks, rows, strict=True):
        assert describe_shown(check, DeviceClass.NOMINAL) in row


@pytest.mark.parametrize(
    ("quantity", "value", "unit", "row"),
    [
        ("bump error", 4.123, "%", "bump error: 4.12 %, limit 10 %"),
        ("correlation loss", 0.0712, "", "correlation loss: 0.0712, limit 10"),
        ("flagged at an end", 53.0, "m", "flagged at an end: 53 m, limit 10 m"),
        ("IRI error", nan, "m/km", "IRI error: not a number, limit 10 m/km"),
    ],
)
def test_a_row_names_quantity_value_unit_and_limit(quantity, value, unit, row):
    shown = Measurement(quantity, "left", value, unit, same_limit(10.0, 10.0))
    made = CheckResult("stop", "", Outcome.FAIL, shown=shown)
    assert describe_shown(made, DeviceClass.NOMINAL) == row
