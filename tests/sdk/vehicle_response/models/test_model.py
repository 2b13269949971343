"""What is refused as a model: matrices that would make energy, tyres and names that are none."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.vehicle_response import Freedom, Tyre, VehicleModel

FREEDOMS = Freedom("body", "z", "sprung"), Freedom("wheel", "u", "unsprung")
TYRES = (Tyre("wheel", 2e5, 100.0),)
MASS = np.diag([500.0, 50.0])
DAMPING = np.array([[1e3, -1e3], [-1e3, 1.1e3]])
STIFFNESS = np.array([[4e4, -4e4], [-4e4, 2.4e5]])


def model(freedoms=FREEDOMS, tyres=TYRES, mass=MASS, damping=DAMPING, stiffness=STIFFNESS):
    return VehicleModel("cart", freedoms, tyres, mass, damping, stiffness)


def test_the_matrices_are_kept_and_cannot_be_changed():
    made = model()
    np.testing.assert_array_equal(made.stiffness, STIFFNESS)
    assert made.stiffness is not STIFFNESS
    with pytest.raises(ValueError, match="read-only"):
        made.stiffness[0, 0] = 0.0


def test_a_tyre_pushes_its_own_wheel():
    np.testing.assert_array_equal(model().selection, [[0.0], [1.0]])


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"mass": np.diag([500.0, 0.0])}, "mass has the eigenvalue 0"),
        ({"mass": np.eye(3)}, r"mass has the shape \(3, 3\); 2 freedoms need \(2, 2\)"),
        ({"mass": np.diag([np.nan, 1.0])}, "mass has a value that is not finite"),
        ({"stiffness": STIFFNESS * [[1, -1], [1, 1]]}, "stiffness is not symmetric"),
        ({"stiffness": STIFFNESS - np.diag([0, 2e5])}, "stiffness without the tyres has the eig"),
        ({"damping": -DAMPING}, "damping without the tyres has the eigenvalue -"),
        ({"tyres": ()}, "0 tyres"),
        ({"freedoms": ()}, "the freedoms -; give"),
        ({"tyres": (Tyre("axle", 1e5),)}, "no freedom 'axle'; it has body, wheel"),
        ({"tyres": (Tyre("wheel", 0.0),)}, "tyre of the wheel has stiffness 0 N/m"),
        ({"tyres": (Tyre("wheel", np.inf),)}, "tyre of the wheel has stiffness inf N/m"),
        ({"tyres": (Tyre("wheel", 1e5, -1.0),)}, r"damping -1 N·s/m"),
        ({"tyres": (Tyre("wheel", 1e5, x_m=np.nan),)}, "x_m nan"),
        ({"freedoms": (FREEDOMS[0], FREEDOMS[0])}, "every freedom a name of its own"),
    ],
)
def test_what_is_no_vehicle_is_refused_in_one_line(changed, message):
    with pytest.raises(InputError, match=f"^model cart: .*{message}") as found:
        model(**changed)
    assert "\n" not in str(found.value)
