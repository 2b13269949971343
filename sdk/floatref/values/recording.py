"""A recording: the raw channels of one run and the geometry of the sensors."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, frozen
from floatref.values.axle_setup import AxleSetup
from floatref.values.channels import ChannelId, channel_spec, check_unit
from floatref.values.clock import Clock, StampedClock, UniformClock
from floatref.values.scanning import first_where
from floatref.values.vehicle_setup import VehicleSetup

Vector = tuple[float, float, float]
ORIGIN: Vector = (0.0, 0.0, 0.0)
ONLY_TRACK = "main"
"""Name of the wheel path of a recording in which no channel names one."""
SHORTEST_INTERVAL_M = 1e-5
LONGEST_INTERVAL_M = 10.0


def check_interval(interval_m: float, where: str) -> None:
    """Raise InputError naming ``where`` unless a profile can be made at ``interval_m`` in m."""
    if not SHORTEST_INTERVAL_M <= interval_m <= LONGEST_INTERVAL_M:
        raise InputError(
            f"{where} is {interval_m:g}; give the profile interval in m, between 0.00001 and 10"
        )


@dataclass(frozen=True)
class TrackSetup:
    """Where one wheel path's sensors sit, in m in body axes: ahead, to the left, up.

    Attributes:
        reference_point_m: the accelerometer, from one point of the vehicle.
        laser_offset_m: the laser, from the accelerometer; (0.105, 0, 0) is 0.105 m ahead of it.
    """

    reference_point_m: Vector = ORIGIN
    laser_offset_m: Vector = ORIGIN


@dataclass(frozen=True)
class Setup:
    """Geometry of the installation and the profile interval, in m, and the vehicle if known.

    ``vehicle`` is its model, for an estimate from its response; ``axles`` are where its wheels are.
    """

    profile_interval_m: float = 0.00508
    gnss_antenna_offset_m: Vector = ORIGIN
    tracks: Mapping[str, TrackSetup] = field(default_factory=dict)
    vehicle: VehicleSetup | None = None
    axles: AxleSetup | None = None

    def __post_init__(self) -> None:
        """Refuse an impossible interval; make the tracks read-only."""
        check_interval(self.profile_interval_m, "setup.profile_interval_m")
        object.__setattr__(self, "tracks", MappingProxyType(dict(self.tracks)))

    def track(self, name: str) -> TrackSetup:
        """Return where the sensors of wheel path ``name`` sit; at the vehicle point if unknown."""
        return self.tracks.get(name, TrackSetup())

    def axles_about(self, track: str) -> AxleSetup:
        """Return the axles, or the usual ones about the accelerometer of ``track`` if unknown."""
        return self.axles or AxleSetup.usual(self.track(track).reference_point_m[0])


@dataclass(frozen=True, eq=False)
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
        """Return a channel; InputError for an unknown name, a wrong unit or infinite samples."""
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
        bad = first_where(np.isinf, self.values)
        if bad is not None:
            raise InputError(
                f"channel {self.id}: sample {bad} is infinite; mark missing samples as NaN"
            )

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


@dataclass(frozen=True, eq=False)
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
            raise InputError(f"channel {missing}: missing; the recording holds {here}")
        return channel


__all__ = [
    "ONLY_TRACK",
    "AxleSetup",
    "Channel",
    "Clock",
    "Recording",
    "Setup",
    "StampedClock",
    "TrackSetup",
    "UniformClock",
    "VehicleSetup",
    "check_interval",
]
