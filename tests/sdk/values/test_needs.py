"""What a pipeline takes of a recording: its own wheel paths, its own clock."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.screening.plausibility import examine
from floatref.values.clock import UniformClock
from floatref.values.needs import Needs, nominal_needs, profiled_tracks, tracks_with
from floatref.values.recording import Channel, Recording

CLOCK = UniformClock.of(100)
K = np.arange(400)


def channel(name: str, track: str | None = None, level: float = 9.8) -> Channel:
    values = 0.2 * K if name == "distance" else level + 0.1 * np.sin(K)
    return Channel.of(name, values, CLOCK, track)


def recording(*more: Channel) -> Recording:
    return Recording((channel("distance"), channel("unsprung_specific_force", "left"), *more))


def test_channels_come_once_and_what_is_not_there_is_left_out() -> None:
    shared = channel("sprung_specific_force")
    both = recording(channel("unsprung_specific_force", "right"), shared)
    needs = Needs(("left", "right"), "unsprung_specific_force", ("sprung_specific_force", "height"))
    names = [str(c.id) for c in needs.channels(both)]
    assert names == [
        "distance",
        "left.unsprung_specific_force",
        "sprung_specific_force",
        "right.unsprung_specific_force",
    ]


def test_a_height_makes_a_nominal_wheel_path() -> None:
    nominal = recording(
        channel("vertical_specific_force", "right"), channel("height", "right", 0.3)
    )
    assert nominal_needs(nominal) == Needs(("right",))
    assert profiled_tracks(nominal) == ("right",)
    assert tracks_with(nominal, "unsprung_specific_force") == ("left",)
    with pytest.raises(InputError, match="channel height: missing"):
        nominal_needs(recording())


def test_what_is_not_needed_is_not_examined() -> None:
    wrong = recording(channel("sprung_specific_force", "left", 0.0))
    assert examine(wrong, Needs(("left",), "unsprung_specific_force", ())) == ()
    with pytest.raises(InputError, match="1 g has been removed"):
        examine(wrong, Needs(("left",), "unsprung_specific_force", ("sprung_specific_force",)))


UNITS = [
    ("unsprung_displacement", 12.0, "if it is in mm, multiply by 0.001"),
    ("unsprung_velocity", 50.0, "if it is in mm/s, multiply by 0.001"),
    ("pitch_angle", 3.0, "if it is in degrees, multiply by 0.0174533"),
    ("pitch_rate", 30.0, "if it is in deg/s, multiply by 0.0174533"),
    ("pitch_acceleration", 900.0, r"if it is in deg/s\^2, multiply by 0.0174533"),
]


@pytest.mark.parametrize(("name", "level", "said"), UNITS)
def test_another_unit_is_guessed(name: str, level: float, said: str) -> None:
    needs = Needs(("left",), "unsprung_specific_force", (name,))
    with pytest.raises(InputError, match=said):
        examine(recording(channel(name, "left", level)), needs)
    assert examine(recording(channel(name, "left", 0.0)), needs) == ()
