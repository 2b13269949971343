"""Stops from triggered samples: what the road does to the body, and the road itself."""

from floatref.estimators.road_slope.triggered.add_road import AddRoad
from floatref.estimators.road_slope.triggered.stage import LevelTriggered

__all__ = ["AddRoad", "LevelTriggered"]
