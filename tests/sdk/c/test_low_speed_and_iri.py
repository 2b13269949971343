"""Low speed, the observer, projection and the IRI in C against the SDK."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import floatref
from floatref.errors import InputError
from floatref.kernels import cut_off, memories, schedule, varying
from floatref.measures import iri, iri_trace
from floatref.measures.roughness.iri_settings import IriSettings
from floatref.stages.timer_distortion import adjusted_time_step
from floatref.values.arrays import new_record

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(
    max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
RATE = 250.0


def signals(seed, gaps=False, length=250):
    rng = np.random.default_rng(seed)
    x, h = rng.normal(size=(2, length))
    speed = np.abs(4.0 + 3.0 * np.cumsum(rng.normal(size=length)) / 5.0)
    if gaps:
        for each in (x, h, speed):
            each[rng.random(length) < 0.1] = np.nan
            each[: rng.integers(0, 3)] = np.nan
    return x, h, speed


def same_bits(found, expected):
    assert np.asarray(found, np.float64).tobytes() == np.asarray(expected).tobytes()


@laws
@given(seed=SEEDS, gaps=st.booleans())
def test_local_suppression(double, plain_sdk, seed, gaps):
    v, _, speed = signals(seed, gaps)
    made = double.make("local_suppression", rate_hz=RATE, missing=int(gaps))
    same_bits(made.push(v, speed)[1], floatref.LocalSuppression(RATE).velocity(v, speed))


@laws
@given(seed=SEEDS, gaps=st.booleans())
def test_the_matched_high_pass(double, plain_sdk, seed, gaps):
    a, h, speed = signals(seed, gaps)
    cutoff = floatref.AdaptiveCutOff().frequency(speed)
    made = double.make("matched_high_pass", rate_hz=RATE, missing=int(gaps))
    expected = floatref.MatchedHighPass(RATE).reference_height(a, h, speed)
    same_bits(made.push(a, h, cutoff)[1], expected)


@laws
@given(seed=SEEDS, limit=st.floats(1e-3, 1.0), sharpness=st.floats(2.0, 60.0))
def test_timer_distortion(double, seed, limit, sharpness):
    # Libraries differ by an ulp or two in pow, log1p and expm1; the powers are at most 1, so the
    # exponent passes on no more than its own ulps times the sharpness.
    dt = np.random.default_rng(seed).choice([0.0, 0.003, 0.014, 0.2, 30.0, 1e5], 50)
    config = double.config(
        "timer_distortion", interval_m=limit, slow_speed_mps=1.0, sharpness=sharpness
    )
    status, found = double.array_call("fr_timer_distortion_steps", config, dt)
    assert status == 0
    bound = 8 * np.finfo(float).eps * (np.minimum(dt, limit) + limit)
    assert (np.abs(found - adjusted_time_step(dt, limit, sharpness)) <= bound).all()


@laws
@given(
    seed=SEEDS,
    count_m=st.sampled_from([2.0**-10, 2.0**-7]),
    interval_m=st.sampled_from([0.01, 0.125, 0.3]),
    back=st.booleans(),
)
def test_projection(double, plain_sdk, seed, count_m, interval_m, back):
    x, *_ = signals(seed)
    steps = np.random.default_rng(seed).integers(-20 if back else 0, 60, x.size)
    counts = np.cumsum(steps) - 77
    distance = np.fmax.accumulate((counts - counts[0]) * count_m)
    wide, y = np.append(0.0, distance), np.append(x[0], x)
    sample, part = np.empty(10**5, np.int64), np.empty(10**5)
    size = plain_sdk.motion.find_points(wide, 0.0, interval_m, 0, sample, part)
    expected = np.empty(size)
    plain_sdk.motion.read_at(y[0], y[1:], sample[:size], part[:size], expected)
    made = double.make("projection", interval_m=interval_m, metres_per_count=count_m, rate_hz=RATE)
    status, found, dt = made.push(counts, x, call="push_timed", outputs=2, capacity=size)
    assert status == 0
    same_bits(found, expected)
    time = (sample[:size] - 1 + part[:size]) / RATE
    np.testing.assert_allclose(dt, np.diff(time, prepend=time[:1]), rtol=0, atol=1e-15)


@laws
@given(
    seed=SEEDS,
    interval_m=st.sampled_from([0.025, 0.0625, 0.3, 2.0]),
    average_m=st.sampled_from([0.0, 0.25, 30.0]),
    cut=st.integers(0, 800),
)
def test_the_iri_and_its_trace(double, seed, interval_m, average_m, cut):
    z = np.cumsum(np.random.default_rng(seed).normal(size=800)) * 1e-3
    made = double.make("iri", interval_m=interval_m, moving_average_m=average_m)
    parts = [made.push(z[b], capacity=900)[1] for b in (slice(0, cut), slice(cut, None))]
    rest, written = np.empty(2000), double.ffi.new("size_t *")
    assert made.call("finish", double.at(rest), rest.size, written) == 0
    value = double.ffi.new("double *")
    assert made.call("value", value) == 0
    expected = iri_trace(z, interval_m, IriSettings(moving_average_m=average_m))
    # A slope is a difference of elevations over an interval, rounded to them; the poles agree to
    # some ulps, and the modes decay within some hundred intervals.
    bound = 1e3 * np.finfo(float).eps * np.abs(expected).max()
    np.testing.assert_allclose(np.concatenate([*parts, rest[: written[0]]]), expected, atol=bound)
    whole = iri(z, interval_m, IriSettings(moving_average_m=average_m))
    assert value[0] == pytest.approx(whole, rel=1e-12)


def test_a_profile_no_longer_than_the_start_has_no_iri(double):
    made = double.make("iri", interval_m=1.0)
    z = np.zeros(11)
    made.push(z)
    value, written = double.ffi.new("double *"), double.ffi.new("size_t *")
    assert double.status[made.call("value", value)] == "FR_WRONG_ORDER"
    assert double.status[made.call("finish", double.at(z), 11, written)] == "FR_WRONG_ORDER"
    with pytest.raises(InputError):
        iri(z, 1.0)


@pytest.mark.parametrize("setting", ["high_pass", "low_pass", "high_pass_wavelength"])
def test_settings_of_two_passes(double, setting):

    of_c, of_sdk = (
        getattr(double.lib, f"fr_{setting}_setting"),
        getattr(cut_off, f"{setting}_setting"),
    )
    assert of_c(0.0489) == of_sdk(0.0489)


def test_the_compiled_kernels_differ_by_fused_operations_alone(double):
    # Each of the (at most) 12 sums of a sample is rounded once less; a filter keeps the error of a
    # sample for its time constant, 1 / c samples, and adds them all up.
    x, _, speed = signals(3, length=4000)
    cutoff = floatref.AdaptiveCutOff().frequency(speed)
    c, expected = np.empty((2, x.size))
    schedule.tangents(cutoff, 1 / RATE, c)
    varying.high_pass_1(x, expected, c, new_record(memories.VARYING), False)
    _, found = double.make("varying", step=1 / RATE, sections=1).push(x, cutoff)
    bound = 12 * np.finfo(float).eps / 2 * np.abs(x).max() / c.min()
    assert np.abs(found - expected).max() <= bound
