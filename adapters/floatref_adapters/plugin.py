"""The plug-in through which `floatref` finds these adapters."""

from collections.abc import Callable
from typing import Any

from floatref import Adapter, ProfileFormat, RecordingFormat, hookimpl
from floatref_adapters.formats.arrow.adapter import ArrowIpc, Parquet
from floatref_adapters.formats.arrow.parquet_profile import ParquetProfile
from floatref_adapters.formats.can_log.adapter import CanLog
from floatref_adapters.formats.csv_table.adapter import CsvTable
from floatref_adapters.formats.erd.erd_profile import Erd
from floatref_adapters.formats.hdf5.adapter import Hdf5
from floatref_adapters.formats.mcap_log.adapter import Mcap
from floatref_adapters.formats.mdf4.adapter import Mdf4
from floatref_adapters.formats.mdf4.mdf_writing import Mf4Recording
from floatref_adapters.formats.nmea.adapter import Nmea
from floatref_adapters.formats.novatel.adapter import NovAtel
from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.formats.viewer_text.text_profile import ViewerText
from floatref_adapters.views import (
    recording_to_pandas,
    recording_to_xarray,
    to_pandas,
    to_xarray,
)


@hookimpl
def floatref_register_adapters(register: Callable[[Adapter], None]) -> None:
    """Register every adapter of this package."""
    adapters = (CsvTable, Parquet, ArrowIpc, Hdf5, Mdf4, Tdms, Nmea, NovAtel, CanLog, Mcap)
    for adapter in adapters:
        register(adapter())


@hookimpl
def floatref_register_profile_formats(register: Callable[[ProfileFormat], None]) -> None:
    """Register every format of profile files of this package."""
    register(Erd())
    register(ViewerText())
    register(ParquetProfile())


@hookimpl
def floatref_register_recording_formats(register: Callable[[RecordingFormat], None]) -> None:
    """Register every format that this package writes recordings in."""
    register(Mcap())
    register(Mf4Recording())


@hookimpl
def floatref_register_views(register: Callable[[str, Callable[[Any], Any]], None]) -> None:
    """Register the tables behind `to_pandas` and `to_xarray` of profiles and recordings."""
    register("profile_to_pandas", to_pandas)
    register("profile_to_xarray", to_xarray)
    register("recording_to_pandas", recording_to_pandas)
    register("recording_to_xarray", recording_to_xarray)
