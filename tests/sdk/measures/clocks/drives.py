"""Short drives of one wheel path with nominal sensors, each simulated once."""

from functools import cache

from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate


@cache
def driven(
    manoeuvre: str, vehicle: str, seed: int, stops: int = 1, laser_ahead_m: float = 0.0
) -> Recording:
    return simulate(
        Scenario(
            seed=seed,
            manoeuvre=manoeuvre,
            vehicle=vehicle,
            speed_kmh=4.0 if manoeuvre == "creeping" else 50.0,
            final_speed_kmh=40.0,
            dwell_s=2.0,
            event_at_m=100.0,
            stops=stops,
            stop_spacing_m=120.0,
            length_m=200.0 + 120.0 * (stops - 1),
            laser_ahead_m=laser_ahead_m,
            rate_hz=4000.0,
            tracks=("left",),
            imu=False,
            gnss=False,
        )
    ).recording


def parts(recording: Recording) -> tuple[Channel, Channel, Channel]:
    names = ("vertical_specific_force", "height", "distance")
    force, height, distance = (recording.channel(name, "left") for name in names)
    return force, height, distance
