"""What is compared with what, and what each cell has."""

from itertools import product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.conformance.matrix.conftest import make_check, make_document

from floatref_conformance.checks.verdict import Outcome, Verdict, verdict_on
from floatref_conformance.matrix.matrix_wording import describe_report
from floatref_conformance.matrix.result_matrix import make_matrix
from floatref_conformance.matrix.stored_reports import StoredReport

IDS = ("stop", "bounce", "waveband")
SHARES = st.dictionaries(st.sampled_from(IDS), st.none() | st.floats(0.0, 1e3))
TERMS = st.fixed_dictionaries(
    {"edition": st.sampled_from(("2026.1", "2026.2")), "seed": st.integers(0, 1)}
)


def report(shares, name="a", **changes):
    return StoredReport(name, Path(name), make_document(shares, **changes))


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(SHARES, TERMS), min_size=1, max_size=6))
def test_the_smallest_share_of_each_group_is_marked_and_no_other(drawn):
    reports = [report(shares, str(k), **terms) for k, (shares, terms) in enumerate(drawn)]
    made = make_matrix(reports)
    assert {r.name for r in made.reports} == {r.name for r in reports}
    for (id_, cells), group in product(made.rows.items(), made.groups):
        ours = [c for c, label in zip(cells, made.labels, strict=True) if label == group.label]
        given_shares = [
            shares[id_]
            for shares, terms in drawn
            if (terms["edition"], terms["seed"]) == (group.terms.edition, group.terms.seed)
            and shares.get(id_) is not None
        ]
        found = [c.share for c in ours if c.share is not None]
        assert found == pytest.approx(given_shares)
        for cell in ours:
            best = cell.share is not None and len(found) > 1 and cell.share == min(found)
            assert cell.smallest == best


@settings(max_examples=40, deadline=None)
@given(SHARES, SHARES, TERMS)
def test_a_report_of_another_group_changes_no_cell(shares, others, terms):
    ours = [report(shares, "a"), report(others, "b")]
    foreign = report(others, "c", **{**terms, "seed": 7})
    alone, beside = make_matrix(ours), make_matrix([*ours, foreign])
    for id_, cells in alone.rows.items():
        assert beside.rows[id_][:2] == cells
    assert beside.groups[1].differs == (
        ("seed",) if terms["edition"] == "2026.2" else ("edition", "seed")
    )


def test_a_share_below_zero_of_a_report_alone_is_not_marked():
    for shares in ((-1.0,), (-1.0, None), (-1.0, -2.0)):
        made = make_matrix([report({"stop": each}, str(k)) for k, each in enumerate(shares)])
        marked = [cell.smallest for cell in made.rows["stop"]]
        assert marked == [each == -2.0 for each in shares]


@given(st.sampled_from(list(Verdict)), st.lists(st.sampled_from(list(Outcome)), max_size=4))
def test_a_verdict_that_is_not_that_of_the_outcomes_is_named(stated, outcomes):
    checks = [make_check(str(k), 0.5, outcome=each.value) for k, each in enumerate(outcomes)]
    words = describe_report(report({}, checks=checks, verdict=stated.value))
    said = f"it states {stated.value}, its outcomes make it"
    assert (said in words) == (stated is not verdict_on(outcomes))
    assert said not in words or words.endswith(verdict_on(outcomes).value)


def test_a_cell_without_a_share_has_its_reason():
    not_a_number = make_check("b", 0.5)
    not_a_number["shown"] |= {"value": None, "margin": None}
    unlimited = make_check("c", 0.5)
    unlimited["shown"] |= {"limit": None, "margin": None}
    full = report({"a": None}, checks=[make_check("a"), not_a_number, unlimited])
    bare = report({}, "b", edition="2026.1")
    rows = make_matrix([full, bare]).rows
    reasons = {id_: cells[0].reason for id_, cells in rows.items()}
    assert reasons == {
        "a": "not selected",
        "b": "the value is no number",
        "c": "its class does not limit it",
    }
    assert {cells[1].reason for cells in rows.values()} == {
        "its report, of edition 2026.1, has no such check"
    }
    assert all(cells[1].outcome is None for cells in rows.values())


def test_an_earlier_report_without_the_shown_quantity_has_its_worst():
    check = make_check("stop", 0.5)
    del check["shown"]
    (cell,) = make_matrix([report({}, checks=[check])]).rows["stop"]
    assert (cell.share, cell.value, cell.case) == (0.5, 0.25, "stop-3")
