"""Tables of drawn stops made by hand, so that what is made of them is tested by itself."""

from collections.abc import Callable, Sequence

import pytest

from floatref_conformance.table.stops import StopScores, StopSettings, StopTable, WheelPath

Made = Callable[..., StopTable]


@pytest.fixture
def hand_stops() -> Made:
    """Return a function that makes a table: one score for each drive in turn, the first again."""

    def make(scores: Sequence[StopScores], settings: StopSettings) -> StopTable:
        drives = [scenario for _, scenario in settings.scenarios(frozenset())]
        paths = (
            WheelPath(pipeline, "left", scenario, scores[number % len(scores)])
            for number, scenario in enumerate(drives)
            for pipeline in settings.pipelines
        )
        return StopTable(settings, tuple(paths))

    return make
