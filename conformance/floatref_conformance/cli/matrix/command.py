"""`conformance matrix`: reports of several devices or editions beside each other."""

import json
from pathlib import Path

import click

from floatref.errors import InputError
from floatref.files.atomic import check_target, replace_file
from floatref.files.sources import document_path, real_path
from floatref_conformance.render.terminal import make_console
from floatref_conformance.render.text import needs_jinja


@click.command()
@click.argument("reports", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--out",
    metavar="FILE.html",
    type=click.Path(path_type=Path),
    help="Write the page to this file, too.",
)
@click.option("--overwrite", is_flag=True, help="Replace the page if it exists.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def matrix(reports: tuple[Path, ...], out: Path | None, overwrite: bool, as_json: bool) -> None:
    """Put REPORTS of `conformance run` beside each other: rows are checks, columns reports.

    A report is a report.json, or the folder of --report. A cell has the outcome and the worst value
    as a share of its limit. Reports of the same edition, class, seed and effort are a group; the
    smallest share of each check is marked within it, and groups are not compared.

    Exit code 0 whatever the verdicts are; 2 for a file that is no report.
    """
    if out is not None:
        needs_jinja("the page of the matrix")
        _check_apart(out, reports)
        check_target(out, overwrite)
    from floatref_conformance.matrix.matrix_document import matrix_document
    from floatref_conformance.matrix.matrix_page import matrix_html
    from floatref_conformance.matrix.matrix_table import print_matrix
    from floatref_conformance.matrix.result_matrix import make_matrix
    from floatref_conformance.matrix.stored_reports import read_reports

    made = make_matrix(read_reports(reports))
    if out is not None:
        with replace_file(out, overwrite) as beside:
            beside.write_text(matrix_html(made), encoding="utf-8")
    if as_json:
        click.echo(json.dumps(matrix_document(made), indent=2, allow_nan=False))
    else:
        print_matrix(made, make_console())


def _check_apart(out: Path, reports: tuple[Path, ...]) -> None:
    """Raise InputError for a page that would replace a report that it is made of."""
    from floatref_conformance.render.report import NAME

    for report in reports:
        if real_path(out) == real_path(document_path(report, NAME)):
            raise InputError(f"--out {out}: is one of the reports; give another name")
