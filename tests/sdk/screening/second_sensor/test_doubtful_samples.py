"""Samples that a doubt replaces count as missing, in their channel and nowhere else."""

import numpy as np
import pytest

from floatref.screening.damage.damaged_samples import Damage
from floatref.screening.second_sensor.doubtful_samples import replaced_by_doubt
from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.channels import ChannelId
from floatref.values.clock import Clock, StampedClock, UniformClock
from floatref.values.recording import Channel

LEFT = ChannelId("height", "left")
CLOCKS = (UniformClock.of(100.0), StampedClock.of(np.arange(1000) / 100.0))


def channel(clock: Clock) -> Channel:
    return Channel(LEFT, np.linspace(0.2, 0.3, 1000), clock)


def doubt(*spans: tuple[float, float], replaced: bool = True) -> Doubt:
    return Doubt((LEFT,), "in doubt", spans=spans, replaced=replaced)


@pytest.mark.parametrize("clock", CLOCKS)
def test_the_samples_of_its_stretches_are_gone_and_disturb_what_follows(clock: Clock) -> None:
    found = replaced_by_doubt(channel(clock), Damage(), [doubt((1.0, 2.0), (5.0, 5.5))])
    assert found.gone.tolist() == [[100, 200], [500, 550]]
    assert found.lasting.tolist() == found.gone.tolist()


def test_other_channels_and_doubts_that_replace_nothing_change_nothing() -> None:
    before = Damage()
    other = Doubt((ChannelId("height", "right"),), "other", spans=((1.0, 2.0),), replaced=True)
    for each in (other, doubt((1.0, 2.0), replaced=False)):
        assert replaced_by_doubt(channel(CLOCKS[0]), before, [each]) is before


def test_damage_that_is_known_stays() -> None:
    known = Damage(np.array([[10, 20]]), warnings=("a line",))
    found = replaced_by_doubt(channel(CLOCKS[0]), known, [doubt((1.0, 2.0))])
    assert found.gone.tolist() == [[10, 20], [100, 200]]
    assert found.warnings == ("a line",)


def test_a_channel_is_never_replaced_as_a_whole() -> None:
    before = Damage()
    assert replaced_by_doubt(channel(CLOCKS[0]), before, [doubt((0.0, 9.9))]) is before
