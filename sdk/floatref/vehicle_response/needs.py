"""The channels that the response architecture needs to measure its vehicle's model."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from floatref.errors import InputError
from floatref.interfaces.pipeline import Context
from floatref.values.block import Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref.values.needs import Needs, tracks_with
from floatref.values.recording import Recording, Setup
from floatref.vehicle_response import VehicleModel, model_of, state_space

SAMPLES_PER_PERIOD = 8.0
"""Least samples per period of the model's fastest mode, so that the hold of a force is right."""
LEAST_SINK_M, MOST_SINK_M = 2e-4, 0.5
"""Range of the tyre deflection of any vehicle under its weight, in m."""

MOST = {"contact_m": 2.0, "denoise_window_s": 5.0}
"""Largest values; the memory of a window grows with the square of its length."""


def short(context: Context, name: str) -> float:
    """Return setting ``name``, one of `MOST`; InputError if it is above the limit there."""
    value = context.setting(name)
    if value > MOST[name]:
        unit = name.rpartition("_")[2]
        raise InputError(f"setting {name} is {value:g}; give it in {unit}, up to {MOST[name]:g}")
    return value


def check_sink(model: VehicleModel) -> None:
    """Raise InputError if the tyres of ``model`` deflect by almost nothing, or by half a metre.

    A stiffness in kN/m, or a mass in t, is off by a thousand, and so would be the elevation.
    """
    heights = [k for k, freedom in enumerate(model.freedoms) if not freedom.angular]
    mass_kg = float(model.mass[heights, heights].sum())
    stiffness = sum(tyre.stiffness for tyre in model.tyres)
    sink_m = mass_kg * STANDARD_GRAVITY / stiffness
    if not LEAST_SINK_M <= sink_m <= MOST_SINK_M:
        raise InputError(
            f"model {model.name}: under {mass_kg:.4g} kg tyres of {stiffness:.4g} N/m deflect by "
            f"{sink_m:.3g} m, which is impossible; give masses in kg and stiffnesses in N/m"
        )


def fastest_mode_hz(model: VehicleModel) -> float:
    """Return the highest frequency in Hz at which ``model`` swings freely."""
    modes = np.linalg.eigvals(state_space(model)[0])
    return float(np.abs(modes.imag).max()) / (2.0 * np.pi)


def least_rate(model: VehicleModel, rate: Fraction, sensor: str) -> float:
    """Return the lowest rate in Hz that follows ``model``; InputError if ``rate`` is below.

    ``sensor`` is the channel that is sampled at ``rate``, in Hz.
    """
    mode_hz = fastest_mode_hz(model)
    least = SAMPLES_PER_PERIOD * mode_hz
    if rate < least:
        raise InputError(
            f"channel {sensor}: {float(rate):.6g} samples per second, but by the parameters of "
            f"model {model.name} the vehicle swings at {mode_hz:.3g} Hz, which needs {least:.0f} "
            "or more; record it faster, or check the parameters"
        )
    return least


FORCE = "unsprung_specific_force"
"""The accelerometer whose clock is that of the blocks."""
DEFLECTION = "suspension_deflection"
EXAMPLE = (
    '"vehicle": {"model": "quarter-car", "x_m": 0, "parameters": {"sprung_kg": ..., '
    '"unsprung_kg": ..., "suspension_n_per_m": ..., "suspension_ns_per_m": ..., '
    '"tyre_n_per_m": ...}}'
)


@dataclass(frozen=True)
class Motion:
    """The measurements of the freedoms of one ``quantity``, with the names of their channels.

    ``acceleration``, ``velocity`` and ``displacement`` are true if such a channel exists.
    """

    quantity: str
    angular: bool
    acceleration: bool = False
    velocity: bool = False
    displacement: bool = False

    @property
    def force_name(self) -> str:
        """The recording's channel of its acceleration: a specific force if it is a height."""
        return self.acceleration_name if self.angular else f"{self.quantity}_specific_force"

    @property
    def acceleration_name(self) -> str:
        """The signal of its acceleration, 1 g removed."""
        return f"{self.quantity}_acceleration"

    @property
    def velocity_name(self) -> str:
        """The channel of its velocity."""
        return f"{self.quantity}_{'rate' if self.angular else 'velocity'}"

    @property
    def integral_name(self) -> str:
        """The signal of a velocity that is integrated from its acceleration."""
        return f"{self.quantity}_integral"

    @property
    def displacement_name(self) -> str:
        """The channel, or the signal, of its displacement."""
        return f"{self.quantity}_{'angle' if self.angular else 'displacement'}"

    @property
    def integrated_twice(self) -> bool:
        """Whether its displacement comes from its acceleration."""
        return self.acceleration and not self.velocity and not self.displacement

    @property
    def integrated_once(self) -> bool:
        """Whether its displacement comes from its velocity."""
        return self.velocity and not self.displacement

    @property
    def placed(self) -> bool:
        """Whether there is a displacement, measured or integrated."""
        return self.acceleration or self.velocity or self.displacement


def vehicle_model(setup: Setup) -> VehicleModel:
    """Return the model of the vehicle; InputError without a setup of it, or as `model_of`."""
    if setup.vehicle is None:
        raise InputError(
            "setup.vehicle: missing, and without a height sensor the road comes from the vehicle's "
            f"response through its model; add {EXAMPLE} to the setup in recording.json"
        )
    return model_of(setup.vehicle)


def response_needs(recording: Recording) -> Needs:
    """Return the channels that measure the freedoms of the vehicle's model, of its wheel paths.

    InputError as `vehicle_model` and `check_sink`, or if no wheel path has an
    `unsprung_specific_force`.
    """
    model = vehicle_model(recording.setup)
    check_sink(model)
    named = tuple(dict.fromkeys(tyre.track for tyre in model.tyres if tyre.track))
    others = {
        name
        for motion in _motions(model)
        for name in (motion.force_name, motion.velocity_name, motion.displacement_name)
    }
    if has_deflection(model):
        others.add(DEFLECTION)
    return Needs(named or tracks_with(recording, FORCE), FORCE, tuple(sorted(others - {FORCE})))


def motions(header: Header, model: VehicleModel) -> tuple[Motion, ...]:
    """Return the measurements of the freedoms of ``model``, of every wheel path, in ``header``."""
    return tuple(
        Motion(
            motion.quantity,
            motion.angular,
            is_there(header, motion.force_name),
            is_there(header, motion.velocity_name),
            is_there(header, motion.displacement_name),
        )
        for motion in _motions(model)
    )


def has_deflection(model: VehicleModel) -> bool:
    """Return whether ``model`` is of one wheel, so that a deflection is body minus wheel."""
    return [freedom.quantity for freedom in model.freedoms] == ["sprung", "unsprung"]


def is_there(header: Header, name: str) -> bool:
    """Return whether every wheel path has channel ``name``."""
    return all(ChannelId(name, track) in header.channels for track in header.tracks)


def _motions(model: VehicleModel) -> tuple[Motion, ...]:
    quantities = dict.fromkeys((f.quantity, f.angular) for f in model.freedoms)
    return tuple(Motion(quantity, angular) for quantity, angular in quantities)
