"""3.2.2 Local Coordinates: where a GPS antenna is along and across the test section."""

from typing import NamedTuple

import numpy as np

from floatref_reference.signals import PI, Real

R_0 = np.longdouble("6368084")
"""R(φ_0) of section 3.2.2, the Earth's radius at the origin, m. (3.1) and (3.2) take the Earth for
a sphere of this radius. On the ellipsoid of GPS a degree east at 45.26° is 0.33 % longer, so that
dF of the section of 458 m is 0.91 m short; a degree north is 0.006 % shorter."""


class Origin(NamedTuple):
    """Where a test section starts: the left wheel path at the starting stripe.

    Args:
        phi: latitude φ_0, rad.
        lam: longitude λ_0, rad.
        H: height above sea level H_0, m.
        R: the Earth's radius at φ_0, m.
    """

    phi: Real
    lam: Real
    H: Real
    R: Real = R_0


class OnEarth(NamedTuple):
    """A horizontal place from the origin, in the order of the axes that point east and north.

    Args:
        east: dE, m.
        north: dN, m.
    """

    east: np.longdouble
    north: np.longdouble


class OnSection(NamedTuple):
    """A horizontal place from the origin along and across the test section.

    Args:
        forward: dF, m.
        leftward: dL, m.
    """

    forward: np.longdouble
    leftward: np.longdouble


def local(phi: Real, lam: Real, origin: Origin) -> OnEarth:
    """Convert latitude and longitude to a place east and north of the origin.

    Equation:
        (3.1) dN = (R(φ_0) + H_0) (φ - φ_0); (3.2) dE = (R(φ_0) + H_0) cos(φ) (λ - λ_0)

    Args:
        phi: latitude φ, rad.
        lam: longitude λ, rad.
        origin: start of the test section.

    Returns:
        dE and dN, m.
    """
    radius = np.longdouble(origin.R) + np.longdouble(origin.H)
    phi_k, lam_k = np.longdouble(phi), np.longdouble(lam)
    dE = radius * np.cos(phi_k) * (lam_k - np.longdouble(origin.lam))
    return OnEarth(dE, radius * (phi_k - np.longdouble(origin.phi)))


def direction(end: OnEarth) -> np.longdouble:
    """Compute the direction of the test section from its left endpoint.

    Equation:
        (3.4) ψ = atan(dN_End/dE_End), which is -37.68° in print. The quadrant is that of the
        endpoint here; the arctangent alone has it for a section that runs east.

    Args:
        end: the endpoint of the left wheel path.

    Returns:
        ψ, rad, positive from east to north.

    Raises:
        ValueError: if the endpoint is the origin.
    """
    if end.east == 0 and end.north == 0:
        raise ValueError("the section ends where it starts: it has no direction")
    return np.longdouble(np.arctan2(end.north, end.east))


def along(place: OnEarth, psi: Real) -> OnSection:
    """Turn a place, or a velocity, into the direction of the test section.

    Equation:
        (3.3) dF = dE cos(ψ) + dN sin(ψ); dL = -dE sin(ψ) + dN cos(ψ)

    Args:
        place: east and north of the origin, m or m/s.
        psi: direction ψ of the section, rad.

    Returns:
        dF and dL in the unit of the place.
    """
    c, s = np.cos(np.longdouble(psi)), np.sin(np.longdouble(psi))
    return OnSection(place.east * c + place.north * s, -place.east * s + place.north * c)


def footprint(antenna: OnSection, forward: Real, leftward: Real, yaw: Real = 0.0) -> OnSection:
    """Move a place from the antenna to the laser footprint of a profiler.

    Equation:
        Section 3.2.2: "the coordinates were offset", by what was measured on the host vehicle.

    Args:
        antenna: where the antenna is, m.
        forward: footprint ahead of the antenna, m along the vehicle.
        leftward: footprint left of the antenna, m across the vehicle.
        yaw: direction of the vehicle from that of the section, rad, positive to the left. The
            text leaves it out.

    Returns:
        dF and dL of the footprint, m.
    """
    c, s = np.cos(np.longdouble(yaw)), np.sin(np.longdouble(yaw))
    x, y = np.longdouble(forward), np.longdouble(leftward)
    return OnSection(antenna.forward + x * c - y * s, antenna.leftward + x * s + y * c)


def degrees(angle: Real) -> np.longdouble:
    """Convert an angle to the unit in which (3.4) is printed.

    Equation:
        (3.4) in degrees.

    Args:
        angle: rad.

    Returns:
        Degrees.
    """
    return np.longdouble(np.longdouble(angle) * 180 / PI)
