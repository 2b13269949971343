"""Schedules refuse what is no cut-off, and a filter refuses a cut-off beyond half the rate."""

from fractions import Fraction

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.stages import observer, schedule, varying
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
    "make", [lambda: varying.VaryingHighPassB3S2("elevation"), observer.MatchedHighPass]
)
def test_a_cut_off_beyond_half_the_rate_is_refused(make, cutoff):
    stage = make()
    stage.start(header(Axis.TIME))
    values = {channel: np.zeros(3) for channel in SENSORS.values()}
    with pytest.raises(
        InputError, match=f"stage {stage.name}: channel high_pass_cutoff holds {cutoff:g};"
    ):
        stage.push(Block(0, {**values, CUTOFF: np.array([1.0, cutoff, 1.0])}))
