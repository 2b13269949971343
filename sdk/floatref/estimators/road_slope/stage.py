"""The stage that gives the smoother what a level accelerometer would read through a stop."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from floatref.estimators.laser_place import pitching
from floatref.estimators.laser_place.bins import in_parts, nothing
from floatref.estimators.laser_place.by_model import RAISED, HeightByModel, middle
from floatref.estimators.laser_place.pitching import model_pitch, second_derivative
from floatref.estimators.road_prior.constants import LEVELLED_LEAN, RoadPrior
from floatref.estimators.road_prior.learned import Brake, pool
from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.readings import Drive
from floatref.estimators.road_slope.stretches import near_brakes
from floatref.stages.conditioning import SPECIFIC_FORCE
from floatref.stages.marks import flags_of
from floatref.stages.signals import HEIGHT, LEVELLED, LEVELLING_SIGMA
from floatref.values.arrays import BoolArray, Flag, FlagArray, FloatArray
from floatref.values.block import Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId

if TYPE_CHECKING:
    from floatref.estimators.road_slope.levelled import Levelled

SHARE, SIGMA = ChannelId(LEVELLED), ChannelId(LEVELLING_SIGMA)
ADDED = "added"
"""Name of what the forces have to be raised by, in m/s²."""


class LevelByRoad(HeightByModel):
    """Levels `vertical_specific_force`, and carries `height` to the accelerometer, through stops.

    The pitch of the body is that of `Levelled`, from the road that the sensors measure themselves;
    between the stretches heights are carried as by `HeightByModel`, if a laser is on a lever. Adds
    `levelled`, the share to which a sample is levelled, and `levelling_sigma`, the 1-σ in m that
    this leaves in the high-passed elevation.
    """

    def __init__(
        self,
        levers_m: Mapping[str, float],
        constants: RoadPrior | None = None,
        wavelength_m: float = 105.91,
    ) -> None:
        """Carry by ``levers_m`` of each wheel path; ``constants`` are those of the smoother."""
        super().__init__(levers_m)
        self.constants = RoadPrior() if constants is None else constants
        self.wavelength_m = wavelength_m

    def open(self, header: Header) -> Header:
        """Ask for force and height of every track and the encoder, in time."""
        out = super().open(header).adding(SHARE, SIGMA)
        self.memory["gains"] = []
        return out

    def advance(self, block: Block) -> Block:
        """Level the forces of the block and carry its heights."""
        block = super().advance(block)
        if len(block) == 0:
            return block.setting({SHARE: np.empty(0), SIGMA: np.empty(0)}, {})
        values = {c: self.between_bins(block, c.name) for c in (SHARE, SIGMA)}
        more, flags = self.between_bins(block, ADDED), {}
        for track in self.levers_m:
            force, height = ChannelId(SPECIFIC_FORCE, track), ChannelId(HEIGHT, track)
            if more is not nothing(len(block)):
                values[force] = block[force] + more
            flags[force] = _with_bridged(block, force, height)
        return block.setting(values, {c: marks for c, marks in flags.items() if marks is not None})

    def list_learned(self) -> Mapping[str, float]:
        """Return the estimate of lean and tilt from all stretches, see `learned.pool`."""
        return pool([Brake(*each) for each in self.memory["gains"]], self.constants)

    def find_pitch(self, bins: FloatArray) -> dict[str, FloatArray]:
        """Return sin θ of every bin, what its forces have to be raised by, and how sure that is."""
        # It loads the sparse matrices of scipy, which no other pipeline needs.
        from floatref.estimators.road_slope.levelled import Levelled

        drive, places = self._drive(bins), self.places()
        del bins
        found = Levelled.of(drive, from_laser(places), self._model(), self.wavelength_m)
        pitch = np.zeros(drive.force.size)
        if any(self.levers_m.values()):
            pitch = model_pitch(drive.force, drive.height, drive.distance, places)
        along = drive.along
        del drive
        pitch = found.hold(found.pitch, pitch)
        lean = found.hold(found.lean, np.zeros(pitch.size))
        self.memory["gains"] = found.gains
        added = self._added(found, along, pitch, lean)
        known = {LEVELLED: found.share, LEVELLING_SIGMA: found.sigma_m}
        return {RAISED: np.sin(pitch, out=pitch), ADDED: added, **known}

    def _added(
        self, found: "Levelled", along: FloatArray, pitch: FloatArray, lean: FloatArray
    ) -> FloatArray:
        """Return what forces have to be raised by at these angles and this acceleration."""
        # The smoother finds the rest of the lean of each wheel path about this mean.
        expected = -LEVELLED_LEAN * self.constants.lean_expected_rad
        added = np.empty(pitch.size)
        for part in in_parts(0, pitch.size):
            p, q = pitch[part], lean[part]
            by_road = found.share[part] * along[part] * (p + q - found.grade[part] - expected)
            climb = 0.5 * STANDARD_GRAVITY * (np.square(p + q) - np.square(q))
            added[part] = by_road + climb
        return added

    def _drive(self, bins: FloatArray) -> Drive:
        """Return the mean of the wheel paths, without a value where one of them is unknown."""
        force, height = middle(bins[:-1:2]) - STANDARD_GRAVITY, middle(bins[1:-1:2])
        lost, unseen = (_any_unknown(rows) for rows in (bins[:-1:2], bins[1:-1:2]))
        distance, unplaced, guessed, rolled = self.take_travelled(bins)
        step, long = self.places().step, distance.size >= pitching.LEAST_SAMPLES
        speed = np.gradient(distance, step) if distance.size > 1 else np.zeros(distance.size)
        along = second_derivative(distance, step) if long else np.zeros(distance.size)
        height = np.where(unseen | rolled, np.nan, height)
        places = distance, speed, along, unplaced
        drive = Drive(np.nan_to_num(force), lost, height, *places, step)
        # At a steady speed a guess is as good as the encoder.
        return drive._replace(lost=unplaced | (guessed & near_brakes(drive)))

    def _model(self) -> SlopeModel:
        """Return the constants of the fit from those of the smoother."""
        c, usual = self.constants, SlopeModel()
        weights = np.array([usual.gain_sigma, c.tilt_sigma]) ** -2.0
        gain = float(weights @ [usual.gain, -c.tilt_expected] / weights.sum())
        return SlopeModel(
            road=c.road,
            bends=c.long_waves,
            acceleration=c.acceleration,
            missing_acceleration=c.missing_acceleration,
            bias=c.acceleration_bias,
            walk=c.acceleration_walk,
            gain=gain,
            gain_sigma=float(weights.sum() ** -0.5),
            lean_rad=-c.lean_expected_rad,
            lean_sigma_rad=c.lean_sigma_rad / len(self.levers_m) ** 0.5,
            hz=c.pitch_hz,
            damping=c.pitch_damping,
        )


def _with_bridged(block: Block, force: ChannelId, height: ChannelId) -> FlagArray | None:
    """Return the flags of ``force`` and, as one that is bridged, of the ``height`` beside it."""
    marks, more = flags_of(block, force), flags_of(block, height)
    if more is None:
        return marks
    bridged: FlagArray = (more != 0) * np.uint8(Flag.MISSING)
    return bridged if marks is None else marks | bridged


def from_laser(places: pitching.Places) -> Places:
    """Return the places of a vehicle as seen from its laser."""
    front_m = places.axles.front_axle_m - places.laser_m
    lever_m = places.laser_m - places.accelerometer_m
    return Places(front_m, front_m - places.axles.wheelbase_m, lever_m)


def _any_unknown(rows: FloatArray) -> BoolArray:
    """Return where a wheel path is unknown that is known elsewhere, or all are."""
    lost = np.isnan(rows)
    dead = lost.all(axis=1)
    if dead.all():
        return np.ones(rows.shape[1], np.bool_)
    return np.asarray(lost[~dead].any(axis=0))
