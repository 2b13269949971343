"""What a class alone refuses: incomplete sets of calls; a refused chunk counts for nothing."""

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
    assert "\n" not in str(error.value)
    return str(error.value)


def filled(stage, *speed):
    for signal in SIGNALS:
        getattr(stage, signal)(X, *speed)
    return stage


def passed(name):
    make, speed = HIGH_PASSES[name]
    return filled(make(), *speed), speed


def at_speed(make):
    stage = make(100.0)
    if isinstance(stage, MatchedHighPass):
        stage.reference_height(X, X, SPEED)
        return stage
    return filled(stage, SPEED)


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
    stage, speed = passed(name)
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
    stage, speed = passed(name)
    with pytest.raises(StageError) as error:
        stage.reverse(X[:4], *(s[:4] for s in speed))
    assert "a profile of 4 samples after 10; give the whole run" in said(error)
    assert stage.reverse(X, *speed).size == 10


@every_high_pass
@pytest.mark.parametrize("again", [*SIGNALS, "reverse", "finish"])
def test_after_the_end_nothing_is_taken(name, again):
    stage, speed = passed(name)
    stage.reverse(X, *speed)
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
    stage = at_speed(make)
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


FAST = np.where(np.arange(10) == 5, 1e6, SPEED)
NAMED = r"%s: speed sample 5 is 1e\+06 m/s: its cut-off is .* outside 0 to 50, half the"


@pytest.mark.parametrize("signal", SIGNALS)
def test_a_chunk_refused_for_its_speed_counts_for_nothing(signal):
    stage, other = AdaptiveHighPass(100.0), AdaptiveHighPass(100.0)
    for each in SIGNALS:
        if each == signal:
            with pytest.raises(InputError, match=NAMED % f"AdaptiveHighPass.{each}") as error:
                getattr(stage, each)(X, FAST)
            said(error)
        found = getattr(stage, each)(X, SPEED)
        np.testing.assert_array_equal(found, getattr(other, each)(X, SPEED))
    np.testing.assert_array_equal(stage.reverse(X, SPEED), other.reverse(X, SPEED))


@pytest.mark.parametrize("make", [AdaptiveHighPass, MatchedHighPass])
def test_a_backward_pass_refused_for_its_arrays_does_not_end_the_run(make):
    stage, nothing = at_speed(make), np.full(10, np.nan)
    with pytest.raises(InputError, match=NAMED % f"{make.__name__}.reverse"):
        stage.reverse(X, FAST)
    for call in (
        lambda: stage.reverse(nothing, SPEED),
        lambda: stage.reverse_over_distance(nothing, SPEED, 0.05),
    ):
        with pytest.raises(InputError, match=r"reverse\w*: all 10 samples of profile are missing"):
            call()
    stage.reverse(X, SPEED)


@pytest.mark.parametrize("make", [AdaptiveHighPass, MatchedHighPass])
def test_a_speed_without_a_cut_off_over_distance_does_not_end_the_run(make):
    # A schedule so flat that (5.3) is below zero for a vehicle that moves backward.
    stage = at_speed(lambda rate: make(rate, cutoff_wavelength_m=0.06, transition_steepness=1e-3))
    backward = np.where(np.arange(10) == 5, -3.0, SPEED)
    call = f"{make.__name__}.reverse_over_distance"
    with pytest.raises(InputError, match=f"{call}: speed sample 5 is -3 m/s"):
        stage.reverse_over_distance(X, backward, 0.1)
    stage.reverse_over_distance(X, SPEED, 0.1)


@pytest.mark.parametrize("name", ["HighPass", "SpatialHighPass"])
def test_a_profile_of_nothing_does_not_end_the_run(name):
    stage, _ = passed(name)
    with pytest.raises(InputError, match=f"{name}.reverse: all 10 samples of profile are missing"):
        stage.reverse(np.full(10, np.nan))
    stage.reverse(X)
