"""Schedules refuse what is no cut-off, and a filter refuses a cut-off beyond half the rate."""

from fractions import Fraction

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.stages.filters import matched_high_pass, schedule, varying
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

CUTOFF, SPEED = ChannelId("high_pass_cutoff"), ChannelId("travel_speed")
SENSORS = {name: ChannelId(name, "main") for name in ("elevation", "height")}
SENSORS["vertical_acceleration"] = ChannelId("vertical_acceleration", "main")


def header(axis):
    channels = frozenset({CUTOFF, SPEED, *SENSORS.values()})
    return Header(axis, 0.1, 0.0, Fraction(10), channels, ("main",))


@pytest.mark.parametrize("name", ["low_speed_hz", "wavelength_m", "transition_speed", "steepness"])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf")])
def test_a_schedule_of_no_cut_off_is_refused(name, value):
    with pytest.raises(InputError, match=name):
        schedule.AdaptiveCutOff(**{name: value})


@pytest.mark.parametrize("value", ["0.45", None, True, 1j])
def test_a_setting_that_is_no_number_is_refused(value):
    with pytest.raises(InputError, match=r"low_speed_hz is .*, not a number; give one above zero"):
        schedule.AdaptiveCutOff(low_speed_hz=value)


@pytest.mark.parametrize("speed", [3, 3.0, np.float64(3.0), [0, 3.0], (3.0,), [[1.0, 2.0], [3, 9]]])
def test_speeds_of_any_shape_have_a_cut_off_each(speed):
    cut_off, array = schedule.AdaptiveCutOff(), np.array(speed, dtype=float)
    hertz, cycles = cut_off.frequency(speed), cut_off.wave_number(speed, 0.05)
    assert hertz.shape == cycles.shape == array.shape
    for where in np.ndindex(array.shape):
        one = array[where]
        expected = one / 105.91 + (0.45 - one / 105.91) / (1.0 + np.exp(2.5 * (one - 2.778)))
        assert hertz[where] == pytest.approx(expected, rel=1e-9)
        assert cycles[where] == pytest.approx(min(expected / max(one, 1e-9), 5.0), rel=1e-9)


def test_a_missing_speed_has_no_cut_off_and_a_vehicle_that_rolls_back_has_that_of_a_stop():
    cut_off = schedule.AdaptiveCutOff()
    np.testing.assert_array_equal(np.isnan(cut_off.frequency([1.0, np.nan])), [False, True])
    assert cut_off.frequency(-20.0) == pytest.approx(0.45)
    assert cut_off.wave_number(-20.0, 0.05) == pytest.approx(5.0)


@pytest.mark.parametrize("interval", [0.0, -0.05, float("nan"), "0.05", None])
def test_an_interval_that_is_none_is_refused(interval):
    with pytest.raises(InputError, match=r"wave_number: interval_m is .*above zero"):
        schedule.AdaptiveCutOff().wave_number([1.0], interval)


@pytest.mark.parametrize("speed", ["fast", None, [1.0, 2.0j], [[1.0], [1.0, 2.0]]])
def test_a_speed_that_is_no_number_is_refused(speed):
    with pytest.raises(InputError, match="frequency: speed is not an array of numbers"):
        schedule.AdaptiveCutOff().frequency(speed)


@pytest.mark.parametrize(
    ("stage", "axis"),
    [(schedule.ScheduleCutOff, Axis.DISTANCE), (schedule.ScheduleWaveNumber, Axis.TIME)],
)
def test_a_schedule_belongs_to_its_axis(stage, axis):
    with pytest.raises(InputError, match=f"stage {stage.__name__}: the stream is not on the"):
        stage().start(header(axis))


@pytest.mark.cites("(5.3)")
def test_over_distance_a_vehicle_at_rest_has_four_points_a_cycle():
    stage = schedule.ScheduleWaveNumber(schedule.AdaptiveCutOff(wavelength_m=50.0))
    stage.start(header(Axis.DISTANCE))
    out = stage.push(Block(0, {SPEED: np.array([0.0, 1e-9, 30.0])}))
    assert out[CUTOFF] == pytest.approx([2.5, 2.5, 0.02])


@pytest.mark.parametrize("cutoff", [-0.1, 5.0, 80.0])
@pytest.mark.parametrize(
    "make", [lambda: varying.VaryingHighPassB3S2("elevation"), matched_high_pass.MatchedHighPass]
)
def test_a_cut_off_beyond_half_the_rate_is_refused(make, cutoff):
    stage = make()
    stage.start(header(Axis.TIME))
    values = {channel: np.zeros(3) for channel in SENSORS.values()}
    with pytest.raises(
        InputError, match=f"stage {stage.name}: channel high_pass_cutoff holds {cutoff:g};"
    ):
        stage.push(Block(0, {**values, CUTOFF: np.array([1.0, cutoff, 1.0])}))
