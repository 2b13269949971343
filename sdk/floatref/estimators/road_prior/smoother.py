"""The road-prior smoother in place of both integrations: at standstill the road does not move."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from floatref.errors import InputError
from floatref.estimators.kalman.inputs import Quiet
from floatref.estimators.models.road_prior_values import ENDS, Inputs
from floatref.estimators.road_prior.constants import LEVELLED_LEAN, RoadPrior
from floatref.estimators.road_prior.excitation import Excitation
from floatref.estimators.road_prior.leaps import lines, mark_leaps
from floatref.estimators.road_prior.learned import pool
from floatref.estimators.road_prior.misfits import Misfits
from floatref.estimators.road_prior.samples import missing_samples, trusted_samples
from floatref.estimators.road_prior.track import RoadTrack, sub_block
from floatref.estimators.road_prior.travel_to_nodes import Travel
from floatref.estimators.road_prior.uncertain import flag_uncertain
from floatref.estimators.smoothing.backlog import ALL, TOLERANCE_M, WAITING_S, Backlog
from floatref.estimators.smoothing.line import Closing
from floatref.estimators.smoothing.nodes import Filtered
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.stages.signals import (
    ACCELERATION,
    DISTANCE,
    HEIGHT,
    LEVELLED,
    LEVELLING_SIGMA,
    MISSING_SHARE,
    REFERENCE_HEIGHT,
    SIGMA,
)
from floatref.values.arrays import (
    BoolArray,
    FloatArray,
    IndexArray,
    Records,
    frozen,
    new_records,
)
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.innovations import Innovations

Waiting = tuple[Block, FloatArray]
"""A block whose accelerations along the road are not known yet, and the places of its nodes."""
UNKNOWN = ChannelId(MISSING_SHARE)
LEVEL = ChannelId(LEVELLED)
LONGEST_S = 180.0
"""What is known of a bias grows for kilometres; little of it remains after this time."""


class RoadPriorSmoother(Stage):
    """Smoother whose road is a process in distance, for nominal sensors.

    Adds `floating_reference_height` and `elevation_sigma` of every track; the vertical
    acceleration is dropped. Where there is a channel `missing_share`, so much of the acceleration
    counts as missing. Blocks wait for the encoder some 0.1 s behind them, and then for the
    readings that still matter to them.
    """

    declared: ClassVar[Declared] = Declared(
        linear=False, zero_in_zero_out=False, shift_invariant=False, delay=ALL
    )
    has_innovations: ClassVar[bool] = True

    def __init__(
        self,
        constants: RoadPrior | None = None,
        wavelength_m: float = 105.91,
        tolerance_m: float = TOLERANCE_M,
        waiting_s: float = WAITING_S,
        longest_s: float = LONGEST_S,
    ) -> None:
        """Filter with ``constants``; the result is cut off at ``wavelength_m`` over distance.

        Blocks wait for ``waiting_s`` and until nothing to come changes them by ``tolerance_m``, or
        for ``longest_s``, see `Backlog`.
        """
        super().__init__()
        self.constants = RoadPrior() if constants is None else constants
        self.wavelength_m, self.tolerance_m = wavelength_m, tolerance_m
        self.waiting_s, self.longest_s = waiting_s, longest_s
        self._header: Header | None = None
        self._made: frozenset[ChannelId] = frozenset()

    def open(self, header: Header) -> Header:
        """Ask for accelerometer and height sensor of every track, in time, and the encoder."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        own = [ChannelId(n, track) for n in (ACCELERATION, HEIGHT) for track in header.tracks]
        header.require(self.name, ChannelId(DISTANCE), *own)
        self._header, c, step = header, self.constants, header.step
        rule = Closing(step, self.tolerance_m, self.wavelength_m, c.height_m)
        excitation = Excitation.of(step * sub_block(step), c.pitch_hz, c.pitch_damping)
        self.memory = {
            "backlog": Backlog.of(header.tracks, rule, self.waiting_s, self.longest_s),
            "excitation": excitation,
            "known": np.empty((2, 0)),
            "waiting": [],
            "quiet": Quiet(sub_block(step) * round(1.0 / (step * sub_block(step)))),
            "filters": {},
            "travel": Travel(),
            "missing": dict.fromkeys(header.tracks, 0),
            "levelled": False,
        }
        out = header.without(LEVELLED, LEVELLING_SIGMA)
        out = out.replacing(ACCELERATION, REFERENCE_HEIGHT)
        out = out.adding(*(ChannelId(SIGMA, track) for track in header.tracks))
        self._made = out.channels
        return out

    def advance(self, block: Block) -> Block:
        """Filter the blocks whose longitudinal acceleration is known; return one that is ready."""
        backlog: Backlog = self.memory["backlog"]
        if len(block):
            places = self.memory["travel"].find_places(block, self._nodes(block))
            self.memory["waiting"].append((block, places))
            self.memory["excitation"].add(places)
            self._filter_known()
            done = next(backlog.come_out(), None)
            if done is not None:
                return self._flag_uncertain(done)
        waiting: list[Waiting] = self.memory["waiting"]
        first = backlog.blocks or [each for each, _ in waiting] or [block]
        return Block(first[0].first, dict.fromkeys(self._made, frozen(())))

    def close(self) -> tuple[Block, ...]:
        """Return all that remains."""
        backlog: Backlog = self.memory["backlog"]
        if not self.memory["waiting"] and not backlog.blocks:
            return ()
        self.memory["excitation"].end()
        self._filter_known()
        last = backlog.blocks[-1]
        at = last.first + len(last) - 1
        travel = self.memory["travel"].since(float(last[ChannelId(DISTANCE)][-1]))
        filters: dict[str, RoadTrack] = self.memory["filters"]
        ending = {name: (each.end(at, travel), None) for name, each in filters.items()}
        for name, each in filters.items():
            # A node now, with the bias and the tilt since the one before.
            backlog.lines[name].heights[-1][1][-1] = each.height_m
        backlog.finish(ending)
        return tuple(map(self._flag_uncertain, backlog.come_out()))

    def list_learned(self) -> Mapping[str, float]:
        """Return the estimate of lean and tilt from all wheel paths, see `pool`.

        Where stretches are levelled, what has levelled them knows both.
        """
        if self.memory["levelled"]:
            return {}
        filters: dict[str, RoadTrack] = self.memory["filters"]
        return pool([b for each in filters.values() for b in each.all_brakes()], self.constants)

    def warnings(self) -> tuple[str, ...]:
        """Warn where the height sensor has leapt at a standstill."""
        filters: dict[str, RoadTrack] = self.memory["filters"]
        assert self._header is not None
        found = {track: each.leaps for track, each in filters.items()}
        return tuple(lines(found, self._header.origin, self._header.step))

    def list_innovations(self) -> Mapping[str, Mapping[str, Innovations]]:
        """Return those of the height sensor, apart for standstills."""
        filters: dict[str, RoadTrack] = self.memory["filters"]
        found = {track: each.misfits for track, each in filters.items()}
        return {track: each.finish() for track, each in found.items() if each is not None}

    def _flag_uncertain(self, block: Block) -> Block:
        """Return ``block`` with the heights flagged whose 1-σ is too large for the road."""
        assert self._header is not None
        filters: dict[str, RoadTrack] = self.memory["filters"]
        bends = {name: each.bends_of(block.first, len(block)) for name, each in filters.items()}
        return flag_uncertain(block, bends, self.constants.most_sigma_share)

    def _nodes(self, block: Block) -> IndexArray:
        """Return the places in ``block`` that are nodes."""
        assert self._header is not None
        every = sub_block(self._header.step)
        return np.arange(-block.first % every, len(block), every)

    def _filter_known(self) -> None:
        more = np.stack(self.memory["excitation"].take())
        self.memory["known"] = known = np.concatenate((self.memory["known"], more), axis=1)
        waiting: list[Waiting] = self.memory["waiting"]
        while waiting and waiting[0][1].size <= known.shape[1]:
            block, places = waiting.pop(0)
            self._filter(block, places, known[:, : places.size])
            self.memory["known"] = known = known[:, places.size :]

    def _filter(self, block: Block, places: FloatArray, known: FloatArray) -> None:
        nodes, found = self._nodes(block), {}
        shared = self._collect_shared(block, nodes, places, known)
        assert self._header is not None
        for track in self._header.tracks:
            vertical, range_ = ChannelId(ACCELERATION, track), ChannelId(HEIGHT, track)
            ends, a = shared.copy(), block[vertical]
            ends["seen"] = trusted_samples(block, range_, nodes)
            share = self._missing(track, missing_samples(block, vertical), len(block), nodes)
            ends["missing"] = np.maximum(shared["missing"], share)
            values = frozen(np.nan_to_num(a) if np.isnan(a.sum()) else a)
            own = self._track(track, block[range_])
            passed = own.advance(Inputs(block.first, values, ends))
            flags = flags_of(block, vertical, range_)
            flags = mark_leaps(flags, own.leaps, block.first, len(block))
            found[track] = Filtered(*passed, flags)
        self.memory["backlog"].add(block.without(ACCELERATION, LEVELLED), found)

    def _track(self, track: str, height: FloatArray) -> RoadTrack:
        """Return the filter of ``track``, which begins at the first of ``height``."""
        filters: dict[str, RoadTrack] = self.memory["filters"]
        if track not in filters:
            assert self._header is not None
            start, step = float(np.nan_to_num(height[0])), self._header.step
            own = filters[track] = RoadTrack.of(self.constants, step, start)
            if self.keeps_innovations:
                own.misfits = Misfits(self._header.origin, step, own.model.edge)
        return filters[track]

    def _collect_shared(
        self, block: Block, nodes: IndexArray, places: FloatArray, known: FloatArray
    ) -> Records:
        """Return what all wheel paths know at the nodes, see `road_prior_values`."""
        distance = block[ChannelId(DISTANCE)]
        quiet = self.memory["quiet"].take(block.first, distance) - block.first
        ends = new_records(nodes.size, ENDS)
        if nodes.size == 0:
            return ends
        a, response = known
        level = block[LEVEL][nodes] if LEVEL in block.values else np.zeros(nodes.size)
        self.memory["levelled"] |= bool(level.any())
        ends["leaning"] = a * (1.0 - level * (1.0 - LEVELLED_LEAN))
        ends["tilting"] = a * response * (1.0 - level)
        ends["along"] = a * (1.0 - level)
        ends["travel"] = self.memory["travel"].take(places)
        if UNKNOWN in block.values:
            ends["missing"] = block[UNKNOWN][nodes]
        ends["anew"][np.searchsorted(nodes, quiet)] = 1.0
        return ends

    def _missing(
        self, track: str, lost: BoolArray | None, size: int, nodes: IndexArray
    ) -> FloatArray:
        """Return the share of samples that are lost up to each node."""
        assert self._header is not None
        if lost is None and not self.memory["missing"][track]:
            return np.zeros(nodes.size)
        total = np.cumsum(np.zeros(size, np.bool_) if lost is None else lost)
        at = total[nodes]
        counted = np.diff(at, prepend=-self.memory["missing"][track])
        left = int(total[-1]) - int(at[-1]) if nodes.size else int(total[-1])
        self.memory["missing"][track] = left + (0 if nodes.size else self.memory["missing"][track])
        share: FloatArray = counted / sub_block(self._header.step)
        return share
