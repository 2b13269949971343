"""A suspension's deflection beside the heights of body and wheel."""

from collections.abc import Callable

import numpy as np
import pytest

from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.vehicle_response.stages import CompareTravel
from floatref_conformance.testing import StageLaws, Stream

NAMES = "suspension_deflection", "sprung_displacement", "unsprung_displacement"
CHANNELS = tuple(ChannelId(name, "left") for name in NAMES)


class TestCompareTravel(StageLaws):
    reads = NAMES

    def make(self) -> CompareTravel:
        return CompareTravel(*NAMES, 5e-4)


def warnings_of(
    change: Callable[[FloatArray, FloatArray, FloatArray], tuple[FloatArray, ...]],
    rms_m: float,
) -> tuple[str, ...]:
    """Return what is told of 20 s at 100 Hz whose channels ``change`` has been at."""
    rng = np.random.default_rng(0)
    at = np.arange(2000) / 100.0
    body = rms_m * np.sin(2 * np.pi * 1.5 * at)
    wheel = rms_m * np.convolve(rng.standard_normal(2000), np.full(5, 0.4), "same")
    travel = body - wheel + 2e-4 * rng.standard_normal(2000)
    samples = dict(zip(CHANNELS, change(travel, body, wheel), strict=True))
    stage = Stream(lambda: CompareTravel(*NAMES, 5e-4), samples, ("left",)).begin([])
    for block in Stream(lambda: CompareTravel(*NAMES, 5e-4), samples, ("left",)).blocks([333, 900]):
        stage.push(block)
    stage.finish()
    return stage.warnings()


def test_sensors_that_agree_are_not_told() -> None:
    assert warnings_of(lambda t, b, w: (t, b, w), 5e-3) == ()
    assert warnings_of(lambda t, b, w: (1.2 * t, b, w), 5e-3) == ()


@pytest.mark.parametrize(
    "change",
    [
        lambda t, b, w: (-t, b, w),
        lambda t, b, w: (t, w, b),
        lambda t, b, w: (2.0 * t, b, w),
        lambda t, b, w: (t, b, 2.0 * w),
        lambda t, b, w: (np.roll(t, 10), b, w),
        lambda t, b, w: (np.random.default_rng(1).standard_normal(t.size) * 5e-3, b, w),
    ],
    ids=["sign", "swapped", "scale", "gain of the wheel", "clock", "another suspension"],
)
def test_sensors_that_do_not_agree_are_told(
    change: Callable[[FloatArray, FloatArray, FloatArray], tuple[FloatArray, ...]],
) -> None:
    (line,) = warnings_of(change, 5e-3)
    assert line.startswith("track left: suspension_deflection follows the heights")


def test_a_suspension_that_hardly_moves_tells_nothing() -> None:
    assert warnings_of(lambda t, b, w: (-t, b, w), 2e-4) == ()


def test_a_drift_of_the_heights_is_no_disagreement() -> None:
    drift = 0.05 * np.sin(2 * np.pi * 0.15 * np.arange(2000) / 100.0)
    assert warnings_of(lambda t, b, w: (t, b + drift, w), 5e-3) == ()
