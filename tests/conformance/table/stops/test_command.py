"""`conformance table --stops`: output, options and refusals in one line."""

import pytest

from floatref_conformance.table import stops as stops_package
from floatref_conformance.table.stops import StopScores, StopSettings


@pytest.fixture
def call(command_making, hand_stops):
    """Return a function that calls the command, every score the same, and what it was to make."""

    def make(settings):
        return hand_stops([StopScores(0.9, 1.0, 2.0)], settings)

    return command_making(stops_package, "make_stop_table", make, "minivan, fair road: stop 1")


def test_json_is_all_there_is_on_stdout(call, assert_json):
    answer = call[0]("--stops", "1", "--json", "--pipeline", "spatial-basic")
    assert_json(answer, "conformance-stops/1", "minivan, fair road")


@pytest.mark.slow
def test_options_reach_the_settings(call):
    command, made = call
    assert command("--stops", "2").exit_code == 0
    words = "--stops 3 --seed 7 --vehicle soft-van --pipeline spatial-basic"
    assert command(*words.split()).exit_code == 0
    assert made == [StopSettings(stops=2), StopSettings(7, 3, ("soft-van",), ("spatial-basic",))]


def test_a_vehicle_that_is_named_drives_alone_even_if_it_is_the_default(call):
    command, made = call
    assert command("--stops", "1", "--vehicle", "loaded-van").exit_code == 0
    assert made == [StopSettings(stops=1, vehicles=("loaded-van",))]


def test_text_and_picture(call, tmp_path):
    words = ("--stops", "1", "--plot", tmp_path / "stops.png", "--pipeline", "spatial-basic")
    answer = call[0](*words)
    assert answer.exit_code == 0, answer.output
    assert answer.stdout.splitlines()[0].strip() == "spatial-basic"
    assert (tmp_path / "stops.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--run", "const_16"), "--run: not together with --stops; leave one of them out"),
        (("--roads", "3"), "--roads: not together with --stops; leave one of them out"),
        (("--seeds", "2"), "--seeds: not together with --stops; leave one of them out"),
        (("--vehicle", "tank"), "vehicle tank: unknown; "),
        (("--pipeline", "magic"), "pipeline magic: unknown; "),
        (("--plot", "stops.txt"), "stops.txt: not the name of a PNG picture"),
        (("--stops", "-1"), "'--stops': -1 is not in the range x>=0"),
    ],
)
def test_what_makes_no_table_is_exit_2_in_one_line_before_any_work(
    call, assert_refused, words, said
):
    assert_refused(call, ("--stops", "1", *words), said)
