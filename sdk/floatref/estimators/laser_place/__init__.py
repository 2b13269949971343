"""The laser that is not under its accelerometer: its height carried there by the body's pitch."""

from floatref.estimators.laser_place.by_attitude import HeightByAttitude
from floatref.estimators.laser_place.by_model import HeightByModel

__all__ = ["HeightByAttitude", "HeightByModel"]
