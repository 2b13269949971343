"""The golden vector of the Kalman smoother: the literal one of section 6.5, by GNSS throughout."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref_reference.chapter_6.section_6_4_4_tuning import per_step
from floatref_reference.chapter_6.section_6_5_implementation import (
    kalman_filter,
    profile,
    rts_smoother,
    spatial_profile,
)
from floatref_reference.chapter_6.section_6_6_2_gps import gps_observations

Array = NDArray[np.float64]
G = 9.80665
INPUTS = ("longitudinal", "lateral", "vertical", "roll_rate", "pitch_rate", "yaw_rate")
READINGS = ("gnss_height", "gnss_velocity", "gnss_pitch", "gnss_roll")
SETTINGS = {
    "rate_hz": 100.0,
    "interval_m": 0.25,
    "arm_x": 0.8,
    "arm_y": -0.5,
    "arm_z": 1.6,
    "acceleration": 4.65e-5,
    "acceleration_walk": 1e-4,
    "roll_rate": 1.34e-5,
    "pitch_rate": 1.34e-5,
    "yaw_rate": 1.34e-5,
    "roll_rate_walk": 9.27e-6,
    "pitch_rate_walk": 4.86e-4,
    "gnss_height_m": 0.012,
    "gnss_velocity_mps": 0.03,
    "gnss_pitch_rad": 2.09e-3,
    "gnss_roll_rad": 3.49e-3,
}
"""At 100 Hz each sample is a node; the axis does not lean, and the datum of GNSS does not walk."""


def sensors(distance: Array, rate_hz: float) -> dict[str, Array]:
    """Return what sensors read of a body that heaves and pitches over a road, with six decimals."""
    t = np.arange(distance.size) / rate_hz
    omega, turning = 2 * np.pi * 1.3, 2 * np.pi * 0.6
    body, pitch, roll = (
        0.02 * np.sin(omega * t),
        0.01 * np.sin(turning * t),
        0.008 * np.cos(turning * t),
    )
    road = 0.005 * np.sin(2 * np.pi * distance / 3.1) + 0.002 * np.sin(2 * np.pi * distance / 0.9)
    at = np.arange(3, distance.size, 5)
    given = {
        "longitudinal": -G * pitch,
        "lateral": G * roll,
        "vertical": 0.02 + G - omega**2 * body,
        "roll_rate": 0.002 - turning * 0.008 * np.sin(turning * t),
        "pitch_rate": turning * 0.01 * np.cos(turning * t),
        "yaw_rate": 0.03 * np.sin(0.5 * t),
        "height": 0.3 + body - road,
        "gnss_height": (313.9 + body + 0.004 * np.sin(31.0 * t))[at],
        "gnss_velocity": (omega * 0.02 * np.cos(omega * t))[at],
        "gnss_pitch": pitch[at],
        "gnss_roll": roll[at],
    }
    rounded = {name: np.round(x, 6) for name, x in given.items()}
    return {**rounded, "distance": distance, "gnss_at": at}


def elevation(s: Mapping[str, float], i: Mapping[str, Any]) -> Any:
    """Return the elevation of the points."""
    i = {name: np.asarray(x, float) for name, x in i.items()}
    dt, lever = 1 / s["rate_hz"], [s[f"arm_{axis}"] for axis in "xyz"]
    u = np.stack([i[name] for name in INPUTS], axis=1)
    mean = np.vstack([(u[:-1] + u[1:]) / 2, u[-1:]])
    white = [s[name] for name in ("acceleration", "roll_rate", "pitch_rate", "yaw_rate")]
    walks = [s[f"{name}_walk"] for name in ("acceleration", "roll_rate", "pitch_rate")]
    x_0 = np.array([i["height"][0], 0, 0, 0, 0, 0, 0])
    P_0 = np.diag(np.square([1.0, 1.0, 0.1, 0.1, 0.1, 0.01, 0.01]))
    y = np.stack([i[name] for name in READINGS], axis=1)
    y[:, 0] -= y[0, 0] - lever[2] - x_0[0]
    units = ("gnss_height_m", "gnss_velocity_mps", "gnss_pitch_rad", "gnss_roll_rad")
    observe = gps_observations(i["gnss_at"].astype(int), y, [s[name] for name in units])
    noise = per_step((*white, *walks), dt)
    run = kalman_filter(mean, dt, x_0, P_0, noise, observe, lever, u_at=u)
    r_zp = rts_smoother(run)[0][:, 0]
    points = spatial_profile(profile(r_zp, i["height"]), i["distance"], s["interval_m"])
    # To a picometre: the reference inverts in double, and its last digits are the machine's.
    return np.round(points, 12)


def rounded_to_single(i: Mapping[str, Any]) -> dict[str, Array]:
    """Return the inputs of which samples are rounded to single precision, not the places."""
    places = ("distance", "gnss_at", "gnss_height")
    return {name: x if name in places else np.asarray(x, np.float32) for name, x in i.items()}


def vector(distance: Array) -> tuple[str, str, dict[str, float], dict[str, Array], dict[str, Any]]:
    """Return stage, equations, settings, inputs and outputs over a drive at 100 Hz."""
    given = sensors(distance, SETTINGS["rate_hz"])
    outputs = {"elevation": elevation(SETTINGS, given)}
    return "kalman-smoother", "(6.13), (6.17)", SETTINGS, given, outputs
