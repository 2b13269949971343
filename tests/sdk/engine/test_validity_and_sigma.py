"""From flags to validity; what a tyre levels."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.engine import validity_and_sigma
from floatref.engine.validity_and_sigma import Reach, add_contact_error, replace_by_validity
from floatref.values.arrays import Flag

KINDS = [0, 0, 0, 0, 0, 1, 2, 3, 4, 6, 8, 12]


def near(k: int, others: list[int], before: int, after: int) -> bool:
    """Return whether point ``k`` lies so few points before or after one of ``others``."""
    return any(-before <= k - other <= after for other in others)


@settings(deadline=None, max_examples=80)
@given(
    flags=st.lists(st.sampled_from(KINDS), max_size=60),
    reach=st.tuples(*[st.integers(0, 9)] * 4),
    run_in=st.integers(0, 4),
    piece=st.integers(1, 50),
)
def test_a_point_is_valid_without_flags_and_out_of_reach(flags, reach, run_in, piece):
    drift, before, after, braking = reach
    where = {kind: [k for k, f in enumerate(flags) if f & kind] for kind in Flag}
    expected = [
        flag == 0
        and not near(k, where[Flag.DRIFT], drift, drift)
        and not near(k, where[Flag.SLOW], before, after)
        and not near(k, where[Flag.BRAKING], 0, braking)
        and run_in <= k < len(flags) - run_in
        for k, flag in enumerate(flags)
    ]
    metres = Reach(*(0.5 * n for n in (drift, run_in, before, after, braking)))
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(validity_and_sigma, "PIECE", piece)
        assert replace_by_validity(np.array(flags, np.uint8), 0.5, metres).tolist() == expected


def test_a_pipeline_without_such_settings_marks_what_its_filter_spreads():
    assert Reach.of({"cutoff_wavelength_m": 80.0}) == Reach(drift_m=80.0, run_in_m=40.0)
    assert Reach.of({}) == Reach()


@pytest.mark.parametrize("contact_m", [0.1, 0.25])
def test_the_levelled_waves_have_the_predicted_size(contact_m: float) -> None:
    interval = 0.005
    steps = np.random.default_rng(0).standard_normal(200_000)
    road = 1e-4 * np.cumsum(steps)
    points = round(contact_m / interval)
    level = np.convolve(road, np.ones(points) / points, "same")
    lost = (road - level)[points:-points]
    sigma = np.zeros(road.size)
    add_contact_error(sigma, level, interval, contact_m)
    assert np.median(sigma) == pytest.approx(lost.std(), rel=0.08)


def test_it_adds_to_what_is_there_as_independent_and_passes_over_gaps() -> None:
    road = 1e-3 * np.random.default_rng(1).standard_normal(4000).cumsum()
    alone, beside = np.zeros(road.size), np.full(road.size, 3e-3)
    add_contact_error(alone, road, 0.05, 0.25)
    add_contact_error(beside, road, 0.05, 0.25)
    np.testing.assert_allclose(beside, np.hypot(3e-3, alone))
    road[1000:1100] = np.nan
    holed = np.zeros(road.size)
    add_contact_error(holed, road, 0.05, 0.25)
    assert np.isfinite(holed).all()
