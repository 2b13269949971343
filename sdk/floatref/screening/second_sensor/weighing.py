"""All doubts about a recording: every sensor against those that measure the same motion.

The encoder is compared first, then the accelerometers of the body, the suspension, and the lasers
last, whose comparison needs all of these.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from floatref.screening.damage.spikes import find_spikes
from floatref.screening.second_sensor.body_faults import body_doubts
from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.encoder.encoder_steps import step_doubts
from floatref.screening.second_sensor.encoder.travel_by_force import force_doubts
from floatref.screening.second_sensor.encoder.travel_by_gnss import encoder_doubts
from floatref.screening.second_sensor.fast_series import (
    STEP_S,
    FastGrid,
    band,
    dilate,
    series_of,
    shared_grid,
)
from floatref.screening.second_sensor.fitting import Fit, points_of
from floatref.screening.second_sensor.height_at_stops import stop_doubts
from floatref.screening.second_sensor.laser_faults import laser_doubts
from floatref.screening.second_sensor.noisier_side import noise_doubts
from floatref.screening.second_sensor.rigid_body import BAND_HZ, Body
from floatref.screening.second_sensor.road_twice import (
    BAND_HZ as ROAD_HZ,
)
from floatref.screening.second_sensor.road_twice import (
    TwoRoads,
    is_moving,
    lift_of,
    wheel_road,
)
from floatref.screening.second_sensor.same_samples import same_doubts
from floatref.screening.second_sensor.slow_bias import bias_doubts
from floatref.screening.second_sensor.suspension_travel import (
    BODY,
    LOUD,
    SHARE,
    TRAVEL,
    WHEEL,
    fit_travel,
    is_consistent,
    travel_doubts,
)
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.channels import ChannelId
from floatref.values.recording import Channel, Recording, TrackSetup

FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"
TURNING = ("pitch_rate", "roll_rate")
SHORTEST_S, PIECE_S = 10.0, 600.0
"""Shortest run that is compared, and length of the pieces of a long one, in s."""
SETTLED_S = 1.0
"""Time in s at either end of a piece, and beside missing samples, that does not count."""
WHEEL_MODEL = "quarter-car"
"""The model whose point is the wheel's place."""
ALONE = (same_doubts, encoder_doubts, force_doubts, step_doubts, noise_doubts)
"""Comparisons that need no grid."""
MAJORITY = 0.5
"""Share of the pieces of a long run in which a fault is one of the whole run."""


def weigh_recording(recording: Recording) -> tuple[Doubt, ...]:
    """Return all doubts about ``recording``, those about the encoder first."""
    found = [doubt for compare in ALONE for doubt in compare(recording)]
    grid = shared_grid([c for c in recording.channels if _is_compared(c)])
    if grid.count * STEP_S < SHORTEST_S:
        return (*found, *stop_doubts(recording, recording.tracks))
    distrusted = {name for doubt in found if doubt.whole_run for name in doubt.suspects}
    pieces = grid.pieces(PIECE_S)
    partial = [doubt for doubt in found if not doubt.whole_run]
    spikes = _Spikes()
    compared = [_Piece(recording, piece, distrusted, partial, spikes) for piece in pieces]
    by_piece = [tuple(piece.doubts()) for piece in compared]
    # While it moves, a laser is compared all the time; a stop says what the others leave open.
    open_ = [t for t in recording.tracks if not any(t in piece.roads for piece in compared)]
    return (*found, *stop_doubts(recording, open_), *_join(by_piece, pieces))


def _is_compared(channel: Channel) -> bool:
    return channel.id.name in (FORCE, HEIGHT, DISTANCE, BODY, WHEEL, TRAVEL, *TURNING)


class _Spikes:
    """Numbers of the spikes by channel: each is looked through once, and not in every piece."""

    def __init__(self) -> None:
        self._found: dict[ChannelId, IndexArray] = {}

    def of(self, channel: Channel) -> IndexArray:
        """Return the numbers of the spikes of ``channel``, shape (n,)."""
        if channel.id not in self._found:
            self._found[channel.id] = find_spikes(channel).gone[:, 0]
        return self._found[channel.id]


