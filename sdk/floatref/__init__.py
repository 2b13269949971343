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

from floatref.values.display.views import place_views
from floatref.version import __version__ as __version__

# As in typing, whose import takes as long as all of this: Ctrl-C in it would be a traceback.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from floatref.c.c_sources import c_sources as c_sources
    from floatref.engine.lookup import make_stage as make_stage
    from floatref.engine.lookup import pipeline as pipeline
    from floatref.engine.lookup import stage_names as stage_names
    from floatref.engine.run import FloatrefWarning as FloatrefWarning
    from floatref.engine.run import pipeline_capabilities as pipeline_capabilities
    from floatref.engine.run import pipelines as pipelines
    from floatref.errors import FloatrefError as FloatrefError
    from floatref.errors import InputError as InputError
    from floatref.errors import PluginError as PluginError
    from floatref.errors import StageError as StageError
    from floatref.errors import missing_extra as missing_extra
    from floatref.estimators.kalman import Noise as Noise
    from floatref.estimators.kalman import Plan as Plan
    from floatref.estimators.road_prior import RoadPrior as RoadPrior
    from floatref.files import check_file as check_file
    from floatref.files import map_bytes as map_bytes
    from floatref.files import open_bytes as open_bytes
    from floatref.files import read_apart as read_apart
    from floatref.files import read_bytes as read_bytes
    from floatref.files import read_profile as read_profile
    from floatref.files import read_recording as read_recording
    from floatref.files import read_start as read_start
    from floatref.files import real_path as real_path
    from floatref.files import scratch_folder as scratch_folder
    from floatref.files import write_profile as write_profile
    from floatref.files import write_profile_csv as write_profile_csv
    from floatref.files import write_recording as write_recording
    from floatref.files.constant_interval import constant_interval as constant_interval
    from floatref.files.constant_interval import count_decimals as count_decimals
    from floatref.files.recording_directory import describe_installation as describe_installation
    from floatref.files.recording_directory import setup_of as setup_of
    from floatref.interfaces.adapter import Adapter as Adapter
    from floatref.interfaces.adapter import NativeAdapter as NativeAdapter
    from floatref.interfaces.adapter import RecordingAdapter as RecordingAdapter
    from floatref.interfaces.drop_out import DropOut as DropOut
    from floatref.interfaces.markers import answers as answers
    from floatref.interfaces.markers import hookimpl as hookimpl
    from floatref.interfaces.pipeline import Context as Context
    from floatref.interfaces.pipeline import Pipeline as Pipeline
    from floatref.interfaces.profile_format import ProfileFormat as ProfileFormat
    from floatref.interfaces.recording_format import RecordingFormat as RecordingFormat
    from floatref.interfaces.stage_calls import Setting as Setting
    from floatref.interfaces.stage_calls import StageCall as StageCall
    from floatref.live.points import LivePoints as LivePoints
    from floatref.live.points import join_points as join_points
    from floatref.live.stream import LiveStream as LiveStream
    from floatref.live.stream import resume_stream as resume_stream
    from floatref.live.stream import start_stream as start_stream
    from floatref.mapping import read_native as read_native
    from floatref.measures import agreement as agreement
    from floatref.measures import channel_noise as channel_noise
    from floatref.measures import high_pass as high_pass
    from floatref.measures import on_common_grid as on_common_grid
    from floatref.measures import short_interval_roughness as short_interval_roughness
    from floatref.notebook import process as process
    from floatref.retrofit import AdaptiveCutOff as AdaptiveCutOff
    from floatref.retrofit import AdaptiveHighPass as AdaptiveHighPass
    from floatref.retrofit import HeightReflection as HeightReflection
    from floatref.retrofit import HighPass as HighPass
    from floatref.retrofit import LocalSuppression as LocalSuppression
    from floatref.retrofit import MatchedHighPass as MatchedHighPass
    from floatref.retrofit import SpatialHighPass as SpatialHighPass
    from floatref.retrofit import TimerDistortion as TimerDistortion
    from floatref.retrofit import TravelSpeed as TravelSpeed
    from floatref.stages.protocol import Declared as Declared
    from floatref.stages.protocol import Direction as Direction
    from floatref.stages.protocol import Stage as Stage
    from floatref.values.arrays import Flag as Flag
    from floatref.values.axle_setup import AxleSetup as AxleSetup
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
    from floatref.values.vehicle_setup import VehicleSetup as VehicleSetup
    from floatref.vehicle_response import IMINE_TRAILER as IMINE_TRAILER
    from floatref.vehicle_response import ZHU_HALF_CAR as ZHU_HALF_CAR
    from floatref.vehicle_response import JointInputState as JointInputState
    from floatref.vehicle_response import Kind as Kind
    from floatref.vehicle_response import Reading as Reading
    from floatref.vehicle_response import UnknownInputObserver as UnknownInputObserver
    from floatref.vehicle_response import check_readings as check_readings
    from floatref.vehicle_response import default_gains as default_gains
    from floatref.vehicle_response import hold_error_of as hold_error_of

