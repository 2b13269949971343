"""The road-prior smoother (the road is a process in distance)."""

from floatref.stages.road_prior.constants import RoadPrior
from floatref.stages.road_prior.smoother import RoadPriorSmoother

__all__ = ["RoadPrior", "RoadPriorSmoother"]
