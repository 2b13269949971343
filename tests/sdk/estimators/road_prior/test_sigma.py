"""1-σ of the delivered elevation is that of least squares, filtered over distance."""

import numpy as np
import pytest

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.measures import high_pass
from floatref.values.channels import ChannelId
from floatref_reference.road_prior.least_squares import deviation, least_squares

SIGMA = ChannelId("elevation_sigma", "left")
RATE, SECONDS, SPEED = 25, 6.0, 30.0
WAVELENGTH_M = 40.0
ONE_PASS = 105.91 / 91.44
"""The cut-off of either pass, where both together are at -3 dB at `WAVELENGTH_M`."""


def least(drive, c):
    """Return 1-σ of the height, filtered as a profile is, at all samples of ``drive``."""
    a_x, response = drive.excitation(c)
    priors = (c.lean_sigma_rad, c.tilt_sigma)
    literally = drive.literally(c, (a_x, a_x * response), a_x, priors)
    weights = np.zeros((a_x.size, a_x.size, 7))
    for k, impulse in enumerate(np.eye(a_x.size)):
        weights[:, k, 0] = high_pass(impulse, SPEED / RATE, WAVELENGTH_M)
    return deviation(least_squares(*literally), weights)


@pytest.mark.slow
@pytest.mark.cites("(2.10)")
@pytest.mark.parametrize("height_m", [4e-5, 2e-3])
@pytest.mark.parametrize(
    "accelerometer",
    [{"acceleration": 0.1}, {"acceleration": 0.3}, {"acceleration_walk": 1.0}],
    ids=str,
)
def test_it_is_that_of_least_squares_and_of_a_reading(drive, through, accelerometer, height_m):
    """The accelerometer is so bad that its own errors are most of it, beyond the filter's reach.

    With a good one most of it is the ramp of the height, unknown in so short a run, of which the
    filter leaves more between marks 8 m apart than between samples.
    """
    constants = RoadPrior(road_memory_m=1e15, edge_sigmas=1e6, height_m=height_m, **accelerometer)
    drawn = drive(3, SECONDS, RATE, speed=SPEED)
    stage = RoadPriorSmoother(constants, WAVELENGTH_M * ONE_PASS, tolerance_m=0.0)
    found = through(stage, drawn)[SIGMA]
    expected = np.hypot(least(drawn, constants), height_m)
    reach = int(1.5 * WAVELENGTH_M * ONE_PASS * RATE / SPEED)
    inside = slice(reach, -reach)
    np.testing.assert_allclose(found[inside], expected[inside], rtol=0.1)
