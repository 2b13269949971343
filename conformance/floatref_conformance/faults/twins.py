"""Healthy recordings with the samples of a fault: why no recording can show it.

A laser reads a line of 0.1 m or less; the tyres roll beside it or on more than it. An overlay
whose edge runs between them, a rut or a patch raise or lower what the laser reads by some
centimetres and leave the tyres alone. A sensor that adds as much to its range, over the same length
of road, has the same samples, and so have all other sensors.
"""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.recording import Recording
from floatref_conformance.faults.fault_list import find_fault
from floatref_conformance.faults.placing import ours
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.simulate import Simulation, simulate
from floatref_conformance.proving_ground.staging import ground_of
from floatref_conformance.proving_ground.tracking import Ground

HEIGHT = "height"


SIGMAS = 4.0
"""Two samples agree if they differ by less than this number of the sensor's 1-sigma."""


@dataclass(frozen=True, eq=False)
class Twin:
    """A faulty recording, the healthy one with its samples, and how far apart they are.

    Attributes:
        faulty: with the fault.
        healthy: the same vehicle, drive and sensors on the other road, with its truth.
        differ: the share of the laser's samples that differ by more than its noise.
    """

    faulty: Recording
    healthy: Simulation
    differ: float


def make_twin(scenario: Scenario, fault: str) -> Twin:
    """Return the twin of ``fault``, one that adds to the laser's range, in ``scenario``."""
    plain = simulate(scenario)
    faulty = find_fault(fault).damage(plain.recording)
    track = str(ours(faulty, HEIGHT).track)
    before, behind = (r.channel(HEIGHT, track).values for r in (plain.recording, faulty))
    road = ground_of(scenario, scenario.length_m).rolled
    read = _lower(road, track, _footprint_m(plain, track), behind - before)
    healthy = simulate(scenario, Ground(road, read))
    off = np.abs(healthy.recording.channel(HEIGHT, track).values - behind)
    return Twin(faulty, healthy, float(np.mean(off > SIGMAS * SensorSuite().range_noise_m)))


def _footprint_m(made: Simulation, track: str) -> FloatArray:
    """Return the place of the laser's footprint on the road at every sample, in m."""
    sensors = made.recording.setup.tracks[track]
    ahead_m = sensors.reference_point_m[0] + sensors.laser_offset_m[0]
    return np.asarray(made.motion.distance + ahead_m)


def _lower(road: Road, track: str, place_m: FloatArray, added: FloatArray) -> Road:
    """Return ``road`` with one wheel path lower by what is ``added`` to the range there."""
    moving = np.append(True, np.diff(np.maximum.accumulate(place_m)) > 0)
    lowered = np.interp(road.distance_m, place_m[moving], added[moving])
    elevation = dict(road.elevation)
    elevation[track] = elevation[track] - lowered
    return road.with_elevation(elevation)
