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

from floatref.version import __version__ as __version__

if TYPE_CHECKING:
    from floatref.architectures.adapter import Adapter as Adapter
    from floatref.architectures.adapter import NativeAdapter as NativeAdapter
    from floatref.architectures.adapter import RecordingAdapter as RecordingAdapter
    from floatref.architectures.fall_back import DropOut as DropOut
    from floatref.architectures.lookup import make_stage as make_stage
    from floatref.architectures.lookup import pipeline as pipeline
    from floatref.architectures.lookup import stage_names as stage_names
    from floatref.architectures.markers import answers as answers
    from floatref.architectures.markers import hookimpl as hookimpl
    from floatref.architectures.pipeline import Context as Context
    from floatref.architectures.pipeline import Pipeline as Pipeline
    from floatref.architectures.processing import FloatrefWarning as FloatrefWarning
    from floatref.architectures.processing import pipeline_capabilities as pipeline_capabilities
    from floatref.architectures.processing import pipelines as pipelines
    from floatref.architectures.processing import process as process
    from floatref.architectures.profile_format import ProfileFormat as ProfileFormat
    from floatref.architectures.stage_calls import Setting as Setting
    from floatref.architectures.stage_calls import StageCall as StageCall
    from floatref.errors import FloatrefError as FloatrefError
    from floatref.errors import InputError as InputError
    from floatref.errors import PluginError as PluginError
    from floatref.errors import StageError as StageError
    from floatref.files import read_profile as read_profile
    from floatref.files import read_recording as read_recording
    from floatref.files import write_profile as write_profile
    from floatref.files import write_profile_csv as write_profile_csv
    from floatref.files import write_recording as write_recording
    from floatref.mapping import read_native as read_native
    from floatref.measures import agreement as agreement
    from floatref.measures import channel_noise as channel_noise
    from floatref.measures import high_pass as high_pass
    from floatref.measures import on_common_grid as on_common_grid
    from floatref.measures import short_interval_roughness as short_interval_roughness
    from floatref.response import IMINE_TRAILER as IMINE_TRAILER
    from floatref.response import ZHU_HALF_CAR as ZHU_HALF_CAR
    from floatref.response import JointInputState as JointInputState
    from floatref.response import Kind as Kind
    from floatref.response import Reading as Reading
    from floatref.response import UnknownInputObserver as UnknownInputObserver
    from floatref.response import check_readings as check_readings
    from floatref.response import default_gains as default_gains
    from floatref.response import hold_error_of as hold_error_of
    from floatref.retrofit import AdaptiveCutOff as AdaptiveCutOff
    from floatref.retrofit import AdaptiveHighPass as AdaptiveHighPass
    from floatref.retrofit import HeightReflection as HeightReflection
    from floatref.retrofit import HighPass as HighPass
    from floatref.retrofit import LocalSuppression as LocalSuppression
    from floatref.retrofit import MatchedHighPass as MatchedHighPass
    from floatref.retrofit import SpatialHighPass as SpatialHighPass
    from floatref.retrofit import TimerDistortion as TimerDistortion
    from floatref.retrofit import TravelSpeed as TravelSpeed
    from floatref.stages.kalman import Noise as Noise
    from floatref.stages.kalman import Plan as Plan
    from floatref.stages.protocol import Declared as Declared
    from floatref.stages.protocol import Direction as Direction
    from floatref.stages.protocol import Stage as Stage
    from floatref.stages.road_prior import RoadPrior as RoadPrior
    from floatref.values.arrays import Flag as Flag
    from floatref.values.block import Axis as Axis
    from floatref.values.block import Block as Block
    from floatref.values.block import Event as Event
    from floatref.values.block import Header as Header
    from floatref.values.block import join_blocks as join_blocks
    from floatref.values.channels import ChannelId as ChannelId
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
    from floatref.values.vehicle import VehicleSetup as VehicleSetup

# Imported on first use, so that `import floatref` loads neither numba nor scipy.
_PUBLIC = {
    "Adapter": "architectures.adapter",
    "AdaptiveCutOff": "retrofit",
    "AdaptiveHighPass": "retrofit",
    "Axis": "values.block",
    "Block": "values.block",
    "Channel": "values.recording",
    "ChannelId": "values.channels",
    "Column": "values.native",
    "Context": "architectures.pipeline",
    "Declared": "stages.protocol",
    "Direction": "stages.protocol",
    "DropOut": "architectures.fall_back",
    "Epoch": "values.native",
    "Event": "values.block",
    "Flag": "values.arrays",
    "FloatrefError": "errors",
    "FloatrefWarning": "architectures.processing",
    "Header": "values.block",
    "HeightReflection": "retrofit",
    "HighPass": "retrofit",
    "IMINE_TRAILER": "response",
    "InputError": "errors",
    "JointInputState": "response",
    "Kind": "response",
    "LocalSuppression": "retrofit",
    "MatchedHighPass": "retrofit",
    "NativeAdapter": "architectures.adapter",
    "NativeClock": "values.native",
    "NativeFile": "values.native",
    "Noise": "stages.kalman",
    "Pipeline": "architectures.pipeline",
    "Plan": "stages.kalman",
    "PluginError": "errors",
    "Profile": "values.profile",
    "ProfileFormat": "architectures.profile_format",
    "ProfileTrack": "values.profile",
    "Reading": "response",
    "Recording": "values.recording",
    "RecordingAdapter": "architectures.adapter",
    "RoadPrior": "stages.road_prior",
    "Rows": "values.native",
    "Setting": "architectures.stage_calls",
    "Setup": "values.recording",
    "SpatialHighPass": "retrofit",
    "Stage": "stages.protocol",
    "StageCall": "architectures.stage_calls",
    "StageError": "errors",
    "StampedClock": "values.clock",
    "Stream": "values.native",
    "TimerDistortion": "retrofit",
    "TrackSetup": "values.recording",
    "TravelSpeed": "retrofit",
    "UniformClock": "values.clock",
    "UnknownInputObserver": "response",
    "VehicleSetup": "values.vehicle",
    "ZHU_HALF_CAR": "response",
    "agreement": "measures",
    "answers": "architectures.markers",
    "channel_noise": "measures",
    "check_readings": "response",
    "default_gains": "response",
    "high_pass": "measures",
    "hold_error_of": "response",
    "hookimpl": "architectures.markers",
    "join_blocks": "values.block",
    "make_stage": "architectures.lookup",
    "on_common_grid": "measures",
    "pipeline": "architectures.lookup",
    "pipeline_capabilities": "architectures.processing",
    "pipelines": "architectures.processing",
    "process": "architectures.processing",
    "read_native": "mapping",
    "read_profile": "files",
    "read_recording": "files",
    "short_interval_roughness": "measures",
    "stage_names": "architectures.lookup",
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
