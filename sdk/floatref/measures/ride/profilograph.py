"""A profilograph: a frame on wheels, and the height that its recording wheel measures against it.

Kinematic: every wheel is a point on a road without its shortest waves, the frame is the mean of
its wheels, and the recording wheel is in the middle. A frame of two wheels 25 ft (7.62 m) apart is
the reference line of a California profilograph. Its trucks have several wheels each; where their
places are known they can be given.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.kernels.cut_off import SIXTH_ORDER
from floatref.measures.ride.deviation_areas import (
    Window,
    bridged_stretch,
    clear_gaps,
    in_pieces,
    sound_points,
)
from floatref.values.arrays import BoolArray, FloatArray, release

HALF_WHEELBASE_M = 3.81
"""Half of the wheelbase of 25 ft, in m."""
WHEEL_FOOTPRINT_M = 0.6096
"""Wavelength in m (2 ft) at which the low-pass loses 3 dB."""


@dataclass(frozen=True)
class Profilograph:
    """Places of the frame's wheels in m from the recording wheel, and the low-pass before them.

    ``low_pass_m`` is the wavelength in m at which it loses 3 dB, 0 for no low-pass. Raises
    InputError unless there are wheels on both sides, and for numbers that are not finite.
    """

    wheels_m: tuple[float, ...] = (-HALF_WHEELBASE_M, HALF_WHEELBASE_M)
    low_pass_m: float = WHEEL_FOOTPRINT_M

    def __post_init__(self) -> None:
        """Refuse a frame that does not stand on both sides of the recording wheel."""
        if not np.isfinite(self.wheels_m).all():
            raise InputError("the place of a wheel is not finite; give places in m")
        if not (self.wheels_m and min(self.wheels_m) < 0.0 < max(self.wheels_m)):
            raise InputError(
                "the frame has no wheel on one side of the recording wheel; "
                "give places in m, below zero behind it and above zero ahead of it"
            )
        if not (np.isfinite(self.low_pass_m) and self.low_pass_m >= 0.0):
            raise InputError(f"low-pass is {self.low_pass_m} m; give zero or more")

    def offsets(self, interval_m: float) -> tuple[int, ...]:
        """Return the place of every wheel in intervals: round(place/interval), ties to even."""
        return tuple(round(place / interval_m) for place in self.wheels_m)

    def is_filtered(self, interval_m: float) -> bool:
        """Return whether the low-pass can act: its cut-off setting is above two intervals."""
        return self.low_pass_m * SIXTH_ORDER > 2.0 * interval_m

    def as_dict(self, interval_m: float) -> dict[str, Any]:
        """Return the settings that are printed with a result; lengths in m."""
        filtered = self.is_filtered(interval_m)
        return {
            "wheels_m": [offset * interval_m for offset in self.offsets(interval_m)],
            "low_pass_m": self.low_pass_m if filtered else None,
        }


CALIFORNIA_LINE = Profilograph()
"""Two wheels 25 ft apart and a low-pass of 2 ft."""


def profilograph_trace(
    elevation: FloatArray, interval_m: float, machine: Profilograph = CALIFORNIA_LINE
) -> FloatArray:
    """Return the height of the recording wheel above the frame in m, one value for each point.

    t_k = s_k − (s_{k+n_1} + … + s_{k+n_W})/W, s the elevation in m through LPF_B3x2 and n_w the
    place of wheel w of W in intervals. Gaps are bridged before; NaN where a wheel is outside the
    measured stretch, and in gaps. Raises InputError for elevations that cannot be used. Source: the
    kinematic model that ASTM E2955 names, by its geometry; the low-pass is LPF_B3x2 of appendix
    A.1, (A.21).
    """
    stretch, road = bridged_stretch(elevation, interval_m)
    smooth = _smooth(road - road[0], interval_m, machine)
    # What was read of a file, or bridged, would stay in memory.
    release(road)
    del road
    offsets = machine.offsets(interval_m)
    window = Window(max(0, -min(offsets)), max(0, max(offsets)))

    def above_frame(part: FloatArray) -> FloatArray:
        end = part.size - window.behind
        frame = sum(part[window.before + n : end + n] for n in offsets) / len(offsets)
        return np.asarray(part[window.before : end] - frame)

    trace = np.full(np.size(elevation), np.nan)
    in_pieces(above_frame, smooth, window, trace[stretch])
    clear_gaps(trace, elevation)
    return trace


def valid_frames(
    elevation: FloatArray,
    interval_m: float,
    machine: Profilograph = CALIFORNIA_LINE,
    valid: ArrayLike | None = None,
) -> BoolArray:
    """Return of which values of `profilograph_trace` all points under the frame are valid.

    Without ``valid``, finite points are valid. Raises InputError unless it has a value for each
    point.
    """
    offsets = machine.offsets(interval_m)
    return sound_points(valid, elevation, max(0, -min(offsets)), max(0, max(offsets)))


def _smooth(rise: FloatArray, interval_m: float, machine: Profilograph) -> FloatArray:
    """Return ``rise`` in m through the low-pass of ``machine``, if that can act, in its place."""
    from floatref.measures.roughness.zero_phase import low_pass_b3x2

    if not machine.is_filtered(interval_m):
        return rise
    return low_pass_b3x2(rise, interval_m, machine.low_pass_m * SIXTH_ORDER, out=rise)
