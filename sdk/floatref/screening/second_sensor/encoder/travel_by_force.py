"""The encoder's acceleration against the longitudinal force: lag and scale, where a vehicle brakes.

Along body X an accelerometer measures the rate of the travel speed, and gravity's share by grade
and pitch. A grade changes slowly and a body pitches by a degree per 0.2 g, so that in a brake both
have one shape, within a tenth.
"""

from collections.abc import Iterator

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.fast_series import FastGrid, series_of, shared_grid
from floatref.values.arrays import FloatArray
from floatref.values.recording import Channel, Recording

ALONG, DISTANCE = "longitudinal_specific_force", "distance"
STEPS = 20
"""Steps of the grid in a mean: 0.1 s."""
APART_S = 0.1
SMOOTH = 10
"""Number of means, 1 s, over which accelerations are averaged: an encoder's second derivative."""
LONGEST = 50
"""Largest lag that is searched, in means: 5 s."""
LATE_S = 0.3
"""Smallest lag in s that is reported: a brake of 0.2 g builds up within it."""
BRAKES = 0.5
"""Root mean square of the force's changes in m/s² that shows a lag."""
ALIKE, SHARPER = 0.9, 3.0
"""Least correlation at the lag, and how many times farther from 1 it is without."""
UNUSABLE = 0.5
"""Deviation of the ratio from 1 that pitch (0.1), grade and slip do not make."""


def force_doubts(recording: Recording) -> Iterator[Doubt]:
    """Yield a doubt if the encoder speeds up at other times than the vehicle, or much more."""
    track = recording.tracks[0]
    encoder, along = recording.find(DISTANCE, track), recording.find(ALONG, track)
    if encoder is None or along is None:
        return
    series = accelerations(encoder, along)
    if series is None or float(np.std(series[1])) < BRAKES:
        return
    counted, felt = series
    if counted.size < 4 * LONGEST:
        return
    alike = {lag: _correlate(counted, felt, lag) for lag in range(-LONGEST, LONGEST + 1)}
    best = max(alike, key=alike.__getitem__)
    if alike[best] < ALIKE:
        return
    late_s = best * APART_S
    if abs(late_s) >= LATE_S and 1.0 - alike[0] >= SHARPER * (1.0 - alike[best]):
        yield _late(encoder, late_s)
        return
    inside = slice(LONGEST, -LONGEST)
    ratio = float(np.std(counted[inside]) / np.std(felt[inside]))
    if abs(ratio - 1.0) > UNUSABLE:
        yield _scaled(encoder, ratio)


def accelerations(encoder: Channel, along: Channel) -> tuple[FloatArray, FloatArray] | None:
    """Return both accelerations, means over 1 s every `APART_S`; None if a sample is missing."""
    grid = shared_grid([encoder, along])
    grid = FastGrid(grid.begin_s, grid.count // STEPS * STEPS)
    if grid.count < 4 * STEPS * SMOOTH:
        return None
    places, felt = (
        series_of(channel, grid).reshape(-1, STEPS).mean(axis=1) for channel in (encoder, along)
    )
    box = np.ones(SMOOTH) / SMOOTH
    speed = np.gradient(places, APART_S)
    counted = np.convolve(np.gradient(np.convolve(speed, box, "valid"), APART_S), box, "valid")
    smooth = np.convolve(np.convolve(felt, box, "valid"), box, "valid")
    known = np.isfinite(counted).all() and np.isfinite(smooth).all()
    return (counted, smooth) if known else None


def _correlate(counted: FloatArray, felt: FloatArray, lag: int) -> float:
    """Return the correlation of ``counted``, taken ``lag`` means later, with ``felt``.

    All lags are compared over one part of ``felt``.
    """
    late = counted[LONGEST + lag : counted.size - LONGEST + lag]
    true = felt[LONGEST : felt.size - LONGEST]
    sizes = float(np.std(late) * np.std(true))
    return float(np.mean((late - late.mean()) * (true - true.mean()))) / max(sizes, 1e-12)


def _late(encoder: Channel, late_s: float) -> Doubt:
    side = "later" if late_s > 0 else "earlier"
    return Doubt(
        (encoder.id,),
        f"channel {encoder.id}: {abs(late_s):.1f} s {side} than the brakes that {ALONG} shows; "
        "correct its start_s or its clock",
    )


def _scaled(encoder: Channel, ratio: float) -> Doubt:
    return Doubt(
        (encoder.id,),
        f"channel {encoder.id}: {ratio:.3g} times the acceleration that {ALONG} shows; correct its "
        "unit, or that of the accelerometer",
    )
