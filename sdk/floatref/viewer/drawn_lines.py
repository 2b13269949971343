"""The lines of a page: levels of extremes, written as arrays, from fine to coarse."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.clock import UniformClock
from floatref.values.parts.extremes import Extremes, samples_per_bin
from floatref.values.recording import Channel
from floatref.viewer.page_writer import BYTE, DOUBLE, SINGLE, PageWriter

TEXT_PER_BYTE = 4 / 3
"""Characters of the page for a byte of an array."""
OF_ALL_LEVELS = 16 / 15
"""Bins of all levels for one of the finest."""
BIN_BYTES, MORE_BYTES = 9, 8
"""Bytes of a bin: lowest, highest and a mark; and those of what is not valid, of a band, or of a
place, each."""
FEWEST_BINS = 256


@dataclass(frozen=True, eq=False)
class Line:
    """One quantity over distance or time, before it is written.

    Attributes:
        values: samples, shape (N,), in the SI unit of the quantity.
        start, step: place of sample 0 and from one to the next, in m or s; or ``at``, shape (N,).
        domain: "distance" or "time".
        label: what a legend calls it.
        path: the wheel path it belongs to, empty for the vehicle.
        run: the number of the profile it is of.
        valid: which samples are valid, shape (N,); without it, those that are not NaN.
        sigma: 1-σ of every sample, in their unit.
    """

    values: FloatArray
    label: str
    domain: str
    start: float = 0.0
    step: float = 1.0
    at: FloatArray | None = None
    path: str = ""
    run: int = 0
    valid: BoolArray | None = None
    sigma: FloatArray | None = field(default=None)

    @classmethod
    def of_channel(cls, channel: Channel, origin_s: float, label: str) -> "Line":
        """Return the line of ``channel`` over the time in s after ``origin_s``."""
        clock, path = channel.clock, channel.id.track or ""
        if isinstance(clock, UniformClock):
            start, step = clock.start_s - origin_s, 1.0 / float(clock.rate)
            return cls(channel.values, label, "time", start, step, path=path)
        return cls(channel.values, label, "time", origin_s, at=clock.times_s, path=path)


def bins_within(sizes: Sequence[tuple[int, int]], most_bytes: float) -> int:
    """Return how many bins a line may have so that all lines take at most ``most_bytes`` of text.

    ``sizes`` are the samples of every line and its bytes for one bin.
    """
    most = max((count for count, _ in sizes), default=1)

    def text(bins: int) -> float:
        total = sum(-(-count // samples_per_bin(count, bins)) * size for count, size in sizes)
        return total * OF_ALL_LEVELS * TEXT_PER_BYTE

    while most > FEWEST_BINS and text(most) > most_bytes:
        most = -(-most // 2)
    return most


def write_line(page: PageWriter, line: Line, most_bins: int) -> dict[str, Any]:
    """Write the arrays of ``line`` and return its entry in the document.

    Arrays hold the values less ``base``, the middle of their range, as 32-bit numbers: they are
    right to 6e-8 of half the range.
    """
    samples = samples_per_bin(line.values.size, most_bins)
    parts = _parts(line, samples)
    low, high = _range(*parts.values())
    base = (low + high) / 2.0
    levels = [extremes.levels() for extremes in parts.values()]
    return {
        "label": line.label,
        "domain": line.domain,
        "path": line.path,
        "run": line.run,
        "start": line.start,
        "step": line.step,
        "count": line.values.size,
        "base": base,
        "levels": [
            _write_level(page, line, dict(zip(parts, level, strict=True)), base)
            for level in zip(*levels, strict=True)
        ],
    }


def _parts(line: Line, samples: int) -> dict[str, Extremes]:
    """Return the extremes of the valid samples, of the others, and of the band, where known."""
    parts = {"values": Extremes.of(line.values, samples, line.valid)}
    if line.valid is not None and parts["values"].missing.any():
        others = Extremes.of(line.values, samples, ~line.valid)
        if np.isfinite(others.low).any():
            parts["others"] = others
    if line.sigma is not None:
        parts["sigma"] = Extremes.of(line.values, samples, line.valid, line.sigma)
    return parts


def _range(*parts: Extremes) -> tuple[float, float]:
    """Return the lowest and the highest value of all ``parts``; zeros if there is no value."""
    low = np.concatenate([part.low[np.isfinite(part.low)] for part in parts])
    high = np.concatenate([part.high[np.isfinite(part.high)] for part in parts])
    return (float(low.min()), float(high.max())) if low.size else (0.0, 0.0)


def _write_level(
    page: PageWriter, line: Line, level: dict[str, Extremes], base: float
) -> dict[str, Any]:
    """Write one level of a line: an array for every entry that is a number."""
    values = level["values"]
    entry: dict[str, Any] = {"samples": values.samples, "bins": values.low.size}
    for name, part in level.items():
        entry[name] = _write_extremes(page, part, base)
    if values.missing.any():
        entry["marked"] = page.add(values.missing, BYTE)
    if line.at is not None:
        entry["at"] = page.add(line.at[:: values.samples] - line.start, DOUBLE)
    return entry


def _write_extremes(page: PageWriter, part: Extremes, base: float) -> list[int]:
    """Return the arrays of lowest and highest values, which are one for single samples."""
    low = page.add(part.low - base, SINGLE)
    same = part.samples == 1 and np.array_equal(part.low, part.high, equal_nan=True)
    return [low, low if same else page.add(part.high - base, SINGLE)]


def finest(entries: Sequence[dict[str, Any]]) -> int:
    """Return the largest number of samples that a bin of the finest level of any line holds."""
    return max((entry["levels"][0]["samples"] for entry in entries), default=1)
