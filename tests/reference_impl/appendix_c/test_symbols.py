"""The abbreviations are sines and cosines, and the vectors are ordered as printed."""

import cmath

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_c.symbols import Inputs, State, abbreviations

ANGLE = st.floats(-3, 3)


@pytest.mark.cites("(C.1)")
@settings(deadline=None, max_examples=30)
@given(theta=ANGLE, phi=ANGLE)
def test_abbreviations_are_the_parts_of_a_turn(theta: float, phi: float) -> None:
    s_theta, c_theta, s_phi, c_phi = abbreviations(theta, phi)
    assert complex(c_theta, s_theta) == pytest.approx(cmath.exp(1j * theta))
    assert complex(c_phi, s_phi) == pytest.approx(cmath.exp(1j * phi))


@pytest.mark.cites("(C.2)")
def test_order_of_the_state_and_of_the_inputs() -> None:
    assert State._fields == ("r_zp", "v_zp", "theta", "phi", "delta_a", "delta_1", "delta_2")
    assert Inputs._fields == ("u_ax", "u_ay", "u_az", "u_1", "u_2", "u_3")
