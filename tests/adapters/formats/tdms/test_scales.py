"""Scales of TDMS: applied where they are known, told where they are not."""

import struct
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.testing.tdms import (
    META,
    NEW,
    RAW,
    doubles,
    metadata_text,
    scale_waveform,
    segment,
    waves,
    write_properties,
)
from floatref_adapters.testing.whole_reading import read_whole

read = partial(read_whole, Tdms())


def test_scales_are_applied_and_those_that_are_not_known_are_told(tmp_path: Path) -> None:
    path = tmp_path / "a.tdms"
    raw = np.arange(3.0).tobytes()
    path.write_bytes(segment(META | NEW | RAW, doubles(1, 3, scale_waveform("Linear")), raw))
    np.testing.assert_array_equal(read(path)[1][0][0]["c0"], [1, 3, 5])
    for properties, why in (
        (scale_waveform("Magic"), "numbers with a scale of unknown kind Magic"),
        (scale_waveform("Linear", 2**30), f"numbers with {2**30} scales"),
        (scale_waveform("Table"), "numbers with a scale that cannot be computed"),
    ):
        path.write_bytes(segment(META | NEW | RAW, doubles(1, 3, properties), raw))
        native, [(values, _)] = read(path)
        assert native.warnings == (f"g: 1 channels are {why}",)
        assert values == {}


@pytest.mark.parametrize(
    ("name", "values"), [("NI_Scale[0]_Linear_Slope", (2.0, 4.0)), ("unit_string", ("V", "mV"))]
)
def test_a_scale_or_unit_that_changes_on_the_way_is_not_applied_to_what_came_before(
    tmp_path: Path, name: str, values: tuple[float | str, float | str]
) -> None:
    path = tmp_path / "a.tdms"
    before, after = (
        {"wf_increment": 1.0, **scale_waveform("Linear"), name: value} for value in values
    )
    path.write_bytes(waves([(2, before), (2, after)]))
    native, _ = read(path)
    assert not native.streams[0].columns[0].numeric
    assert "whose scale or unit changes" in native.warnings[0]
    for same in (waves([(2, before), (2, before)]), waves([(4, before)]) + waves([(0, after)])):
        path.write_bytes(same)
        native, _ = read(path)
        assert native.streams[0].columns[0].numeric
        assert native.warnings == ()


def test_buffers_of_a_device_are_read(tmp_path: Path) -> None:
    """Two channels of int16 side by side in records of 4 bytes, as DAQmx logs them."""
    rows = np.arange(10, dtype="<i2").reshape(5, 2)
    channels = b""
    for k in range(2):
        scaler = struct.pack("<IIIII", 3, 0, 2 * k, 0, 0)
        layout = struct.pack("<IIIQI", 0x1269, 0xFFFFFFFF, 1, 5, 1) + scaler
        widths = struct.pack("<II", 1, 4)
        scale = scale_waveform("Linear", 2) | {"NI_Scale[1]_Scale_Type": "Linear"}
        del scale["NI_Scale[0]_Scale_Type"]
        scale |= {"NI_Scale[1]_Linear_Slope": 0.5, "NI_Scale[1]_Linear_Y_Intercept": 1.0}
        scale |= {"NI_Scale[1]_Linear_Input_Source": 0}
        channels += metadata_text(f"/'g'/'c{k}'") + layout + widths + write_properties(scale)
    data = segment(META | NEW | RAW | 128, struct.pack("<I", 2) + channels, rows.tobytes())
    (tmp_path / "a.tdms").write_bytes(data + segment(RAW | 128, b"", rows.tobytes()))
    native, [(values, _)] = read(tmp_path / "a.tdms")
    assert native.streams[0].count == 10
    for k in range(2):
        np.testing.assert_array_equal(values[f"c{k}"], np.tile(rows[:, k] * 0.5 + 1, 2))
