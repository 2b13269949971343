"""The readings of a vehicle's model in a stream, and the rate at which they are taken."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import sqrt

from floatref.interfaces.pipeline import Context
from floatref.values.channels import ChannelId
from floatref.vehicle_response import Kind, Reading, VehicleModel
from floatref.vehicle_response.needs import (
    DEFLECTION,
    FORCE,
    Motion,
    has_deflection,
    is_there,
    least_rate,
    motions,
    vehicle_model,
)
from floatref.vehicle_response.stages.calculation_rate import POINTS_PER_M, calculation_rate
from floatref.vehicle_response.stages.estimation import drift_sigma
from floatref.vehicle_response.stages.estimators import Group, RoadEstimator

STEPS_PER_HZ = 10
"""Rates are whole multiples of a tenth of a hertz."""

MakeEstimator = Callable[[Context, VehicleModel, Sequence[Reading], float], RoadEstimator]


@dataclass(frozen=True)
class Signal:
    """A channel, its sign in the model's coordinate, and its reading."""

    channel: ChannelId
    sign: float
    reading: Reading


def calculation_rate_of(context: Context) -> Fraction:
    """Return the rate in Hz: ``points_per_m`` at the run's fastest speed, section 4.3 of Zhu.

    At least `SAMPLES_PER_PERIOD` of the model's fastest mode, and at most the stream's own.
    InputError if that is too slow for the model.
    """
    points = context.setting("points_per_m") / POINTS_PER_M
    rate = points * calculation_rate(context.fastest_mps)
    model = vehicle_model(context.header.setup)
    rate = max(rate, least_rate(model, context.header.rate, FORCE))
    if rate >= float(context.header.rate):
        return context.header.rate
    return Fraction(round(STEPS_PER_HZ * rate), STEPS_PER_HZ)


def groups_of(context: Context, make: MakeEstimator) -> tuple[Group, ...]:
    """Return an estimator for every wheel path, or one for all if the model has them all."""
    model = vehicle_model(context.header.setup)
    together = any(tyre.track for tyre in model.tyres)
    tracks = context.header.tracks[:1] if together else context.header.tracks
    return tuple(_group(context, model, track, make) for track in tracks)


def _group(context: Context, model: VehicleModel, track: str, make: MakeEstimator) -> Group:
    found = {m.quantity: m for m in motions(context.header, model)}
    signals = list(_signals(context, model, found, track))
    step_s = float(1 / calculation_rate_of(context))
    density = context.setting("acceleration_density")
    wheels = [model.freedoms[model.index(tyre.freedom)] for tyre in model.tyres]
    return Group(
        model,
        make(context, model, [signal.reading for signal in signals], step_s),
        tuple((signal.channel, signal.sign) for signal in signals),
        tuple(tyre.track or track for tyre in model.tyres),
        tuple(density * found[wheel.quantity].integrated_twice for wheel in wheels),
    )


def _signals(
    context: Context, model: VehicleModel, found: dict[str, Motion], track: str
) -> Iterator[Signal]:
    for freedom in model.freedoms:
        motion, own = found[freedom.quantity], freedom.track or track
        for kind, name in _name_kinds(motion):
            sigma = _sigma(context, motion, kind)
            reading = Reading(kind, freedom.name, sigma)
            yield Signal(ChannelId(name, own), freedom.sign, reading)
    if has_deflection(model) and is_there(context.header, DEFLECTION):
        body, wheel = (freedom.name for freedom in model.freedoms)
        sigma = context.setting("deflection_sigma_m")
        yield Signal(
            ChannelId(DEFLECTION, track), 1.0, Reading(Kind.DISPLACEMENT, body, sigma, wheel)
        )


def _name_kinds(motion: Motion) -> Iterator[tuple[Kind, str]]:
    if motion.placed:
        yield Kind.DISPLACEMENT, motion.displacement_name
    if motion.velocity:
        yield Kind.VELOCITY, motion.velocity_name
    if motion.acceleration:
        yield Kind.ACCELERATION, motion.acceleration_name


def _sigma(context: Context, motion: Motion, kind: Kind) -> float:
    """Return the standard deviation of one sample at the rate of the calculation."""
    prefix = "angular_" if motion.angular else ""
    density = context.setting(f"{prefix}acceleration_density")
    if kind is Kind.ACCELERATION:
        return density * sqrt(calculation_rate_of(context))
    if kind is Kind.VELOCITY:
        return context.setting(f"{prefix}velocity_sigma")
    if motion.integrated_twice:
        cutoff_hz = context.fastest_mps / context.setting("cutoff_wavelength_m")
        return float(drift_sigma(density, cutoff_hz)[()])
    return context.setting(f"{prefix}displacement_sigma")
