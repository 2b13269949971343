"""The height carried to the accelerometer by a pitch that the road under the axles explains."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.estimators.laser_place.bins import Bins, BinsAhead, nothing
from floatref.estimators.laser_place.pitching import Places, model_pitch
from floatref.estimators.laser_place.travelled import Travelled
from floatref.estimators.levelling.lines import Means
from floatref.stages.conditioning import SPECIFIC_FORCE
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import DISTANCE, HEIGHT
from floatref.values.arrays import Flag, FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId

BINS_HZ = 100.0
"""Readings per second of the model, for pitch up to 20 Hz."""
RAISED = "raised"
"""Name of sin θ, by which a sensor 1 m ahead is higher."""


class HeightByModel(Stage):
    """Replaces `height` by what the laser would read in the accelerometer's place.

    A laser x ahead of its accelerometer is higher by x sin θ at the pitch θ, nose up. θ is that of
    `model_pitch`, for which the engine shows this stage the whole run first. The body has one
    pitch, so sensors of all wheel paths have a part in it, and roll has no part. A height has the
    flags of its own accelerometer, too; a sample that is missing is bridged in the pitch.

    ``force`` is the name of what the accelerometers give.
    """

    surveys = True
    declared = Declared(linear=False, zero_in_zero_out=False)
    force: ClassVar[str] = SPECIFIC_FORCE

    def __init__(self, levers_m: Mapping[str, float]) -> None:
        """Carry by ``levers_m`` of each wheel path: its laser ahead of its accelerometer."""
        super().__init__()
        self.levers_m = dict(levers_m)
        self._header: Header | None = None
        self._every = 1

    def open(self, header: Header) -> Header:
        """Ask for force and height of every track and the encoder, in time."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        own = [channel for track in header.tracks for channel in self.own(track)]
        header.require(self.name, *own, ChannelId(DISTANCE))
        self._header = header
        self._every = max(1, round(1.0 / (BINS_HZ * header.step)))
        bins, miscounted = (Bins(Means(self._every, rows)) for rows in (len(own) + 1, 1))
        self.memory = {"bins": bins, "miscounted": miscounted, "begin": None, "ahead": None}
        return header

    def survey(self, block: Block) -> None:
        """Add the block to the means of the bins."""
        self.memory["bins"].add(*self.rows(block))
        flags, miscounted = block.flags.get(ChannelId(DISTANCE)), nothing(len(block))
        if flags is not None:
            miscounted = ((flags & np.uint8(Flag.SLOW)) != 0).astype(np.float64)
        # A leap is two samples, which the mean over a bin would hide.
        self.memory["miscounted"].add(miscounted)
        if self.memory["begin"] is None and len(block):
            self.memory["begin"] = block.first

    def rows(self, block: Block) -> list[FloatArray]:
        """Return force and height of every track, and the distance, NaN where not to be trusted."""
        assert self._header is not None
        names = [channel for track in self._header.tracks for channel in self.own(track)]
        return [trusted(block, name) for name in (*names, ChannelId(DISTANCE))]

    def advance(self, block: Block) -> Block:
        """Carry the heights of the block."""
        if len(block) == 0:
            return block
        if self.memory["ahead"] is None:
            found = self.find_pitch(self.whole_bins())
            self.memory["ahead"] = BinsAhead(found, self.memory["begin"], self._every)
        values, flags = {}, {}
        raised = self.between_bins(block, RAISED)
        for track, lever_m in self.levers_m.items():
            height = ChannelId(HEIGHT, track)
            if lever_m:
                values[height] = block[height] - lever_m * raised
            marks = flags_of(block, *self.own(track))
            if marks is not None:
                flags[height] = marks
        return block.setting(values, flags)

    def whole_bins(self) -> FloatArray:
        """Return all bins, rows as in `rows`."""
        bins: Bins = self.memory["bins"]
        return bins.take()

    def between_bins(self, block: Block, name: str) -> FloatArray:
        """Return the lines through what was found under ``name`` at the samples of ``block``."""
        ahead: BinsAhead = self.memory["ahead"]
        return ahead.at(name, block.first, len(block))

    def find_pitch(self, bins: FloatArray) -> dict[str, FloatArray]:
        """Return what is found of every bin of all that was surveyed, rows as in `rows`.

        That is sin θ under the name `RAISED`.
        """
        force, height = middle(bins[:-1:2]) - STANDARD_GRAVITY, middle(bins[1:-1:2])
        travelled = self.take_travelled(bins)
        pitch = model_pitch(force, height, travelled.distance, self.places())
        return {RAISED: np.sin(pitch)}

    def take_travelled(self, bins: FloatArray) -> Travelled:
        """Return the travel in all ``bins``, rows as in `rows`."""
        miscounted: Bins = self.memory["miscounted"]
        return Travelled.of(bins[-1], miscounted.take()[0] > 0.0, self.places().step)

    def own(self, track: str) -> tuple[ChannelId, ChannelId]:
        """Return the channels of accelerometer and laser of the ``track``."""
        return ChannelId(self.force, track), ChannelId(HEIGHT, track)

    def places(self) -> Places:
        """Return where the middle of the sensors is, and the axles."""
        assert self._header is not None
        setup, tracks = self._header.setup, self._header.tracks
        at_m = float(np.mean([setup.track(t).reference_point_m[0] for t in tracks]))
        laser_m = at_m + float(np.mean([self.levers_m[t] for t in tracks]))
        step = self._every * self._header.step
        return Places(at_m, laser_m, setup.axles_about(tracks[0]), step)


def middle(rows: FloatArray) -> FloatArray:
    """Return the mean of the wheel paths, shape (n,); a path that is unknown is a line there."""
    total, count = np.zeros(rows.shape[1]), 0
    for row in rows:
        known = np.flatnonzero(~np.isnan(row))
        if known.size:
            whole = known.size == row.size
            total += row if whole else np.interp(np.arange(row.size), known, row[known])
            count += 1
    if not count:
        return np.full(total.size, np.nan)
    total /= count
    return total


def trusted(block: Block, channel: ChannelId) -> FloatArray:
    """Return the samples of ``channel``, NaN where they are flagged."""
    flags = block.flags.get(channel)
    return block[channel] if flags is None else np.where(flags == 0, block[channel], np.nan)
