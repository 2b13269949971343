"""Preliminary runs put through a pipeline with values to try: each once, several at a time."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from floatref.engine.run import run
from floatref.errors import FloatrefError
from floatref.screening.findings import Screening
from floatref.tuning.levels import Levels, Point
from floatref.tuning.run_scores import HOPELESS, Comparison, Scores
from floatref.values.profile import Profile
from floatref.values.recording import Recording


@dataclass(frozen=True)
class Preliminary:
    """A preliminary run, its drive, and the comparison for its profiles."""

    name: str
    recording: Recording
    screening: Screening
    comparison: Comparison

    def profile(self, pipeline: str, settings: Mapping[str, Any] | None = None) -> Profile:
        """Return the profile by ``pipeline``."""
        return run(self.recording, pipeline, settings, known=self.screening).profile


@dataclass
class Trials:
    """Cache of all calculated scores.

    Attributes:
        pipeline: the tuned one.
        given: fixed settings.
        levels: the values of the steps of a point.
        runs: by name.
        done: is called after each profile with their number so far.
    """

    pipeline: str
    given: Mapping[str, Any]
    levels: Levels
    runs: Mapping[str, Preliminary]
    done: Callable[[int], None] = field(default=lambda _: None)
    profiles: int = 0
    known: dict[tuple[str, tuple[tuple[str, Any], ...]], Scores] = field(default_factory=dict)
    workers: ThreadPoolExecutor | None = None

    @contextmanager
    def open_workers(self) -> Iterator["Trials"]:
        """Process as many runs at a time as there are processors."""
        with ThreadPoolExecutor(os.cpu_count()) as workers:
            self.workers = workers
            try:
                yield self
            finally:
                workers.shutdown(cancel_futures=True)
                self.workers = None

    def losses(self, point: Point, names: Sequence[str]) -> dict[str, list[float]]:
        """Return the losses of every wheel path of the runs called ``names`` at ``point``."""
        scores = self.scores(self.levels.settings(point), names)
        return {name: [score.loss for score in scores[name]] for name in names}

    def scores(self, values: Mapping[str, float], names: Sequence[str]) -> dict[str, Scores]:
        """Return the scores of runs with ``values`` in place of the settings given."""
        settings = {**self.given, **values}
        key = tuple(sorted(settings.items()))
        missing = [name for name in names if (name, key) not in self.known]
        found = (self.workers.map if self.workers else map)(
            lambda name: self._score_run(name, settings), missing
        )
        for name, scores in zip(missing, found, strict=True):
            self.known[name, key] = scores
            self.profiles += 1
            self.done(self.profiles)
        return {name: self.known[name, key] for name in names}

    @property
    def combinations(self) -> int:
        """How many combinations of values were tried on any run."""
        return len({key for _, key in self.known})

    def _score_run(self, name: str, settings: Mapping[str, Any]) -> Scores:
        chosen = self.runs[name]
        try:
            return chosen.comparison.scores(chosen.profile(self.pipeline, settings))
        except FloatrefError:
            # The same recording gave a profile before, so these values are the cause.
            return (HOPELESS,) * len(chosen.comparison.reference.tracks)
