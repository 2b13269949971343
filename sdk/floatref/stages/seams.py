"""The elevation continues at its grade where the encoder lost travel, or made it up."""

from dataclasses import dataclass, field
from itertools import pairwise
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
LEAPT = 3.0
"""Number of times that travel, within `PACE_S`, above which the encoder leapt."""
GRADE_M, POINT_M = 20.0, 0.25
"""Travel over which the grade is measured, and the interval of its points. It is long for a bump,
and short for the waves that a high-pass leaves."""
EMPTY: IndexArray = np.empty(0, np.int64)


@dataclass(eq=False)
class Grade:
    """The road before a sample: points of it, and the last that was known.

    Attributes:
        places, heights: of the points, in m; without what seams lost or made up.
        place, height: of the last sample, in m.
    """

    places: FloatArray = field(default_factory=lambda: np.empty(0))
    heights: FloatArray = field(default_factory=lambda: np.empty(0))
    place: float = 0.0
    height: float = 0.0

    def add(self, place: FloatArray, height: FloatArray) -> None:
        """Take the next samples, shape (n,), of which one in each `POINT_M` is a point."""
        seen = np.flatnonzero(~np.isnan(height))
        if not seen.size:
            return
        if seen.size < height.size:
            place, height = place[seen], height[seen]
        near = int(np.argmax(place >= place[-1] - GRADE_M))
        self._add_near(place, place[near:], height[near:])

    def _add_near(self, every: FloatArray, place: FloatArray, height: FloatArray) -> None:
        """Take those samples, the last of ``every``, that are near enough to the last one."""
        latest = float(self.places[-1]) if self.places.size else float(every[0]) - POINT_M
        # What is too far from the last sample is not kept: only how far it got counts.
        far = every[: every.size - place.size]
        latest = max(latest, float(far.max(initial=-np.inf)))
        cells = np.maximum.accumulate(np.floor(np.append(latest, place) / POINT_M))
        new = np.flatnonzero(np.diff(cells) > 0)
        self.places = np.append(self.places, place[new])
        self.heights = np.append(self.heights, height[new])
        self.place, self.height = float(place[-1]), float(height[-1])
        self._keep_near()

    def add_road(self, place: FloatArray, reference: FloatArray, range_: FloatArray) -> None:
        """Take the next samples of the road, ``reference`` less ``range_``, as `add` does.

        Of a road that is known throughout only the end is looked at.
        """
        if np.isnan(reference.sum() + range_.sum()):
            self.add(place, reference - range_)
            return
        near = int(np.argmax(place >= place[-1] - GRADE_M))
        self._add_near(place, place[near:], reference[near:] - range_[near:])

    def cross(self, place: float, height: float) -> float:
        """Return by how much the sample behind a seam is below the road that goes on, in m.

        What was before moves up to that sample. A height that is missing goes on at the grade.
        """
        if not self.places.size:
            return 0.0
        self._keep_near()
        travel, level = place - self.place, self.height
        if self.places.size > 1:
            level += travel * float(np.polyfit(self.places - self.place, self.heights, 1)[0])
        behind = level if np.isnan(height) else height
        self.places, self.heights = self.places + travel, self.heights + behind - self.height
        return level - behind

    def _keep_near(self) -> None:
        near = self.places >= self.place - GRADE_M
        self.places, self.heights = self.places[near], self.heights[near]


