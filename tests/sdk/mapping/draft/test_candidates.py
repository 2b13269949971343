"""What a column may be depends on what else the file holds."""

from itertools import permutations

import pytest

from floatref.mapping.draft.guesses import candidates
from floatref.values.native import Column, NativeClock, NativeFile, Stream

UNITS = {"Acc": "g", "Travel": "mm", "Laser": "mm", "force": ""}


def channels(*names: str) -> dict[str, str | None]:
    """Return what the columns ``names`` of one stream may be, by name."""
    columns = tuple(
        Column(name, next(unit for part, unit in UNITS.items() if part in name)) for name in names
    )
    native = NativeFile((Stream("adc", columns, 3, NativeClock(), lambda _: iter(())),))
    return {c.column.name: c.guess and c.guess.channel for c in candidates(native)}


@pytest.mark.parametrize("names", list(permutations(["BodyAccZ", "HubAccFL", "Laser_L"])))
def test_beside_a_laser_the_body_has_the_accelerometer_of_a_profiler(names: tuple) -> None:
    found = channels(*names)
    assert found["BodyAccZ"] == "vertical_specific_force"
    assert found["HubAccFL"] == "unsprung_specific_force"
    assert found["Laser_L"] == "height"


@pytest.mark.parametrize("names", list(permutations(["BodyAccZ", "HubAccFL", "SuspTravelFL"])))
def test_beside_wheels_alone_it_is_that_of_a_sprung_mass(names: tuple) -> None:
    assert channels(*names)["BodyAccZ"] == "sprung_specific_force"


def test_an_accelerometer_that_says_no_body_stays_that_of_a_profiler() -> None:
    found = channels("AccZ", "HubAccFL")
    assert found["AccZ"] == "vertical_specific_force"
    assert channels("BodyAccZ", "SuspTravelFL")["BodyAccZ"] == "vertical_specific_force"


def test_a_rear_axle_that_is_the_only_one_has_the_channels_of_that() -> None:
    alone = channels("HubAccRL", "SuspTravelRL", "BodyAcc")
    assert alone == {
        "HubAccRL": "unsprung_specific_force",
        "SuspTravelRL": "suspension_deflection",
        "BodyAcc": "sprung_specific_force",
    }
    both = channels("HubAccRL", "SuspTravelFL")
    assert both["HubAccRL"] == "rear_unsprung_specific_force"
    assert both["SuspTravelFL"] == "suspension_deflection"


def test_what_has_our_names_keeps_them() -> None:
    names = ("left.rear_unsprung_specific_force", "body.vertical_specific_force")
    assert list(channels(*names).values()) == [name.partition(".")[2] for name in names]
