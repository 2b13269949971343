"""What is shown of a table: text, JSON and picture."""

import json
from dataclasses import replace
from errno import EACCES
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from floatref.errors import InputError
from floatref_conformance.table import Scores, TableSettings
from floatref_conformance.table.comparison_picture import check_picture, draw_comparison_maps
from floatref_conformance.table.comparison_text import print_comparison
from floatref_conformance.table.making import PassProgress
from floatref_conformance.table.table_document import document

STOP, BRAKE = "sg_5.7s_0.20g", "brk_49-20_0.25g"
BASIC = "temporal-basic"
SCORES = {
    (BASIC, STOP): Scores(1234.5, 4321.0, -0.25),
    (BASIC, BRAKE): Scores(2.5, -1.5, 0.87, 0.991),
}


@pytest.fixture
def table(hand_table, small):
    return hand_table(SCORES, small)


def printed(table, **settings):
    file = StringIO()
    print_comparison(table, Console(file=file, emoji=False, **settings))
    return file.getvalue()


def test_each_figure_stands_beside_the_printed_one(table):
    lines = printed(table).splitlines()
    assert lines[0].strip() == "temporal-basic (Table 5.3)"
    (stop,) = [line.split() for line in lines if line.startswith(f"{STOP}")]
    assert stop[1:] == ["1,234.5", "949.0", "4,321.0", "3,784.1", "-0.250", "<0.2", "–"]
    (brake,) = [line.split() for line in lines if line.startswith(f"{BRAKE}")]
    assert brake[1:] == ["2.5", "2.2", "-1.5", "0.0", "0.870", "0.944", "0.991"]
    assert "chapter 5: 1.00 over 2 cells" in lines[-2]
    assert "'stop: low, else high' alone: 1.00" in lines[-2]
    assert lines[-1] == "  its stops alone: no value over 1 cell"


def test_the_cells_to_which_the_slip_is_fitted_are_marked_and_not_predicted(hand_table):
    runs = ("brk_49-23_0.18g_b", "brk_49-20_0.25g", "const_16")
    figures = {("temporal-hpf", run): Scores(2.0, 1.0, 0.9 + n / 100) for n, run in enumerate(runs)}
    table = hand_table(figures, TableSettings(runs=runs, pipelines=("temporal-hpf",)))
    text = printed(table)
    assert "0.900*" in text
    assert "without the cells marked *: " in text
    assert "over 2 cells" in text
    made = document(table)
    assert {cell["run"]: cell["fitted"] for cell in made["cells"]} == dict(
        zip(runs, (True, False, False), strict=True)
    )
    assert made["rank_correlation"]["predicted"]["cells"] == 2
    assert made["slip_percent_per_g"] == 2.5


@pytest.mark.slow
@pytest.mark.parametrize("cross_correlation", [0.87, -0.25])
def test_the_whole_table_fits_a_terminal_of_80_columns(hand_table, cross_correlation):
    """The numbers are larger than the largest of print, 3299.8 m/km and 13139.7 %."""
    whole = TableSettings()
    keys = [(pipeline, run) for pipeline in whole.pipelines for run in whole.runs]
    worst = hand_table(
        dict.fromkeys(keys, Scores(98765.4, 123456.7, *2 * (cross_correlation,))), whole
    )
    text = printed(worst, force_terminal=True, width=80, color_system=None)
    assert "98,765.4" in text
    assert "123,456.7" in text
    assert [line for line in text.splitlines() if "…" in line] == []
    for run in whole.runs:
        assert text.count(f"\n{run} ") == len(whole.pipelines)


def test_what_was_not_published_says_so(table):
    bare = replace(table, cells=tuple(replace(cell, published=None) for cell in table.cells))
    (stop,) = [line.split() for line in printed(bare).splitlines() if line.startswith(f"{STOP}")]
    assert stop[1:] == ["1,234.5", "–", "4,321.0", "–", "-0.250", "–", "–"]


