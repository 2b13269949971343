"""The two estimators of the road, made from the settings of their pipelines."""

from collections.abc import Sequence

from floatref.architectures.question import Question
from floatref.errors import InputError
from floatref.response import Kind, Reading, VehicleModel
from floatref.stages.response.estimators import RoadEstimator, WithPlaces


def observer(
    question: Question, model: VehicleModel, readings: Sequence[Reading], step_s: float
) -> RoadEstimator:
    """Return the observer with unknown inputs, (8) to (15) of Imine, of these readings.

    InputError if a wheel's acceleration is missing, or as `UnknownInputObserver.of`.
    """
    from floatref.response.gains import default_gains
    from floatref.response.observer import UnknownInputObserver

    places = [k for k, r in enumerate(readings) if r.kind is Kind.DISPLACEMENT]
    measured = [readings[k] for k in places]
    wheels = [_acceleration_of(model, readings, tyre.freedom) for tyre in model.tyres]
    gains = default_gains(
        model, measured, question.setting("position_gain_hz"), question.setting("rate_gain_hz")
    )
    sigma = readings[wheels[0]].sigma
    found = UnknownInputObserver.of(model, step_s, gains, measured, sigma)
    return WithPlaces(found, tuple(places), tuple(wheels))


def _acceleration_of(model: VehicleModel, readings: Sequence[Reading], freedom: str) -> int:
    for place, reading in enumerate(readings):
        if reading.kind is Kind.ACCELERATION and reading.freedom == freedom:
            return place
    quantity = model.freedoms[model.index(freedom)].quantity
    raise InputError(
        f"model {model.name}: the observer needs the acceleration of the {freedom}; add its "
        f"channel {quantity}_specific_force"
    )
