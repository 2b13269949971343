"""The channels of a TDMS file: which hold numbers, and how raw ones become values."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref_adapters.formats.tdms.tdms_objects import SCALING, StoredObject
from floatref_adapters.formats.tdms.waveform_clock import Waveforms, find_waveforms

SCALES = (
    "Polynomial",
    "Linear",
    "RTD",
    "Strain",
    "Table",
    "Thermistor",
    "Thermocouple",
    "Add",
    "Subtract",
    "AdvancedAPI",
)
"""Kinds of scale that npTDMS knows; it leaves the values as they are for any other."""
MOST_SCALES = 64
MOST_SUMS = 8
"""Scales with two inputs: each may double the work of the one before."""
STAMPS, TEXT, RAW_BUFFERS = "TimeStamp", "String", "DaqMxRawData"


@dataclass(frozen=True, eq=False)
class TdmsChannel:
    """A channel, with the properties of its group and its file."""

    origin: StoredObject
    inherited: tuple[Mapping[str, Any], ...]

    @property
    def kind(self) -> str:
        """NpTDMS's name of the type of its values."""
        return getattr(self.origin.data_type, "__name__", "")

    @property
    def stamps(self) -> bool:
        """Whether it holds time stamps."""
        return self.kind == STAMPS

    @property
    def daqmx(self) -> bool:
        """Whether its values lie among others in buffers of a device."""
        return bool(self.origin.scaler_data_types)

    @property
    def unit(self) -> str:
        """Its unit as the file has it; "" if missing."""
        properties = self.origin.properties
        unit = properties.get("unit_string") or properties.get("NI_UnitDescription") or ""
        return str(unit).strip()

    @cached_property
    def waveforms(self) -> Waveforms | None:
        """Its time properties, if it has them."""
        return find_waveforms(self.origin.properties, self.origin.histories)

    def unreadable(self) -> str:
        """Return why it gives no numbers; "" if it does."""
        if self.stamps:
            return "time stamps"
        if self.kind == TEXT:
            return "text"
        native = getattr(self.origin.data_type, "nptype", None)
        if not self.daqmx and (native is None or native.kind not in "biuf"):
            return f"values of type {self.kind}"
        return self._scaling_fault()

    def _scaling_fault(self) -> str:
        if any(name.startswith(SCALING) for name in self.origin.histories):
            return "numbers whose scale or unit changes on the way"
        for properties in (self.origin.properties, *self.inherited):
            kinds = [str(properties[name]) for name in properties if _NAMES_SCALE.match(name)]
            unknown = [kind for kind in kinds if kind not in SCALES]
            if unknown:
                return f"numbers with a scale of unknown kind {unknown[0][:40]}"
            sums = kinds.count("Add") + kinds.count("Subtract")
            count = properties.get("NI_Number_Of_Scales", 0)
            if not str(count).isdecimal() or int(count) > MOST_SCALES or sums > MOST_SUMS:
                return f"numbers with {str(count)[:20]} scales"
        return "" if self._can_be_scaled() else "numbers with a scale that cannot be computed"

    def _can_be_scaled(self) -> bool:
        if self.daqmx:
            return self.kind != RAW_BUFFERS or self.scaling() is not None
        try:
            self.make_scale()(np.arange(2).astype(self.origin.data_type.nptype))
        except Exception:
            return False
        return True

    def scaling(self) -> Any:
        """Return npTDMS's scaling of it; None if it is not scaled."""
        from nptdms.scaling import get_scaling

        return get_scaling(self.origin.properties, *self.inherited)

    def make_scale(self) -> Callable[[NDArray[Any]], NDArray[np.float64]]:
        """Return what makes values of raw numbers, as npTDMS does."""
        from nptdms.base_segment import RawChannelDataChunk

        scaling = self.scaling()

        def scale(raw: NDArray[Any]) -> NDArray[np.float64]:
            if scaling is None:
                return raw.astype(np.float64, copy=False)
            with np.errstate(all="ignore"):
                chunk = RawChannelDataChunk.channel_data(raw)
                return np.array(scaling.scale(chunk), np.float64)

        return scale


_NAMES_SCALE = re.compile(r"NI_Scale\[\d+\]_Scale_Type")
