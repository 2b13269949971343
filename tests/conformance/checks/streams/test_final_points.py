"""Final points: they stay, they cover the drive, and they are the road."""

import numpy as np
import pytest

from floatref_conformance.checks.streams.final_points import FinalCheck
from floatref_conformance.devices.streams.transcript import Given
from floatref_conformance.errors import DeviceError

from .conftest import MadeUp, points, steadily

CHECK = FinalCheck()


def test_points_of_the_road_that_are_given_once_pass(fails, transcript):
    assert fails(CHECK, MadeUp(transcript())) == []


def test_what_is_given_again_unchanged_passes(fails, transcript):
    given = steadily()
    assert fails(CHECK, MadeUp(transcript([*given, Given(given[3].points, 99.0)]))) == []


@pytest.mark.parametrize("last_s", [50.0, np.inf])
def test_a_final_point_that_is_given_again_with_another_value_fails(fails, transcript, last_s):
    given = steadily()
    again = points(given[3].points.first, [0.123])
    runs = MadeUp(transcript([*given, Given(again, last_s)]))
    assert fails(CHECK, runs) == ["change of a final point"]


def test_a_provisional_point_may_change(fails, transcript):
    first, other = steadily("provisional", 1.0), steadily("provisional", 2.0, error=1.1)
    assert fails(CHECK, MadeUp(transcript([*first, *other, *steadily()]))) == []


@pytest.mark.parametrize("number", [0, 7, -1])
def test_a_piece_of_the_drive_without_final_points_fails(fails, transcript, number):
    given = steadily()
    del given[number]
    assert fails(CHECK, MadeUp(transcript(given))) == ["drive without final points"]


@pytest.mark.parametrize(
    ("gain", "found"), [(1.09, []), (1.11, ["IRI error"]), (0.0, ["IRI error"])]
)
def test_at_constant_speed_the_points_are_the_road_within_a_tenth(fails, transcript, gain, found):
    assert fails(CHECK, MadeUp(transcript(steadily(error=gain)))) == found


def test_a_device_that_flags_half_of_a_steady_drive_is_at_fault(transcript):
    flagged = [
        Given(points(g.points.first, g.points.paths["left"].elevation, valid=[k < 18] * 200), 0.0)
        for k, g in enumerate(steadily())
    ]
    with pytest.raises(DeviceError, match="less than half"):
        CHECK.judge(MadeUp(transcript(flagged)))


def test_a_wheel_path_that_is_missing_is_a_fault(transcript):
    other = Given(points(0, [0.0], name="right"), 1.0)
    with pytest.raises(DeviceError, match="track left: no final point"):
        CHECK.judge(MadeUp(transcript([other])))
