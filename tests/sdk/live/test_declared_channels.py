"""What a stream is given is checked before it is taken, and refused in one line."""

import numpy as np
import pytest

from floatref import InputError, Setup, start_stream
from floatref.live.declared_channels import Entrance, read_declarations
from floatref.values.clock import StampedClock, UniformClock

CHANNELS = {
    "left.vertical_specific_force": 1000.0,
    "left.height": UniformClock.of(500.0, 2.0),
    "distance": None,
}


def declared():
    return read_declarations(CHANNELS)


def test_a_rate_is_a_clock_that_begins_at_zero():
    clocks = declared()
    assert [str(name) for name in clocks] == list(CHANNELS)
    assert list(clocks.values()) == [UniformClock.of(1000.0), CHANNELS["left.height"], None]


@pytest.mark.parametrize(
    ("channels", "message"),
    [
        ({}, "the stream has no channels; name each with its rate in Hz"),
        ({"left.hight": 10.0}, "channel left.hight: unknown name; "),
        ({"height": -3.0}, "channel height: rate_hz is -3; give the sampling rate in Hz"),
        ({"height": "fast"}, "channel height: 'fast' is no clock; give a rate in Hz"),
        ({"height": np.zeros(99)}, "channel height: array([0., 0., 0., 0., 0., 0., … is no clock"),
        (
            {"height": StampedClock(np.arange(99.0))},
            "channel height: is declared with the times of its samples; declare None, and push (t",
        ),
        ({"height": True}, "channel height: True is no clock; give a rate in Hz"),
    ],
)
def test_a_declaration_that_cannot_be_is_refused(channels, message):
    with pytest.raises(InputError) as error:
        read_declarations(channels)
    assert str(error.value).startswith(message)
    assert str(error.value).isprintable()


@pytest.mark.parametrize(
    ("samples", "message"),
    [
        ({"right.height": [1.0]}, "channel right.height: was not declared; the stream has left."),
        ({"left.height": [[1.0]]}, "channel left.height: shape (1, 1); give one dimension"),
        ({"left.height": [np.inf]}, "channel left.height sample 0 is inf; give NaN"),
        ({"left.height": "abc"}, "channel left.height is not an array of numbers"),
        ({"distance": [1.0]}, "channel distance: has no rate; give (times in s, samples)"),
        ({"distance": ([1.0, 2.0], [1.0])}, "channel distance: 1 samples but 2 time stamps"),
        ({"distance": ([2.0, 1.0], [1.0, 2.0])}, "channel distance: time stamp 1 is 1 s, not aft"),
        ({"distance": ([5.0], [1.0])}, "channel distance: time 5 s comes after 7 s was pushed"),
        ({"distance": ([1e6], [1.0])}, "channel distance: time 1000000 s is more than a day beh"),
    ],
)
def test_samples_that_cannot_be_are_refused_and_nothing_is_taken(samples, message):
    entrance = Entrance(declared())
    entrance.check({"distance": ([6.0, 7.0], [0.0, 1.0])})
    before = dict(entrance.latest_s)
    with pytest.raises(InputError) as error:
        entrance.check({"left.vertical_specific_force": [9.8], **samples})
    assert str(error.value).startswith(message)
    assert entrance.latest_s == before


def test_the_caller_may_write_into_its_array_again():
    own = np.ones(3)
    (piece,) = Entrance(declared()).check({"left.height": own}).values()
    own[:] = 5.0
    np.testing.assert_array_equal(piece.values, 1.0)


@pytest.mark.parametrize(
    ("pipeline", "settings", "message"),
    [
        ("kalman-smoother", None, "pipeline kalman-smoother: needs "),
        ("temporal-besic", None, "pipeline temporal-besic: unknown"),
        ("temporal-basic", {"cutoff_wavelength_m": 900.0}, "setting cutoff_wavelength_m: the filt"),
        ("temporal-hpf", {"collective_cutoff_hz": 0.01}, "setting collective_cutoff_hz: the filt"),
        ("temporal-basic", {"interval_m": 1e-9}, "setting interval_m is 1e-09"),
    ],
)
def test_a_stream_that_cannot_run_is_refused_in_one_line(pipeline, settings, message):
    with pytest.raises(InputError) as error:
        start_stream(Setup(), CHANNELS, pipeline, settings)
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)


def test_a_channel_that_no_pipeline_can_do_without_is_named():
    with pytest.raises(InputError, match="channel distance: missing"):
        start_stream(Setup(), {"vertical_specific_force": 100.0, "height": 100.0})


def test_auto_takes_the_best_pipeline_that_has_its_channels():
    with start_stream(Setup(), CHANNELS) as stream:
        assert stream.pipelines == ("road-prior-smoother",)