class Seams(Stage):
    """Shifts `floating_reference_height` behind travel that the encoder lost or made up.

    Both sides of lost travel lie at one place, and the road in between would cause a step there. On
    both sides of a leap is one place of the road, but a grade goes on for the travel that a
    high-pass over distance sees. Where the encoder was missing and its distance includes the travel
    afterwards, nothing is shifted.
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
        shift, grade = dict.fromkeys(header.tracks, 0.0), {t: Grade() for t in header.tracks}
        self.memory = {"shift": shift, "grade": grade, "places": np.empty(0), "at": EMPTY}
        return header

    def advance(self, block: Block) -> Block:
        """Shift what lies behind a seam."""
        if len(block) == 0:
            return block
        distance, values = block[ChannelId(DISTANCE)], {}
        if self._goes_on(block.first, distance):
            return self._carry_on(block, distance)
        known = np.flatnonzero(~np.isnan(distance))
        seams = self._seams(distance[known], known + block.first)
        for track in self._tracks:
            name, range_ = ChannelId(REFERENCE_HEIGHT, track), ChannelId(HEIGHT, track)
            road = distance, block[name] - block[range_]
            shifts = self._shifts(track, *road, known, seams)
            if shifts is not None:
                values[name] = block[name] + shifts
        return block.setting(values) if values else block

    def _goes_on(self, first: int, distance: FloatArray) -> bool:
        """Return whether every sample is known, up to the first of the block from the one before.

        Then there is no seam, and the places before the next one are those of the last samples.
        """
        at: IndexArray = self.memory["at"]
        if np.isnan(distance.sum()) or (at.size and at[-1] != first - 1):
            return False
        last = distance[-self._pace - 1 :]
        behind = np.arange(first + distance.size - last.size, first + distance.size)
        self.memory["places"] = np.append(self.memory["places"], last)[-self._pace - 1 :].copy()
        self.memory["at"] = np.append(at, behind)[-self._pace - 1 :].copy()
        return True

    def _carry_on(self, block: Block, distance: FloatArray) -> Block:
        """Return the block without a seam: its heights are shifted as those before it."""
        values = {}
        for track in self._tracks:
            name, range_ = ChannelId(REFERENCE_HEIGHT, track), ChannelId(HEIGHT, track)
            shift: float = self.memory["shift"][track]
            self.memory["grade"][track].add_road(distance, block[name], block[range_])
            if shift:
                values[name] = block[name] + shift
        return block.setting(values) if values else block

    def _seams(self, places: FloatArray, at: IndexArray) -> list[int]:
        """Return which known samples, ``at`` these, are behind travel that was lost or made up."""
        count = self.memory["at"].size
        whole = np.concatenate((self.memory["places"], places))
        where = np.concatenate((self.memory["at"], at))
        found = []
        for k in np.flatnonzero(np.diff(where) > 1).tolist():
            back = min(int(np.searchsorted(where, where[k] - self._pace)), k - 1)
            if k + 1 >= count and back >= 0:
                pace = (whole[k] - whole[back]) / (where[k] - where[back])
                if self._is_seam(where[k + 1] - where[k], whole[k + 1] - whole[k], pace):
                    found.append(k + 1 - count)
        self.memory["places"] = whole[-self._pace - 1 :].copy()
        self.memory["at"] = where[-self._pace - 1 :].copy()
        return found

    def _is_seam(self, samples: int, travel: float, pace: float) -> bool:
        """Return whether ``travel`` in m is lost or made up, at a ``pace`` in m per sample."""
        leapt = samples <= self._pace and travel > LEAPT * pace * samples
        return bool(leapt or travel < LOST * pace * samples)

    def _shifts(
        self,
        track: str,
        place: FloatArray,
        height: FloatArray,
        known: IndexArray,
        seams: list[int],
    ) -> FloatArray | None:
        """Return by how much each sample is shifted, None if nothing is."""
        shift: float = self.memory["shift"][track]
        grade: Grade = self.memory["grade"][track]
        shifts = np.full(height.size, shift) if shift or seams else None
        if not seams and known.size == height.size:
            grade.add(place, height)
            return shifts
        first = known[: seams[0] if seams else known.size]
        grade.add(place[first], height[first])
        for begin, end in pairwise([*seams, known.size]):
            part = known[begin:end]
            step = grade.cross(float(place[part[0]]), float(height[part[0]]))
            grade.add(place[part], height[part])
            shift += step
            if shifts is not None:
                shifts[part[0] :] += step
        self.memory["shift"][track] = shift
        return shifts
