"""What a class alone refuses: incomplete sets of calls, and arrays that cannot be."""

import numpy as np
import pytest

from floatref import (
    AdaptiveHighPass,
    HeightReflection,
    HighPass,
    InputError,
    LocalSuppression,
    MatchedHighPass,
    SpatialHighPass,
    StageError,
    TimerDistortion,
    TravelSpeed,
)

X = np.linspace(0.0, 1.0, 10)
SPEED = np.full(10, 5.0)
HIGH_PASSES = {
    "HighPass": (lambda: HighPass(100.0), ()),
    "SpatialHighPass": (lambda: SpatialHighPass(0.05), ()),
    "AdaptiveHighPass": (lambda: AdaptiveHighPass(100.0), (SPEED,)),
}
every_high_pass = pytest.mark.parametrize("name", HIGH_PASSES)
SIGNALS = ("acceleration", "velocity", "height")


def said(error):
    """Return the message, which is one line."""
    assert "\n" not in str(error.value)
    return str(error.value)


@every_high_pass
@pytest.mark.parametrize("ending", ["reverse", "finish"])
@pytest.mark.parametrize("left_out", ["velocity", "height"])
def test_an_incomplete_set_of_calls_is_refused(name, ending, left_out):
    make, speed = HIGH_PASSES[name]
    stage = make()
    for signal in SIGNALS:
        if signal != left_out:
            getattr(stage, signal)(X, *speed)
    with pytest.raises(StageError) as error:
        getattr(stage, ending)(*((X, *speed) if ending == "reverse" else ()))
    expected = ", ".join(f"{0 if s == left_out else 10} of {s}" for s in SIGNALS)
    assert said(error).startswith(f"{name}.{ending}: samples so far are {expected}; all must")
    getattr(stage, left_out)(X, *speed)
    getattr(stage, ending)(*((X, *speed) if ending == "reverse" else ()))


@every_high_pass
def test_a_height_that_lags_is_refused(name):
    make, speed = HIGH_PASSES[name]
    stage = make()
    for signal in SIGNALS:
        getattr(stage, signal)(X, *speed)
    for signal in SIGNALS[:2]:
        getattr(stage, signal)(X, *speed)
    with pytest.raises(StageError, match="20 of acceleration, 20 of velocity, 10 of height"):
        stage.finish()


@every_high_pass
def test_a_velocity_before_its_acceleration_is_refused(name):
    make, speed = HIGH_PASSES[name]
    stage = make()
    with pytest.raises(StageError, match="filter the acceleration, integrate it, then"):
        stage.velocity(X, *speed)
    stage.acceleration(X, *speed)
    stage.velocity(X, *speed)
    with pytest.raises(StageError, match=r"velocity: sample 20 before"):
        stage.velocity(X, *speed)


@every_high_pass
def test_a_part_of_the_run_is_no_profile(name):
    make, speed = HIGH_PASSES[name]
    stage = make()
    for signal in SIGNALS:
        getattr(stage, signal)(X, *speed)
    with pytest.raises(StageError) as error:
        stage.reverse(X[:4], *(s[:4] for s in speed))
    assert "a profile of 4 samples after 10; give the whole run" in said(error)
    assert stage.reverse(X, *speed).size == 10


@every_high_pass
@pytest.mark.parametrize("again", [*SIGNALS, "reverse", "finish"])
def test_after_the_end_nothing_is_taken(name, again):
    make, speed = HIGH_PASSES[name]
    stage = make()
    for signal in (*SIGNALS, "reverse"):
        getattr(stage, signal)(X, *speed)
    with pytest.raises(StageError, match=f"{name}.{again}: the run has ended; make a new one"):
        getattr(stage, again)(*(() if again == "finish" else (X, *speed)))


@every_high_pass
def test_a_run_of_no_samples_has_no_end(name):
    with pytest.raises(StageError, match="0 of acceleration, 0 of velocity, 0 of height"):
        HIGH_PASSES[name][0]().finish()


@pytest.mark.parametrize("ending", ["reverse", "reverse_over_distance", "finish"])
@pytest.mark.parametrize("signal", SIGNALS)
def test_signals_at_different_speeds_are_refused(ending, signal):
    stage = AdaptiveHighPass(100.0)
    for each in SIGNALS:
        getattr(stage, each)(X, SPEED + 0.1 if each == signal else SPEED)
    arguments = {"reverse": (X, SPEED), "reverse_over_distance": (X, SPEED, 0.05), "finish": ()}
    with pytest.raises(StageError, match="were given different speeds"):
        getattr(stage, ending)(*arguments[ending])


