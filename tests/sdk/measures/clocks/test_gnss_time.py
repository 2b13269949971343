"""GNSS time that was recorded, held and late: the clock behind it comes back."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.clocks.clock_alignment import align_by_time_readings
from floatref_reference.chapter_4 import section_4_4_clocks as reference

FEW = settings(deadline=None, max_examples=40)
seeds = st.integers(0, 2**32 - 1)
drifts = st.floats(-2e-4, 2e-4)


@FEW
@given(
    seed=seeds,
    drift=drifts,
    late=st.floats(0.0, 0.04),
    start=st.sampled_from([3600.0, 86_390.0, 604_790.0]),
    roll=st.sampled_from([86_400.0, 604_800.0]),
)
def test_time_readings_tell_the_clock_to_within_their_bound(seed, drift, late, start, roll) -> None:
    """Held between updates of 0.1 s, recorded 20 to 60 ms late, over midnight or a week's end."""
    assume(start < roll)
    rng = np.random.default_rng(seed)
    base = np.arange(0.0, 60.0, 0.002)
    gnss = start + np.arange(0.0, 60.0, 0.1)
    shown = 5.0 + (1 + drift) * (gnss - start)
    after = np.searchsorted(shown + 0.02 + rng.uniform(0.0, late, gnss.size), base) - 1
    read = np.where(after >= 0, gnss[after] % roll, np.nan)
    found = align_by_time_readings(base, read)
    at = gnss[60:]
    behind = found.to_base(at) - (5.0 + (1 + drift) * (at - start))
    assert behind.min() > 0.0
    assert behind.max() < 0.02 + 0.004 + 0.1 * late
    assert behind.max() < found.late_s <= 0.11
    assert "late by up to 0.102 s" in found.warnings[0]


@pytest.mark.cites("section 4.4")
@settings(deadline=None, max_examples=15)
@given(seed=seeds, drift=drifts)
def test_the_earliest_readings_are_those_of_the_reference(seed, drift) -> None:
    rng = np.random.default_rng(seed)
    gnss = np.arange(21.0)  # Twenty count: their middle is no reading, which two lines could share.
    shown = 3.0 + (1 + drift) * gnss + rng.uniform(0.0, 0.5, gnss.size)
    found = align_by_time_readings(shown, gnss)
    line = reference.earliest_line(gnss[1:], shown[1:])
    assert found.drift == pytest.approx(float(line.drift), abs=1e-12)
    assert found.offset_s == pytest.approx(float(line.offset), abs=1e-9)


def test_readings_before_the_first_fix_are_none() -> None:
    base = np.arange(0.0, 30.0, 0.01)
    gnss = 400_000.0 + np.floor(base * 10) / 10
    gnss[:700] = 0.0
    gnss[1500] = 12.0
    found = align_by_time_readings(base, gnss)
    assert found.offset_s + 400_000.0 * (1 + found.drift) == pytest.approx(0.0, abs=0.011)
    assert found.dropped >= 1


@pytest.mark.parametrize(
    ("base", "gnss", "said"),
    [
        (np.arange(5.0), np.zeros(4), "4 readings of GNSS time at 5 times"),
        (np.arange(500.0), np.full(500, 7.0), r"takes 0 new value\(s\) in 500 samples"),
        (np.arange(500.0), np.full(500, np.nan), r"takes 0 new value\(s\) in 500 samples"),
    ],
)
def test_what_is_no_time_is_refused(base, gnss, said) -> None:
    with pytest.raises(InputError, match=said):
        align_by_time_readings(base, gnss)


def test_a_unit_that_is_not_seconds_is_refused() -> None:
    """Readings in ms go on a thousand times too fast."""
    base = np.arange(0.0, 60.0, 0.01)
    with pytest.raises(InputError, match="advance with time"):
        align_by_time_readings(base, 1e3 * np.floor(base * 10) / 10)
