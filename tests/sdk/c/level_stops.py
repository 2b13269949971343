"""Drawn stops on humps, and fits of them by the C library and by the SDK."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from hypothesis import strategies as st
from scipy.signal import StateSpace, lsim

from floatref.estimators.laser_place.pitching import second_derivative
from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.readings import Drive, Readings
from floatref.estimators.road_slope.rows import Stretch
from floatref.values.channels import STANDARD_GRAVITY

FIELDS = ("force", "missing", "height", "distance", "speed", "along")
"""Of `fr_level_bins` and of `Drive`."""
SETTINGS = {
    "road_m": "road",
    "bends_per_m": "bends",
    "acceleration": "acceleration",
    "missing_acceleration": "missing_acceleration",
    "bias": "bias",
    "walk": "walk",
    "gain": "gain",
    "gain_sigma": "gain_sigma",
    "lean_rad": "lean_rad",
    "lean_sigma_rad": "lean_sigma_rad",
    "pitch_hz": "hz",
    "pitch_damping": "damping",
}
"""From those of C to `SlopeModel`."""


@dataclass(frozen=True)
class Stop:
    """A brake, a standstill and a start, with a hump under the front axle where it stands."""

    seed: int = 0
    step_s: float = 0.01
    speed_mps: float = 15.0
    brake_mps2: float = 3.0
    stood_s: float = 6.0
    hump_m: float = 0.1
    wheelbase_m: float = 3.4
    front_m: float = 4.3
    lever_m: float = 0.0
    unread: float = 0.0
    missing: float = 0.0
    stops: int = 1
    between_s: float = 8.0


STOPS = st.builds(
    Stop,
    seed=st.integers(0, 2**32 - 1),
    step_s=st.sampled_from([0.01, 0.0125, 0.02]),
    speed_mps=st.floats(6.0, 20.0),
    brake_mps2=st.floats(1.5, 4.0),
    stood_s=st.floats(0.5, 15.0),
    hump_m=st.floats(-0.1, 0.15),
    wheelbase_m=st.floats(2.4, 4.0),
    front_m=st.floats(-1.5, 4.5),
    lever_m=st.floats(-0.5, 0.5),
    unread=st.sampled_from([0.0, 0.2]),
    missing=st.sampled_from([0.0, 0.05]),
)


def speeds_of(stop):
    """Return speeds in m/s: travel before each brake and behind each start."""
    fast, longer, between = stop.speed_mps, stop.speed_mps / stop.brake_mps2, stop.between_s
    times = [longer, stop.stood_s, 1.5 * longer, between]
    corners = np.cumsum([0.0, between, *(times * stop.stops)])
    t = np.arange(0.0, corners[-1], stop.step_s)
    return np.interp(t, corners, [fast, fast, *([0.0, 0.0, fast, fast] * stop.stops)])


def follow(road, step, hz, damping, more=0.0):
    """Return how a mass on springs and dampers follows the ``road``; ``more`` is at rest."""
    w = 2 * np.pi * hz
    drive = road + 2 * damping / w * np.gradient(road, step) + more
    body = StateSpace([[0, 1], [-w * w, -2 * damping * w]], [[0], [w * w]], [[1, 0]], [[0]])
    return lsim(body, drive, step * np.arange(road.size), [drive[0], 0.0])[1]


def hump(stop, away_m):
    """Return the elevation ``away_m`` from the top of a hump."""
    return stop.hump_m * np.exp(-np.square(away_m / 8.0))


def drive_of(stop):
    """Return the bins of a stop, with noise as usual sensors have it."""
    rng, step, gravity = np.random.default_rng(stop.seed), stop.step_s, STANDARD_GRAVITY
    speed = speeds_of(stop)
    distance, along = np.cumsum(speed) * step, np.gradient(speed, step)
    ends = stop.front_m, stop.front_m - stop.wheelbase_m, 0.0
    halts = np.flatnonzero(np.diff(1.0 * (speed == 0.0), prepend=0.0) > 0.0)
    tops = distance[halts] + stop.front_m
    roads = [sum(hump(stop, distance + e - top) for top in tops) for e in ends]
    slope = (roads[0] - roads[1]) / stop.wheelbase_m
    pitch = follow(slope, step, 1.5, 0.3, 0.006 * (along + gravity * slope))
    middle_m = 0.5 * (ends[0] + ends[1])
    body = follow(0.5 * (roads[0] + roads[1]), step, 1.35, 0.27)
    accelerometer = body - (middle_m + stop.lever_m) * pitch
    level = np.gradient(np.gradient(accelerometer, step), step) + gravity
    force = level * np.cos(pitch) - along * np.sin(pitch) - gravity
    height = accelerometer + stop.lever_m * pitch + 0.3 - roads[2]
    noise, texture = rng.normal(size=(2, speed.size)) * [[2e-3], [1e-4]]
    unread = rng.uniform(size=speed.size) < stop.unread
    return Drive(
        force=force + noise,
        missing=(rng.uniform(size=speed.size) < stop.missing).astype(float),
        height=np.where(unread, np.nan, height + texture),
        distance=distance,
        speed=np.gradient(distance, step),
        along=second_derivative(distance, step),
        lost=np.zeros(speed.size, bool),
        step=step,
    )


class Fitted(NamedTuple):
    """What `fr_level_fit` gives."""

    status: str
    result: object
    pitch: np.ndarray
    sigma_m: np.ndarray
    memory: np.ndarray


def config_of(library, stop, **settings):
    front_m = stop.front_m
    axles = {"front_m": front_m, "rear_m": front_m - stop.wheelbase_m, "lever_m": stop.lever_m}
    return library.config("level_fit", **{"step_s": stop.step_s, **axles, **settings})


def bins_of(library, drive, pieces):
    """Return the bins of ``pieces`` as a struct, and the arrays that it points to."""
    at = np.concatenate([np.arange(p.start, p.stop) for p in pieces]).astype(np.int64)
    arrays = {name: np.ascontiguousarray(getattr(drive, name)[at], float) for name in FIELDS}
    bins = library.ffi.new("fr_level_bins *", {"count": at.size})
    bins.number = library.ffi.cast("int64_t *", at.ctypes.data)
    for name, values in arrays.items():
        setattr(bins, name, library.ffi.cast("double *", values.ctypes.data))
    return bins, {"number": at, **arrays}


def fit_in_c(library, config, bins, dirt=0, offset=0):
    """Fit ``bins`` in memory that is full of ``dirt``, ``offset`` words from its begin."""
    ffi, size = library.ffi, library.lib.fr_level_fit_size(config)
    memory = np.full(size // 8 + offset, dirt, np.uint64)
    address = ffi.cast("void *", memory.ctypes.data + 8 * offset)
    result, written = ffi.new("fr_level_result *"), ffi.new("size_t *")
    pitch, sigma = np.full((2, bins.count), np.nan)
    room = [ffi.cast("double *", each.ctypes.data) for each in (pitch, sigma)]
    status = library.lib.fr_level_fit(
        config, address, size, bins, result, *room, pitch.size, written
    )
    return Fitted(library.status[status], result, pitch, sigma, memory)


def stretch_of(config, drive, pieces):
    """Return the stretch of the SDK with the settings of C."""
    model = SlopeModel(**{theirs: getattr(config, ours) for ours, theirs in SETTINGS.items()})
    places = Places(config.front_m, config.rear_m, config.lever_m)
    return Stretch(Readings.of(drive, pieces, model.interval_s), places, model)
