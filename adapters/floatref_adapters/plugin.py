"""The plug-in through which `floatref` finds these adapters."""

from collections.abc import Callable

import pluggy

from floatref_adapters.can_log import CanLog
from floatref_adapters.csv_recording import CsvRecording
from floatref_adapters.erd import Erd
from floatref_adapters.mdf4 import Mdf4
from floatref_adapters.nmea import Nmea
from floatref_adapters.novatel import NovAtel
from floatref_adapters.parquet_profile import ParquetProfile
from floatref_adapters.tdms import Tdms

hookimpl = pluggy.HookimplMarker("floatref")


@hookimpl
def floatref_register_adapters(register: Callable[[object], None]) -> None:
    """Register every adapter of this package."""
    register(CsvRecording())
    register(Nmea())
    register(NovAtel())
    register(CanLog())
    register(Mdf4())
    register(Tdms())


@hookimpl
def floatref_register_profile_formats(register: Callable[[Erd | ParquetProfile], None]) -> None:
    """Register every format of profile files of this package."""
    register(Erd())
    register(ParquetProfile())
