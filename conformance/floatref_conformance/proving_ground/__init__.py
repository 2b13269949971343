"""Roads, drives, vehicles and sensors whose truth is known.

A `Scenario` is a few numbers and a seed; `simulate` makes of it a recording, the truth along
the laser's path, and the true motion. Nothing here imports a compiler until it is called.
"""

from floatref_conformance.proving_ground.cache import CachedSimulation, simulate_cached
from floatref_conformance.proving_ground.scenario import Scenario, repeat_passes, scenario_of_run
from floatref_conformance.proving_ground.scenario_file import read_scenario
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.simulate import Simulation, simulate, stationary
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion, TrackMotion

__all__ = [
    "BodyMotion",
    "CachedSimulation",
    "Scenario",
    "SensorSuite",
    "Simulation",
    "TrackMotion",
    "read_scenario",
    "repeat_passes",
    "scenario_of_run",
    "simulate",
    "simulate_cached",
    "stationary",
]
