"""The high-pass sets and the whole algorithm of 5.7 in C: the bits of the SDK's objects."""

from itertools import pairwise

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import floatref
from floatref.kernels import memories
from floatref.measures import iri
from floatref.values.arrays import new_record

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(
    max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
RATE, INTERVAL, COUNT_M = 250.0, 0.125, 2.0**-10
NAMES = ("acceleration", "velocity", "height")


class Drive:
    """Signals of a slow drive with stops; the distance is in counts of a binary part of a metre."""

    def __init__(self, seed, gaps=False, length=300):
        rng = np.random.default_rng(seed)
        self.a, self.v = rng.normal(size=(2, length))
        self.h = 0.3 + 0.01 * rng.normal(size=length)
        speed = np.clip(4.0 + np.cumsum(rng.normal(size=length)), 0.0, 30.0)
        self.counts = 5000 + np.round(np.cumsum(speed) / RATE / COUNT_M).astype(np.int64)
        self.distance = self.counts * COUNT_M
        self.speed = floatref.TravelSpeed(RATE).of(self.distance)
        if gaps:
            for x in (self.a, self.v, self.h, self.speed):
                x[rng.random(length) < 0.1] = np.nan
                x[: rng.integers(0, 3)] = np.nan


def same_bits(found, expected):
    assert np.asarray(found, np.float64).tobytes() == np.asarray(expected).tobytes()


@laws
@given(seed=SEEDS, gaps=st.booleans(), cut=st.integers(0, 300))
def test_the_set_that_follows_the_speed(double, plain_sdk, seed, gaps, cut):
    drive = Drive(seed, gaps)
    sdk, made = (
        floatref.AdaptiveHighPass(RATE),
        double.make("adaptive_set", rate_hz=RATE, missing=int(gaps)),
    )
    for name, x in zip(NAMES, (drive.a, drive.v, drive.h), strict=True):
        blocks = slice(0, cut), slice(cut, x.size)
        found = [made.push(x[b], drive.speed[b], call=name) for b in blocks]
        assert [status for status, _ in found] == [0, 0]
        same_bits(np.concatenate([y for _, y in found]), getattr(sdk, name)(x, drive.speed))
    _, found = made.push(drive.h, drive.speed, call="reverse")
    same_bits(found, sdk.reverse(drive.h, drive.speed))
    assert double.status[made.call("finish")] == "FR_WRONG_ORDER"


@laws
@given(seed=SEEDS, gaps=st.booleans(), cut=st.integers(0, 300))
def test_the_set_at_a_fixed_cut_off(double, plain_sdk, seed, gaps, cut):
    drive = Drive(seed, gaps)
    sdk = floatref.HighPass(RATE, 0.5)
    made = double.make("high_pass_set", step=1.0 / RATE, cutoff=0.5, missing=int(gaps))
    for name, x in zip(NAMES, (drive.a, drive.v, drive.h), strict=True):
        found = [made.push(x[b], call=name)[1] for b in (slice(0, cut), slice(cut, x.size))]
        same_bits(np.concatenate(found), getattr(sdk, name)(x))
    same_bits(made.push(drive.h, call="reverse")[1], sdk.reverse(drive.h))


@laws
@given(seed=SEEDS, window_s=st.sampled_from([0.001, 0.05, 0.3, 2.0]), cut=st.integers(0, 300))
def test_travel_speed(double, plain_sdk, seed, window_s, cut):
    drive = Drive(seed)
    made = double.make("travel_speed", rate_hz=RATE, metres_per_count=COUNT_M, window_s=window_s)
    found = [made.push(drive.counts[b])[1] for b in (slice(0, cut), slice(cut, None))]
    same_bits(np.concatenate(found), floatref.TravelSpeed(RATE, window_s).of(drive.distance))


@laws
@given(seed=SEEDS)
def test_the_cut_off_of_the_speed(double, plain_sdk, seed):
    speed = Drive(seed, gaps=True).speed * 3.0 - 2.0
    sdk, config = floatref.AdaptiveCutOff(), double.config("cut_off")
    same_bits(double.array_call("fr_cut_off_frequency", config, speed)[1], sdk.frequency(speed))
    found = np.empty(speed.size)
    written = double.ffi.new("size_t *")
    arguments = config, INTERVAL, double.at(speed), speed.size, double.at(found), speed.size
    assert double.lib.fr_cut_off_wave_number(*arguments, written) == 0
    same_bits(found, sdk.wave_number(speed, INTERVAL))


def through_the_sdk(drive, motion, interval_m=INTERVAL):
    """Return elevation and speed of the points, before and after the backward pass."""
    sdk, half = floatref.AdaptiveHighPass(RATE), 1 / RATE / 2.0
    v, r = np.empty((2, drive.a.size))
    motion.integrate(
        sdk.acceleration(drive.a, drive.speed), v, new_record(memories.INTEGRATOR), half
    )
    slow = sdk.velocity(v, drive.speed)
    motion.integrate(slow, r, new_record(memories.INTEGRATOR), half)
    z = r - sdk.height(drive.h, drive.speed)
    points = [project(motion, drive.distance, x, interval_m) for x in (z, drive.speed)]
    return *points, sdk.reverse_over_distance(*points, interval_m)


def project(motion, distance, x, interval_m):
    wide, x = np.append(distance[0], distance), np.append(x[0], x)
    sample, part = np.empty(99999, np.int64), np.empty(99999)
    # From the first distance on, as the stage does; the distances are exact, so is their change.
    count = motion.find_points(wide - distance[0], 0.0, interval_m, 0, sample, part)
    y = np.empty(count)
    motion.read_at(x[0], x[1:], sample[:count], part[:count], y)
    return y


def adaptive(library, **settings):
    encoder = {"travel__rate_hz": RATE, "travel__metres_per_count": COUNT_M}
    return library.make("adaptive", **encoder, **{"interval_m": INTERVAL, **settings})


def through_c(made, drive, cuts=()):
    edges = [0, *sorted(cuts), drive.a.size]
    found = [
        made.push(drive.a[i:j], drive.h[i:j], drive.counts[i:j], outputs=2, capacity=9999)
        for i, j in pairwise(edges)
    ]
    assert {status for status, *_ in found} == {0}
    return [np.concatenate(parts) for parts in list(zip(*found, strict=True))[1:]]


@laws
@given(
    seed=SEEDS,
    cuts=st.lists(st.integers(0, 300), max_size=3),
    interval_m=st.sampled_from([0.125, 0.01]),
)
def test_the_whole_algorithm(double, plain_sdk, seed, cuts, interval_m):
    drive = Drive(seed)
    made = adaptive(double, interval_m=interval_m)
    elevation, speed = through_c(made, drive, cuts)
    expected = through_the_sdk(drive, plain_sdk.motion, interval_m)
    same_bits(elevation, expected[0])
    same_bits(speed, expected[1])
    same_bits(made.push(elevation, speed, call="finish")[1], expected[2])


def test_a_run_ends_with_all_points_only(double):
    drive = Drive(1)
    made = adaptive(double)
    elevation, speed = through_c(made, drive)
    before = made.memory.copy()
    status, profile = made.push(elevation[:-1], speed[:-1], call="finish")
    assert double.status[status] == "FR_INCOMPLETE_SET"
    assert np.isnan(profile).all()
    assert (made.memory == before).all()


def test_a_cut_off_that_is_updated_rarely_is_within_its_stated_error(double):
    # 3 m/s² from rest to 20 m/s: the body swings by 10 mm, the road has waves of 20 mm over 20 m.
    drive = Drive(2, length=4000)
    t = np.arange(drive.a.size) / RATE
    x = np.where(t < 20 / 3, 1.5 * t**2, 20 * t - 200 / 3)
    body, road = 0.01 * np.cos(2 * np.pi * t), 0.02 * np.sin(2 * np.pi * x / 20.0)
    drive.counts = np.round(x / COUNT_M).astype(np.int64)
    drive.a, drive.h = -((2 * np.pi) ** 2) * body, body - road

    def profile(every):
        made = adaptive(double, cut_off_every=every)
        return made.push(*through_c(made, drive), call="finish")[1]

    # Held for 4 ms; the points within a cut-off wavelength of the end are run-out.
    error = (profile(2) - profile(1))[: -round(105.91 / INTERVAL)]
    assert 0.0 < iri(error, INTERVAL) < 0.02


@laws
@given(seed=SEEDS, cuts=st.lists(st.integers(0, 300), max_size=3), every=st.integers(1, 70))
def test_any_split_gives_the_same_bits(single, seed, cuts, every):
    drive = Drive(seed)
    options = {"cut_off_every": every, "tangent": 1}
    parts, whole = (through_c(adaptive(single, **options), drive, c) for c in (cuts, ()))
    for mine, theirs in zip(parts, whole, strict=True):
        assert mine.tobytes() == theirs.tobytes()
