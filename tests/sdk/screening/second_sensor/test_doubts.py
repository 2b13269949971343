"""A doubt about a stretch never refuses the recording."""

import pytest

from floatref.screening.second_sensor.doubts import WHOLE, Doubt
from floatref.values.channels import ChannelId

CHANNEL = (ChannelId("height", "left"),)


@pytest.mark.parametrize("spans", [((3.0, 5.0),), (WHOLE, (3.0, 5.0)), ((3.0, float("inf")),)])
def test_a_fault_on_a_stretch_refuses_no_recording(spans: tuple[tuple[float, float], ...]) -> None:
    assert not Doubt(CHANNEL, "in doubt", spans=spans).whole_run
    with pytest.raises(ValueError, match="refuses no recording"):
        Doubt(CHANNEL, "in doubt", fatal=True, spans=spans)


def test_a_fault_of_the_whole_run_may() -> None:
    assert Doubt(CHANNEL, "useless", fatal=True).whole_run
