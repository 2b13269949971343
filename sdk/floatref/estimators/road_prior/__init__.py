"""The road-prior smoother (the road is a process in distance)."""

from floatref.estimators.road_prior.constants import RoadPrior
from floatref.estimators.road_prior.smoother import RoadPriorSmoother

__all__ = ["RoadPrior", "RoadPriorSmoother"]
