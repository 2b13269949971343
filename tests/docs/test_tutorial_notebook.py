"""The tutorial as a notebook: a valid file without outputs, every cell of which runs in order.

The cells run in one fresh namespace. As in a notebook, the value of a cell's last expression is
shown: as a picture, a table or a line.
"""

import ast
import json
import os
import re
import sysconfig
from pathlib import Path
from typing import Any

import pytest

import floatref

pytest.importorskip("pandas", reason="the notebook shows frames; it comes with floatref[adapters]")
pytest.importorskip("xarray", reason="the notebook shows a set; it comes with floatref[adapters]")

FILE = Path(__file__).parents[2] / "docs" / "tutorial.ipynb"
NOTEBOOK = json.loads(FILE.read_text(encoding="utf-8"))
CODE = {
    cell["id"]: "".join(cell["source"]) for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"
}
LINE = 200


def run_cell(source: str, names: dict[str, Any]) -> Any:
    """Run ``source`` with ``names``, and return the value of its last line, if it has one."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    if last is None:
        return None
    return eval(compile(ast.Expression(last.value), "cell", "eval"), names)


def show(value: Any) -> str:
    """Return how a notebook shows ``value``: "png", "html" or "text"."""
    for kind in ("png", "html"):
        method = getattr(value, f"_repr_{kind}_", None)
        if method is not None and method():
            return kind
    return "text" if repr(value) else ""


def test_the_file_is_a_notebook_of_version_4_5_without_outputs() -> None:
    assert (NOTEBOOK["nbformat"], NOTEBOOK["nbformat_minor"]) == (4, 5)
    assert set(NOTEBOOK) == {"cells", "metadata", "nbformat", "nbformat_minor"}
    ids = [cell["id"] for cell in NOTEBOOK["cells"]]
    assert len(set(ids)) == len(ids)
    for cell in NOTEBOOK["cells"]:
        assert re.fullmatch(r"[a-zA-Z0-9_-]{1,64}", cell["id"])
        assert all(line.endswith("\n") for line in cell["source"][:-1])
        expected = {"cell_type", "id", "metadata", "source"}
        if cell["cell_type"] == "code":
            expected |= {"execution_count", "outputs"}
            assert (cell["execution_count"], cell["outputs"]) == (None, [])
        assert set(cell) == expected


def test_it_imports_public_names_alone() -> None:
    for source in CODE.values():
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.Attribute) and ast.unparse(node.value) == "floatref":
                assert node.attr in floatref.__all__
            if isinstance(node, ast.Import | ast.ImportFrom):
                assert "floatref." not in ast.unparse(node)


@pytest.mark.slow
def test_every_cell_runs_and_shows_what_it_is_about(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    scripts = sysconfig.get_path("scripts")
    monkeypatch.setenv("PATH", os.pathsep.join([scripts, os.environ["PATH"]]))
    names: dict[str, Any] = {}
    values = {cell: run_cell(source, names) for cell, source in CODE.items()}
    shown = {cell: show(value) for cell, value in values.items() if value is not None}
    pictures = {cell for cell, kind in shown.items() if kind == "png"}
    tables = {cell for cell, kind in shown.items() if kind == "html"}
    assert pictures == {"recording-plot", "plot", "fails-plot"}
    assert tables == {"recording", "process", "iri", "truth", "fails", "pandas", "xarray"}
    assert set(shown) - pictures - tables == {"track", "units"}
    for cell in ("recording", "process", "track", "iri"):
        assert len(repr(values[cell])) <= LINE + 40 * (cell == "recording")
    assert_that_the_road_is_found(names)


def assert_that_the_road_is_found(names: dict[str, Any]) -> None:
    """The text of the notebook is right: the valid part is the road, the basic pipeline fails."""
    truth, basic = (each.iri() for each in (floatref.read_profile("stop_truth"), names["basic"]))
    for found in names["profile"].iri():
        assert found.valid_m_per_km == pytest.approx(truth[found.track].valid_m_per_km, rel=0.1)
        assert found.counted_share > 0.6
    assert all(found.all_m_per_km > 10.0 for found in basic)


def test_a_cell_that_fails_is_noticed() -> None:
    names: dict[str, Any] = {}
    assert run_cell("a = 2\na + 1", names) == 3
    assert run_cell("b = a", names) is None
    with pytest.raises(NameError, match="c"):
        run_cell("c", names)
