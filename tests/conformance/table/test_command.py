"""`conformance table`: output, options and refusals in one line."""

import pytest

from floatref.errors import InputError
from floatref_conformance import table as table_package
from floatref_conformance.errors import SuiteError
from floatref_conformance.table import Scores, TableSettings, comparison_picture


@pytest.fixture
def call(command_making, hand_table):
    """Return a function that calls the command, every cell the same, and what it was to make."""

    def make(settings):
        keys = [(p, r) for p in settings.pipelines for r in settings.runs]
        return hand_table(dict.fromkeys(keys, Scores(3.0, 5.0, 0.9)), settings)

    return command_making(table_package, "make_table", make, "road 1, noise 1: ref_72")


def test_json_is_all_there_is_on_stdout(call, assert_json):
    answer = call[0]("--json", "--run", "const_16", "--pipeline", "spatial-basic")
    made = assert_json(answer, "conformance-table/1", "road 1, noise 1")
    assert [(c["pipeline"], c["run"]) for c in made["cells"]] == [("spatial-basic", "const_16")]


def test_the_terminal_gets_a_block_for_each_pipeline(call):
    answer = call[0]("--run", "const_16", "--pipeline", "spatial-basic")
    assert answer.exit_code == 0
    assert "spatial-basic (Table 5.9)" in answer.stdout
    assert "temporal-basic" not in answer.stdout


@pytest.mark.slow
def test_options_reach_the_settings(call):
    command, made = call
    assert command().exit_code == 0
    words = "--seed 7 --seeds 3 --roads 4 --vehicle minivan --run const_5 --run const_16"
    assert command(*words.split()).exit_code == 0
    assert made == [TableSettings(), TableSettings(7, 4, 3, "minivan", ("const_16", "const_5"))]


@pytest.mark.slow
def test_the_picture_is_written(call, tmp_path):
    answer = call[0]("--plot", tmp_path / "table.png", "--run", "const_16")
    assert answer.exit_code == 0, answer.output
    assert (tmp_path / "table.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("words", [(), ("--json",)])
def test_what_cannot_be_drawn_is_printed_all_the_same(call, monkeypatch, tmp_path, words):
    def full(_table, path):
        raise InputError(f"{path}: cannot be written (No space left on device)")

    monkeypatch.setattr(comparison_picture, "draw_comparison_maps", full)
    plot = ("--plot", tmp_path / "table.png", "--run", "const_16")
    answer = call[0](*plot, "--pipeline", "spatial-basic", *words)
    assert answer.exit_code == 2
    assert "table.png: cannot be written (No space left" in answer.stderr
    assert answer.stdout == call[0](*plot[2:], "--pipeline", "spatial-basic", *words).stdout


def test_an_interrupted_table_does_not_speak_of_a_verdict(call, monkeypatch):
    def interrupted(_settings, _watch):
        raise KeyboardInterrupt

    monkeypatch.setattr(table_package, "make_table", interrupted)
    answer = call[0]()
    assert (answer.exit_code, answer.stderr) == (130, "Interrupted: no table\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--run", "const_26"), "run const_26: unknown; did you mean const_16?"),
        (("--pipeline", "magic"), "pipeline magic: unknown; choose from temporal-basic, "),
        (("--vehicle", "tank"), "vehicle tank: unknown; "),
        (("--plot", "table.txt"), "table.txt: not the name of a PNG picture"),
        (("--plot", "nowhere/table.png"), "nowhere/table.png: its folder does not exist"),
        (("--roads", "0"), "'--roads': 0 is not in the range x>=1"),
    ],
)
def test_what_makes_no_table_is_exit_2_in_one_line_before_any_work(
    call, assert_refused, words, said
):
    assert_refused(call, words, said)


def test_a_fault_of_the_suite_is_exit_3_and_leaves_no_picture(call, monkeypatch, tmp_path):
    def broken(_settings, _watch):
        raise SuiteError("pipeline x, run y: no luck")

    monkeypatch.setattr(table_package, "make_table", broken)
    answer = call[0]("--plot", tmp_path / "table.png")
    assert answer.exit_code == 3
    assert "at fault, no table: SuiteError: pipeline x, run y: no luck" in answer.stderr
    assert list(tmp_path.iterdir()) == []
