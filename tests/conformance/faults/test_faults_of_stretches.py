"""A fault on a stretch is flagged there: the recording is used, and the road before it is valid."""

import numpy as np
import pytest

from floatref.values.profile import Profile
from floatref_conformance.devices.builtin import process_with_warnings
from floatref_conformance.faults.fault_list import FAULTS
from floatref_conformance.faults.placing import BEGIN_M
from floatref_conformance.faults.study import drive_healthy

PIPELINE = "temporal-basic"
ENDS_M = 60.0
"""Flagged at the begin of any run of this pipeline: 53 m, and the filters' warm-up."""
REACH_M = 105.91
"""The cut-off wavelength of the pipeline's high-pass, which spreads what is not valid."""
SEEN_M = 60.0
"""3 s at 20 m/s: the comparisons' band begins at 0.5 Hz, where a pulse of 4 g rings as long."""
OF_THE_WHOLE_RUN = ("accelerometer-scale-halved-midway",)
"""Half of the run at half the scale: the comparison of the body takes it for one of all of it."""
STRETCHES = tuple(name for name, fault in FAULTS.items() if not fault.whole_run)


def valid_before(profile: Profile) -> bool:
    """Return whether all points between the begin and the fault's reach are valid."""
    places = profile.distance_m
    before = (places > ENDS_M) & (places < BEGIN_M - REACH_M - SEEN_M)
    assert np.count_nonzero(before) > 1000
    return all(bool(np.all(np.asarray(track.valid)[before])) for track in profile.tracks)


@pytest.mark.slow
@pytest.mark.parametrize("sensor", sorted({FAULTS[name].sensor for name in STRETCHES}))
def test_a_fault_on_a_stretch_leaves_the_road_before_it_valid(sensor: str) -> None:
    healthy, _ = drive_healthy("constant")
    spoilt = []
    for name in (n for n in STRETCHES if FAULTS[n].sensor == sensor):
        # No InputError: the recording is not refused.
        profile, _ = process_with_warnings(FAULTS[name].damage(healthy), PIPELINE)
        if not valid_before(profile):
            spoilt.append(name)
    assert [name for name in spoilt if name not in OF_THE_WHOLE_RUN] == []


@pytest.mark.slow
def test_a_fault_of_one_wheel_path_leaves_the_other_one_as_it_was() -> None:
    healthy, _ = drive_healthy("constant")
    faulty = FAULTS["laser-noise-only-1-s"].damage(healthy)
    before, after = (process_with_warnings(r, PIPELINE)[0] for r in (healthy, faulty))
    was, now = (dict(zip(("left", "right"), p.tracks, strict=True)) for p in (before, after))
    np.testing.assert_array_equal(was["right"].valid, now["right"].valid)
    assert np.sum(now["left"].valid) < np.sum(was["left"].valid)
