"""A plan in TOML: what it becomes, and every mistake in it as one line."""

from pathlib import Path

import pytest

from floatref.errors import InputError
from floatref_conformance.certify.plan.plan_document import (
    DistancePlan,
    Plan,
    SectionPlan,
    StationaryPlan,
    read_plan,
)

SECTION = """
[[sections]]
name = "smooth"
reference = "smooth/reference.erd"
runs = ["smooth/run-*.erd"]
"""
WHOLE = f"""
format = "conformance-plan/1"
profiler = "Van 3"
weather = "dry"
{SECTION}from_m = 10
to_m = 160.9

[[sections]]
name = "rough"
reference = "rough.csv"
runs = ["more", "smooth/run-1.erd"]

[quiescent]
source = "parked"
from_m = 100.0
to_m = 250

[bounce]
source = "rough.csv"

[distance]
known_m = 1609
readings_m = [1609.1, 1610]
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A directory with the files that plans name; it is not the one that tests run in."""
    for name in ("smooth/reference.erd", "smooth/run-1.erd", "smooth/run-2.erd", "rough.csv"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    for name in ("parked/recording.json", "more/a/profile.json"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).touch()
    return tmp_path


def plan_of(folder: Path, text: str | bytes) -> Plan:
    path = folder / "plan.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_plan(path)


def test_all_that_a_plan_can_say(folder: Path) -> None:
    first, second = folder / "smooth/run-1.erd", folder / "smooth/run-2.erd"
    smooth = SectionPlan("smooth", folder / "smooth/reference.erd", (first, second), (10.0, 160.9))
    rough = SectionPlan("rough", folder / "rough.csv", (folder / "more/a", first))
    assert plan_of(folder, WHOLE) == Plan(
        (smooth, rough),
        "Van 3",
        StationaryPlan(folder / "parked", (100.0, 250.0)),
        StationaryPlan(folder / "rough.csv"),
        DistancePlan(1609.0, (1609.1, 1610.0)),
    )


def test_a_section_is_all_that_is_needed(folder: Path) -> None:
    plan = plan_of(folder, SECTION)
    assert plan.sections[0].stretch_m is None
    assert (plan.profiler, plan.quiescent, plan.bounce, plan.distance) == ("", None, None, None)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "has no sections"),
        ("sections = 3", "sections is 3; expected a list of 1 to 100 test sections"),
        ("sections = []", "sections is a list of 0"),
        ("[[sections]]", "has no name, reference, runs"),
        (SECTION.replace("reference =", "refrence ="), r"sections\[0\].refrence: did you mean ref"),
        (SECTION.replace("reference =", "truth ="), r"sections\[0\] \(smooth\) has no reference"),
        (f"{SECTION}too_m = 5", r"sections\[0\].too_m: did you mean to_m"),
        (f"profilr = 'a'\n{SECTION}", "profilr: did you mean profiler"),
        (f"{SECTION}[quiescant]\nsource = 'parked'", "quiescant: did you mean quiescent"),
        (f"{SECTION}[bounce]\nsorce = 'parked'", "bounce.sorce: did you mean source"),
        (f"{SECTION}[distance]\nknown = 1", "distance.known: did you mean known_m"),
        (f"{SECTION}from_m = 1", "section smooth: from_m stands alone"),
        (f"{SECTION}from_m = 9\nto_m = 9", "section smooth: from 9 to 9 m is no stretch"),
        (f"{SECTION}from_m = 'a'\nto_m = 9", r"from_m \(smooth\) is .a.; expected a distance in m"),
        (f"{SECTION}from_m = nan\nto_m = 9", "from_m is nan; give a finite number"),
        (SECTION.replace("run-*", "ride-*"), "section smooth: .*ride-.*no file matches"),
        (SECTION.replace("reference.erd", "truth.erd"), "section smooth: .*truth.erd: not found"),
        (
            SECTION.replace('["smooth/run-*.erd"]', "[]"),
            r"runs \(smooth\) is a list of 0; expected a list",
        ),
        (SECTION.replace('"smooth/run-*.erd"', "7"), r"runs\[0\] \(smooth\) is 7; expected a path"),
        (SECTION * 2, "two sections are called smooth"),
        (f"{SECTION}[quiescent]\nsource = 'nowhere'", "quiescent: .*nowhere: not found"),
        (f"{SECTION}[distance]\nknown_m = 0\nreadings_m = [1]", "known_m is 0; expected the len"),
        (f"{SECTION}[distance]\nknown_m = 5\nreadings_m = []", "readings_m is a list of 0"),
        (f"format = 'conformance-plan/2'\n{SECTION}", "format is .conformance-plan/2.; expected"),
        ("sections = [", "not TOML"),
        (b"\xff\xfe", "byte 0 is not UTF-8; save the plan as UTF-8"),
    ],
)
def test_a_mistake_is_one_line_that_names_the_plan(
    folder: Path, text: str | bytes, said: str
) -> None:
    with pytest.raises(InputError, match=said) as refused:
        plan_of(folder, text)
    assert "plan.toml" in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_plan_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none"):
        read_plan(tmp_path / "none.toml")
