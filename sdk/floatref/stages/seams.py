"""The elevation continues without a step where the encoder lost travel."""

from typing import ClassVar

import numpy as np

from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import DISTANCE, HEIGHT, REFERENCE_HEIGHT
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId

PACE_S = 0.1
"""Time in s over which the pace before a seam is measured."""
LOST = 0.5
"""Share of the travel expected from the pace below which counts were lost."""
EMPTY: IndexArray = np.empty(0, np.int64)


class Seams(Stage):
    """Shifts `floating_reference_height` behind travel that the encoder lost.

    Both sides of such a stretch lie at one place, and the road in between would cause a step there.
    Where the encoder was missing and its distance includes the travel afterwards, nothing is
    shifted.
    """

    declared: ClassVar[Declared] = Declared(
        linear=False, zero_in_zero_out=False, shift_invariant=False
    )

    def __init__(self) -> None:
        """Wait for `start`."""
        super().__init__()
        self._tracks: tuple[str, ...] = ()
        self._pace = 1

    def open(self, header: Header) -> Header:
        """Ask for heights of every track, and the encoder."""
        own = [ChannelId(n, track) for n in (REFERENCE_HEIGHT, HEIGHT) for track in header.tracks]
        header.require(self.name, ChannelId(DISTANCE), *own)
        self._tracks = header.tracks
        self._pace = max(1, round(PACE_S / header.step))
        zeros = dict.fromkeys(header.tracks, 0.0)
        self.memory = {"shift": zeros, "elevation": dict(zeros), "places": np.empty(0), "at": EMPTY}
        return header

    def advance(self, block: Block) -> Block:
        """Shift what lies behind a seam."""
        if len(block) == 0:
            return block
        distance, values = block[ChannelId(DISTANCE)], {}
        known = np.flatnonzero(~np.isnan(distance))
        seams = self._seams(distance[known], known + block.first)
        for track in self._tracks:
            name, range_ = ChannelId(REFERENCE_HEIGHT, track), ChannelId(HEIGHT, track)
            shifts = self._shifts(track, block[name] - block[range_], known, seams)
            if shifts is not None:
                values[name] = block[name] + shifts
        return block.setting(values) if values else block

    def _seams(self, places: FloatArray, at: IndexArray) -> list[int]:
        """Return which known samples, ``at`` these, are behind a stretch whose travel was lost."""
        count = self.memory["at"].size
        whole = np.concatenate((self.memory["places"], places))
        where = np.concatenate((self.memory["at"], at))
        found = []
        for k in np.flatnonzero(np.diff(where) > 1).tolist():
            back = min(int(np.searchsorted(where, where[k] - self._pace)), k - 1)
            if k + 1 >= count and back >= 0:
                pace = (whole[k] - whole[back]) / (where[k] - where[back])
                if whole[k + 1] - whole[k] < LOST * pace * (where[k + 1] - where[k]):
                    found.append(k + 1 - count)
        self.memory["places"] = whole[-self._pace - 1 :].copy()
        self.memory["at"] = where[-self._pace - 1 :].copy()
        return found

    def _shifts(
        self, track: str, elevation: FloatArray, known: IndexArray, seams: list[int]
    ) -> FloatArray | None:
        """Return by how much each sample is shifted, None if nothing is."""
        shift: float = self.memory["shift"][track]
        shifts = np.full(elevation.size, shift) if shift or seams else None
        for k in seams:
            before = elevation[known[k - 1]] if k else self.memory["elevation"][track]
            step = float(np.nan_to_num(before - elevation[known[k]]))
            if shifts is not None:
                shifts[known[k] :] += step
            shift += step
        self.memory["shift"][track] = shift
        if known.size:
            self.memory["elevation"][track] = float(elevation[known[-1]])
        return shifts
