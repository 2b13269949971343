"""Of drawn stops on five shapes of road the truth lies within two sigma as often as it should.

Along the encoder's distance, over all points of 160.9 m. An error of the grade moves all points
about a stop together, so that a wheel path has all of them within two sigma or a half: the points
of a shape are looked at together. Sigma must not be wide everywhere, either.
"""

from functools import cache

import numpy as np
import pytest

from floatref_conformance.table.families.conditions import STOPS, STOPS_FAMILY
from floatref_conformance.table.families.family_making import make_family_table
from floatref_conformance.table.families.family_settings import FamilySettings
from floatref_conformance.table.families.family_table import FamilyTable

pytestmark = pytest.mark.slow

PIPELINES = "road-prior-smoother", "road-prior-smoother-imu"
DRIVES, SEED = 8, 4
SHAPES = [condition.name for condition in STOPS]
TOO_SMALL = {("road-prior-smoother-imu", name) for name in ("hump, gutter", "break of 6 %")}
"""Where sigma falls short of what is asked, 85 %: docs/road-prior-imu.md says so."""
SHORT = pytest.mark.xfail(reason="sigma has no share for an error of the attitude", strict=True)
CASES = [
    pytest.param(name, shape, marks=[SHORT] if (name, shape) in TOO_SMALL else [])
    for name in PIPELINES
    for shape in SHAPES
]


@cache
def driven(pipeline: str) -> FamilyTable:
    return make_family_table(FamilySettings(STOPS_FAMILY, SEED, DRIVES, (pipeline,)))


def within(pipeline: str, shape: str) -> float:
    """Return the share of points within two sigma, in percent."""
    (condition,) = (c for c in STOPS if c.name == shape)
    scores = [path.scores for path in driven(pipeline).of(pipeline, condition)]
    assert len(scores) == 2 * DRIVES
    return float(np.mean([s.encoder.within_two_sigma_percent for s in scores if s]))


@pytest.mark.parametrize(("pipeline", "shape"), CASES)
def test_sigma_contains_the_truth_on_every_shape(pipeline: str, shape: str) -> None:
    assert within(pipeline, shape) >= 85.0


@pytest.mark.parametrize("pipeline", PIPELINES)
def test_sigma_is_not_wide_on_all_of_them(pipeline: str) -> None:
    assert np.mean([within(pipeline, shape) for shape in SHAPES]) <= 99.5
