"""The road under a scenario's vehicle, which does not keep exactly to its wheel paths."""

from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.bridging import bridge
from floatref_conformance.proving_ground.roads.crg import crg_road
from floatref_conformance.proving_ground.roads.files import file_of, is_surface
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.roads.shaping import scale_by
from floatref_conformance.proving_ground.roads.strips import ACROSS_M, along_line, strip_around
from floatref_conformance.proving_ground.roads.surface import Surface
from floatref_conformance.proving_ground.roads.wander import Line
from floatref_conformance.proving_ground.scenario import Scenario

ALIKE_SIDEWAYS = ("flat", "sines")
"""Roads that are the same on every line: one has nothing, the other known waves."""


class Ground(NamedTuple):
    """The road twice: what the tyres roll on, and what the lasers read.

    Of point lasers both are one. A line laser reads the bridged height of its line, in whose
    middle the tyres roll (`roads.bridging`).
    """

    rolled: Road
    read: Road


def line_of(scenario: Scenario) -> Line:
    """Return the line that ``scenario.seed`` draws."""
    return Line(scenario.seed, scenario.wander_m, scenario.wander_within_m)


def follow_line(
    scenario: Scenario, road: Road, length_m: float, road_seed: int, factor: float
) -> Ground:
    """Return the ground under the line that ``scenario.seed`` draws.

    Without wander the tyres roll on the road itself. A measured surface is sampled along the
    line; every other road gets strips beside its wheel paths, drawn from ``road_seed``, so that
    passes of other seeds drive on the same road. Strips are what a line laser reads, too.

    Args:
        scenario: whose line it is.
        road: its wheel paths, already scaled.
        length_m: usable length of the road, in m.
        road_seed: drew the road.
        factor: what the road was scaled by.

    Raises:
        InputError: for a surface too narrow for the line, or with a hole under it.
    """
    line = line_of(scenario)
    width_m = scenario.laser_line_mm / 1000
    if (line.is_straight and width_m == 0) or scenario.road in ALIKE_SIDEWAYS:
        return Ground(road, road)
    path = file_of(scenario.road)
    if path is not None and is_surface(path):
        rolled = road
        if not line.is_straight:
            rolled = scale_by(crg_road(path, length_m, line, tracks=scenario.tracks), factor)
        return Ground(rolled, _read_surface(scenario, rolled, length_m, line, factor))
    if width_m == 0:
        rolled = along_line(road, line, road_seed)
        return Ground(rolled, rolled)
    return read_beside(road, line, road_seed, width_m)


def read_beside(road: Road, line: Line, road_seed: int, width_m: float) -> Ground:
    """Return the ground of a line laser of ``width_m`` in m, whose strips ``road_seed`` draws.

    Raises InputError as `along_line` and `bridge` do.
    """
    y = line.at(road.distance_m)
    reach = float(y.min()) - width_m / 2, float(y.max()) + width_m / 2

    def of(track: str) -> tuple[FloatArray, FloatArray]:
        strip = strip_around(road, track, road_seed, *reach)
        rolled = road.elevation[track] if line.is_straight else strip.line(y)
        return rolled, bridge(strip, y, width_m)

    # Every wheel path draws from a stream of its own, and arrays and kernels let others run.
    with ThreadPoolExecutor(len(road.tracks)) as workers:
        found = dict(zip(road.tracks, workers.map(of, road.tracks), strict=True))
    rolled, read = ({track: both[n] for track, both in found.items()} for n in (0, 1))
    return Ground(road.with_elevation(rolled), road.with_elevation(read))


def _read_surface(
    scenario: Scenario, rolled: Road, length_m: float, line: Line, factor: float
) -> Road:
    """Return what lasers read of a measured surface beside the line that the tyres roll on."""
    width_m = scenario.laser_line_mm / 1000
    path = file_of(scenario.road)
    if width_m == 0 or path is None:
        return rolled
    cells = 2 * int(np.ceil(width_m / 2 / ACROSS_M))
    beside = width_m * (np.arange(cells + 1) / cells - 0.5)
    sides = {
        f"{name} {k}": rolled.lateral_m[name] + y
        for name in rolled.tracks
        for k, y in enumerate(beside)
    }
    strings = crg_road(path, length_m, line, tracks=sides).elevation
    read = {}
    for name in rolled.tracks:
        rows = factor * np.stack([strings[f"{name} {k}"] for k in range(cells + 1)])
        across = Surface(rolled.start_m, rolled.spacing_m, beside[0], width_m / cells, rows)
        height: FloatArray = bridge(across, np.zeros(rolled.points), width_m)
        read[name] = rolled.elevation[name] + height - rows[cells // 2]
    return rolled.with_elevation(read)
