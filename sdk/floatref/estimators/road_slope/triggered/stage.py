"""The stage that levels triggered samples, without those of the standstill."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from floatref.estimators.laser_place.bins import Bins
from floatref.estimators.laser_place.by_model import RAISED, HeightByModel, trusted
from floatref.estimators.laser_place.pitching import LEAST_SAMPLES, model_pitch
from floatref.estimators.levelling.lines import Means
from floatref.estimators.road_prior.excitation import Excitation
from floatref.estimators.road_slope.readings import Drive
from floatref.estimators.road_slope.stage import ADDED, LevelByRoad, from_laser
from floatref.stages.marks import flags_of
from floatref.stages.signals import ACCELERATION, EXPECTED_ROAD, LEVELLING_SIGMA, MISSING_SHARE
from floatref.values.arrays import Flag, FlagArray, FloatArray
from floatref.values.block import Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId

UNKNOWN, ROAD = ChannelId(MISSING_SHARE), ChannelId(EXPECTED_ROAD)
SIGMA = ChannelId(LEVELLING_SIGMA)


class LevelTriggered(LevelByRoad):
    """Takes out of `vertical_acceleration` what the road does to it through stops.

    Without samples of the standstill a fit does not know the accelerometer's bias, and a bias that
    is off goes with a gain of the pitch and long waves of the road that are off and make up for it.
    So a part of a fit must not go without the others. What the acceleration along the road makes
    of the pitch is left to the smoother, which weighs it against its own bias. What the road makes
    of it is taken out; so is the fitted road itself, which is `expected_road` for `AddRoad`: the
    smoother would rather have a bias that is off than a hump.

    Heights are carried to the accelerometer. Adds `levelling_sigma`, as `LevelByRoad` does.
    """

    force: ClassVar[str] = ACCELERATION

    def open(self, header: Header) -> Header:
        """Ask for acceleration and height of every track, the encoder and the missing share."""
        header.require(self.name, UNKNOWN)
        out = HeightByModel.open(self, header).adding(SIGMA, ROAD)
        self.memory["share"] = None
        self.memory["bins"] = Bins(Means(self._every, 3 * len(header.tracks) + 2))
        return out

    def rows(self, block: Block) -> list[FloatArray]:
        """Return force, height or 0, and whether there is one, of every track; share, distance.

        One reading in a bin is enough; a mean of NaN would need half of the bin.
        """
        assert self._header is not None
        found = []
        for force, height in map(self.own, self._header.tracks):
            read = trusted(block, height)
            known = ~np.isnan(read)
            seen = np.where(known, read, 0.0), known.astype(np.float64)
            found += [trusted(block, force) + STANDARD_GRAVITY, *seen]
        return [*found, block[UNKNOWN], super().rows(block)[-1]]

    def whole_bins(self) -> FloatArray:
        """Return all bins, rows as those of `HeightByModel.rows`; keep the missing share."""
        *rows, share, distance = super().whole_bins()
        self.memory["share"] = share
        found = []
        for force, height, known in zip(rows[::3], rows[1::3], rows[2::3], strict=True):
            nothing = np.full(known.size, np.nan)
            found += [force, np.divide(height, known, out=nothing, where=known > 0.0)]
        return np.stack([*found, distance])

    def find_pitch(self, bins: FloatArray) -> dict[str, FloatArray]:
        """Return sin θ of every bin, what its accelerations have to be raised by, and the road."""
        from floatref.estimators.road_slope.triggered.expected_road import (
            ExpectedRoad,
            LevelledRoad,
        )

        drive, places = self._drive(bins), self.places()
        found = LevelledRoad.over(drive, from_laser(places), self._model(), self.wavelength_m)
        pitch = np.zeros(drive.force.size)
        if any(self.levers_m.values()):
            pitch = model_pitch(drive.force, drive.height, drive.distance, places)
        pitch = found.hold(found.pitch, pitch)
        lean = found.hold(found.lean, np.zeros(pitch.size))
        along, response = self._follow(drive)
        by_road = found.share * along * (pitch - found.gain * response - found.grade)
        climb = 0.5 * STANDARD_GRAVITY * (np.square(pitch + lean) - np.square(lean))
        road = ExpectedRoad.of(found.slope, drive.distance, drive.step)
        self.memory["share"] = None
        known = {LEVELLING_SIGMA: found.sigma_m, EXPECTED_ROAD: road.elevation}
        return {RAISED: np.sin(pitch), ADDED: by_road + climb - road.acceleration, **known}

    def advance(self, block: Block) -> Block:
        """Level the accelerations of the block, take the road out, and carry its heights."""
        block = HeightByModel.advance(self, block)
        if len(block) == 0:
            return block.setting({SIGMA: np.empty(0), ROAD: np.empty(0)}, {})
        values = {c: self.between_bins(block, c.name) for c in (SIGMA, ROAD)}
        # Where a share of the acceleration is missing, it is less by that share.
        more = self.between_bins(block, ADDED) * (1.0 - block[UNKNOWN])
        flags = {}
        for force, height in map(self.own, self.levers_m):
            values[force] = block[force] + more
            marks = _with_doubts(block, force, height)
            if marks is not None:
                flags[force] = marks
        return block.setting(values, flags)

    def list_learned(self) -> Mapping[str, float]:
        """Return nothing: the smoother has the tilt and the lean."""
        return {}

    def _drive(self, bins: FloatArray) -> Drive:
        """Return the mean of the wheel paths, with what is missing by triggers that are far off."""
        drive = super()._drive(bins)
        return drive._replace(missing=np.maximum(drive.missing, self.memory["share"]))

    def _follow(self, drive: Drive) -> tuple[FloatArray, FloatArray]:
        """Return the acceleration along the road and the pitch's answer, the smoother's own."""
        if drive.distance.size < LEAST_SAMPLES:
            return drive.along, drive.along
        c = self.constants
        excitation = Excitation.of(drive.step, c.pitch_hz, c.pitch_damping)
        excitation.add(drive.distance)
        excitation.end()
        return excitation.take()


def _with_doubts(block: Block, force: ChannelId, height: ChannelId) -> FlagArray | None:
    """Return the flags of ``force``, and as one that is bridged those of the ``height`` beside it.

    A height that is only missing does not count: away from triggers every one is.
    """
    marks, more = flags_of(block, force), flags_of(block, height)
    if more is None:
        return marks
    doubts: FlagArray = ((more & ~np.uint8(Flag.MISSING)) != 0) * np.uint8(Flag.MISSING)
    return doubts if marks is None else marks | doubts
