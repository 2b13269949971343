"""Simulating in the background what the next cases will ask for, on another core."""

from collections.abc import Iterable
from concurrent.futures import Future, ThreadPoolExecutor

from floatref_conformance.bench import seen_by, taken_of
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import Description
from floatref_conformance.proving_ground.scenario import Scenario


class Ahead:
    """Makes recordings in the order in which they were announced, one at a time.

    What is asked for before its turn is made at once by the one who asks, so that both work.
    The results are those of `taken_of`, whoever makes them.
    """

    def __init__(self, description: Description) -> None:
        """Make recordings with the channels that ``description`` allows."""
        self._description = description
        self._worker = ThreadPoolExecutor(1, "simulating-ahead")
        self._coming: dict[Scenario, Future[Taken]] = {}

    def announce(self, cases: Iterable[Case]) -> None:
        """Begin on what ``cases`` will ask for, as far as it is not on its way already."""
        for case in cases:
            scenario = seen_by(self._description, case.scenario)
            if scenario not in self._coming:
                self._coming[scenario] = self._worker.submit(taken_of, scenario)

    def __call__(self, scenario: Scenario) -> Taken:
        """Return the recording and truth of ``scenario``."""
        coming = self._coming.pop(scenario, None)
        if coming is None or coming.cancel():
            return taken_of(scenario)
        return coming.result()

    def close(self) -> None:
        """Drop what has not begun, and wait for what has."""
        self._worker.shutdown(cancel_futures=True)
        self._coming.clear()
