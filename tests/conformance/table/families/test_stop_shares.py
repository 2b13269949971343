"""The shares of many stops: four kinds that are all there is, flagged metres, and sigma."""

import json
from io import StringIO

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from rich.console import Console

from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.schemas import read_schema
from floatref_conformance.table.families import FamilyScores, FamilySettings, PathScores
from floatref_conformance.table.families.conditions import STOPS
from floatref_conformance.table.families.family_document import family_document
from floatref_conformance.table.families.family_table import FamilyPath, FamilyTable
from floatref_conformance.table.families.family_text import print_families
from floatref_conformance.table.families.stop_shares import (
    FLAGGED_M,
    Kind,
    kind_of,
    rows_of_stops,
    share_stops,
)

PIPELINE = "temporal-basic"


def scores(right=True, valid_right=True, flagged_m=0.0, share=95.0, points=1000, r=0.99):
    axis = PathScores(r, 1.0, share, valid_right, 1.0, right, points)
    # Along the true distance everything is wrong, which no share may heed.
    true = PathScores(0.1, 50.0, 1.0, False, 50.0, False, points)
    return FamilyScores(true, axis, 2 * flagged_m, 0.0, flagged_m)


def path(found, vehicle="loaded-van", condition=STOPS[0]):
    scenario = Scenario(manoeuvre="stop", vehicle=vehicle)
    return FamilyPath(PIPELINE, condition, "left", scenario, found, "" if found else "refused")


@pytest.mark.parametrize(
    ("found", "kind"),
    [
        (scores(), Kind.RIGHT_VALID),
        (scores(flagged_m=FLAGGED_M), Kind.RIGHT_VALID),
        (scores(flagged_m=1.1 * FLAGGED_M), Kind.RIGHT_FLAGGED),
        (scores(right=False, flagged_m=30.0), Kind.WRONG_FLAGGED),
        # Flags below 16 km/h cover what is wrong.
        (scores(right=False), Kind.WRONG_FLAGGED),
        (scores(right=False, valid_right=False), Kind.WRONG_VALID),
        (scores(right=False, valid_right=False, flagged_m=30.0), Kind.WRONG_VALID),
        # Two errors that cancel, one of which is flagged.
        (scores(valid_right=False, flagged_m=30.0), Kind.WRONG_VALID),
        (None, Kind.WRONG_FLAGGED),
    ],
)
def test_a_wheel_path_is_of_the_kind_that_the_page_says(found, kind):
    assert kind_of(found) is kind


drawn = st.none() | st.builds(scores, st.booleans(), st.booleans(), st.floats(0.0, 160.0))


@settings(max_examples=30)
@given(st.lists(drawn, min_size=1, max_size=30))
def test_the_four_shares_add_up_to_100(found):
    shares = share_stops([path(each) for each in found])
    four = (
        shares.right_valid_percent,
        shares.right_flagged_percent,
        shares.wrong_flagged_percent,
        shares.wrong_valid_percent,
    )
    assert sum(four) == pytest.approx(100.0)
    assert min(four) >= 0.0


def test_flagged_metres_are_of_wheel_paths_with_a_profile():
    shares = share_stops([path(scores(flagged_m=m)) for m in range(101)] + [path(None)] * 50)
    assert shares.flagged_fast_median_m == pytest.approx(50.0)
    assert shares.flagged_fast_percentile_95_m == pytest.approx(95.0)


def test_all_points_are_pooled_and_wheel_paths_are_held_between_both_ends():
    found = [(84.9, 100), (85.0, 200), (99.5, 300), (99.6, 400)]
    paths = [path(scores(share=share, points=points)) for share, points in found]
    without = [path(scores(share=None, points=0)), path(None)]
    shares = share_stops(paths + without)
    pooled = (84.9 * 100 + 85.0 * 200 + 99.5 * 300 + 99.6 * 400) / 1000
    assert shares.sigma.pooled_percent == pytest.approx(pooled)
    assert (shares.sigma.held_percent, shares.sigma.at_least_percent) == (50.0, 75.0)
    assert shares.sigma.median_percent == pytest.approx((85.0 + 99.5) / 2)
    assert shares.sigma.percentile_10_percent == pytest.approx(84.93)


def test_what_nothing_is_known_of_has_no_figure():
    shares = share_stops([path(None)])
    assert shares.wrong_flagged_percent == 100.0
    assert shares.flagged_fast_median_m is None
    assert shares.sigma is None


@pytest.fixture
def stops():
    """Two vehicles on every condition but one, where one drives alone and is refused."""
    table = FamilyTable(FamilySettings("stops", drives=1, pipelines=(PIPELINE,)))
    for condition in STOPS[:-1]:
        table.paths += [path(scores(), name, condition) for name in ("minivan", "loaded-van")]
    table.paths.append(path(None, "pickup", STOPS[-1]))
    return table


def test_vehicles_follow_their_condition_and_make_it_up(stops):
    rows = list(rows_of_stops(stops, PIPELINE))
    names = [(condition.name, vehicle) for condition, vehicle, _ in rows]
    assert names[:3] == [("plain", None), ("plain", "loaded-van"), ("plain", "minivan")]
    assert names[-2:] == [(STOPS[-1].name, None), (STOPS[-1].name, "pickup")]
    for condition in STOPS:
        own = [paths for of, vehicle, paths in rows if of is condition and vehicle is not None]
        assert sum(map(len, own)) == len(stops.of(PIPELINE, condition))


def test_the_document_has_a_share_for_each_row_and_other_families_have_no_shares(
    stops, hand_families
):
    made = json.loads(json.dumps(family_document(stops), allow_nan=False))
    Draft202012Validator(read_schema("conformance-families-1")).validate(made)
    rows = [(c.name, vehicle) for c, vehicle, _ in rows_of_stops(stops, PIPELINE)]
    assert [(s["condition"], s["vehicle"]) for s in made["stop_shares"]] == rows
    assert made["stop_shares"][-1]["without_profile"] == 1
    assert made["stop_shares"][0]["encoder"]["cross_correlation_percentile_1"] == 0.99
    assert "stop_shares" not in family_document(hand_families({}))


def test_the_terminal_has_a_row_for_each_condition_and_vehicle(stops):
    out = StringIO()
    print_families(stops, Console(file=out, width=100, emoji=False))
    lines = out.getvalue().splitlines()
    assert not [line for line in lines if "…" in line]
    begin = next(k for k, line in enumerate(lines) if "stops along the encoder's" in line)
    names = [line[1:20].rstrip() for line in lines[begin + 5 :]]
    rows = [
        f"  {vehicle}" if vehicle else c.name for c, vehicle, _ in rows_of_stops(stops, PIPELINE)
    ]
    assert names[: len(rows)] == rows
