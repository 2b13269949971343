"""The road under a scenario's vehicle, which does not keep exactly to its wheel paths."""

from floatref_conformance.proving_ground.roads.crg import crg_road
from floatref_conformance.proving_ground.roads.files import file_of, is_surface
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.roads.shaping import scale_by
from floatref_conformance.proving_ground.roads.strips import along_line
from floatref_conformance.proving_ground.roads.wander import Line
from floatref_conformance.proving_ground.scenario import Scenario

ALIKE_SIDEWAYS = ("flat", "sines")
"""Roads that are the same on every line: one has nothing, the other known waves."""


def follow_line(
    scenario: Scenario, road: Road, length_m: float, road_seed: int, factor: float
) -> Road:
    """Return the road under the line that ``scenario.seed`` draws, the road itself without wander.

    A measured surface is sampled along the line; every other road gets strips beside its wheel
    paths, drawn from ``road_seed``, so that passes of other seeds drive on the same road.

    Args:
        scenario: whose line it is.
        road: its wheel paths, already scaled.
        length_m: usable length of the road, in m.
        road_seed: drew the road.
        factor: what the road was scaled by.

    Raises:
        InputError: for a surface too narrow for the line, or with a hole under it.
    """
    line = Line(scenario.seed, scenario.wander_m, scenario.wander_within_m)
    if line.is_straight or scenario.road in ALIKE_SIDEWAYS:
        return road
    path = file_of(scenario.road)
    if path is not None and is_surface(path):
        return scale_by(crg_road(path, length_m, line, tracks=scenario.tracks), factor)
    return along_line(road, line, road_seed)
