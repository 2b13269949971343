"""Levelling: the vertical acceleration by the attitude that an inertial unit measures."""

from floatref.estimators.levelling.level import Level

__all__ = ["Level"]
