"""What `bench_growth` found: its runs, how they grow, a table and a plot."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import minimize_scalar, nnls

if TYPE_CHECKING:
    from matplotlib.axis import Axis

LEAST_LATE = 3
"""Fewest long runs: through two lengths any start and slope fit."""
FLAT_S = 900.0
"""Memory is to be flat behind this length in s."""
COLUMNS = ("pipeline", "length", "paths", "processor", "of real time", "clock",
           "memory beyond the profile")  # fmt: skip


@dataclass(frozen=True)
class Run:
    """What one process took: length in s, wheel paths, times in s, memory and files in MB."""

    seconds: float
    paths: int
    processor_s: float
    clock_s: float
    peak_mb: float
    profile_mb: float
    recording_mb: float
    others: float
    """Processors that were busy with other work meanwhile."""

    @property
    def beyond_mb(self) -> float:
        """Memory at its peak, without the profile that it holds at the end."""
        return self.peak_mb - self.profile_mb


AXES = ("processor time in s", "memory beyond the profile in MB")
Found = dict[str, dict[str, list[Run]]]
"""Runs by what was varied, lengths or paths, and by pipeline."""


def exponent(runs: list[Run]) -> float:
    """Return p of the processor's time a + b L^p in the length L, for the least relative misfit.

    The start a is fitted with it. To take the start from a straight line first would pull p to 1:
    1.03 is found of 1.1.
    """
    length, taken = (np.array([getattr(r, n) for r in runs]) for n in ("seconds", "processor_s"))

    def misfit(power: float) -> float:
        terms = np.column_stack((np.ones_like(length), (length / length.max()) ** power))
        return float(nnls(terms / taken[:, np.newaxis], np.ones_like(taken))[1])

    return float(minimize_scalar(misfit, bounds=(0.5, 2.0), method="bounded").x)


def row(pipeline: str, one: Run) -> tuple[str, ...]:
    """Return the cells of one run."""
    return (
        f"`{pipeline}`",
        f"{one.seconds / 60.0:g} min",
        f"{one.paths}",
        f"{one.processor_s:.1f} s",
        f"{one.seconds / one.processor_s:.0f} ×",
        f"{one.clock_s:.1f} s",
        f"{one.beyond_mb:.0f} MB",
    )


def as_json(machine: Mapping[str, object], found: Found) -> str:
    """Return all runs and where they were taken."""
    runs = {
        kind: {pipeline: [asdict(run) for run in runs] for pipeline, runs in of.items()}
        for kind, of in found.items()
    }
    return json.dumps({"machine": machine, **runs}, indent=1) + "\n"


def summary(pipeline: str, runs: list[Run]) -> str:
    """Return how the time grows, and the memory of long runs, by the files of the profile too."""
    late = [r.beyond_mb for r in runs if r.seconds >= FLAT_S]
    if len(late) < LEAST_LATE:
        return f"`{pipeline}`: too few lengths for an exponent"
    share, rest = np.polyfit([r.profile_mb for r in runs], [r.peak_mb for r in runs], 1)
    return (
        f"`{pipeline}`: time grows by length to the power {exponent(runs):.3f}; memory beyond the "
        f"profile from {FLAT_S / 60.0:g} min on {min(late):.0f} to {max(late):.0f} MB. The peak of "
        f"all lengths is {rest:.0f} MB and {share:.2f} times the profile: 1.00 where it is flat"
    )


def from_json(text: str) -> tuple[dict[str, str | float], Found]:
    """Return where runs were taken, and the runs."""
    stored = json.loads(text)
    machine = stored.pop("machine")
    return machine, {
        kind: {pipeline: [Run(**run) for run in runs] for pipeline, runs in of.items()}
        for kind, of in stored.items()
    }


def plot(found: Found, target: Path) -> None:
    """Draw time and memory against length, and against the number of wheel paths."""
    import matplotlib as mpl

    mpl.use("agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(2, 2, figsize=(9.0, 6.5), constrained_layout=True)
    sides = (found["lengths"], "length in min"), (found["paths"], "wheel paths")
    for column, (runs_of, name) in enumerate(sides):
        for pipeline, runs in runs_of.items():
            x = [run.paths if column else run.seconds / 60.0 for run in runs]
            axes[0, column].plot(x, [run.processor_s for run in runs], "o-", label=pipeline)
            axes[1, column].plot(x, [run.beyond_mb for run in runs], "o-", label=pipeline)
        for axis, label in zip(axes[:, column], AXES, strict=True):
            axis.set(xlabel=name, ylabel=label, xscale="log")
            axis.grid(visible=True, which="both", alpha=0.3)
            _plain_ticks(axis.xaxis, (1.0, 2.0, 4.0, 8.0) if column else (1.0, 2.0, 5.0))
        axes[0, column].set_yscale("log")
        _plain_ticks(axes[0, column].yaxis, (1.0, 2.0, 5.0))
        axes[1, column].set_ylim(bottom=0.0)
    axes[0, 0].legend(fontsize="small")
    figure.savefig(target, dpi=110)


def _plain_ticks(axis: "Axis", subs: tuple[float, ...]) -> None:
    """Have a logarithmic axis ticks at ``subs`` of each decade, without powers of ten."""
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

    axis.set_major_locator(LogLocator(subs=subs))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_formatter(NullFormatter())
