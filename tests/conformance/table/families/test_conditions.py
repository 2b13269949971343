"""What the conditions draw: drives that can be driven, within the ranges of their sources."""

from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.checks.driving.layout import layout_of
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import drive_of, road_of
from floatref_conformance.table.families.conditions import (
    CONDITIONS,
    FAMILIES,
    SINGLE,
    SINGLE_FAMILY,
)
from floatref_conformance.table.families.family_settings import FamilySettings, draw_drive

NOTHING: frozenset[str] = frozenset()
conditions = st.sampled_from(CONDITIONS)
RANGES = {
    "slip_percent_per_g": (3.0, 12.0),
    "laser_ahead_m": (-0.3, 0.3),
    "latency_ms": (0.0, 3.0),
    "radius_percent": (0.0, 1.0),
    "friction_nm": (0.0, 2500.0),
    "crown_mm": (-150.0, 150.0),
    "break_percent": (-6.0, 6.0),
    "wander_m": (0.0, 0.3),
}


@settings(deadline=None, max_examples=60)
@given(condition=conditions, seed=st.integers(0, 1000), number=st.integers(0, 50))
def test_every_drive_can_be_driven_scored_and_read(condition, seed, number):
    scenario = draw_drive(seed, condition, number, NOTHING)
    layout = layout_of(scenario)
    assert drive_of(scenario).length_m >= scenario.length_m - 1e-6
    assert all(end - start == pytest.approx(160.9) for start, end in layout.stretches)
    assert scenario.bump_mm == 0.0
    for name, (low, high) in RANGES.items():
        if condition.family != SINGLE_FAMILY:
            assert low <= getattr(scenario, name) <= high, name
    values = [getattr(scenario, f.name) for f in fields(scenario)]
    assert all(v == round(v, 6) for v in values if isinstance(v, float))


@settings(deadline=None, max_examples=20)
@given(condition=conditions, seed=st.integers(0, 1000), number=st.integers(0, 20))
def test_a_drive_follows_from_seed_condition_and_number_alone(condition, seed, number):
    first = draw_drive(seed, condition, number, NOTHING)
    assert draw_drive(seed, condition, number, NOTHING) == first
    assert draw_drive(seed + 1, condition, number, NOTHING) != first


def test_a_smaller_table_has_the_same_drives():
    few = FamilySettings("urban", drives=1, pipelines=("temporal-basic",))
    more = FamilySettings("urban", drives=2, pipelines=("temporal-basic",))
    drives = {name: scenario for _, name, scenario in more.scenarios(NOTHING)}
    assert len(drives) == more.passes
    for _, name, scenario in few.scenarios(NOTHING):
        assert drives[name] == scenario


def test_a_column_of_single_changes_only_what_it_says():
    columns = {c.name: draw_drive(3, c, 1, NOTHING) for c in CONDITIONS if c.family == "single"}
    plain = columns.pop("plain stop")
    for name, scenario in columns.items():
        changed = {
            f.name for f in fields(Scenario) if getattr(scenario, f.name) != getattr(plain, f.name)
        }
        # A drive over a break of grade runs on for longer.
        follows = {"crown_at_m", "break_at_m", *({"length_m"} if scenario.break_percent else ())}
        assert changed - follows == {
            key for key, value in SINGLE[name].items() if getattr(plain, key) != value
        }


def test_a_shape_lies_at_the_event_or_beside_it():
    beside = next(c for c in CONDITIONS if c.beside_m)
    scenario = draw_drive(0, beside, 0, NOTHING)
    at_m = scenario.crown_at_m if scenario.crown_mm else scenario.break_at_m
    assert at_m == scenario.event_at_m + beside.beside_m
    crown = next(c for c in CONDITIONS if c.name == "stop, crown")
    scenario = draw_drive(0, crown, 0, NOTHING)
    assert scenario.crown_at_m == scenario.event_at_m


@pytest.mark.slow
def test_concrete_has_a_slope_whose_kurtosis_is_in_the_hundreds():
    concrete = next(c for c in CONDITIONS if c.full_name == "single: concrete")
    scenario = draw_drive(0, concrete, 0, NOTHING)
    road = road_of(scenario, scenario.length_m)
    slope = np.diff(road.elevation["left"])[: int(400 / road.spacing_m)]
    slope = slope[int(100 / road.spacing_m) :] - slope[int(100 / road.spacing_m) :].mean()
    assert np.mean(slope**4) / np.mean(slope**2) ** 2 > 100.0


def test_names_are_unique_and_unknown_ones_are_refused():
    assert len({c.full_name for c in CONDITIONS}) == len(CONDITIONS)
    assert FAMILIES == ("single", "urban", "rural", "harsh")
    with pytest.raises(InputError, match="family suburban: unknown"):
        FamilySettings("suburban")
    with pytest.raises(InputError, match="drives is 0; give 1 or more"):
        FamilySettings(drives=0)
