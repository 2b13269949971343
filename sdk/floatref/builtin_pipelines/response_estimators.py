"""The two estimators of the road, made from the settings of their pipelines."""

from collections.abc import Sequence
from dataclasses import replace
from math import hypot

import numpy as np

from floatref.errors import InputError
from floatref.interfaces.pipeline import Context
from floatref.vehicle_response import Hold, Kind, Reading, VehicleModel
from floatref.vehicle_response.stages.estimators import RoadEstimator, WithPlaces

INITIAL_M, INITIAL_MPS = 0.01, 0.1
"""Initial 1-σ of displacements in m or rad and of velocities in m/s or rad/s."""
LASTING_S = 0.1
"""Duration in s of a force of pitch and roll on the body: a quarter of their period."""


def joint_filter(
    context: Context, model: VehicleModel, readings: Sequence[Reading], step_s: float
) -> RoadEstimator:
    """Return the joint input-state filter, steps (a) to (c) of Zhu, of these readings.

    ``body_disturbance``, a in m/s² and rad/s², acts on every freedom without a tyre: motion that
    the model omits, as a quarter car omits pitch and roll. Velocities walk by a²·τ·dt in a step, τ
    = `LASTING_S`, and their accelerations are off by a. InputError as `JointInputState.of`.
    """
    from floatref.vehicle_response.estimators.joint_filter import JointInputState

    wheels = {tyre.freedom for tyre in model.tyres}
    off = np.array([freedom.name not in wheels for freedom in model.freedoms], dtype=np.float64)
    a = off * context.setting("body_disturbance")
    disturbance = np.concatenate((a**2 * step_s**4 / 4.0, a**2 * LASTING_S * step_s))
    initial = np.repeat([INITIAL_M**2, INITIAL_MPS**2], len(model.freedoms))
    known = [_disturb(reading, a[model.index(reading.freedom)]) for reading in readings]
    return JointInputState.of(model, known, step_s, disturbance, initial, Hold.FIRST_ORDER)


def observer(
    context: Context, model: VehicleModel, readings: Sequence[Reading], step_s: float
) -> RoadEstimator:
    """Return the observer with unknown inputs, (8) to (15) of Imine, of these readings.

    InputError if a wheel's acceleration is missing, or as `UnknownInputObserver.of`.
    """
    from floatref.vehicle_response.estimators.gains import default_gains
    from floatref.vehicle_response.estimators.observer import UnknownInputObserver

    places = [k for k, r in enumerate(readings) if r.kind is Kind.DISPLACEMENT]
    measured = [readings[k] for k in places]
    wheels = [_acceleration_of(model, readings, tyre.freedom) for tyre in model.tyres]
    gains = default_gains(
        model, measured, context.setting("position_gain_hz"), context.setting("rate_gain_hz")
    )
    sigma = readings[wheels[0]].sigma
    found = UnknownInputObserver.of(model, step_s, gains, measured, sigma)
    return WithPlaces(found, tuple(places), tuple(wheels))


def _disturb(reading: Reading, acceleration: float) -> Reading:
    """Return ``reading`` with the ``acceleration`` that its freedom's equation omits."""
    if reading.kind is not Kind.ACCELERATION:
        return reading
    return replace(reading, sigma=hypot(reading.sigma, acceleration))


def _acceleration_of(model: VehicleModel, readings: Sequence[Reading], freedom: str) -> int:
    for place, reading in enumerate(readings):
        if reading.kind is Kind.ACCELERATION and reading.freedom == freedom:
            return place
    quantity = model.freedoms[model.index(freedom)].quantity
    raise InputError(
        f"model {model.name}: the observer needs the acceleration of the {freedom}; add its "
        f"channel {quantity}_specific_force"
    )