def test_the_document_holds_every_figure_with_its_unit(table):
    made = json.loads(json.dumps(document(table), allow_nan=False))
    assert made["format"] == "conformance-table/1"
    assert [made[name] for name in ("seed", "seeds", "roads", "vehicle")] == [
        0, 1, 1, table.settings.vehicle,
    ]  # fmt: skip
    stop, brake = made["cells"]
    assert stop == {
        "pipeline": BASIC,
        "table": "5.3",
        "run": STOP,
        "passes": 1,
        "peak_m_per_km": 1234.5,
        "published_peak_m_per_km": 949.0,
        "iri_error_percent": 4321.0,
        "published_iri_error_percent": 3784.1,
        "cross_correlation": -0.25,
        "cross_correlation_encoder": None,
        "published_cross_correlation": 0.2,
        "published_cross_correlation_is_upper_bound": True,
        "slip_percent_per_g": 2.5,
        "fitted": False,
    }
    # The published error of 0.0 is a figure and not a missing one.
    assert brake["published_iri_error_percent"] == 0.0
    assert brake["published_cross_correlation_is_upper_bound"] is False
    assert brake["cross_correlation_encoder"] == 0.991
    assert made["rank_correlation"]["chapter_5"] == {
        "ours": pytest.approx(1.0), "rule": pytest.approx(1.0), "cells": 2,
    }  # fmt: skip
    assert made["rank_correlation"]["stops"] == {"ours": None, "rule": None, "cells": 1}


def test_the_document_has_null_where_nothing_was_published(table):
    bare = replace(table, cells=tuple(replace(cell, published=None) for cell in table.cells))
    for cell in document(bare)["cells"]:
        assert {value for name, value in cell.items() if name.startswith("published")} == {None}
        assert cell["peak_m_per_km"] is not None


def drawn(table, path):
    draw_comparison_maps(table, path)
    return path.read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize(
    "changed", [Scores(2.5, -1.5, 0.35), Scores(80.0, -1.5, 0.87)], ids=["correlation", "peak"]
)
def test_the_picture_is_a_png_that_shows_the_data(hand_table, small, table, tmp_path, changed):
    first = drawn(table, tmp_path / "a.png")
    assert first.startswith(b"\x89PNG\r\n\x1a\n")
    assert drawn(table, tmp_path / "a.png") == first
    other = hand_table(SCORES | {(BASIC, BRAKE): changed}, small)
    assert drawn(other, tmp_path / "b.png") != first
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.png", "b.png"]


@pytest.mark.slow
def test_the_picture_shows_what_was_not_published(table, tmp_path):
    bare = replace(table, cells=tuple(replace(cell, published=None) for cell in table.cells))
    assert drawn(bare, tmp_path / "a.png") != drawn(table, tmp_path / "b.png")


@pytest.mark.parametrize(
    "name", ["table.jpeg", "table", "gone/table.png", "folder.png", f"{'x' * 300}.png"]
)
def test_a_picture_that_cannot_be_written_is_refused_early(tmp_path, name):
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(InputError, match=name):
        check_picture(tmp_path / name)


def test_a_folder_that_takes_no_file_is_noticed_early(tmp_path, monkeypatch):
    check_picture(tmp_path / "table.png")
    assert list(tmp_path.iterdir()) == []

    def closed(*_, **__):
        raise PermissionError(EACCES, "Permission denied")

    monkeypatch.setattr(Path, "touch", closed)
    with pytest.raises(InputError, match=r"table\.png: cannot be written \(Permission denied\)"):
        check_picture(tmp_path / "table.png")


@pytest.mark.parametrize("terminal", [True, False])
def test_progress_names_the_sets_of_passes(terminal):
    file = StringIO()
    with PassProgress(4, Console(file=file, force_terminal=terminal, width=90)) as progress:
        for name in ("road 1: ref_72", "road 1: const_5", "road 2: ref_72", "road 2: const_5"):
            progress(name)
    if terminal:
        assert "road 2: const_5" in file.getvalue()
        assert "3 of 4" in file.getvalue()
    else:
        assert file.getvalue().splitlines() == ["road 1 …", "road 2 …"]
