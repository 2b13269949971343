"""The pitch of the body from nominal sensors: the half car over the road that they measure."""

from dataclasses import dataclass

import numpy as np

from floatref.estimators.laser_place.band import filter_both_ways, sections_of
from floatref.estimators.laser_place.half_car import PITCH, STATES, Gains, HalfCar
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.axle_setup import AxleSetup
from floatref.values.channels import STANDARD_GRAVITY

SLOW_HZ, FAST_HZ = 0.3, 20.0
"""Frequencies of pitch that are modelled: above the bounce of no body, below its longest swing."""
POINT_M = 0.05
"""Interval of the road under the wheels, a fifth of the IRI's 250 mm."""
SMOOTHED_S = 0.06
"""Standard deviation of the Gaussian that smooths the distance before it is differentiated."""
REACH = 4.0
PASSES = 3
"""The pitch changes the road that makes it by its lever over the wheelbase, at most a fifth; so
three passes leave less than a hundredth."""
LEAST_SAMPLES = 64
LEAST_EXPLAINED = 0.25
"""Least share of the accelerometer's motion that road and brakes have to give the half car. Below
it something else moves the body, as in a bounce test: its pitch is unknown."""
WINDOW_S, SHARED_S = 600.0, 30.0
"""A long run is modelled in windows, so that memory is bounded; each shares its end with the next,
and there one passes into the other."""


@dataclass(frozen=True)
class Places:
    """Where sensors and axles are, in m ahead of one point, and the time between two readings.

    Attributes:
        accelerometer_m: middle of the accelerometers.
        laser_m: middle of the lasers.
        axles: of the vehicle.
        step: in s.
    """

    accelerometer_m: float
    laser_m: float
    axles: AxleSetup
    step: float


def model_pitch(
    force: FloatArray, height: FloatArray, distance: FloatArray, places: Places
) -> FloatArray:
    """Return the pitch in rad, nose up, at every reading, shape (n,).

    All three have shape (n,), NaN where unknown: vertical specific force less 1 g in m/s², the
    laser's height in m and the encoder's distance in m. A run too short or without one of them has
    pitch 0, and so has one in which something else than the road moves the body. Frequencies below
    `SLOW_HZ` are the model's answer to acceleration along the road.
    """
    known = [~np.isnan(x) for x in (force, height, distance)]
    if force.size < LEAST_SAMPLES or any(not each.any() for each in known):
        return np.zeros(force.size)
    force, height, distance = map(_bridge, (force, height, distance), known)
    distance = np.maximum.accumulate(distance)
    found, last = np.empty(force.size), 0
    window, shared = round(WINDOW_S / places.step), round(SHARED_S / places.step)
    for begin in range(0, max(force.size - shared, 1), window):
        end = min(begin + window + shared, force.size)
        part = slice(begin, end)
        pitch = _model_window(force[part], height[part], distance[part], places)
        both = last - begin
        share = np.linspace(0.0, 1.0, max(both, 0))
        pitch[:both] = found[begin:last] + share * (pitch[:both] - found[begin:last])
        found[part], last = pitch, end
    return found


def _model_window(
    force: FloatArray, height: FloatArray, distance: FloatArray, places: Places
) -> FloatArray:
    """Return the pitch of one window, in which nothing is unknown."""
    along = second_derivative(distance, places.step)
    pitch, level = np.zeros(force.size), _Band(places.step)
    car = HalfCar.usual(places.axles, places.accelerometer_m)
    gains = Gains.of(car, places.step)
    height = level.pass_band(height)
    for _ in range(PASSES):
        vertical = force + along * pitch
        road = level.height_of(vertical) - height
        road += (places.laser_m - places.accelerometer_m) * level.pass_band(pitch)
        u, measured = _inputs(road, distance, along, places), level.pass_band(vertical)
        if np.std(_explained(car, gains, u)) < LEAST_EXPLAINED * np.std(measured):
            return np.zeros(force.size)
        pitch = smooth_states(car, gains, u, measured)[:, PITCH]
    return pitch


