"""The trailer: how it hangs together, and the signs of its channels."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.vehicle_response import IMINE_TRAILER, Trailer


def test_without_a_hitch_the_chassis_turns_freely_about_the_axle():
    model = IMINE_TRAILER.model()
    free = np.array([0.0, 0.0, IMINE_TRAILER.axle_m, 0.0, 1.0])
    np.testing.assert_allclose(model.stiffness @ free, 0.0, atol=1e-9)
    np.testing.assert_allclose(model.damping @ free, 0.0, atol=1e-9)


def test_the_angles_are_positive_against_those_of_a_recording():
    model = IMINE_TRAILER.model()
    on_the_left = model.selection @ [190e3 * 0.1, 0.0]
    # The free turn about the axle is left out: that with the least pitch.
    rest = np.linalg.lstsq(model.stiffness, on_the_left, rcond=1e-10)[0]
    roll = model.freedoms[model.index("roll")].sign * rest[model.index("roll")]
    assert roll > 0.01
    # With the nose up the chassis is low over the axle, and presses both wheels down.
    nose_up = np.array([0.0, 0.0, 0.0, 0.0, 0.1])
    pressed = model.stiffness @ nose_up
    assert pressed[0] > 0
    assert pressed[1] > 0
    assert model.freedoms[model.index("pitch")].sign == -1.0


def test_its_wheels_run_in_two_wheel_paths():
    model = IMINE_TRAILER.model("north", "south")
    assert [(t.freedom, t.track, t.x_m) for t in model.tyres] == [
        ("left wheel", "north", -0.6),
        ("right wheel", "south", -0.6),
    ]
    assert [f.track for f in model.freedoms] == ["north", "south", "", "", ""]


@pytest.mark.parametrize("name", ["coupling_n_per_m", "left_tyre_ns_per_m", "right_tyre_ns_per_m"])
def test_some_parts_may_be_left_out(name):
    assert getattr(Trailer(**{name: 0.0}), name) == 0.0
    with pytest.raises(InputError, match=f"two-wheel-trailer: {name} is -1 N.*zero or above"):
        Trailer(**{name: -1.0})


def test_a_roll_inertia_that_no_chassis_has_is_refused():
    with pytest.raises(InputError, match="roll_kg_m2 is 2000 kg·m², above the 1350 kg·m² of 600"):
        Trailer(roll_kg_m2=2000.0)
