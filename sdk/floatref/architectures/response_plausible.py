"""Whether a model can be a vehicle, its wheels are sampled fast enough, and settings are sane."""

from fractions import Fraction

import numpy as np

from floatref.architectures.pipeline import Context
from floatref.errors import InputError
from floatref.response import VehicleModel, state_space
from floatref.values.channels import STANDARD_GRAVITY

SAMPLES_PER_PERIOD = 8.0
"""At the model's fastest mode; with fewer the force on a tyre is not what it is between samples."""
LEAST_SINK_M, MOST_SINK_M = 2e-4, 0.5
"""What tyres of any vehicle give way under its weight lies between these, in m."""

MOST = {"contact_m": 2.0, "denoise_window_s": 5.0}
"""No tyre levels the road over more; a longer window takes a memory that grows with its square."""


def short(context: Context, name: str) -> float:
    """Return setting ``name``, one of `MOST`; InputError if it is above what that has for it."""
    value = context.setting(name)
    if value > MOST[name]:
        unit = name.rpartition("_")[2]
        raise InputError(f"setting {name} is {value:g}; give it in {unit}, up to {MOST[name]:g}")
    return value


def check_sink(model: VehicleModel) -> None:
    """Raise InputError if the tyres would hardly give way under ``model``, or by half a metre.

    A stiffness in kN/m, or a mass in t, is off by a thousand, and so would be the elevation.
    """
    heights = [k for k, freedom in enumerate(model.freedoms) if not freedom.angular]
    mass_kg = float(model.mass[heights, heights].sum())
    stiffness = sum(tyre.stiffness for tyre in model.tyres)
    sink_m = mass_kg * STANDARD_GRAVITY / stiffness
    if not LEAST_SINK_M <= sink_m <= MOST_SINK_M:
        raise InputError(
            f"model {model.name}: under {mass_kg:.4g} kg tyres of {stiffness:.4g} N/m give way by "
            f"{sink_m:.3g} m, which no vehicle's do; give masses in kg and stiffnesses in N/m"
        )


def fastest_mode_hz(model: VehicleModel) -> float:
    """Return the highest frequency in Hz at which ``model`` swings by itself."""
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