def _explained(car: HalfCar, gains: Gains, u: FloatArray) -> FloatArray:
    """Return the acceleration in m/s² that road and brakes alone give the body, shape (n,)."""
    from floatref.estimators.laser_place import kernel

    predicted, filtered = np.empty((2, u.shape[0], STATES))
    filtered[0] = car.at_rest(u[0])
    none = np.zeros(STATES)
    model = gains.transition, gains.before, gains.now, none, car.reading, car.direct
    kernel.filter_forward(*model, u, np.zeros(u.shape[0]), predicted, filtered)
    return np.asarray(predicted @ car.reading + u @ car.direct)


def smooth_states(car: HalfCar, gains: Gains, u: FloatArray, force: FloatArray) -> FloatArray:
    """Return the half car's states at all readings, shape (n, 10), from ``u`` of shape (n, 3)."""
    from floatref.estimators.laser_place import kernel

    predicted, filtered = np.empty((2, force.size, STATES))
    filtered[0] = car.at_rest(u[0])
    model = gains.transition, gains.before, gains.now, gains.filter, car.reading, car.direct
    kernel.filter_forward(*model, u, force, predicted, filtered)
    kernel.smooth_backward(gains.smoother, predicted, filtered)
    return filtered


def _inputs(
    road: FloatArray, distance: FloatArray, along: FloatArray, places: Places
) -> FloatArray:
    """Return the road under front and rear axle, and the specific force along it, shape (n, 3).

    ``road`` is the elevation under the laser in time. A place has that of the first reading there.
    """
    points = np.arange(distance[0], distance[-1] + POINT_M, POINT_M)
    first = np.minimum(np.searchsorted(distance, points), road.size - 1)
    ends = places.axles.front_axle_m, places.axles.rear_axle_m
    under = [np.interp(distance + end - places.laser_m, points, road[first]) for end in ends]
    slope = (under[0] - under[1]) / places.axles.wheelbase_m
    return np.stack([*under, along + STANDARD_GRAVITY * slope], axis=1)


def _bridge(x: FloatArray, known: BoolArray) -> FloatArray:
    """Return ``x`` with lines in place of what is unknown."""
    if known.all():
        return x
    places = np.flatnonzero(known)
    return np.interp(np.arange(x.size), places, x[places])


def second_derivative(distance: FloatArray, step: float) -> FloatArray:
    """Return the acceleration in m/s² of a smoothed ``distance``, at a constant speed before it."""
    half = max(2, round(REACH * SMOOTHED_S / step))
    place = np.arange(-half, half + 1) * step
    bell = np.exp(-0.5 * (place / SMOOTHED_S) ** 2)
    weights = bell * (place**2 - (bell @ place**2) / bell.sum())
    weights *= 2.0 / (weights @ place**2)
    steps = np.arange(1, half + 1)
    before = distance[0] - steps[::-1] * (distance[half] - distance[0]) / half
    after = distance[-1] + steps * (distance[-1] - distance[-1 - half]) / half
    return np.asarray(np.convolve(np.concatenate((before, distance, after)), weights, "valid"))


class _Band:
    """Butterworth filters of third order, both ways, between `SLOW_HZ` and `FAST_HZ`."""

    def __init__(self, step: float) -> None:
        self.step = step
        self.slow = sections_of(SLOW_HZ, step, high=True)
        self.fast = sections_of(min(FAST_HZ, 0.4 / step), step, high=False)

    def pass_band(self, x: FloatArray) -> FloatArray:
        """Return ``x`` between both frequencies, filtered as `height_of` does."""
        for _ in range(2):
            x = filter_both_ways(self.slow, x)
        return filter_both_ways(self.fast, x)

    def height_of(self, acceleration: FloatArray) -> FloatArray:
        """Return the second integral of ``acceleration``, less what is slower than the band."""
        x = acceleration - acceleration.mean()
        for _ in range(2):
            x = filter_both_ways(self.slow, np.cumsum(x) * self.step)
        return filter_both_ways(self.fast, x)
