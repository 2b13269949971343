"""Simulating in the background what the next cases will ask for, on another core."""

from collections.abc import Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import islice, takewhile

from floatref_conformance.bench import seen_by, taken_of
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import Description
from floatref_conformance.proving_ground.scenario import Scenario

OUTSTANDING = 3
"""Recordings at most that are made and not asked for yet: without a cache they fill the memory."""


class Ahead:
    """Makes recordings in the order in which they were announced, one at a time.

    No more than `OUTSTANDING` are under way or waiting to be asked for. What is asked for before
    its turn is made at once by the one who asks, so that both work; what was announced before it
    is not waited for any more. The results are those of `taken_of`, whoever makes them.
    """

    def __init__(self, description: Description) -> None:
        """Make recordings with the channels that ``description`` allows."""
        self._description = description
        self._worker = ThreadPoolExecutor(1, "simulating-ahead")
        self._coming: dict[Scenario, Future[Taken] | None] = {}

    def announce(self, cases: Iterable[Case]) -> None:
        """Begin on what ``cases`` will ask for, as far as it is not on its way already."""
        for case in cases:
            self._coming.setdefault(seen_by(self._description, case.scenario), None)
        self._begin()

    def __call__(self, scenario: Scenario) -> Taken:
        """Return the recording and truth of ``scenario``."""
        if scenario not in self._coming:
            return taken_of(scenario)
        for passed in list(takewhile(lambda other: other != scenario, self._coming)):
            self._drop(passed)
        coming = self._coming.pop(scenario)
        at_once = coming is None or coming.cancel()
        self._begin()
        return taken_of(scenario) if coming is None or at_once else coming.result()

    def close(self) -> None:
        """Drop what has not begun, and wait for what has."""
        self._worker.shutdown(cancel_futures=True)
        self._coming.clear()

    def _begin(self) -> None:
        """Have the first `OUTSTANDING` made, as far as they are not under way."""
        for scenario in list(islice(self._coming, OUTSTANDING)):
            if self._coming[scenario] is None:
                self._coming[scenario] = self._worker.submit(taken_of, scenario)

    def _drop(self, scenario: Scenario) -> None:
        coming = self._coming.pop(scenario)
        if coming is not None:
            coming.cancel()
