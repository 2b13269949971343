"""`conformance table --family`: output, options and refusals in one line."""

import pytest

from floatref_conformance.table.families import FamilySettings, family_making
from floatref_conformance.table.families.conditions import STOPS


@pytest.fixture
def call(command_making, hand_families):
    """Return a function that calls the command without any drive, and what it was to make."""

    def make(settings):
        return hand_families({}, settings.pipelines, settings.family)

    return command_making(family_making, "make_family_table", make, "urban: stop 1")


def test_json_is_all_there_is_on_stdout(call, assert_json):
    words = "--family urban --drives 1 --json --pipeline spatial-basic"
    assert_json(call[0](*words.split()), "conformance-families/1", "urban")


def test_options_reach_the_settings(call):
    command, made = call
    words = "--family harsh --drives 5 --seed 7 --pipeline spatial-basic --jobs 2"
    assert command(*words.split()).exit_code == 0
    assert made == [FamilySettings("harsh", 7, 5, ("spatial-basic",), 2)]


def test_stops_of_their_own_have_shares_in_the_json(call, assert_json):
    words = "--family stops --drives 1 --json --pipeline spatial-basic"
    answer = call[0](*words.split())
    made = assert_json(answer, "conformance-families/1", "urban")
    assert {share["condition"] for share in made["stop_shares"]} == {c.name for c in STOPS}


@pytest.mark.slow
def test_text_and_picture(call, tmp_path):
    picture = tmp_path / "families.png"
    answer = call[0]("--family", "rural", "--pipeline", "spatial-basic", "--plot", picture)
    assert answer.exit_code == 0, answer.output
    assert answer.stdout.splitlines()[0].strip() == "spatial-basic"
    assert answer.stdout.splitlines()[-1] == (
        "What is valid is right (5 % or 0.1 m/km) on every drive."
    )
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--run", "const_16"), "--run: not together with --family; leave one of them out"),
        (("--roads", "3"), "--roads: not together with --family; leave one of them out"),
        (("--vehicle", "minivan"), "--vehicle: not together with --family; leave one of them out"),
        (("--stops", "2"), "--stops: not together with --family; leave one of them out"),
        (("--pipeline", "magic"), "pipeline magic: unknown; "),
        (("--drives", "0"), "'--drives': 0 is not in the range x>=1"),
        (("--jobs", "0"), "'--jobs': 0 is not in the range x>=1"),
        (("--family", "urben"), "'--family': 'urben' is not one of 'single', 'urban', 'rural'"),
    ],
)
def test_what_makes_no_table_is_exit_2_in_one_line_before_any_work(
    call, assert_refused, words, message
):
    assert_refused(call, ("--family", "urban", *words), message)


@pytest.mark.parametrize("before", [(), ("--stops", "1")])
@pytest.mark.parametrize("option", ["--drives", "--jobs"])
def test_drives_and_jobs_without_a_family_are_refused(call, assert_refused, before, option):
    assert_refused(call, (*before, option, "2"), f"{option}: only with --family")
