"""Stages, architectures and measures for inertial road profilers.

Units are SI throughout: metres, seconds, radians, m/s². Angular rates are right-handed.
Body axes (ISO 8855): X forward, Y left, Z up. Pitch is a rotation about +Y, nose down
positive; roll is a rotation about +X, left side up positive; the order is yaw, pitch, roll.
Braking gives a negative longitudinal acceleration and a positive pitch.

`vertical_specific_force` is what an accelerometer along body Z reads: +9.80665 m/s² at rest
and level. `height` is the range from the reference point down to the road, positive. The
profile is the floating reference height minus the height.

Time is an integer sample index with a rational rate; distance is an integer point index with
a constant interval. Arrays of values are one-dimensional, float64 and read-only; NaN means
missing. IRI is in m/km.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from floatref.engine.run import FloatrefWarning as FloatrefWarning
    from floatref.engine.run import pipeline_capabilities as pipeline_capabilities
    from floatref.engine.run import pipelines as pipelines
    from floatref.engine.run import process as process
    from floatref.errors import FloatrefError as FloatrefError
    from floatref.errors import InputError as InputError
    from floatref.errors import StageError as StageError
    from floatref.files import read_profile as read_profile
    from floatref.files import read_recording as read_recording
    from floatref.files import write_profile as write_profile
    from floatref.files import write_profile_csv as write_profile_csv
    from floatref.files import write_recording as write_recording
    from floatref.mapping import read_native as read_native
    from floatref.retrofit import AdaptiveCutOff as AdaptiveCutOff
    from floatref.retrofit import AdaptiveHighPass as AdaptiveHighPass
    from floatref.retrofit import HeightReflection as HeightReflection
    from floatref.retrofit import HighPass as HighPass
    from floatref.retrofit import LocalSuppression as LocalSuppression
    from floatref.retrofit import MatchedHighPass as MatchedHighPass
    from floatref.retrofit import SpatialHighPass as SpatialHighPass
    from floatref.retrofit import TimerDistortion as TimerDistortion
    from floatref.retrofit import TravelSpeed as TravelSpeed
    from floatref.values.clock import StampedClock as StampedClock
    from floatref.values.clock import UniformClock as UniformClock
    from floatref.values.native import Column as Column
    from floatref.values.native import Epoch as Epoch
    from floatref.values.native import NativeClock as NativeClock
    from floatref.values.native import NativeFile as NativeFile
    from floatref.values.native import Rows as Rows
    from floatref.values.native import Stream as Stream
    from floatref.values.profile import Profile as Profile
    from floatref.values.profile import ProfileTrack as ProfileTrack
    from floatref.values.recording import Channel as Channel
    from floatref.values.recording import Recording as Recording
    from floatref.values.recording import Setup as Setup
    from floatref.values.recording import TrackSetup as TrackSetup
    from floatref.values.vehicle_setup import VehicleSetup as VehicleSetup

__version__ = "0.1.0"

# Imported on first use, so that `import floatref` loads neither numba nor scipy.
_PUBLIC = {
    "AdaptiveCutOff": "retrofit",
    "AdaptiveHighPass": "retrofit",
    "Channel": "values.recording",
    "Column": "values.native",
    "Epoch": "values.native",
    "FloatrefError": "errors",
    "FloatrefWarning": "engine.run",
    "HeightReflection": "retrofit",
    "HighPass": "retrofit",
    "InputError": "errors",
    "LocalSuppression": "retrofit",
    "MatchedHighPass": "retrofit",
    "NativeClock": "values.native",
    "NativeFile": "values.native",
    "Profile": "values.profile",
    "ProfileTrack": "values.profile",
    "Recording": "values.recording",
    "Rows": "values.native",
    "Setup": "values.recording",
    "SpatialHighPass": "retrofit",
    "StageError": "errors",
    "StampedClock": "values.clock",
    "Stream": "values.native",
    "TimerDistortion": "retrofit",
    "TrackSetup": "values.recording",
    "TravelSpeed": "retrofit",
    "UniformClock": "values.clock",
    "VehicleSetup": "values.vehicle_setup",
    "pipeline_capabilities": "engine.run",
    "pipelines": "engine.run",
    "process": "engine.run",
    "read_native": "mapping",
    "read_profile": "files",
    "read_recording": "files",
    "write_profile": "files",
    "write_profile_csv": "files",
    "write_recording": "files",
}
__all__ = ["__version__", *_PUBLIC]


def __getattr__(name: str) -> Any:
    """Import the public name ``name``."""
    if name not in _PUBLIC:
        raise AttributeError(f"module floatref has no attribute {name!r}")
    return getattr(import_module(f"floatref.{_PUBLIC[name]}"), name)


def __dir__() -> list[str]:
    """List the public names."""
    return sorted(__all__)
