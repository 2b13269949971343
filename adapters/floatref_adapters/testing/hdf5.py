"""A recording as an HDF5 file: a group per clock, a dataset per channel.

A group has the attributes `rate_hz` and `start_s`, as text, or a dataset `time_s`. Channels with
a quantum are integers with the attribute `scale_factor`, missing samples `_FillValue`.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, InputError, Recording, UniformClock
from floatref_adapters.shared.refusals import library
from floatref_adapters.testing.file_writing import (
    Floats,
    by_clock,
    check_quanta,
    quantum_of,
    replace_file,
    start_of,
)

ROWS = 1 << 16
MISSING = np.iinfo(np.int64).min


def write_hdf5(recording: Recording, path: Path, quanta: Mapping[str, float] | None = None) -> None:
    """Write ``recording`` to ``path``; InputError if that fails or a name holds a slash."""
    h5py = library("h5py", "writing HDF5")

    check_quanta(recording, quanta)
    with replace_file(path) as beside, h5py.File(beside, "w") as file:
        _state(file, {"vendor": recording.vendor, "model": recording.model})
        for number, channels in enumerate(by_clock(recording.channels), 1):
            group = file.create_group(f"clock_{number}")
            clock = channels[0].clock
            if isinstance(clock, UniformClock):
                _state(group, {"rate_hz": str(clock.rate), "start_s": start_of(clock)})
            else:
                _write(group, "time_s", clock.times_s, "s")
            for channel in channels:
                _write_channel(group, channel, quantum_of(channel, quanta))


def _write_channel(group: Any, channel: Channel, quantum: float | None) -> None:
    name = str(channel.id)
    if "/" in name or "\0" in name:
        raise InputError(f"channel {name!r}: HDF5 has no such name; rename the wheel path")
    if quantum is None:
        _write(group, name, channel.values, channel.unit)
        return
    dataset = _write(group, name, _steps(channel.values, quantum), channel.unit)
    dataset.attrs["scale_factor"] = quantum
    dataset.attrs["_FillValue"] = MISSING


def _steps(values: Floats, quantum: float) -> NDArray[np.int64]:
    missing = np.isnan(values)
    steps = np.round(np.where(missing, 0.0, values) / quantum)
    if (np.abs(steps) > 2.0**62).any():
        raise InputError(f"quantum {quantum}: too small for samples of {np.nanmax(values)}")
    return np.where(missing, MISSING, steps.astype(np.int64))


def _state(item: Any, attributes: Mapping[str, str]) -> None:
    """Write attributes as text of a fixed length, which lies in the object's own header."""
    for name, text in attributes.items():
        item.attrs[name] = np.bytes_(text.encode())


def _write(group: Any, name: str, values: NDArray[Any], unit: str) -> Any:
    chunks = (min(ROWS, values.size),)
    dataset = group.create_dataset(
        name,
        data=values,
        chunks=chunks,
        compression="gzip",
        compression_opts=1,
        shuffle=True,
        fletcher32=True,
    )
    _state(dataset, {"unit": unit})
    return dataset


__all__ = ["write_hdf5"]
