"""How much the result depends on each standard deviation of Table 6.1 (section 6.4.4)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from floatref.tuning.levels import FIXED, TUNED, round_value
from floatref.tuning.run_scores import Scores
from floatref.tuning.trials import Trials

FACTORS = (2.0**-0.5, 1.0, 2.0**0.5)
"""Down to 71 % and up to 141 % of a value, by a step of half an octave."""


@dataclass(frozen=True)
class Sensitivity:
    """The scores of every run with one setting changed.

    Attributes:
        setting: its name.
        value: the one that was chosen, or is fixed.
        scores: by factor on the value, then by run.
    """

    setting: str
    value: float
    scores: Mapping[float, Mapping[str, Scores]]

    def losses(self, run: str) -> list[float]:
        """Return the mean loss of ``run`` at each factor."""
        return [
            sum(score.loss for score in scores[run]) / len(scores[run])
            for scores in self.scores.values()
        ]

    @property
    def mean_losses(self) -> list[float]:
        """The mean loss of all runs at each factor."""
        runs = next(iter(self.scores.values()))
        each = [self.losses(name) for name in runs]
        return [sum(losses) / len(each) for losses in zip(*each, strict=True)]

    @property
    def worst(self) -> tuple[float, str]:
        """The largest rise of any run's loss above that without a change, and which run."""
        runs = next(iter(self.scores.values()))
        rises = []
        for name in runs:
            losses = self.losses(name)
            rises.append((max(losses) - losses[FACTORS.index(1.0)], name))
        return max(rises, key=lambda pair: pair[0])


def sensitivities(
    trials: Trials, values: Mapping[str, float], chosen: Mapping[str, float], runs: Sequence[str]
) -> list[Sensitivity]:
    """Return the sensitivity to every setting of Table 6.1 among ``values``.

    ``chosen`` are the settings tuned; the others of ``values`` are those of the pipeline.
    """
    found = []
    for name in (*TUNED, *FIXED):
        if name not in values:
            continue
        value = chosen.get(name, values[name])
        scores = {}
        for factor in FACTORS:
            changed = {} if factor == 1.0 else {name: round_value(factor * value)}
            scores[factor] = trials.scores({**chosen, **changed}, runs)
        found.append(Sensitivity(name, value, scores))
    return found
