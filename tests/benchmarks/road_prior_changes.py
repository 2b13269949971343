"""What `road_prior_adversities.py` changes: the road before a run, or its recording behind."""

from collections.abc import Callable

import numpy as np

import floatref
from floatref.values.arrays import FloatArray
from floatref_conformance.checks.faults.injection import replace_values
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.roads.shaping import cosine_rise, scale_to
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation
from floatref_conformance.proving_ground.vehicles.parameter_sets import find_vehicle

STOP_M = 316.0
FORCE, HEIGHT = "vertical_specific_force", "height"
IDLE_HZ, REVVING_HZ_PER_MPS = 25.0, 1.0
STEP_M = 2.0
"""One roughness goes over into another within this length."""

RoadChange = Callable[[Road, Scenario], Road]
Change = Callable[[Simulation], floatref.Recording]


def crack(depth_mm: float, width_mm: float = 40.0) -> RoadChange:
    """Return a groove one edge of which lies where the lasers stand, but for the body's pitch."""

    def cut(road: Road, scenario: Scenario) -> Road:
        edge = STOP_M + find_vehicle(scenario.vehicle).sensor_x_m
        inside = np.abs(road.distance_m - edge - width_mm / 2000.0) < width_mm / 2000.0
        return added(road, -1e-3 * depth_mm * inside)

    return cut


def step(before: float, behind: float) -> RoadChange:
    """Return a road whose IRI in m/km is another behind the place where the lasers stand."""

    def scaled(road: Road, scenario: Scenario) -> Road:
        place = STOP_M + find_vehicle(scenario.vehicle).sensor_x_m
        weight = cosine_rise((road.distance_m - place) / STEP_M + 0.5)
        low, high = scale_to(road, before).elevation, scale_to(road, behind).elevation
        slopes = {
            n: np.diff(low[n]) * (1 - weight[1:]) + np.diff(high[n]) * weight[1:] for n in low
        }
        return road.with_elevation({n: np.append(0.0, s.cumsum()) for n, s in slopes.items()})

    return scaled


def texture(rms_mm: float) -> RoadChange:
    """Return a road with so much more of texture, independent every 5 mm."""

    def coarse(road: Road, scenario: Scenario) -> Road:
        rng = np.random.default_rng(scenario.seed)
        heights = {
            name: z + 1e-3 * rms_mm * rng.standard_normal(z.size)
            for name, z in road.elevation.items()
        }
        return road.with_elevation(heights)

    return coarse


def added(road: Road, heights: FloatArray) -> Road:
    """Return ``road`` with ``heights`` in m on every wheel path."""
    return road.with_elevation({name: z + heights for name, z in road.elevation.items()})


def shaking(amplitude: float, moves: bool) -> Change:
    """Return the engine's shake of so many m/s² on the accelerometers.

    If the sensors' whole mount ``moves``, the height sensor follows.
    """

    def shake(simulation: Simulation) -> floatref.Recording:
        motion, recording = simulation.motion, simulation.recording
        phase = 2 * np.pi * (IDLE_HZ * motion.times_s + REVVING_HZ_PER_MPS * motion.distance)
        omega = 2 * np.pi * (IDLE_HZ + REVVING_HZ_PER_MPS * motion.speed)
        swing = amplitude * np.sin(phase)
        recording = with_added(recording, FORCE, swing)
        return with_added(recording, HEIGHT, -swing / omega**2) if moves else recording

    return shake


def bias_step(size: float) -> Change:
    """Return a bias of so many m/s² that is there while the vehicle stands, as of its shake."""

    def stepped(simulation: Simulation) -> floatref.Recording:
        return with_added(simulation.recording, FORCE, size * (simulation.motion.speed == 0.0))

    return stepped


def boarding(sag_mm: float, seconds: float = 1.5) -> Change:
    """Return a body that sags by so much, from a second after the stop on, and stays so."""

    def sagging(simulation: Simulation) -> floatref.Recording:
        motion = simulation.motion
        begin = motion.times_s[np.argmax(motion.speed == 0.0)] + 1.0
        x = np.clip((motion.times_s - begin) / seconds, 0.0, 1.0)
        sag = -1e-3 * sag_mm * (x - np.sin(2 * np.pi * x) / (2 * np.pi))
        moved = -1e-3 * sag_mm * 2 * np.pi / seconds**2 * np.sin(2 * np.pi * x)
        recording = with_added(simulation.recording, FORCE, moved)
        return with_added(recording, HEIGHT, sag)

    return sagging


def with_added(recording: floatref.Recording, name: str, values: FloatArray) -> floatref.Recording:
    """Return ``recording`` with ``values`` added to channel ``name`` of every wheel path."""
    for channel in recording.channels:
        if channel.id.name == name:
            changed = channel.values + values
            recording = replace_values(recording, name, channel.id.track, changed)
    return recording


def injured(fault: str, seconds: float, ahead_m: float = 0.0) -> Change:
    """Return a fault of `SENSOR_FAULTS` that begins ahead of the stop, on every wheel path."""

    def hurt(simulation: Simulation) -> floatref.Recording:
        motion, whole = simulation.motion, simulation.recording
        encoder_m = whole.channel("distance").values[np.argmax(motion.distance >= STOP_M - ahead_m)]
        numbers = {"at_m": float(encoder_m), "length_s": seconds, "fault": fault}
        spoilt = SENSOR_FAULTS[fault](whole, numbers).recording
        if fault.startswith("encoder"):
            return spoilt
        first, *others = whole.tracks
        alike = np.isnan(spoilt.channel(HEIGHT, first).values)
        held = spoilt.channel(HEIGHT, first).values != whole.channel(HEIGHT, first).values
        begin = int(np.argmax(alike | held)) - 1
        for track in others:
            values = np.array(whole.channel(HEIGHT, track).values)
            values[held & ~alike], values[alike] = values[begin], np.nan
            spoilt = replace_values(spoilt, HEIGHT, track, values)
        return spoilt

    return hurt
