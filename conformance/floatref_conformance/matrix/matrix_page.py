"""The matrix as one HTML file that needs nothing else."""

from dataclasses import dataclass

from floatref_conformance.matrix import matrix_wording as wording
from floatref_conformance.matrix.result_matrix import Cell, Matrix
from floatref_conformance.render.text import fill_template

TEMPLATE = "matrix.html.j2"
FULL_SCALE = 1.5
"""Share of the limit at the end of a bar."""
NEAR = 0.85
"""Above this share of the limit a bar warns."""


@dataclass(frozen=True)
class Column:
    """The head of a report; ``opens`` is true for the first of its group."""

    name: str
    group: str
    opens: bool
    device: str
    verdict: str
    summary: str


@dataclass(frozen=True)
class Field:
    """One cell; ``bar`` is the width of its bar in percent, None without one."""

    outcome: str
    word: str
    opens: bool
    share: str
    bar: float | None
    colour: str
    smallest: bool
    value: str
    reason: str


@dataclass(frozen=True)
class MatrixPage:
    """All that the template needs."""

    groups: tuple[tuple[str, str], ...]
    columns: tuple[Column, ...]
    rows: tuple[tuple[str, tuple[Field, ...]], ...]


def matrix_html(matrix: Matrix) -> str:
    """Return the page that shows ``matrix``; all text of a report is escaped in it."""
    return fill_template(TEMPLATE, __package__, page=page_of(matrix))


def page_of(matrix: Matrix) -> MatrixPage:
    """Return what the page of ``matrix`` shows, in words."""
    labels = matrix.labels
    opens = tuple(k > 0 and label != labels[k - 1] for k, label in enumerate(labels))
    columns = (
        Column(
            report.name,
            label,
            first,
            report.device,
            report.document["verdict"],
            wording.describe_report(report),
        )
        for report, label, first in zip(matrix.reports, labels, opens, strict=True)
    )
    return MatrixPage(
        tuple((g.label, wording.describe_group(g, matrix.groups[0])) for g in matrix.groups),
        tuple(columns),
        tuple(
            (id_, tuple(_field(*pair) for pair in zip(cells, opens, strict=True)))
            for id_, cells in matrix.rows.items()
        ),
    )


def _field(cell: Cell, opens: bool) -> Field:
    share = cell.share
    within = 0.0 if share is None else min(max(share / FULL_SCALE, 0.0), 1.0)
    over, near = share is not None and share > 1, share is not None and share > NEAR
    return Field(
        outcome=cell.outcome.value if cell.outcome else "missing",
        word=wording.outcome_in_words(cell),
        opens=opens,
        share=wording.share_in_words(cell),
        bar=None if share is None else round(100 * within, 1),
        colour="over" if over else "near" if near else "good",
        smallest=cell.smallest,
        value=wording.describe_value(cell),
        reason=wording.cut(cell.reason) if share is None else "",
    )
