"""Writing a recording as MDF 4: a channel group for each clock, its master channel the time."""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from floatref import Channel, Recording, UniformClock
from floatref_adapters.formats.mdf4.mdf_opening import quiet
from floatref_adapters.shared.clock_groups import group_by_clock
from floatref_adapters.shared.refusals import library
from floatref_adapters.shared.simplest_ratio import find_simplest

LARGEST = 1 << 29
"""Bytes of the records of one group, which asammdf holds in memory; a longer one is divided."""
SAMPLE = 8
TRANSPOSED = 2
"""Compression of blocks that are transposed before they are deflated."""


class Mf4Recording:
    """The format of such files; the adapter `mdf4` reads them, by a channel map."""

    name = "mdf4"
    suffix = ".mf4"
    summary = "ASAM MDF 4 (.mf4): a channel group per clock, for any program that reads MDF"
    holds_setup = False

    def check_installed(self) -> None:
        """Raise InputError where asammdf is missing."""
        library("asammdf", "writing MDF4")

    def write(self, recording: Recording, path: Path) -> None:
        """Write ``recording`` to ``path``; InputError where asammdf is missing."""
        asammdf = library("asammdf", "writing MDF4")
        with quiet(), asammdf.MDF(version="4.10") as mdf:
            # The time of a recording has an origin of its own: the header states no date.
            mdf.header.abs_time = 0
            for number, channels in enumerate(_divide(group_by_clock(recording))):
                signals = _signals(channels, asammdf)
                mdf.append(signals, acq_name=f"clock {number}", common_timebase=True)
            written = Path(mdf.save(path, overwrite=True, compression=TRANSPOSED))
        if written != path:
            # It gives every file its own suffix.
            written.replace(path)


def _divide(groups: Sequence[Sequence[Channel]]) -> Iterator[Sequence[Channel]]:
    for channels in groups:
        most = max(LARGEST // (SAMPLE * channels[0].values.size), 1)
        for first in range(0, len(channels), most):
            yield channels[first : first + most]


def _signals(channels: Sequence[Channel], asammdf: Any) -> list[Any]:
    """Return the signals of ``channels``; the step of a uniform clock is that of the master."""
    clock, more = channels[0].clock, {}
    if isinstance(clock, UniformClock) and _is_exact(clock):
        line = {"a": float(1 / clock.rate), "b": clock.start_s}
        conversion = library("asammdf.blocks.conversion_utils", "writing MDF4").from_dict(line)
        more = {
            "flags": asammdf.Signal.Flags.virtual_master,
            "virtual_master_conversion": conversion,
        }
    times = channels[0].times_s
    return [
        asammdf.Signal(channel.values, times, channel.unit, str(channel.id), **more)
        for channel in channels
    ]


def _is_exact(clock: UniformClock) -> bool:
    """Return whether a float64 of the step gives the rate back."""
    return 1 / find_simplest(float(1 / clock.rate)) == Fraction(clock.rate)
