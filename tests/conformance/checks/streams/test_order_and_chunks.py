"""Two runs: points that were there before a moment, and final points of all, must be equal."""

import numpy as np
import pytest

from floatref_conformance.checks.streams.chunks import ChunksCheck
from floatref_conformance.checks.streams.order import OrderCheck
from floatref_conformance.devices.streams.transcript import Given
from floatref_conformance.errors import DeviceError

from .conftest import MadeUp, points, steadily

ORDER, CHUNKS = OrderCheck(), ChunksCheck()


def altered(given, number, by):
    """Return ``given`` whose element ``number`` is higher by ``by`` m."""
    each = given[number]
    path = each.points.paths["left"]
    other = points(each.points.first, path.elevation + by, each.points.state, path.valid)
    return [*given[:number], Given(other, each.until_s), *given[number + 1 :]]


def test_what_differs_after_the_moment_alone_is_no_fault(fails, transcript):
    given = steadily()
    late = next(k for k, each in enumerate(given) if each.until_s > 70.0)
    runs = MadeUp(transcript(given), changed=transcript(altered(given, late, 1.0)))
    assert fails(ORDER, runs) == []


@pytest.mark.parametrize("state", ["final", "provisional"])
def test_a_bit_that_differs_before_the_moment_is_one(fails, transcript, state):
    given = [*steadily("final"), *steadily("provisional", 2.0)]
    number = next(k for k, each in enumerate(given) if each.points.state == state)
    runs = MadeUp(transcript(given), changed=transcript(altered(given, number, 1e-9)))
    assert fails(ORDER, runs) == ["change by later samples"]


def test_a_declared_tolerance_allows_as_much_and_no_more(fails, transcript):
    given = steadily()
    for by, found in ((0.9e-6, []), (1.1e-6, ["change by later samples"])):
        other = transcript(altered(given, 0, by))
        assert fails(ORDER, MadeUp(transcript(given, tolerance_m=1e-6), changed=other)) == found


def test_a_point_that_only_one_run_has_by_the_moment_is_one(fails, transcript):
    given = steadily()
    runs = MadeUp(transcript(given), changed=transcript(given[1:]))
    assert fails(ORDER, runs) == ["change by later samples"]


def test_a_device_that_gives_nothing_by_the_moment_is_at_fault(transcript):
    late = steadily(after_s=80.0)
    with pytest.raises(DeviceError, match="no point in the first 70 s"):
        ORDER.judge(MadeUp(transcript(late), changed=transcript(late)))


def test_times_and_pieces_of_the_points_do_not_count_in_the_end(fails, transcript):
    other = steadily(piece_m=25.0, after_s=30.0)
    runs = MadeUp(transcript(), recut=transcript(other))
    assert fails(CHUNKS, runs) == []


@pytest.mark.parametrize("by", [1e-10, np.nan])
def test_one_final_point_that_differs_in_other_pieces_is_a_fault(fails, transcript, by):
    given = steadily()
    runs = MadeUp(transcript(given), recut=transcript(altered(given, -2 % len(given), by)))
    assert fails(CHUNKS, runs) == ["change by other pieces"]


def test_a_run_without_final_points_is_at_fault(transcript):
    nothing = transcript(steadily("provisional"))
    with pytest.raises(DeviceError, match="no final point"):
        CHUNKS.judge(MadeUp(nothing, recut=nothing))
