"""The columns of a summary as segments: wheel paths are combined, and files are in order."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray

SUMMARY_COLUMNS = (
    "name",
    "status",
    "segment",
    "length_m",
    "latitude_deg",
    "longitude_deg",
    "iri_m_per_km",
    "mean_roughness_index_m_per_km",
    "flagged_m",
    "iri_of_valid_m_per_km",
    "counted_share",
    "mean_roughness_index_of_valid_m_per_km",
)
"""Columns of a summary that its drawing needs."""
FAILED = "failed"


@dataclass(frozen=True, eq=False)
class Segments:
    """Segments of a network, each of shape (N,), and its files, each of shape (F,).

    Attributes:
        file: index of the segment's file among the files.
        roughness: mean roughness index of valid points, else the mean IRI of valid points of its
            wheel paths, in m/km; NaN where no wheel path has one.
        counted_share: the share of its length that this is over, 0 to 1: the smallest of the wheel
            paths.
        length_m: of the segment.
        flagged_m: invalid length, the mean of the wheel paths.
        latitude, longitude: of its start in degrees; longitudes do not jump at 180.
        paired: whether its roughness is a mean roughness index.
        names, failed: of the files.
    """

    file: NDArray[np.intp]
    roughness: FloatArray
    counted_share: FloatArray
    length_m: FloatArray
    flagged_m: FloatArray
    latitude: FloatArray
    longitude: FloatArray
    paired: BoolArray
    names: tuple[str, ...]
    failed: BoolArray

    @property
    def marked(self) -> BoolArray:
        """Whether its roughness is over a part of it only."""
        return np.asarray(self.counted_share < 1.0)


def segments_of(columns: Mapping[str, Sequence[Any]]) -> Segments:
    """Return the segments in ``columns`` of a summary, in its order; missing values are NaN.

    Raises InputError for a column that is missing, or not as long as the others.
    """
    _check(columns)
    places = {name: at for at, name in enumerate(dict.fromkeys(columns["name"]))}
    rows = np.array([places[name] for name in columns["name"]], np.intp)
    bad = np.array([status == FAILED for status in columns["status"]], np.bool_)
    failed = np.zeros(len(places), np.bool_)
    failed[rows[bad]] = True
    part = np.array([-1 if number is None else number for number in columns["segment"]], np.intp)
    file, part = rows[~bad], part[~bad]
    values = {name: np.array(columns[name], np.float64)[~bad] for name in SUMMARY_COLUMNS[3:]}
    keys = file * (part.max(initial=0) + 2) + part
    _, first, which = np.unique(keys, return_index=True, return_inverse=True)
    mean = {name: _means(column, which, first.size) for name, column in values.items()}
    index = mean["mean_roughness_index_of_valid_m_per_km"]
    return Segments(
        file=file[first],
        roughness=np.where(np.isnan(index), mean["iri_of_valid_m_per_km"], index),
        counted_share=_smallest(values["counted_share"], which, first.size),
        length_m=mean["length_m"],
        flagged_m=mean["flagged_m"],
        latitude=mean["latitude_deg"],
        longitude=_remove_jump(values["longitude_deg"][first]),
        paired=~np.isnan(index),
        names=tuple(places),
        failed=failed,
    )


def _check(columns: Mapping[str, Sequence[Any]]) -> None:
    for name in SUMMARY_COLUMNS:
        if name not in columns:
            raise InputError(f"column {name}: missing; give the columns of a summary")
        if len(columns[name]) != len(columns["name"]):
            raise InputError(
                f"column {name}: has {len(columns[name])} rows and name {len(columns['name'])}; "
                "give columns of one length"
            )


def _means(values: FloatArray, which: NDArray[np.intp], count: int) -> FloatArray:
    """Return the mean of the finite values for each of ``count`` segments, NaN without any."""
    there = np.isfinite(values)
    sums = np.bincount(which[there], values[there], count)
    numbers = np.bincount(which[there], minlength=count)
    found: FloatArray = np.full(count, np.nan)
    np.divide(sums, numbers, out=found, where=numbers > 0)
    return found


def _smallest(shares: FloatArray, which: NDArray[np.intp], count: int) -> FloatArray:
    """Return the smallest share for each of ``count`` segments; an unknown one is 0."""
    found = np.ones(count)
    np.minimum.at(found, which, np.nan_to_num(shares))
    return found


def _remove_jump(longitude: FloatArray) -> FloatArray:
    """Return ``longitude`` in degrees within 180 of the middle of the network."""
    turn = np.exp(1j * np.radians(longitude[np.isfinite(longitude)]))
    middle = float(np.degrees(np.angle(turn.sum()))) if turn.size else 0.0
    found: FloatArray = middle + (longitude - middle + 180.0) % 360.0 - 180.0
    return found
