"""The reference's areas, bumps, dips and straightedge, by closed forms."""

import numpy as np
import pytest

from floatref_reference.ride_measures.areas import Area, areas_above, valid_share
from floatref_reference.ride_measures.localized import (
    bumps_and_dips,
    deviation,
    localized_roughness,
)
from floatref_reference.ride_measures.straightedge import beyond_tolerance, midpoint_deviation


def test_areas_of_a_short_signal() -> None:
    assert areas_above([1, 3, 3, 0, 2], 0.5) == [Area(0, 2, 1), Area(4, 4, 4)]
    assert areas_above([0, 0.5], 0.5) == []


def test_a_share_counts_samples_whose_points_are_all_valid() -> None:
    valid = [True, True, False, True, True, True]
    assert valid_share(valid, 0, 5) == 5 / 6
    assert valid_share(valid, 3, 5, before=1) == 2 / 3


def test_one_bump_on_a_flat_road_is_one_area() -> None:
    interval = 0.1
    z = np.zeros(900)
    z[400:410] = 0.01
    (place,) = localized_roughness(z, interval, 3.0)
    assert place.start < 40.5 < place.end
    assert place.start < place.peak_at < place.end


def test_bumps_of_a_parabola_and_of_one_step_up_and_down() -> None:
    interval, n = 0.0762, 50
    d = deviation(np.arange(300.0) ** 2, interval)
    assert [float(value) for value in d] == pytest.approx([-n * (n + 1) / 3] * len(d))
    z = np.zeros(400)
    z[200:210] = 0.005
    (bump,) = bumps_and_dips(z, interval)
    assert float(bump.peak) == pytest.approx(0.005 * (1 - 10 / 101))
    assert (bump.start, bump.end) == (200 * interval, 209 * interval)


def test_a_straightedge_on_a_crest_and_on_a_bump() -> None:
    interval, half = 0.0762, 20
    crest = midpoint_deviation(-(np.arange(200.0) ** 2), interval)
    assert [float(value) for value in crest] == pytest.approx([half**2] * len(crest))
    z = np.zeros(200)
    z[100] = 0.008
    assert [float(each.peak) for each in beyond_tolerance(z, interval, 0.003)] == [
        -0.004,
        0.008,
        -0.004,
    ]
