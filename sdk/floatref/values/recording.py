"""A recording: the raw channels of one run and the geometry of the sensors."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, frozen
from floatref.values.axle_setup import AxleSetup
from floatref.values.channels import CHANNELS, ChannelId, channel_spec, check_unit
from floatref.values.clock import Clock, StampedClock, UniformClock
from floatref.values.display.html_table import html_table
from floatref.values.display.short_text import join_some, percent, rate_text, share_of, shorten
from floatref.values.display.similar_names import hint_at
from floatref.values.display.views import view
from floatref.values.installation import ORIGIN, Setup, TrackSetup, Vector, check_interval
from floatref.values.scan import Scan
from floatref.values.scanning import first_where
from floatref.values.vehicle_setup import VehicleSetup

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame
    from xarray import Dataset

ONLY_TRACK = "main"
"""Name of the wheel path of a recording in which no channel names one."""
MOST_CHANNELS = 6
"""Most channels of a recording that its line lists; its table has all of them."""


@dataclass(frozen=True, eq=False, repr=False)
class Channel:
    """Samples of one quantity, in its SI unit; NaN is a missing sample."""

    id: ChannelId
    values: FloatArray
    clock: Clock

    @classmethod
    def of(
        cls,
        name: str,
        values: ArrayLike,
        clock: Clock,
        track: str | None = None,
        unit: str | None = None,
    ) -> "Channel":
        """Return a channel; InputError for an unknown name, a wrong unit or infinite samples.

        Do not change ``values`` afterwards: what is found of them is kept.
        """
        channel = cls(ChannelId(name, track), frozen(values), clock)
        check_unit(channel.id, channel.unit if unit is None else unit)
        return channel

    def __post_init__(self) -> None:
        """Refuse an unknown name, no samples, infinities, or times that do not match."""
        channel_spec(self.id.name)
        if self.values.size == 0:
            raise InputError(f"channel {self.id}: no samples")
        if isinstance(self.clock, StampedClock) and self.clock.times_s.size != self.values.size:
            raise InputError(
                f"channel {self.id}: {self.values.size} samples "
                f"but {self.clock.times_s.size} time stamps"
            )
        if self.scan.largest == np.inf:
            bad = first_where(np.isinf, self.values)
            raise InputError(
                f"channel {self.id}: sample {bad} is infinite; mark missing samples as NaN"
            )

    @cached_property
    def scan(self) -> Scan:
        """What the first pass over the samples has found."""
        return Scan.of(self.values)

    @property
    def unit(self) -> str:
        """The channel's unit."""
        return channel_spec(self.id.name).unit

    @property
    def times_s(self) -> FloatArray:
        """Time of every sample in s."""
        return self.clock.times(self.values.size)

    @property
    def span_s(self) -> tuple[float, float]:
        """Times of the first and the last sample in s."""
        last = self.values.size - 1
        return float(self.clock.times(1)[0]), float(self.clock.times(1, last)[0])

    @property
    def mean_rate_hz(self) -> float:
        """Samples per second over the whole channel; infinite for a single time stamp."""
        if isinstance(self.clock, UniformClock):
            return float(self.clock.rate)
        begin, end = self.span_s
        return (self.values.size - 1) / (end - begin) if end > begin else np.inf

    def __repr__(self) -> str:
        """Return name, size, rate and unit on one line."""
        return f"Channel({self._short}, {self.values.size} samples in {self.unit or '1'})"

    @property
    def _short(self) -> str:
        return f"{shorten(str(self.id))} {rate_text(self.mean_rate_hz)}"

    @property
    def _cells(self) -> tuple[str, ...]:
        """Name, unit, rate, samples and the share of them that is missing."""
        missing = percent(share_of(np.isnan(self.values)))
        rate = rate_text(self.mean_rate_hz)
        return shorten(str(self.id)), self.unit, rate, str(self.values.size), missing


