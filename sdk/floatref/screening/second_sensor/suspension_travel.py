"""Travel of the suspension, and the accelerometers at both of its ends: one measures the others.

The second derivative of the deflection is the acceleration of the body above the wheel less that of
the wheel carrier, whatever the springs. In the band the deflection is therefore their difference,
integrated twice, with a weight of 1 for the body and of -1 for the wheel.
"""

from collections.abc import Iterator

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.fast_series import band
from floatref.screening.second_sensor.fitting import Fit, fit
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import ChannelId

BAND_HZ = (0.8, 5.0)
"""Above the drift of two integrations, below the noise of a potentiometer differentiated twice."""
COHERENT = 0.9
LOUD, SHARE = 4.0, 0.3
"""In a window with more than this number of usual residuals, and more than this share of the usual
motion, one of the sensors measures something else."""
UNUSABLE = 0.3
"""Largest deviation of a weight that is a tolerance, not a wrong unit or sign."""
BODY, WHEEL, TRAVEL = "sprung_specific_force", "unsprung_specific_force", "suspension_deflection"


def fit_travel(
    travel: FloatArray, body: FloatArray, wheel: FloatArray, known: BoolArray
) -> Fit | None:
    """Return the deflection, shape (n,) in m, as a sum of both accelerometers, in m/s²."""
    rows = np.stack([band(each, *BAND_HZ, integrals=2) for each in (body, wheel)])
    return fit(band(travel, *BAND_HZ), rows, known, COHERENT)


def is_consistent(found: Fit | None) -> bool:
    """Return whether deflection and accelerometers measure one motion, each with its scale."""
    if found is None or found.explained < COHERENT:
        return False
    body, wheel = found.weights.tolist()
    return bool(max(abs(body - 1.0), abs(wheel + 1.0)) <= UNUSABLE)


def travel_doubts(track: str, found: Fit | None) -> Iterator[Doubt]:
    """Yield a doubt if a sign or a scale of the three sensors of ``track`` is wrong."""
    if found is None or found.explained < COHERENT or is_consistent(found):
        return
    body, wheel = found.weights.tolist()
    suspect, gain = _wrong(body, wheel)
    name = ChannelId(suspect, track)
    what = (
        "its sign is inverted, multiply changes about rest by -1"
        if gain < 0
        else "correct its unit or scale"
    )
    yield Doubt(
        (name,),
        f"channel {name}: {gain:.3g} times the motion by the suspension's other sensors; {what}",
        True,
    )


def _wrong(body: float, wheel: float) -> tuple[str, float]:
    """Return which of the three is wrong, and its gain: the deflection's is in both weights."""
    if abs(body + wheel) <= UNUSABLE * max(abs(body), abs(wheel)):
        return TRAVEL, body
    if abs(body - 1.0) <= UNUSABLE:
        return WHEEL, -1.0 / wheel
    return BODY, 1.0 / body
