"""Where a profile may end: 0.3 m early with a warning, and at the end of either axis."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.files import read_recording, write_profile
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.checks.interface import Taken
from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.classes import DeviceClass
from floatref_conformance.devices.interface import Description
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.bench import DeviceBench
from floatref_conformance.judge.exercise import Delivery, early_end_m, exercise
from floatref_conformance.proving_ground.scenario import Scenario

INTERVAL = 0.01
TRUE_M, LOST_M = 20.0, 0.8
ENCODER_M = TRUE_M - LOST_M
FIRST, SECOND = (find_edition(name) for name in ("2026.1", "2026.2"))
SAID = Description("cut", "1", "temporal", ())


def record():
    """Return 20 m at 10 m/s, of which a slipping wheel loses the last 0.8 m."""
    times = np.arange(2001) / 1000.0
    distance = np.minimum(10.0 * times, ENCODER_M)
    clock = UniformClock.of(1000.0)
    values = {"distance": distance, "height": 0.3 + 0.0 * times}
    values["vertical_specific_force"] = 9.80665 + 0.0 * times
    channels = tuple(
        Channel.of(name, x, clock, None if name == "distance" else "left")
        for name, x in values.items()
    )
    return Recording(channels, Setup(0.005))


RECORDING = record()
TRUTH = Profile(INTERVAL, (ProfileTrack.of("left", np.zeros(round(TRUE_M / INTERVAL) + 1)),))
TAKEN = Taken(RECORDING, TRUTH, Scenario(tracks=("left",)))


class Cut:
    """Delivers a flat profile that ends at ``end_m``."""

    def __init__(self, end_m):
        self.end_m = end_m

    def describe(self):
        return {"name": "cut", "version": "1", "architecture": "temporal", "capabilities": []}

    def run(self, recording, profile):
        read_recording(recording)
        count = round(self.end_m / INTERVAL) + 1
        write_profile(Profile(INTERVAL, (ProfileTrack.of("left", np.zeros(count)),)), profile)


def delivered(end_m, edition):
    """Return how early the profile is found to end; DeviceError if that is too early or late."""
    bench = DeviceBench(Cut(end_m), SAID, edition=edition)
    bench.run(TAKEN)
    return bench.early_m


@settings(deadline=None, max_examples=12)
@given(st.integers(0, 30), st.sampled_from([ENCODER_M, TRUE_M]))
def test_up_to_0_3_m_early_is_a_length_to_report(centimetres, end_m):
    early_m = centimetres / 100
    # Two intervals are rounding.
    expected = early_m if centimetres > 2 else 0.0
    assert delivered(end_m - early_m, SECOND) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("end_m", [ENCODER_M, TRUE_M])
def test_a_centimetre_more_is_an_error_and_so_is_a_profile_that_ends_late(end_m):
    for wrong_m in (end_m - 0.31, end_m + 0.03):
        with pytest.raises(DeviceError, match=f"over {wrong_m:.3f} m; the recording goes"):
            delivered(wrong_m, SECOND)


def test_the_first_edition_has_the_encoders_end_and_two_intervals_alone():
    assert delivered(ENCODER_M, FIRST) == delivered(ENCODER_M - 0.02, FIRST) == 0.0
    for wrong_m in (ENCODER_M - 0.03, TRUE_M):
        with pytest.raises(DeviceError, match="the recording goes"):
            delivered(wrong_m, FIRST)


def test_without_a_word_on_delivery_it_is_that_of_the_first_edition():
    assert Delivery() == Delivery(FIRST.early_end_m, None)
    exercise(Cut(ENCODER_M), SAID, RECORDING)
    with pytest.raises(DeviceError):
        exercise(Cut(TRUE_M), SAID, RECORDING)
    exercise(Cut(TRUE_M), SAID, RECORDING, Delivery(0.0, TRUE_M))


@pytest.mark.parametrize("interval_m", [0.05, 0.2])
def test_two_intervals_of_a_coarse_profile_are_no_early_end(interval_m):
    def ends(early_m):
        count = int((ENCODER_M - early_m) / interval_m + 1e-9) + 1
        return Profile(interval_m, (ProfileTrack.of("left", np.zeros(count)),))

    assert early_end_m(ends(0.0), RECORDING, None) == 0.0
    assert early_end_m(ends(1.9 * interval_m - 0.01), RECORDING, None) == 0.0
    assert early_end_m(ends(3.1 * interval_m), RECORDING, None) >= 3.0 * interval_m


def test_the_longest_early_end_of_all_runs_is_that_of_a_case():
    device = Cut(ENCODER_M)
    bench = DeviceBench(device, SAID, edition=SECOND)
    for early_m in (0.1, 0.25, 0.0):
        device.end_m = ENCODER_M - early_m
        bench.run(TAKEN)
    assert bench.early_m == pytest.approx(0.25)


def test_a_device_that_ends_early_passes_with_a_warning(plan, result_of, fake_device, toy_check):
    class Early(fake_device):
        """Leaves the last 0.25 m away."""

        def __init__(self):
            super().__init__(lambda tracks: {t: z[:-5] for t, z in tracks.items()})

    late = result_of(plan(Early(), edition=SECOND)).checks[0]
    assert late.outcome is Outcome.PASS
    assert late.early_m == pytest.approx(0.25, abs=0.05)
    assert late.class_reached is DeviceClass.REFERENCE
    assert result_of(plan(Early(), edition=FIRST)).checks[0].outcome is Outcome.ERROR
    assert result_of(plan(fake_device(), edition=SECOND)).checks[0].early_m == 0.0
