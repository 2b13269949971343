"""How a run lies against the reference, and the run put right accordingly."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.units import METRE


@dataclass(frozen=True)
class Placement:
    """How a run lies against the reference, and what has to be done to it.

    Attributes:
        found: whether the reference's road was found in the run at all.
        correlation: of slope in the waveband of 1.6 to 8 m, at the best place that was found.
        said: all of it in sentences; empty for a run that lies right.
        tracks: wheel path of the reference → that of the run; without those that it lacks.
        reversed: whether the run's axis points against the reference's.
        inverted: whether its heights are upside down; they stay so, for that is a fault.
        distance_unit, distance_factor: of its axis, and m per unit.
        height_unit, height_factor: of its elevation, and m per unit.
        height_gain: by how much higher it takes the road after that, at a first glance.
        offset_m: by how much it lay farther along, after mirroring, in m.
        moves: whether anything has to be done to the run.
        alternatives: places at which it would fit as well.
    """

    found: bool
    correlation: float
    said: tuple[str, ...] = ()
    tracks: Mapping[str, str] = field(default_factory=dict)
    reversed: bool = False
    inverted: bool = False
    distance_unit: str = METRE
    distance_factor: float = 1.0
    height_unit: str = METRE
    height_factor: float = 1.0
    height_gain: float = 1.0
    offset_m: float = 0.0
    alternatives: int = 0

    @property
    def moves(self) -> bool:
        """Whether the run has to be changed before it can be compared."""
        same_names = all(mine == its for mine, its in self.tracks.items())
        scales = self.distance_factor, self.height_factor
        turned = self.reversed or not same_names
        return self.found and (turned or scales != (1.0, 1.0) or self.offset_m != 0.0)


def placed(run: Profile, placement: Placement) -> Profile:
    """Return ``run`` as ``placement`` says: the same object if it lies right or was not found.

    Wheel paths that are not the reference's are dropped where another takes their name.
    """
    if not placement.moves:
        return run
    factor = placement.distance_factor
    mine = {its: name for name, its in placement.tracks.items()}
    others = [t for t in run.tracks if t.name not in mine and t.name not in placement.tracks]
    renamed = [_track(run.track(its), name, placement) for its, name in mine.items()]
    kept = [_track(t, t.name, placement) for t in others]
    return replace(
        run,
        tracks=(*renamed, *kept),
        interval_m=run.interval_m * factor,
        start_m=run.start_m * factor - placement.offset_m,
    )


def _track(track: ProfileTrack, name: str, placement: Placement) -> ProfileTrack:
    """Return ``track`` in m and forward, under ``name``."""
    order = slice(None, None, -1 if placement.reversed else 1)
    factor = placement.height_factor
    sigma = None if track.sigma is None else _scaled(track.sigma[order], factor)
    elevation = _scaled(track.elevation[order], factor)
    return ProfileTrack.of(name, elevation, track.valid[order], sigma)


def _scaled(values: FloatArray, factor: float) -> FloatArray:
    """Return ``values`` times ``factor``, the same numbers where it is one."""
    return np.array(values) if factor == 1.0 else values * factor
