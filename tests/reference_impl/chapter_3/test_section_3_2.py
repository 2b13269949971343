"""Local coordinates put a place where it was; an average over one second is a change of speed."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.chapter_3.section_3_2_2_coordinates import (
    OnEarth,
    OnSection,
    Origin,
    along,
    degrees,
    direction,
    footprint,
    local,
)
from floatref_reference.chapter_3.section_3_2_3_speed import averaged, differentiated, resolved

MNROAD = Origin(math.radians(45.26), math.radians(-93.71), 290.0)
PSI = math.radians(-37.68)
A, E2 = 6378137.0, 0.00669437999014


def ellipsoidal(phi: float, lam: float) -> OnEarth:
    """Return east and north of MNROAD by the radii of curvature of the ellipsoid WGS 84."""
    w = 1 - E2 * math.sin(MNROAD.phi) ** 2
    meridian, prime = A * (1 - E2) / w**1.5 + MNROAD.H, A / math.sqrt(w) + MNROAD.H
    east = prime * math.cos(MNROAD.phi) * (lam - MNROAD.lam)
    return OnEarth(np.longdouble(east), np.longdouble(meridian * (phi - MNROAD.phi)))


@pytest.mark.cites("(3.3)", "(3.4)")
@given(angle=st.floats(-3.1, 3.1), length=st.floats(1.0, 1e4), share=st.floats(0.0, 1.0))
def test_a_place_between_both_ends_is_forward_alone(angle, length, share) -> None:
    end = OnEarth(*(np.longdouble(length * f(angle)) for f in (math.cos, math.sin)))
    dF, dL = along(OnEarth(share * end.east, share * end.north), direction(end))
    assert float(dF) == pytest.approx(share * length, abs=1e-9)
    assert float(dL) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.cites("(3.3)")
@given(east=st.floats(-500, 500), north=st.floats(-500, 500))
def test_the_sections_axes_are_a_rotation_left_of_forward_is_left(east, north) -> None:
    place = along(OnEarth(np.longdouble(east), np.longdouble(north)), PSI)
    assert math.hypot(*map(float, place)) == pytest.approx(math.hypot(east, north), abs=1e-9)
    left_of_a_section_to_the_east = along(OnEarth(np.longdouble(0), np.longdouble(1)), 0.0)
    assert left_of_a_section_to_the_east == OnSection(np.longdouble(0), np.longdouble(1))


@pytest.mark.cites("(3.4)")
def test_a_section_of_458_m_to_the_southeast_has_the_printed_direction() -> None:
    end = OnEarth(np.longdouble(458 * math.cos(PSI)), np.longdouble(458 * math.sin(PSI)))
    assert end.east > 0 > end.north
    assert float(degrees(direction(end))) == pytest.approx(-37.68)


def test_a_section_without_length_has_no_direction() -> None:
    with pytest.raises(ValueError, match="ends where it starts"):
        direction(OnEarth(np.longdouble(0), np.longdouble(0)))


@pytest.mark.cites("(3.1)", "(3.2)")
def test_the_sphere_of_print_is_0_9_m_short_over_the_section() -> None:
    """458 m by the ellipsoid are 457.09 m by (3.1) to (3.3): 0.33 % of the eastward part."""
    per_rad = ellipsoidal(MNROAD.phi + 1.0, MNROAD.lam + 1.0)
    phi = MNROAD.phi + 458 * math.sin(PSI) / float(per_rad.north)
    lam = MNROAD.lam + 458 * math.cos(PSI) / float(per_rad.east)
    by_print = local(phi, lam, MNROAD)
    assert float(by_print.north) == pytest.approx(458 * math.sin(PSI), rel=1e-4)
    assert float(by_print.east) / (458 * math.cos(PSI)) - 1 == pytest.approx(-0.0033, abs=1e-4)
    assert 458 - float(along(by_print, PSI).forward) == pytest.approx(0.91, abs=0.01)


@given(forward=st.floats(-3, 3), leftward=st.floats(-2, 2), yaw=st.floats(-0.2, 0.2))
def test_the_footprint_is_as_far_from_the_antenna_as_on_the_vehicle(forward, leftward, yaw):
    antenna = OnSection(np.longdouble(100), np.longdouble(0.5))
    moved = footprint(antenna, forward, leftward, yaw)
    gone = math.hypot(moved.forward - antenna.forward, moved.leftward - antenna.leftward)
    assert gone == pytest.approx(math.hypot(forward, leftward), abs=1e-12)
    straight = footprint(antenna, forward, leftward)
    assert map(float, straight) != map(float, antenna)
    assert float(straight.forward) == pytest.approx(100 + forward)


@given(speed=st.floats(0.1, 40), psi=st.floats(-3, 3), off=st.floats(-0.3, 0.3))
def test_a_heading_along_the_section_is_forward_speed_alone(speed, psi, off) -> None:
    heading = math.pi / 2 - psi - off
    forward, left = resolved(speed, heading, psi)
    assert float(forward) == pytest.approx(speed * math.cos(off), abs=1e-9)
    assert float(left) == pytest.approx(speed * math.sin(off), abs=1e-9)


@given(seed=st.integers(0, 99), n=st.integers(1, 20))
def test_an_averaged_acceleration_is_the_change_of_speed_in_that_second(seed, n) -> None:
    v = np.random.default_rng(seed).normal(size=40)
    a = averaged(differentiated(v, 1 / n), 1 / n)
    assert a.astype(float) == pytest.approx(v[n:] - v[:-n])


def test_a_drive_shorter_than_a_second_has_no_average() -> None:
    with pytest.raises(ValueError, match="shorter than the average"):
        averaged(np.zeros(19))
