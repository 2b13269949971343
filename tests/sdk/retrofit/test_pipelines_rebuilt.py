"""An engine made of the classes alone gives the profile of the pipeline, bit for bit."""

import numpy as np
import pytest

import floatref
from floatref.kernels import motion
from floatref.kernels.memories import INTEGRATOR
from floatref.values.arrays import new_record

G, RATE, INTERVAL = 9.80665, 2000.0, 0.025


def summed(x, step):
    """Trapezoidal integral from zero, by the kernel of the pipelines."""
    y = np.empty(x.size)
    if np.ndim(step):
        motion.integrate_steps(x, y, new_record(INTEGRATOR), step)
    else:
        motion.integrate(x, y, new_record(INTEGRATOR), 0.5 * step)
    return y


def high_pass(a, h, distance):
    stage = floatref.HighPass(RATE)
    v = summed(stage.acceleration(a), 1 / RATE)
    r = summed(stage.velocity(v), 1 / RATE)
    return projected(stage.reverse(r - stage.height(h)), distance)


def local_suppression(a, h, distance):
    stage, control = floatref.HighPass(RATE), floatref.LocalSuppression(RATE, below_mps=4.4704)
    speed = floatref.TravelSpeed(RATE).of(distance)
    v = control.velocity(summed(stage.acceleration(a), 1 / RATE), speed)
    r = summed(stage.velocity(v), 1 / RATE)
    return projected(stage.reverse(r - stage.height(h)), distance)


def adaptive(a, h, distance):
    stage, speed, z = forward(a, h, distance)
    return projected(stage.reverse(z, speed), distance)


def adaptive_spatial_backward(a, h, distance):
    stage, speed, z = forward(a, h, distance)
    points = projected(z, distance), projected(speed, distance)
    return stage.reverse_over_distance(*points, INTERVAL)


def forward(a, h, distance):
    stage, speed = floatref.AdaptiveHighPass(RATE), floatref.TravelSpeed(RATE).of(distance)
    v = summed(stage.acceleration(a, speed), 1 / RATE)
    r = summed(stage.velocity(v, speed), 1 / RATE)
    return stage, speed, r - stage.height(h, speed)


def matched(a, h, distance):
    stage, speed = floatref.MatchedHighPass(RATE), floatref.TravelSpeed(RATE).of(distance)
    z = stage.reference_height(a, h, speed) - h
    points = projected(z, distance), projected(speed, distance)
    return stage.reverse_over_distance(*points, INTERVAL)


def spatial(a, h, distance, limit=None, reflection=None):
    times = projected(np.arange(a.size) / RATE, distance)
    true = np.diff(times, prepend=times[0])
    step = true if limit is None else limit.time_step(true)
    stage = floatref.SpatialHighPass(INTERVAL)
    v = stage.velocity(summed(stage.acceleration(projected(a, distance)), step))
    height = stage.height(projected(h, distance))
    if reflection is None:
        return stage.reverse(summed(v, step) - height)
    return stage.reverse(reflection.reference_height(v, step, true, height) - height)


def timer_distortion(a, h, distance):
    return spatial(a, h, distance, floatref.TimerDistortion(INTERVAL))


def with_reflection(a, h, distance):
    limit, reflection = floatref.TimerDistortion(INTERVAL), floatref.HeightReflection()
    return spatial(a, h, distance, limit, reflection)


ENGINES = {
    "temporal-hpf": high_pass,
    "temporal-hpf-local-suppression": local_suppression,
    "temporal-adaptive-hpf": adaptive,
    "temporal-adaptive-hpf-spatial-backward": adaptive_spatial_backward,
    "temporal-matched-hpf": matched,
    "spatial-hpf": spatial,
    "spatial-hpf-timer-distortion": timer_distortion,
    "spatial-hpf-timer-distortion-reflection": with_reflection,
}


def projected(x, distance):
    """The first sample that has reached each point."""
    points = distance[0] + INTERVAL * np.arange(
        int((distance[-1] - distance[0]) / INTERVAL + 1e-6) + 1
    )
    return x[np.searchsorted(distance, points - 1e-6 * INTERVAL)]


@pytest.fixture(scope="module")
def signals():
    """Three seconds that slow from 15 m/s to a stop and start again; encoder of 2 mm."""
    rng = np.random.default_rng(2)
    times = np.arange(6000) / RATE
    speed = np.clip(25.0 * np.abs(times - 1.4) - 2.0, 0.0, 15.0)
    distance = 0.002 * np.floor(np.cumsum(speed) / RATE / 0.002)
    height = 0.3 + 0.01 * np.cumsum(rng.standard_normal(6000)) / np.sqrt(RATE)
    return G + 0.2 + rng.standard_normal(6000), height, distance


@pytest.mark.parametrize("pipeline", ENGINES)
def test_the_classes_alone_rebuild_the_pipeline(signals, pipeline):
    force, height, distance = signals
    clock = floatref.UniformClock.of(RATE)
    names = ("vertical_specific_force", "height", "distance")
    channels = [floatref.Channel.of(n, x, clock) for n, x in zip(names, signals, strict=True)]
    profile = floatref.process(
        floatref.Recording(tuple(channels)), pipeline, {"interval_m": INTERVAL}
    )
    rebuilt = ENGINES[pipeline](force - G, height, distance)
    np.testing.assert_array_equal(rebuilt, profile.tracks[0].elevation)


def test_every_pipeline_of_chapter_5_that_suppresses_is_rebuilt():
    others = {"temporal-basic", "temporal-mean-removal", "spatial-basic"}
    others |= {name for name in floatref.pipelines() if name.startswith("road-prior-")}
    nominal = {n for n in floatref.pipelines() if not floatref.pipeline_capabilities(n)}
    assert set(ENGINES) == nominal - others
