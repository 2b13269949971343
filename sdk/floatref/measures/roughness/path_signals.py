"""A wheel path of two profiles through one filter, on the same points, and their agreement."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from floatref.measures.common_grid import CommonPath
from floatref.measures.gaps import bridge
from floatref.measures.roughness.agreement import Agreement, correlate_pieces
from floatref.measures.roughness.lagged_sums import SignalPiece
from floatref.measures.roughness.pieces_of_road import (
    CAR_RUN_IN_M,
    RUN_IN_WAVES,
    RoadPiece,
    cut_road,
)
from floatref.measures.roughness.wavebands import WAVEBANDS, band_signal, common_stretch
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile, ProfileTrack


def path_agreement(
    reference: Profile,
    profile: Profile,
    name: str,
    band: str = "iri",
    max_offset_m: float = 1.0,
    of_valid: bool = False,
    sign: float = 1.0,
) -> Agreement:
    """Return the `agreement` of the wheel path ``name`` of two profiles, on the reference's points.

    With ``of_valid`` all points that are not valid in both are bridged; ``sign`` is -1 for heights
    of ``profile`` that are upside down. A long road is filtered in pieces, which changes nothing
    beyond rounding. Raises InputError as `on_common_grid` and `agreement`.
    """
    signals = _PathSignals.of(CommonPath.of(reference, profile, name), band, of_valid, sign)
    size, interval_m = signals.usable.size - 1, signals.path.interval_m
    return correlate_pieces(signals.pieces, size, interval_m, max_offset_m)


@dataclass(frozen=True, eq=False)
class _PathSignals:
    """Both signals from common point ``first`` on, over as many points as ``usable`` has."""

    path: CommonPath
    band: str
    of_valid: bool
    sign: float
    first: int
    usable: BoolArray

    @classmethod
    def of(cls, path: CommonPath, band: str, of_valid: bool, sign: float) -> "_PathSignals":
        """Return the signals over the longest stretch whose ends are usable in both."""
        usable = path.usable(of_valid)
        stretch = common_stretch(usable)
        return cls(path, band, of_valid, sign, stretch.start, usable[stretch])

    def pieces(self, largest: int) -> Iterator[SignalPiece]:
        """Yield the signals piece by piece, the profile's wider by ``largest`` values."""
        interval_m = self.path.interval_m
        limits = WAVEBANDS.get(self.band)
        run_in_m = RUN_IN_WAVES * limits.long_m if limits else CAR_RUN_IN_M
        slopes = self._mean_slopes()
        for piece in cut_road(self.usable, run_in_m + largest * interval_m, interval_m):
            points = self.first + piece.first, self.first + piece.last
            p = self._filter(self.path.expected(*points), piece, slopes[0])[piece.inside()].copy()
            q = self._filter(self.path.found(*points), piece, slopes[1])[piece.inside(largest)]
            q_first = piece.first + piece.inside(largest).start
            yield SignalPiece(piece.begin, p, q_first, np.multiply(q, self.sign, out=q))

    def _mean_slopes(self) -> tuple[float, float]:
        """Return the mean slopes in m/m of reference and profile over the stretch."""
        ends = self.first, self.first + self.usable.size - 1
        length_m = (self.usable.size - 1) * self.path.interval_m
        p, q = (
            [float(at(end, end + 1).elevation[0]) for end in ends]
            for at in (self.path.expected, self.path.found)
        )
        return (p[1] - p[0]) / length_m, (q[1] - q[0]) / length_m

    def _filter(self, track: ProfileTrack, piece: RoadPiece, mean_slope: float) -> FloatArray:
        """Return the elevation of ``track`` at the points of ``piece`` through the filter."""
        missing = ~self.usable[piece.points] if self.of_valid else None
        bridged = bridge(track.elevation, missing)
        return band_signal(bridged, self.path.interval_m, self.band, mean_slope)
