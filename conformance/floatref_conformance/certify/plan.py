"""What is certified: test sections with their references and runs, and the stationary tests."""

from dataclasses import dataclass
from pathlib import Path

Stretch = tuple[float, float]
"""From and to, in m."""


@dataclass(frozen=True)
class SectionPlan:
    """One test section.

    Attributes:
        name: what it is called.
        reference: its reference profile, of any format.
        runs: repeated runs over it: profiles of any format, or recordings.
        stretch_m: from and to on the reference's axis; None: all of the reference.
    """

    name: str
    reference: Path
    runs: tuple[Path, ...]
    stretch_m: Stretch | None = None


@dataclass(frozen=True)
class StationaryPlan:
    """A recorded stationary test: a profile or a recording, and the part that counts, in m."""

    source: Path
    stretch_m: Stretch | None = None


@dataclass(frozen=True)
class DistancePlan:
    """A path of known length in m, and what the profiler read for it, run by run, in m."""

    known_m: float
    readings_m: tuple[float, ...]


@dataclass(frozen=True)
class Plan:
    """All that a worksheet is made of."""

    sections: tuple[SectionPlan, ...]
    profiler: str = ""
    quiescent: StationaryPlan | None = None
    bounce: StationaryPlan | None = None
    distance: DistancePlan | None = None


@dataclass(frozen=True)
class Processing:
    """How recordings become profiles: what the `floatref process` command is given."""

    pipeline: str | None = None
    settings: Path | None = None
    adapter: str | None = None
    channel_map: Path | None = None