# Imported on first use, so that `import floatref` loads neither numba nor scipy.
_PUBLIC = {
    "Adapter": "interfaces.adapter",
    "AdaptiveCutOff": "retrofit",
    "AdaptiveHighPass": "retrofit",
    "Axis": "values.block",
    "AxleSetup": "values.axle_setup",
    "Block": "values.block",
    "Channel": "values.recording",
    "ChannelId": "values.channels",
    "Column": "values.native",
    "Context": "interfaces.pipeline",
    "Declared": "stages.protocol",
    "Direction": "stages.protocol",
    "DropOut": "interfaces.drop_out",
    "Epoch": "values.native",
    "Event": "values.block",
    "Flag": "values.arrays",
    "FloatrefError": "errors",
    "FloatrefWarning": "engine.run",
    "Header": "values.block",
    "HeightReflection": "retrofit",
    "HighPass": "retrofit",
    "IMINE_TRAILER": "vehicle_response",
    "InputError": "errors",
    "JointInputState": "vehicle_response",
    "Kind": "vehicle_response",
    "LivePoints": "live.points",
    "LiveStream": "live.stream",
    "LocalSuppression": "retrofit",
    "MatchedHighPass": "retrofit",
    "NativeAdapter": "interfaces.adapter",
    "NativeClock": "values.native",
    "NativeFile": "values.native",
    "Noise": "estimators.kalman",
    "Pipeline": "interfaces.pipeline",
    "Plan": "estimators.kalman",
    "PluginError": "errors",
    "Profile": "values.profile",
    "ProfileFormat": "interfaces.profile_format",
    "ProfileTrack": "values.profile",
    "Reading": "vehicle_response",
    "Recording": "values.recording",
    "RecordingAdapter": "interfaces.adapter",
    "RecordingFormat": "interfaces.recording_format",
    "RoadPrior": "estimators.road_prior",
    "Rows": "values.native",
    "Setting": "interfaces.stage_calls",
    "Setup": "values.recording",
    "SpatialHighPass": "retrofit",
    "Stage": "stages.protocol",
    "StageCall": "interfaces.stage_calls",
    "StageError": "errors",
    "StampedClock": "values.clock",
    "Stream": "values.native",
    "TimerDistortion": "retrofit",
    "TrackSetup": "values.recording",
    "TravelSpeed": "retrofit",
    "UniformClock": "values.clock",
    "UnknownInputObserver": "vehicle_response",
    "VehicleSetup": "values.vehicle_setup",
    "ZHU_HALF_CAR": "vehicle_response",
    "agreement": "measures",
    "answers": "interfaces.markers",
    "read_start": "files",
    "real_path": "files",
    "c_sources": "c.c_sources",
    "channel_noise": "measures",
    "check_file": "files",
    "check_readings": "vehicle_response",
    "constant_interval": "files.constant_interval",
    "count_decimals": "files.constant_interval",
    "default_gains": "vehicle_response",
    "describe_installation": "files.recording_directory",
    "high_pass": "measures",
    "hold_error_of": "vehicle_response",
    "hookimpl": "interfaces.markers",
    "join_blocks": "values.block",
    "join_points": "live.points",
    "make_stage": "engine.lookup",
    "map_bytes": "files",
    "missing_extra": "errors",
    "on_common_grid": "measures",
    "open_bytes": "files",
    "pipeline": "engine.lookup",
    "pipeline_capabilities": "engine.run",
    "pipelines": "engine.run",
    "process": "notebook",
    "read_apart": "files",
    "read_bytes": "files",
    "read_native": "mapping",
    "read_profile": "files",
    "read_recording": "files",
    "resume_stream": "live.stream",
    "scratch_folder": "files",
    "setup_of": "files.recording_directory",
    "short_interval_roughness": "measures",
    "stage_names": "engine.lookup",
    "start_stream": "live.stream",
    "write_profile": "files",
    "write_profile_csv": "files",
    "write_recording": "files",
}
__all__ = ["__version__", *_PUBLIC]

# Methods of values, such as `Profile.plot`, that rooms above `values` carry out.
place_views(
    {
        "profile_figure": ("floatref.plots.profile_figure", "profile_figure"),
        "profile_iri": ("floatref.measures.valid_iri", "profile_iri"),
        "profile_to_pandas": ("floatref.notebook.tables", "profile_to_pandas"),
        "profile_to_xarray": ("floatref.notebook.tables", "profile_to_xarray"),
        "recording_figure": ("floatref.plots.recording_figure", "recording_figure"),
        "recording_to_pandas": ("floatref.notebook.tables", "recording_to_pandas"),
        "recording_to_xarray": ("floatref.notebook.tables", "recording_to_xarray"),
    }
)


def __getattr__(name: str) -> "Any":
    """Import the public name ``name``."""
    if name not in _PUBLIC:
        raise AttributeError(f"module floatref has no attribute {name!r}")
    return getattr(import_module(f"floatref.{_PUBLIC[name]}"), name)


def __dir__() -> list[str]:
    """List the public names."""
    return sorted(__all__)