class _Piece:
    """A piece of a run on one grid; series are made when they are first read."""

    def __init__(
        self,
        recording: Recording,
        grid: FastGrid,
        distrusted: set[ChannelId],
        partial: list[Doubt],
        spikes: _Spikes,
    ) -> None:
        self._spikes = spikes
        self._recording, self._grid, self._distrusted = recording, grid, set(distrusted)
        self._series: dict[ChannelId, FloatArray] = {}
        self.roads: dict[str, TwoRoads] = {}
        for doubt in partial:
            self._leave_out(doubt)

    def doubts(self) -> Iterator[Doubt]:
        """Yield the doubts; what is in doubt does not count as a second sensor."""
        for doubts in (self._of_body, self._of_bias, self._of_suspension, self._of_lasers):
            for doubt in doubts():
                if doubt.whole_run:
                    self._distrusted.update(doubt.suspects)
                else:
                    self._leave_out(doubt)
                yield doubt

    def _leave_out(self, doubt: Doubt) -> None:
        """Count the stretches of ``doubt`` as unknown in the series of its suspects."""
        times = self._grid.times
        for channel in (c for c in self._recording.channels if c.id in doubt.suspects):
            series = np.array(self._read(channel))
            for begin, end in doubt.spans:
                series[(times >= begin) & (times <= end)] = np.nan
            self._series[channel.id] = series

    def _of_body(self) -> Iterator[Doubt]:
        rows = [c for c in self._recording.channels if c.id.name in (FORCE, BODY)]
        rows = [c for c in rows if c.id not in self._distrusted]
        if len(rows) < 2:
            return
        gyros = [c for n in TURNING if (c := self._recording.find(n)) is not None]
        if len(rows) == 2 and len(gyros) < len(TURNING):
            return
        series = [self._read(c) for c in (*rows, *gyros)]
        turning = [band(np.gradient(each, STEP_S), *BAND_HZ) for each in series[len(rows) :]]
        forces = {c.id: band(s, *BAND_HZ) for c, s in zip(rows, series, strict=False)}
        known = _known(series)
        body = Body(forces, np.array(turning).reshape(len(gyros), known.size), known)
        yield from body_doubts(body, self._grid)

    def _of_bias(self) -> Iterator[Doubt]:
        rows = [c for c in self._recording.channels if c.id.name in (FORCE, BODY, WHEEL)]
        sound = {c.id: self._read(c) for c in rows if c.id not in self._distrusted}
        yield from bias_doubts(sound, self._grid)

    def _of_suspension(self) -> Iterator[Doubt]:
        for track in self._recording.tracks:
            yield from travel_doubts(track, self._fit_travel(track))

    def _fit_travel(self, track: str) -> Fit | None:
        found = [self._trusted(name, track) for name in (TRAVEL, BODY, WHEEL)]
        if any(channel is None for channel in found):
            return None
        travel, body, wheel = (self._read(c) for c in found if c is not None)
        return fit_travel(travel, body, wheel, _known([travel, body, wheel]))

    def _of_lasers(self) -> Iterator[Doubt]:
        found = {track: self._roads(track) for track in self._recording.tracks}
        self.roads = {track: each for track, each in found.items() if each is not None}
        yield from laser_doubts(self.roads, self._grid)

    def _roads(self, track: str) -> TwoRoads | None:
        """Return the road twice; None without a sensor that is not in doubt, or on a flat road."""
        vehicle = self._recording.setup.vehicle
        names = (FORCE, HEIGHT, WHEEL, DISTANCE)
        found = [c for n in names if (c := self._trusted(n, track)) is not None]
        if len(found) < len(names) or vehicle is None or vehicle.model != WHEEL_MODEL:
            return None
        travel = self._fit_travel(track)
        if self._trusted(TRAVEL, track) and not is_consistent(travel):
            return None
        force, height, wheel, distance = (self._read(c) for c in found)
        setup = self._recording.setup.tracks.get(track, TrackSetup())
        ahead_m = setup.laser_offset_m[0]
        gyro = self._recording.find("pitch_rate")
        pitch = None if gyro is None else self._read(gyro)
        known = _known([force, height, wheel, distance]) & is_moving(_bridged(distance))
        if travel is not None:
            known &= ~dilate(points_of(travel.loud(LOUD, SHARE), known.size), SETTLED_S)
        to_wheel_m = vehicle.x_m - setup.reference_point_m[0] - ahead_m
        roads = TwoRoads(
            lift_of(force, pitch, ahead_m),
            band(height, *ROAD_HZ),
            wheel_road(wheel, _bridged(distance), to_wheel_m, self._grid),
            known,
        )
        return roads if roads.moves_the_body else None

    def _trusted(self, name: str, track: str) -> Channel | None:
        channel = self._recording.find(name, track)
        return None if channel is None or channel.id in self._distrusted else channel

    def _read(self, channel: Channel) -> FloatArray:
        if channel.id not in self._series:
            spikes = self._spikes.of(channel)
            self._series[channel.id] = series_of(channel, self._grid, spikes)
        return self._series[channel.id]


def _known(series: list[FloatArray]) -> BoolArray:
    """Return the points at which all of ``series`` are known and the filters have settled."""
    known: BoolArray = np.all([np.isfinite(each) for each in series], axis=0)
    if not known.all():
        known = ~dilate(~known, SETTLED_S)
    edge = round(SETTLED_S / STEP_S)
    known[:edge] = known[max(known.size - edge, 0) :] = False
    return known


def _bridged(series: FloatArray) -> FloatArray:
    known = np.flatnonzero(np.isfinite(series))
    if known.size in (0, series.size):
        return np.nan_to_num(series)
    return np.interp(np.arange(series.size), known, series[known])


def _join(by_piece: list[tuple[Doubt, ...]], pieces: list[FastGrid]) -> Iterator[Doubt]:
    """Yield the doubts of all pieces; of one that few pieces have, the stretch is the piece."""
    if len(by_piece) == 1:
        yield from by_piece[0]
        return
    every = [doubt for doubts in by_piece for doubt in doubts if doubt.whole_run]
    seen: set[tuple[ChannelId, ...]] = set()
    for doubts, piece in zip(by_piece, pieces, strict=True):
        for doubt in doubts:
            alike = sum(other.suspects == doubt.suspects for other in every)
            if not doubt.whole_run:
                yield doubt
            elif alike <= MAJORITY * len(pieces):
                end = piece.begin_s + STEP_S * piece.count
                yield replace(doubt, fatal=False, spans=((piece.begin_s, end),))
            elif doubt.suspects not in seen:
                seen.add(doubt.suspects)
                yield doubt