@pytest.mark.parametrize("make", [AdaptiveHighPass, MatchedHighPass])
def test_the_backward_pass_at_another_speed_is_refused(make):
    stage = make(100.0)
    if make is MatchedHighPass:
        stage.reference_height(X, X, SPEED)
    else:
        for signal in SIGNALS:
            getattr(stage, signal)(X, SPEED)
    with pytest.raises(StageError, match="reverse: another speed than before"):
        stage.reverse(X, SPEED[::-1] + X)
    stage.reverse_over_distance(X[:3], SPEED[:3] + 1.0, 0.05)


def test_the_observer_needs_samples_before_its_backward_pass():
    with pytest.raises(StageError, match="0 of reference_height"):
        MatchedHighPass(100.0).reverse_over_distance(X, SPEED, 0.05)


@pytest.mark.parametrize(
    ("call", "line"),
    [
        (lambda: AdaptiveHighPass(100.0).acceleration(X, SPEED[:9]), "10 of a, 9 of speed"),
        (lambda: LocalSuppression(100.0).velocity(X[:3], SPEED), "3 of v, 10 of speed"),
        (
            lambda: HeightReflection().reference_height(X, X, X[:2], X),
            "10 of velocity, 10 of adjusted_time_step, 2 of time_step, 10 of filtered_height",
        ),
    ],
)
def test_chunks_of_different_length_are_refused(call, line):
    with pytest.raises(InputError) as error:
        call()
    assert f": {line}; give as many samples of each" in said(error)


@every_high_pass
def test_a_refused_chunk_counts_for_nothing(name):
    make, speed = HIGH_PASSES[name]
    stage, other = make(), make()
    with pytest.raises(InputError):
        stage.acceleration(np.append(X[:9], np.inf), *speed)
    for signal in SIGNALS:
        found = getattr(stage, signal)(X, *speed)
        np.testing.assert_array_equal(found, getattr(other, signal)(X, *speed))
    stage.finish()


@pytest.mark.parametrize("value", [np.inf, -np.inf])
def test_an_infinite_sample_is_refused_by_number(value):
    bad = np.where(np.arange(10) == 6, value, X)
    with pytest.raises(InputError, match=r"HighPass.height: h sample 6 is -?inf; give NaN"):
        HighPass(100.0).height(bad)


def test_what_is_no_number_is_refused():
    with pytest.raises(InputError, match=r"TravelSpeed.of: distance is not an array of numbers"):
        TravelSpeed(100.0).of(["here", "there"])


@pytest.mark.parametrize("wrong", [-0.001, np.nan])
def test_a_step_that_goes_back_or_is_missing_is_refused(wrong):
    steps = np.array([0.0, 0.01, wrong])
    with pytest.raises(InputError, match=r"dt sample 2 is (-0.001|nan) s; a step is zero"):
        TimerDistortion(0.05).time_step(steps)
    for given in ((X[:3], steps, X[:3], X[:3]), (X[:3], X[:3], steps, X[:3])):
        with pytest.raises(InputError, match="time_step sample 2"):
            HeightReflection().reference_height(*given)


@pytest.mark.parametrize(
    "make",
    [
        lambda: HighPass(0.0),
        lambda: HighPass(np.nan),
        lambda: HighPass(100.0, cutoff_hz=50.0),
        lambda: HighPass(100.0, cutoff_hz=0.0),
        lambda: SpatialHighPass(-0.05),
        lambda: SpatialHighPass(0.05, cutoff_wavelength_m=0.1),
        lambda: SpatialHighPass(0.05, cutoff_wavelength_m=0.0),
        lambda: AdaptiveHighPass(100.0, low_speed_cutoff_hz=0.0),
        lambda: MatchedHighPass(np.inf),
        lambda: LocalSuppression(100.0, below_mps=-1.0),
        lambda: LocalSuppression(100.0, integral_per_s=0.0),
        lambda: TimerDistortion(0.05, slow_speed_mps=0.0),
        lambda: TimerDistortion(0.0),
        lambda: TravelSpeed(100.0, window_s=0.0),
    ],
)
def test_settings_that_make_no_sense_are_refused(make):
    with pytest.raises(InputError) as error:
        make()
    said(error)
