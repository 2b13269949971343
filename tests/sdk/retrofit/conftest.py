"""Signals of a slow drive, and every class of `floatref.retrofit` as one function of a chunk."""

import numpy as np
import pytest

import floatref

RATE, INTERVAL, LENGTH = 200.0, 0.05, 240


class Drive:
    """Accelerations, heights and a speed that wanders between standstill and 15 m/s."""

    names = ("a", "v", "h", "speed", "distance", "dt", "adjusted")

    def __init__(self, seed=0, length=LENGTH):
        rng = np.random.default_rng(seed)
        self.a = rng.standard_normal(length)
        self.v = np.cumsum(rng.standard_normal(length)) / RATE
        self.h = 0.3 + 0.01 * rng.standard_normal(length)
        self.speed = np.clip(4.0 + np.cumsum(rng.normal(size=length)), 0.0, 15.0)
        self.distance = 7.0 + np.cumsum(self.speed) / RATE
        self.dt = rng.choice([0.0, 0.003, 0.014, 0.2, 30.0], length)
        self.adjusted = np.minimum(self.dt, 0.014)

    def cut(self, begin, end):
        part = Drive.__new__(Drive)
        part.__dict__.update({name: getattr(self, name)[begin:end] for name in self.names})
        return part


def three(stage, drive, *speed):
    """All three forward calls of a high-pass, one row each."""
    return np.stack(
        [
            stage.acceleration(drive.a, *speed),
            stage.velocity(drive.v, *speed),
            stage.height(drive.h, *speed),
        ]
    )


CLASSES = {
    "TravelSpeed": (lambda: floatref.TravelSpeed(RATE), lambda s, d: s.of(d.distance)),
    "HighPass": (lambda: floatref.HighPass(RATE), three),
    "SpatialHighPass": (lambda: floatref.SpatialHighPass(INTERVAL), three),
    "AdaptiveHighPass": (
        lambda: floatref.AdaptiveHighPass(RATE),
        lambda s, d: three(s, d, d.speed),
    ),
    "MatchedHighPass": (
        lambda: floatref.MatchedHighPass(RATE),
        lambda s, d: s.reference_height(d.a, d.h, d.speed),
    ),
    "LocalSuppression": (
        lambda: floatref.LocalSuppression(RATE),
        lambda s, d: s.velocity(d.v, d.speed),
    ),
    "TimerDistortion": (lambda: floatref.TimerDistortion(INTERVAL), lambda s, d: s.time_step(d.dt)),
    "HeightReflection": (
        floatref.HeightReflection,
        lambda s, d: s.reference_height(d.v, d.adjusted, d.dt, d.h),
    ),
}


@pytest.fixture(params=CLASSES)
def every(request):
    """Each class in turn: a maker, and what it makes of a stretch of a drive."""
    return CLASSES[request.param]


@pytest.fixture
def drive():
    return Drive
