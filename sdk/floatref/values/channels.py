"""The channels of a recording: names, units and meaning.

Every channel has one unit and one sign; a recording in other units is refused, and an
adapter converts it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest

STANDARD_GRAVITY = 9.80665
"""Standard gravity g in m/s², added by an accelerometer at rest."""


class ChannelId(NamedTuple):
    """A channel's name and the wheel path it belongs to; ``None`` is shared by all."""

    name: str
    track: str | None = None

    def __str__(self) -> str:
        """Return ``track.name``, as in the file names of a recording directory."""
        return self.name if self.track is None else f"{self.track}.{self.name}"


@dataclass(frozen=True)
class ChannelSpec:
    """Unit and meaning of one channel."""

    unit: str
    meaning: str


CHANNELS: Mapping[str, ChannelSpec] = MappingProxyType(
    {
        "vertical_specific_force": ChannelSpec("m/s^2", "accelerometer along body Z, +9.8 at rest"),
        "longitudinal_specific_force": ChannelSpec("m/s^2", "accelerometer along body X"),
        "lateral_specific_force": ChannelSpec("m/s^2", "accelerometer along body Y"),
        "height": ChannelSpec("m", "range from the laser to the road, positive"),
        "distance": ChannelSpec("m", "encoder distance, non-decreasing"),
        "wheel_distance": ChannelSpec("m", "encoder of the wheel on that side, non-decreasing"),
        "optical_distance": ChannelSpec("m", "of a sensor that does not slip, non-decreasing"),
        "wheel_speed": ChannelSpec("m/s", "from the vehicle bus, 0 below about 2 km/h"),
        "roll_rate": ChannelSpec("rad/s", "angular rate about body X"),
        "pitch_rate": ChannelSpec("rad/s", "angular rate about body Y"),
        "yaw_rate": ChannelSpec("rad/s", "angular rate about body Z"),
        "gnss_height": ChannelSpec("m", "antenna height, up"),
        "gnss_vertical_velocity": ChannelSpec("m/s", "antenna vertical velocity, up"),
        "gnss_speed": ChannelSpec("m/s", "antenna speed over ground, from Doppler"),
        "gnss_pitch": ChannelSpec("rad", "Euler pitch, nose down positive"),
        "gnss_roll": ChannelSpec("rad", "asin(cos pitch sin roll), left side up positive"),
        "gnss_quality": ChannelSpec(
            "1", "0 no fix, 1 single, 2 differential, 4 RTK fixed, 5 RTK float"
        ),
        "gnss_latitude": ChannelSpec("rad", "geodetic latitude"),
        "gnss_longitude": ChannelSpec("rad", "geodetic longitude"),
        "unsprung_specific_force": ChannelSpec("m/s^2", "wheel carrier, vertical, +9.8 at rest"),
        "rear_unsprung_specific_force": ChannelSpec("m/s^2", "rear wheel carrier, likewise"),
        "sprung_specific_force": ChannelSpec("m/s^2", "body above that wheel, +9.8 at rest"),
        "equipment_specific_force": ChannelSpec("m/s^2", "equipment carried, +9.8 at rest"),
        "suspension_deflection": ChannelSpec("m", "body minus wheel height, against rest"),
        "rear_suspension_deflection": ChannelSpec("m", "the same at the rear wheel"),
        "unsprung_displacement": ChannelSpec("m", "wheel height against rest, up"),
        "rear_unsprung_displacement": ChannelSpec("m", "rear wheel height against rest, up"),
        "sprung_displacement": ChannelSpec("m", "body height against rest, up"),
        "equipment_displacement": ChannelSpec("m", "height of equipment against rest, up"),
        "unsprung_velocity": ChannelSpec("m/s", "wheel, up"),
        "rear_unsprung_velocity": ChannelSpec("m/s", "rear wheel, up"),
        "sprung_velocity": ChannelSpec("m/s", "body, up"),
        "equipment_velocity": ChannelSpec("m/s", "equipment carried, up"),
        "pitch_angle": ChannelSpec("rad", "body against rest, nose down positive"),
        "roll_angle": ChannelSpec("rad", "body against rest, left side up positive"),
        "pitch_acceleration": ChannelSpec("rad/s^2", "second derivative of pitch_angle"),
        "roll_acceleration": ChannelSpec("rad/s^2", "second derivative of roll_angle"),
    }
)

SPELLINGS: Mapping[str, str] = MappingProxyType(
    {"m/s²": "m/s^2", "rad/s²": "rad/s^2", "-": "1", "–": "1", "": "1"}
)
"""Other ways to write the units of the channels."""

FACTORS: Mapping[tuple[str, str], str] = MappingProxyType(
    {
        ("g", "m/s^2"): "9.80665",
        ("mm", "m"): "0.001",
        ("cm", "m"): "0.01",
        ("km", "m"): "1000",
        ("in", "m"): "0.0254",
        ("ft", "m"): "0.3048",
        ("deg", "rad"): "0.017453292519943295",
        ("deg/s", "rad/s"): "0.017453292519943295",
        ("deg/s^2", "rad/s^2"): "0.017453292519943295",
        ("km/h", "m/s"): "1/3.6",
    }
)
"""Factors that convert samples from other common units."""


def channel_spec(name: str) -> ChannelSpec:
    """Return the specification of channel ``name``; InputError if it is unknown."""
    if name in CHANNELS:
        return CHANNELS[name]
    raise InputError(f"channel {name}: unknown name; {suggest(name, CHANNELS, 'known:')}")


def check_unit(channel: ChannelId, unit: str) -> None:
    """Raise InputError unless ``unit`` is the one that ``channel`` is defined in."""
    expected = channel_spec(channel.name).unit
    if SPELLINGS.get(unit, unit) == expected:
        return
    factor = FACTORS.get((unit, expected))
    advice = "convert the samples" + (f", multiply them by {factor}" if factor else "")
    raise InputError(f"channel {channel}: unit {unit!r}, expected {expected!r}; {advice}")
