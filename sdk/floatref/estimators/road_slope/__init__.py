"""The pitch of the body through a stop, from the slope under its wheels.

docs/road-prior-slope.md has the equations; `floatref_reference.road_slope` the literal reference.
"""

from floatref.estimators.road_slope.stage import LevelByRoad
from floatref.estimators.road_slope.triggered import AddRoad, LevelTriggered

__all__ = ["AddRoad", "LevelByRoad", "LevelTriggered"]