@dataclass(frozen=True, eq=False, repr=False)
class Recording:
    """All channels of one run on one time base, and the setup they were taken with."""

    channels: tuple[Channel, ...]
    setup: Setup = field(default_factory=Setup)
    vendor: str = ""
    model: str = ""

    def __post_init__(self) -> None:
        """Refuse a recording without channels or with the same channel twice."""
        if not self.channels:
            raise InputError("the recording has no channels")
        seen: set[ChannelId] = set()
        for channel in self.channels:
            if channel.id in seen:
                raise InputError(f"channel {channel.id}: given twice")
            seen.add(channel.id)

    @property
    def tracks(self) -> tuple[str, ...]:
        """Names of the wheel paths, in the order of their channels."""
        named = [c.id.track for c in self.channels if c.id.track is not None]
        return tuple(dict.fromkeys(named)) or (ONLY_TRACK,)

    def find(self, name: str, track: str | None = None) -> Channel | None:
        """Return channel ``name`` of ``track``, else the shared one, else None."""
        shared = None
        for channel in self.channels:
            if channel.id == (name, track):
                return channel
            if channel.id == (name, None):
                shared = channel
        return shared

    def channel(self, name: str, track: str | None = None) -> Channel:
        """Return channel ``name`` of ``track`` (or shared); InputError if it is missing."""
        channel = self.find(name, track)
        if channel is None:
            here = ", ".join(str(c.id) for c in self.channels)
            named = any(c.id.track is not None for c in self.channels)
            missing = ChannelId(name, track if named else None)
            # A standard name is not a mistyped one, however near another is.
            hint = "" if name in CHANNELS else hint_at(name, [c.id.name for c in self.channels])
            raise InputError(f"channel {missing}: missing; the recording holds {here}{hint}")
        return channel

    @property
    def duration_s(self) -> float:
        """Time from the first sample of any channel to the last one, in s."""
        begins, ends = zip(*(channel.span_s for channel in self.channels), strict=True)
        return float(max(ends) - min(begins))

    def __repr__(self) -> str:
        """Return duration and channels with their mean rates, on one line."""
        channels = join_some([channel._short for channel in self.channels], MOST_CHANNELS)
        return f"Recording({self.duration_s:.2f} s; {channels})"

    def _repr_html_(self) -> str:
        made = shorten(f"{self.vendor} {self.model}".strip())
        caption = f"Recording: {self.duration_s:.2f} s" + (f", {made}" if made else "")
        header = ("channel", "unit", "mean rate", "samples", "missing")
        return html_table(caption, header, [channel._cells for channel in self.channels])

    def plot(self) -> "Figure":
        """Return a figure with a panel for each quantity over the time in s.

        Times at which a sample is missing are shaded. Raises InputError if matplotlib, of the
        extra ``plot``, is missing.
        """
        return cast("Figure", view("recording_figure")(self))

    def to_pandas(self) -> "list[DataFrame]":
        """Return read-only frames with index `time_s` in s, one for every clock.

        Columns are `<channel>` or `<track>.<channel>`; `attrs` holds their `units`. Nothing is
        resampled. Raises InputError if pandas, of the extra ``adapters``, is missing.
        """
        return cast("list[DataFrame]", view("recording_to_pandas")(self))

    def to_xarray(self) -> "Dataset":
        """Return a data set with a dimension `time_1`, `time_2` … for every clock.

        Variables are `<channel>` or `<track>.<channel>`, with their `units`. Raises InputError if
        xarray, of the extra ``adapters``, is missing.
        """
        return cast("Dataset", view("recording_to_xarray")(self))


__all__ = [
    "ONLY_TRACK",
    "ORIGIN",
    "AxleSetup",
    "Channel",
    "Clock",
    "Recording",
    "Setup",
    "StampedClock",
    "TrackSetup",
    "UniformClock",
    "Vector",
    "VehicleSetup",
    "check_interval",
]
