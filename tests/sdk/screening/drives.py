"""Drives with an inertial unit and GNSS, changes of their channels, and what is said of them."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

from floatref.screening.gnss_height import gnss_faults
from floatref.screening.imu_and_gnss import ImuUse, check_kinematics
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate

LONG, LAT = "longitudinal_specific_force", "lateral_specific_force"
ROLL, PITCH, YAW = "roll_rate", "pitch_rate", "yaw_rate"
Change = Callable[[Recording], Recording]

BRAKE = {
    "manoeuvre": "stop",
    "event_at_m": 110.0,
    "length_m": 220.0,
    "speed_kmh": 60.0,
    "final_speed_kmh": 45.0,
}
DRIVES: dict[str, dict[str, Any]] = {
    "curve": {**BRAKE, "curvature_per_km": 16.0},
    "hill": {**BRAKE, "grade_percent": 8.0, "vehicle": "trailer"},
    "curve at speed": {"length_m": 220.0, "speed_kmh": 60.0, "curvature_per_km": 16.0},
    "hill at speed": {"length_m": 220.0, "speed_kmh": 60.0, "grade_percent": 8.0,
                      "vehicle": "trailer"},
    "constant": {"length_m": 250.0, "vehicle": "soft-van"},
    "banked": {"length_m": 150.0, "speed_kmh": 30.0, "curvature_per_km": 20.0,
               "cross_slope_percent": -15.0, "vehicle": "pickup"},
    "banked stop": {**BRAKE, "speed_kmh": 40.0, "final_speed_kmh": 40.0, "curvature_per_km": 20.0,
                    "cross_slope_percent": -15.0},
    "quiescent": {"manoeuvre": "quiescent"},
    "bounce": {"manoeuvre": "bounce", "vehicle": "minivan"},
    "perfect": {**BRAKE, "sensors": 0.0},
    "parked, perfect": {"manoeuvre": "quiescent", "sensors": 0.0},
    "level, perfect": {"length_m": 150.0, "road": "flat", "sensors": 0.0},
    "slippery": {**BRAKE, "slip_percent_per_g": 20.0, "deceleration_g": 0.4},
}  # fmt: skip


@cache
def driven(drive: str, seed: int = 0) -> Recording:
    scenario = Scenario.from_dict({**DRIVES[drive], "seed": seed, "rate_hz": 1000.0})
    return simulate(scenario).recording


def warnings_of(
    recording: Recording, *tracks: str, gnss: bool = True, attitude: bool = True
) -> tuple[str, ...]:
    return check_kinematics(recording, ImuUse(tracks, gnss, attitude), gnss_faults(recording))


def each(names: str | tuple[str, ...], change: Callable[[Channel], Channel]) -> Change:
    chosen = (names,) if isinstance(names, str) else names

    def changed(recording: Recording) -> Recording:
        channels = (change(c) if c.id.name in chosen else c for c in recording.channels)
        return replace(recording, channels=tuple(channels))

    return changed
