"""`live-memory`: the memory of a device does not grow with the length of the run."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from floatref_conformance.checks.streams.stream_check import Runs, measurement
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.devices.streams.pieces import span
from floatref_conformance.errors import DeviceError, DeviceSkipped

GROWTH = "growth of the memory"
MOST_PERCENT = 25.0
"""Growth in percent of the pushed samples at 8 bytes: half of what floats in 4 bytes take."""
SAMPLE_BYTES = 8
PARTS, FIRST = 6, 3
"""Parts of the run; those before number `FIRST` fill what a device holds, the others count."""


@dataclass(frozen=True)
class MemoryCheck:
    """Over a long run the memory of the device stays where a window of samples brought it."""

    id: str = "live-memory"
    title: str = "memory does not grow with the run"
    clause: str = "Declared window"
    derivation: str = (
        "A drive at 10 m/s is streamed over and over, for half an hour. A device may hold samples "
        "and work for the longest_s that it declares, a quarter of an hour at most, so in the "
        "first half its memory may do as it likes. It is taken from /proc at every tenth second "
        "of samples: memory of its own, swapped out or not, of all its processes. Of each sixth "
        "of the run the smallest value counts, since a full window, and work on it, take more "
        "than an empty one; and of the growths to the fifth and to the last sixth the smaller "
        "one, since an allocator may take a block once. A device that keeps its samples grows by "
        "4 or 8 bytes for each, in both; a quarter of 8 is allowed. Where the system has no /proc "
        "the check is not applicable."
    )
    floor: str = "The device answers every sync of the run and gives out final points."
    limits: Mapping[str, str] = field(
        default_factory=lambda: {GROWTH: f"{MOST_PERCENT:g} % of the samples at 8 bytes"}
    )
    is_long: bool = True

    def judge(self, runs: Runs) -> tuple[Measurement, ...]:
        """Return the growth over the second half of the run."""
        measured = runs.long.memory_bytes
        if not measured:
            raise DeviceSkipped("the memory of a process is not known here: there is no /proc")
        if not runs.long.final:
            raise DeviceError("stream: gave out no final point in a long run")
        latency = runs.long.started.latency
        begin_s, end_s = span(runs.recording)
        part_s = runs.case.repeats * (end_s - begin_s) / PARTS
        if latency.longest_s > FIRST * part_s:
            raise DeviceError(
                f"stream: declares longest_s {latency.longest_s:g}; a stream gives out final "
                f"points within {FIRST * part_s:.0f} s"
            )
        least = [_least(measured, k * part_s, (k + 1) * part_s) for k in range(FIRST, PARTS)]
        growth = min(after - before for before, after in pairwise(least))
        rate = sum(c.values.size for c in runs.recording.channels) / (end_s - begin_s)
        share = max(0, growth) / (SAMPLE_BYTES * rate * part_s)
        return (measurement(GROWTH, "all", 100.0 * share, "%", MOST_PERCENT),)


def _least(measured: Sequence[tuple[float, int]], from_s: float, to_s: float) -> int:
    inside = [size for at_s, size in measured if from_s <= at_s < to_s]
    if not inside:
        raise DeviceError("stream: ended before the long run was over")
    return min(inside)
